// What a step or a birth has put behind a sheet comes back to its side: the whole body moves along the sheet's
// normal, until the inner points of its pieces (sides.hpp) are where they came from. Contacts and sweeps do all they
// can first. What they cannot: shells that are thinner than one step's error, what a heap presses, what is born a
// millimetre deep.
#include <algorithm>

#include "engine/bullet/bullet_world.hpp"
#include "engine/bullet/sides.hpp"
#include "engine/rigid_allocations.hpp"

namespace cullet::bullet {
namespace {

constexpr uint32_t kBodiesAJob = 64;
// A corner takes two moves, a narrow one more, each shorter than the one before. What is not out after so many goes
// back to where the step began.
constexpr int kMoves = 6;
// What is new has nowhere to go back to. A groove of 20 degrees takes two of three of these.
constexpr int kFirstMoves = 100;

btTransform where_it_stood(const Body& body) {
    return body.has_offset ? body.fresh_at * body.hull_offset.inverse() : body.fresh_at;
}

Box way_box(const Body& body, const btTransform& hulls_now) {
    Box box = body.shape.box;
    for (int k = 0; k < 8; ++k) {
        const Box& local = body.local_box;
        const btVector3 corner(k & 1 ? local.high.x : local.low.x, k & 2 ? local.high.y : local.low.y,
                               k & 4 ? local.high.z : local.low.z);
        include(box, from_bullet(hulls_now * corner));
    }
    return box;
}

// Holds way_box(), for a third of its cost: most of a heap is near no sheet.
Box box_about_way(const Body& body, const btTransform& hulls_now) {
    const Vec3 middle = from_bullet(hulls_now * to_bullet(0.5f * (body.local_box.low + body.local_box.high))),
               rounding = 1e-5f * Vec3{std::fabs(middle.x), std::fabs(middle.y), std::fabs(middle.z)};
    const float far = 0.5001f * length(body.local_box.high - body.local_box.low);
    const Vec3 half = rounding + Vec3{far, far, far};
    Box box = body.shape.box;
    include(box, middle - half), include(box, middle + half);
    return box;
}

bool has_triangles_near(const StaticMesh& mesh, const Box& box) {
    bool is_any = false;
    visit_triangles(mesh, box, [&](uint32_t) { is_any = true; });
    return is_any;
}

void keep_deepest(const Crossing& found, Vec3 place, uint32_t mesh, BulletWorld::PutThrough& deepest) {
    if (found.share > 1 || !(found.depth > deepest.depth)) return;
    deepest = {found.depth, found.normal, place, mesh};
}

}  // namespace

// The deepest of a body's pieces on its way from where it stood. The tree names bodies in any order.
BulletWorld::PutThrough BulletWorld::find_put_through(const Body& body) const {
    PutThrough deepest;
    const btTransform now = body.hulls_at(body.bullet->getWorldTransform());
    bool is_near = false;
    visit_meshes(body, box_about_way(body, now), [&](const Body&) { is_near = true; });
    if (!is_near) return deepest;
    const Mat3 rotation = rotation_of(now), stood = rotation_of(body.fresh_at);
    const Vec3 origin = from_bullet(now.getOrigin()), stood_at = from_bullet(body.fresh_at.getOrigin());
    const Box box = way_box(body, now);
    visit_meshes(body, box, [&](const Body& other) {
        if (!has_triangles_near(*other.mesh, box)) return;
        PutThrough here;
        for (const Hull* hull = body.hulls; hull; hull = hull->next) {
            const Vec3 from = inner_point(*hull, stood, stood_at), to = inner_point(*hull, rotation, origin);
            keep_deepest(first_crossing(*other.mesh, from, to, clearance_at(to)), to, other.id, here);
        }
        if (here.depth > deepest.depth || (here.depth == deepest.depth && here.mesh < deepest.mesh)) deepest = here;
    });
    return deepest;
}

void BulletWorld::move_by(Body& body, Vec3 way) {
    btTransform moved = body.bullet->getWorldTransform();
    moved.setOrigin(moved.getOrigin() + to_bullet(way));
    body.bullet->proceedToTransform(moved);
}

// As a blow without restitution: the sheet takes the speed that led through it.
void BulletWorld::stop_at_sheet(Body& body, const PutThrough& put) {
    const float closing = -dot(velocity_at(body, put.place), put.normal);
    if (!(closing > 0) || !body.is_free()) return;
    const btVector3 along = to_bullet(put.normal), arm = to_bullet(put.place) - body.bullet->getCenterOfMassPosition(),
                    lever = arm.cross(along);
    const float give = body.bullet->getInvMass() + lever.dot(body.bullet->getInvInertiaTensorWorld() * lever);
    const btVector3 impulse = closing / give * along;
    body.bullet->applyImpulse(impulse, arm);
    to_static_ -= Vec3d(from_bullet(impulse));
}

void BulletWorld::bring_back(Body& body) {
    const Vec3 from = from_bullet(body.bullet->getCenterOfMassPosition());
    bool is_back = false;
    for (int move = 0; move < kMoves && !is_back; ++move) {
        const PutThrough put = find_put_through(body);
        is_back = !(put.depth > 0);
        if (is_back) break;
        move_by(body, put.depth * put.normal);
        stop_at_sheet(body, put);
    }
    if (!is_back && find_put_through(body).depth > 0) body.bullet->proceedToTransform(where_it_stood(body));
    if (CULLET_CHECKS_ON) {
        const Vec3 way = from_bullet(body.bullet->getCenterOfMassPosition()) - from;
        work_done_.lifted -= static_cast<double>(body.mass) * static_cast<double>(dot(from_bullet(gravity_), way));
    }
}

// After the step: who was put through is found on all threads, each of them is brought back by itself, in rising ids,
// because the sums of what the ground takes are in that order.
void BulletWorld::bring_all_back() {
    if (mesh_count_ == 0) return;
    scratches_.run((body_end_ + kBodiesAJob - 1) / kBodiesAJob, [this](uint32_t job, PairScratch&) {
        const RigidId end = std::min(body_end_, (job + 1) * kBodiesAJob);
        for (RigidId id = job * kBodiesAJob; id < end; ++id) {
            Body& body = bodies_[id];
            body.is_put_through = body.is_used && body.is_free() && !body.is_soft && find_put_through(body).depth > 0;
        }
    });
    for (RigidId id = 0; id < body_end_; ++id)
        if (bodies_[id].is_put_through) bring_back(bodies_[id]);
}

// Of all its pieces, where they stand.
void BulletWorld::list_inner_points(const Body& body) {
    inner_points_.clear();
    inner_reach_ = 0;
    if (mesh_count_ == 0) return;
    for (const Hull* hull = body.hulls; hull; hull = hull->next) {
        inner_points_.push_back(inner_point(*hull, body.fresh_at));
        inner_reach_ = std::max(inner_reach_, hull->radius + hull->margin);
    }
}

namespace {

Vec3 nearest_of(std::span<const Vec3> points, Vec3 place) {
    Vec3 nearest;
    float least = kFar;
    for (const Vec3 point : points) {
        const Vec3 way = point - place;
        if (dot(way, way) < least) least = dot(way, way), nearest = point;
    }
    return nearest;
}

}  // namespace

// A piece that has come off is on the side of the piece of its parent that was nearest.
BulletWorld::PutThrough BulletWorld::find_born_through(const Body& body) const {
    PutThrough deepest;
    visit_meshes(body, grown(body.shape.box, inner_reach_), [&](const Body& other) {
        PutThrough here;
        for (const Hull* hull = body.hulls; hull; hull = hull->next) {
            const Vec3 to = inner_point(*hull, body.fresh_at);
            if (!has_triangles_near(*other.mesh, grown({to, to}, inner_reach_))) continue;
            const Vec3 from = nearest_of(inner_points_, to);
            keep_deepest(first_crossing(*other.mesh, from, to, clearance_at(to)), to, other.id, here);
        }
        if (here.depth > deepest.depth || (here.depth == deepest.depth && here.mesh < deepest.mesh)) deepest = here;
    });
    return deepest;
}

LeftOut BulletWorld::left_out(RigidId id) const {
    return is_known(id) ? bodies_[id].left_out : LeftOut{};
}

Vec3 BulletWorld::to_side_of(RigidId id, Vec3 place) const {
    if (!is_known(id) || mesh_count_ == 0) return place;
    const Body& body = bodies_[id];
    Vec3 from;
    float least = kFar, reach = 0;
    for (const Hull* hull = body.hulls; hull; hull = hull->next) {
        const Vec3 point = inner_point(*hull, body.fresh_at), way = point - place;
        reach = std::max(reach, hull->radius + hull->margin);
        if (dot(way, way) < least) least = dot(way, way), from = point;
    }
    for (int move = 0; move < kFirstMoves && least < kFar; ++move) {
        Crossing first;
        visit_meshes(body, grown({place, place}, reach), [&](const Body& other) {
            const Crossing found = first_crossing(*other.mesh, from, place, clearance_at(place));
            if (found.share < first.share) first = found;
        });
        if (first.share > 1) break;
        place += first.depth * first.normal;
    }
    return place;
}

void BulletWorld::settle_born(Body& body) {
    if (mesh_count_ == 0 || inner_points_.empty() || body.kind != RigidKind::Dynamic || body.is_soft) return;
    for (int move = 0; move < kFirstMoves; ++move) {
        const PutThrough put = find_born_through(body);
        if (!(put.depth > 0)) return;
        lift_new(body, put);
    }
}

void BulletWorld::lift_new(Body& body, const PutThrough& put) {
    const Vec3 way = put.depth * put.normal;
    btTransform moved = body.bullet->getWorldTransform();
    moved.setOrigin(moved.getOrigin() + to_bullet(way));
    body.bullet->setCenterOfMassTransform(moved);
    body.anchor = body.far_anchor = moved;
    if (CULLET_CHECKS_ON)
        work_done_.lifted -= static_cast<double>(body.mass) * static_cast<double>(dot(from_bullet(gravity_), way));
    refresh(body);
}

}  // namespace cullet::bullet
