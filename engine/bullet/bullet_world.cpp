#include "engine/bullet/bullet_world.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "engine/assert.hpp"
#include "engine/bullet/advance.hpp"
#include "engine/bullet/free_turn.hpp"
#include "engine/bullet/stopped_fall.hpp"
#include "engine/principal_axes.hpp"
#include "engine/rigid_allocations.hpp"

namespace cullet::bullet {
namespace {

// Most by which a body is pushed out of a sleeper, which does not give way. A slab that fell asleep a millimetre and a
// half deep in its neighbour lifted that one by half a millimetre at once, was woken by it, and dropped it. At five
// times it a vase on a shard that falls asleep squeezed is lifted by a tenth of a millimetre, and falls at 8 mm/s.
constexpr float kPushedOffSleepers = 0.00002f;  // m in a step, at scale 1
constexpr float kAngularDamping = 0.1f;         // 1/s, of what is touched: flight has none, nor a birth, nor a ball
constexpr float kPressedIn = 0.001f;            // m a step, at scale 1, that an unsolved contact may deepen by
// Leaves of the tree hold what they are about with half of the way from which pieces are watched (see
// pair_algorithm.cpp), and this room to move. Ten times it and a heap has three times the pairs, a tenth and what falls
// is looked up in every step.
constexpr float kWatched = 0.01f;   // m
constexpr float kLeafRoom = 0.01f;  // m
constexpr uint32_t kBodiesAJob = 64, kPairsAJob = 32, kSeamsAJob = 4;

uint64_t scatter(RigidId a, RigidId b) {
    uint64_t z = (uint64_t{a} << 32 | b) * 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 29)) * 0xbf58476d1ce4e5b9ull;
    return z ^ (z >> 32);
}

}  // namespace

BulletWorld::BulletWorld(uint32_t body_limit)
    : body_limit_(body_limit),
      bodies_(new Body[body_limit]),
      hulls_(4 * static_cast<size_t>(body_limit) + 256),
      work_(body_limit),
      scratches_(body_limit),
      tree_(body_limit),
      firm_tree_(body_limit),
      has_strayed_(body_limit),
      pairs_(body_limit),
      solver_(body_limit),
      sweeper_(body_limit) {
    work_.bodies = bodies_.get();
    work_.around = {bodies_.get(), &firm_tree_};
    strayed_.reserve(4 * static_cast<size_t>(body_limit) + 1024);
    contacts_.reserve(32 * static_cast<size_t>(body_limit) + 1024);
    loads_.reserve(32 * static_cast<size_t>(body_limit) + 1024);
    manifolds_.reserve(8 * static_cast<size_t>(body_limit) + 1024);
    in_the_way_.reserve(body_limit);
    scattered_.reserve(manifolds_.capacity());
    ignored_.reserve(16 * static_cast<size_t>(body_limit) + 1024);
    newborn_.reserve(16 * static_cast<size_t>(body_limit) + 1024);
    skipped_.reserve(16 * static_cast<size_t>(body_limit) + 1024);
    shapes_.reserve(8 * static_cast<size_t>(body_limit) + 4096);
    lacking_seams_.reserve(body_limit);
    seams_.reserve(4 * static_cast<size_t>(body_limit) + 4096);
    lost_.reserve(4 * static_cast<size_t>(body_limit) + 4096);
    inner_points_.reserve(4 * static_cast<size_t>(body_limit) + 4096);
    ways_.reserve(4096);
}

BulletWorld::~BulletWorld() {
    InsideRigidEngine guard;
}

void BulletWorld::set_gravity(Vec3 gravity) {
    InsideRigidEngine guard(counts_.allocations);
    gravity_ = to_bullet(gravity);
    for (RigidId id = 0; id < body_end_; ++id) {
        Body& body = bodies_[id];
        if (!body.is_used || body.kind != RigidKind::Dynamic) continue;
        wake_body(body);
        body.bullet->setGravity(gravity_);
    }
}

void BulletWorld::drop_pieces(Body& body) {
    while (body.hulls) {
        Hull* const hull = body.hulls;
        body.hulls = hull->next;
        hulls_.give(hull);
    }
    body.hull_count = 0;
}

// Both lists rise by cell as a rule, so the search goes on where the last one ended.
const Hull* BulletWorld::find_same(const ConvexPiece& piece, const Hull* old_hulls, RigidId own,
                                   const Hull*& cursor) const {
    if (piece.same_body != own && !is_known(piece.same_body)) return nullptr;
    const Hull* const first = piece.same_body == own ? old_hulls : bodies_[piece.same_body].hulls;
    const auto search = [&](const Hull* from) {
        while (from && from->cell != piece.same_cell) from = from->next;
        return from;
    };
    const Hull* found = search(cursor);
    if (!found) found = search(first);
    if (found) cursor = found;
    return found && found->point_count == piece.points.size() ? found : nullptr;
}

void BulletWorld::reserve_shapes(uint32_t count) {
    for (Hull* const hull : shapes_)
        if (hull) hulls_.give(hull);
    shapes_.clear();
    InsideRigidEngine guard(counts_.allocations);
    for (uint32_t shape = 0; shape < count; ++shape) shapes_.push_back(hulls_.take());
}

void BulletWorld::make_shape(uint32_t shape, std::span<const Vec3> points) const {
    uint64_t allocations = 0;
    {
        InsideRigidEngine guard(allocations);
        build_hull(*shapes_[shape], points, 0, 0);
    }
    shape_allocations_.fetch_add(allocations, std::memory_order_relaxed);
}

RigidCounts BulletWorld::counts() const {
    RigidCounts counts = counts_;
    counts.allocations += shape_allocations_.load(std::memory_order_relaxed) + scratches_.allocations();
    return counts;
}

// Without seams.
Hull* BulletWorld::make_hull(const ConvexPiece& piece, const BodyFrame& frame, float margin) {
    if (piece.shape < shapes_.size() && shapes_[piece.shape]) return take_shape(piece, frame, margin);
    const Quat to_axes = conjugate(frame.axes);
    Vec3 local[kMaxPoints];
    const size_t count = std::min<size_t>(piece.points.size(), kMaxPoints);
    for (size_t k = 0; k < count; ++k) local[k] = rotate(to_axes, piece.points[k] - frame.centre);
    Hull* const hull = hulls_.take();
    build_hull(*hull, {local, count}, margin, piece.cell);
    return hull;
}

// Turned from the caller's axes into the body's. It may have fewer points than the piece: those inside are left out.
Hull* BulletWorld::take_shape(const ConvexPiece& piece, const BodyFrame& frame, float margin) {
    Hull* const hull = std::exchange(shapes_[piece.shape], nullptr);
    turn_hull(*hull, matrix(conjugate(frame.axes)), frame.centre, margin, piece.cell);
    return hull;
}

namespace {

/// What others cover of a hull, while it is made anew.
struct Covered {
    bool is_face_inner[kMaxFaces];
    uint64_t places[kMaxFaces], flush;
    explicit Covered(const Hull& hull) : flush(hull.flush) {
        std::copy_n(hull.is_face_inner, kMaxFaces, is_face_inner);
        std::copy_n(hull.covered, kMaxFaces, places);
    }
    void give_to(Hull& hull) const {
        std::copy_n(is_face_inner, kMaxFaces, hull.is_face_inner);
        std::copy_n(places, kMaxFaces, hull.covered);
        hull.flush = flush;
    }
};

Hull* unlink(Hull*& list, const Hull* wanted) {
    Hull** at = &list;
    while (*at != wanted) at = &(*at)->next;
    Hull* const found = *at;
    *at = found->next;
    return found;
}

}  // namespace

// `old_frame` is what the body's hulls so far stand in. Those that stay keep their seams, so that the cost of a small
// change does not go with the body.
void BulletWorld::set_pieces(Body& body, std::span<const ConvexPiece> pieces, float margin,
                             const BodyFrame& old_frame) {
    const Quat old_axes = old_frame.axes;
    Hull* old_hulls = body.hulls;
    body.hulls = nullptr;
    body.hull_count = 0;
    Hull** link = &body.hulls;
    const Hull* cursor = nullptr;
    RigidId cursor_body = kNoRigid;
    const Quat to_axes = conjugate(body.frame.axes);
    for (const ConvexPiece& piece : pieces) {
        if (piece.points.empty()) continue;
        if (piece.same_body != cursor_body) cursor = nullptr;
        cursor_body = piece.same_body;
        const Hull* const same = piece.same_body == kNoRigid ? nullptr : find_same(piece, old_hulls, body.id, cursor);
        // The body's own hulls are turned where they stand.
        const bool is_own = same && piece.same_body == body.id;
        Hull* const hull = is_own ? unlink(old_hulls, same)
                           : same ? hulls_.take()
                                  : make_hull(piece, body.frame, margin);
        if (is_own && cursor == same) cursor = same->next;
        const bool had_seams = same && same->has_seams;
        if (same) {
            Vec3 local[kMaxPoints];
            const size_t count = std::min<size_t>(piece.points.size(), kMaxPoints);
            for (size_t k = 0; k < count; ++k) local[k] = rotate(to_axes, piece.points[k] - body.frame.centre);
            const Quat& axes = is_own ? old_axes : bodies_[piece.same_body].hull_frame.axes;
            const Covered covered(*same);
            build_hull_like(*hull, *same, matrix(to_axes * axes), {local, count}, margin, piece.cell);
            if (is_own) covered.give_to(*hull);
        }
        hull->has_seams = is_own && had_seams;
        hull->ordinal = body.hull_count++;
        hull->next = nullptr;
        *link = hull;
        link = &hull->next;
    }
    lost_.clear();
    for (Hull* hull = old_hulls; hull;) {
        Hull* const next = hull->next;
        const Vec3 place = rotate(old_axes, hull->local.centre) + old_frame.centre;
        lost_.push_back({rotate(to_axes, place - body.frame.centre), hull->radius});
        hulls_.give(hull);
        hull = next;
    }
    forget_seams(body, lost_);
    put_off_seams(body);
    body.hull_frame = body.frame;
    seat_hulls(body);
    measure_body(body);
}

// One walk: the named pieces leave, new ones take their places by name, ordinals follow.
void BulletWorld::change_pieces(Body& body, std::span<const uint32_t> gone, std::span<const ConvexPiece> pieces) {
    const Mat3 rotation = rotation_of(body.fresh_at);
    const Vec3 origin = from_bullet(body.fresh_at.getOrigin());
    Hull** link = &body.hulls;
    size_t next_gone = 0, next_new = 0;
    lost_.clear();
    body.hull_count = 0;
    const auto keep = [&](Hull* hull) {
        hull->ordinal = body.hull_count++;
        link = &hull->next;
    };
    for (;;) {
        Hull* const here = *link;
        while (next_new < pieces.size() && (!here || pieces[next_new].cell < here->cell)) {
            const ConvexPiece& piece = pieces[next_new++];
            if (piece.points.empty()) continue;
            Hull* const hull = make_hull(piece, body.hull_frame, body.margin);
            refresh_world(*hull, rotation, origin);
            hull->next = here;
            *link = hull;
            hull->has_seams = false;
            keep(hull);
        }
        if (!here) break;
        while (next_gone < gone.size() && gone[next_gone] < here->cell) ++next_gone;
        if (next_gone == gone.size() || gone[next_gone] != here->cell) {
            keep(here);
            continue;
        }
        lost_.push_back({here->local.centre, here->radius});
        *link = here->next;
        hulls_.give(here);
    }
}

// Births come one after the other. The marks of all of them are made at once, before anything meets.
void BulletWorld::put_off_seams(Body& body) {
    if (!body.lacks_seams) lacking_seams_.push_back(body.id);
    body.lacks_seams = true;
}

// In lists that stay within the room there is, unless a single body has more pieces.
void BulletWorld::mark_all_seams() {
    for (size_t k = 0; k < lacking_seams_.size();) {
        seams_.clear();
        do {
            Body& body = bodies_[lacking_seams_[k++]];
            list_seams(body, seams_);
            body.lacks_seams = false;
        } while (k < lacking_seams_.size() &&
                 seams_.size() + bodies_[lacking_seams_[k]].hull_count <= seams_.capacity());
        mark_listed_seams();
    }
    lacking_seams_.clear();
}

void BulletWorld::mark_listed_seams() {
    const auto count = static_cast<uint32_t>(seams_.size());
    scratches_.run((count + kSeamsAJob - 1) / kSeamsAJob, [this, count](uint32_t job, PairScratch&) {
        for (uint32_t k = job * kSeamsAJob; k < std::min(count, (job + 1) * kSeamsAJob); ++k) mark_seam(seams_, k);
    });
    for (const Seam& seam : seams_) seam.hull->has_seams = true;
}

// Of the pieces' own bounds: an upper bound of the reach, for one look at each piece.
void BulletWorld::bound_pieces(Body& body) {
    body.local_box = empty_box();
    body.thickness = kFar;
    body.reach = 0;
    for (const Hull* hull = body.hulls; hull; hull = hull->next) {
        include(body.local_box, hull->local_box.low);
        include(body.local_box, hull->local_box.high);
        const float reach = length(hull->local.centre - body.hull_centre) + hull->radius + hull->margin;
        body.reach = std::max(body.reach, reach);
        body.thickness = std::min(body.thickness, hull->thickness);
    }
    set_scale(body);
    ++body.shape_changes;
}

// Where the hull frame stands in the Bullet frame.
void BulletWorld::seat_hulls(Body& body) {
    const BodyFrame &from = body.hull_frame, &to = body.frame;
    const auto are_same = [](Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; };
    body.has_offset = !are_same(from.centre, to.centre) ||
                      !are_same({from.axes.x, from.axes.y, from.axes.z}, {to.axes.x, to.axes.y, to.axes.z}) ||
                      from.axes.w != to.axes.w;
    body.hull_offset.setIdentity();
    body.hull_centre = {};
    if (!body.has_offset) return;
    const Quat to_axes = conjugate(to.axes);
    body.hull_offset =
        btTransform(to_bullet(normalised(to_axes * from.axes)), to_bullet(rotate(to_axes, from.centre - to.centre)));
    body.hull_centre = rotate(conjugate(from.axes), to.centre - from.centre);
}

void BulletWorld::measure_body(Body& body) {
    body.local_box = empty_box();
    body.thickness = kFar;
    body.reach = 0;
    for (const Hull* hull = body.hulls; hull; hull = hull->next) {
        const Points& p = hull->local;
        float square = 0;
        for (uint32_t k = 0; k < hull->point_count; ++k) {
            const float x = p.centre.x + p.x[k], y = p.centre.y + p.y[k], z = p.centre.z + p.z[k];
            square = std::max(square, x * x + y * y + z * z);
        }
        include(body.local_box, hull->local_box.low);
        include(body.local_box, hull->local_box.high);
        body.reach = std::max(body.reach, std::sqrt(square) + hull->margin);
        body.thickness = std::min(body.thickness, hull->thickness);
    }
    set_scale(body);
    ++body.shape_changes;
}

void BulletWorld::set_mass(Body& body, double mass, Vec3d centre, const Sym3d& inertia) {
    const PrincipalAxes principal = principal_axes(inertia);
    body.frame = {centre.to_float(), principal.axes};
    body.mass = body.kind == RigidKind::Dynamic ? std::max(static_cast<float>(mass), 1e-9f) : 0;
    body.moments = body.kind == RigidKind::Dynamic ? to_bullet(principal.moments.to_float()) : btVector3(0, 0, 0);
}

void BulletWorld::make_bullet(Body& body, const btTransform& at) {
    btRigidBody::btRigidBodyConstructionInfo info(body.mass, nullptr, &body.shape, body.moments);
    info.m_startWorldTransform = at;
    if (!is_ball(body)) info.m_angularDamping = kAngularDamping;
    info.m_friction = body.friction;
    info.m_restitution = body.restitution;
    info.m_rollingFriction = info.m_spinningFriction = body.rolling_friction;
    body.bullet.emplace(info);
    btRigidBody& bullet = *body.bullet;
    bullet.setUserIndex(static_cast<int>(body.id));
    bullet.setFlags(0);  // see turn_freely()
    if (body.kind == RigidKind::Kinematic) {
        const int flags = bullet.getCollisionFlags() & ~btCollisionObject::CF_STATIC_OBJECT;
        bullet.setCollisionFlags(flags | btCollisionObject::CF_KINEMATIC_OBJECT);
    }
}

void BulletWorld::enter(Body& body, const Pose& at, uint32_t layer, uint32_t mask) {
    make_bullet(body, to_bullet(at, body.frame));
    set_scale(body);
    body.is_used = true;
    body.is_held = body.is_soft = false;
    body.is_fast = false;
    body.moved_fraction = 1;
    body.still_seconds = body.creep_seconds = body.slow_seconds = 0;
    body.pressed_seconds = body.settling_seconds = body.overlap = body.sunk = 0;
    body.is_touched = body.is_held_up = body.is_driven = false;
    body.anchor = body.far_anchor = body.bullet->getWorldTransform();
    body.has_left = false;
    body.idle_wakes = 0;
    body.sibling_seconds = 0;
    body.gained = {};
    body_end_ = std::max(body_end_, body.id + 1);
    body.layer = layer, body.mask = mask;
    refresh(body);
    enter_tree(body);
}

void BulletWorld::enter_tree(Body& body) {
    if (body.kind == RigidKind::Dynamic) body.bullet->setGravity(gravity_);
    if (body.kind == RigidKind::Static) body.bullet->setActivationState(ISLAND_SLEEPING);
    enter_leaf(body);
}

void BulletWorld::enter_leaf(Body& body) {
    const Box box = grown(body.shape.box, kWatched + kLeafRoom);
    body.leaf = tree_.add(box, body.id);
    if (is_firm(body)) body.firm_leaf = firm_tree_.add(box, body.id);
    strayed_.push_back(body.id);
}

void BulletWorld::leave_leaf(Body& body) {
    tree_.remove(body.leaf);
    if (body.firm_leaf != kNoLeaf) firm_tree_.remove(body.firm_leaf);
    body.leaf = body.firm_leaf = kNoLeaf;
}

void BulletWorld::add_static_triangles(RigidId id, std::span<const Vec3> positions,
                                       std::span<const std::array<uint32_t, 3>> triangles, float friction,
                                       float restitution, uint32_t layer, uint32_t mask, bool one_sided) {
    InsideRigidEngine guard(counts_.allocations);
    if (id >= body_limit_ || bodies_[id].is_used) return;
    Body& body = bodies_[id];
    body.id = id;
    body.kind = RigidKind::Static;
    body.is_level = true;
    body.friction = friction, body.restitution = restitution, body.rolling_friction = body.rolling_share = 0;
    body.margin = 0;
    set_mass(body, 0, {}, {});
    auto mesh = std::make_unique<StaticMesh>(sort_static_triangles(positions, triangles, one_sided));
    std::vector<ConvexPiece> pieces;
    for (const auto& solid : mesh->solids) pieces.push_back({solid, static_cast<uint32_t>(pieces.size())});
    set_pieces(body, pieces, 0, body.frame);
    body.left_out = {mesh->left_out, mesh->first_left};
    body.mesh = mesh->triangles.empty() ? nullptr : std::move(mesh);
    mesh_count_ += body.mesh != nullptr;
    enter(body, {}, layer, mask);
}

void BulletWorld::set_rolling_share(RigidId id, float share) {
    if (is_known(id)) bodies_[id].rolling_share = share;
}

void BulletWorld::add(RigidId id, const RigidDescription& d) {
    InsideRigidEngine guard(counts_.allocations);
    if (id >= body_limit_ || bodies_[id].is_used) return;
    Body& body = bodies_[id];
    body.id = id;
    body.kind = d.kind;
    body.is_level = false;
    body.left_out = {};
    body.friction = d.friction, body.restitution = d.restitution, body.rolling_friction = d.rolling_friction;
    body.rolling_share = d.rolling_share;
    body.mesh.reset();
    set_mass(body, d.mass, d.centre, d.inertia);
    const Vec3 origin;
    const ConvexPiece ball{{&origin, 1}, 0};
    if (d.radius > 0)
        set_pieces(body, {&ball, 1}, d.radius, body.frame);
    else
        set_pieces(body, d.pieces, d.margin, body.frame);
    body.margin = d.radius > 0 ? d.radius : d.margin;
    enter(body, d.pose, d.layer, d.mask);
    if (is_known(d.parent) && d.parent != id) {
        list_inner_points(bodies_[d.parent]);
        settle_born(body);
    } else {
        mark_all_seams();
        settle_laid(body);
    }
    set_motion(id, d.motion);
}

void BulletWorld::remove(RigidId id) {
    if (is_known(id)) wake_touching(id);
    take_out(id);
}

void BulletWorld::replace(RigidId id, const RigidDescription& description) {
    take_out(id);
    add(id, description);
}

void BulletWorld::take_out(RigidId id) {
    if (!is_known(id)) return;
    InsideRigidEngine guard(counts_.allocations);
    Body& body = bodies_[id];
    for (SortedManifold& m : manifolds_)
        if (m.a == id || m.b == id) m.manifold = nullptr;
    pairs_.drop(id);
    leave_leaf(body);
    body.bullet.reset();
    mesh_count_ -= body.mesh != nullptr;
    body.mesh.reset();
    drop_pieces(body);
    if (body.lacks_seams) std::erase(lacking_seams_, id);
    body.is_used = body.lacks_seams = false;
    std::erase_if(ignored_, [id](const IgnoredPair& p) { return p.a == id || p.b == id; });
    std::erase_if(newborn_, [id](const NewbornPieces& p) { return p.a == id || p.b == id; });
    while (body_end_ > 0 && !bodies_[body_end_ - 1].is_used) --body_end_;
}

Pose BulletWorld::pose(RigidId id) const {
    return is_known(id) ? from_bullet(bodies_[id].bullet->getWorldTransform(), bodies_[id].frame) : Pose{};
}

Motion BulletWorld::motion(RigidId id) const {
    if (!is_known(id)) return {};
    const Body& body = bodies_[id];
    if (body.is_held) return body.kept;
    return {from_bullet(body.bullet->getLinearVelocity()), from_bullet(body.bullet->getAngularVelocity())};
}

void BulletWorld::set_pose(RigidId id, const Pose& at) {
    if (!is_known(id)) return;
    InsideRigidEngine guard(counts_.allocations);
    Body& body = bodies_[id];
    wake_touching(id);
    body.bullet->setCenterOfMassTransform(to_bullet(at, body.frame));
    if (body.kind == RigidKind::Dynamic) wake_body(body);
    refresh(body);
    settle_laid(body);
}

void BulletWorld::set_motion(RigidId id, const Motion& m) {
    if (!is_known(id)) return;
    InsideRigidEngine guard(counts_.allocations);
    Body& body = bodies_[id];
    const bool is_moving = dot(m.velocity, m.velocity) + dot(m.angular_velocity, m.angular_velocity) > 0;
    if (body.is_held) {
        body.kept = m;
        return;
    }
    body.bullet->setLinearVelocity(to_bullet(m.velocity));
    body.bullet->setAngularVelocity(to_bullet(m.angular_velocity));
    if (body.kind == RigidKind::Kinematic) body.bullet->setActivationState(is_moving ? ACTIVE_TAG : ISLAND_SLEEPING);
    if (body.kind == RigidKind::Dynamic && is_moving) wake_body(body);
}

void BulletWorld::set_shape(RigidId id, double mass, Vec3d centre, Sym3d inertia, std::span<const ConvexPiece> pieces) {
    if (!is_known(id) || bodies_[id].mesh) return;
    InsideRigidEngine guard(counts_.allocations);
    Body& body = bodies_[id];
    const Pose at = pose(id);
    Motion moving = motion(id);
    const Vec3 shift = rotate(at.orientation, centre.to_float() - body.frame.centre);
    moving.velocity += cross(moving.angular_velocity, shift);
    const BodyFrame old_frame = body.hull_frame;
    refresh(body);
    list_inner_points(body);
    set_mass(body, mass, centre, inertia);
    set_pieces(body, pieces, body.margin, old_frame);
    reseat(body, at);
    body.fresh_at.setOrigin({kFar, kFar, kFar});  // the points are new, wherever they stand
    refresh(body);
    settle_born(body);
    rouse(body, moving);
}

// Hulls that stay keep their frame and their points, in the world too.
bool BulletWorld::change_shape(RigidId id, double mass, Vec3d centre, Sym3d inertia, std::span<const uint32_t> gone,
                               std::span<const ConvexPiece> pieces) {
    if (!is_known(id) || bodies_[id].mesh) return true;
    InsideRigidEngine guard(counts_.allocations);
    Body& body = bodies_[id];
    refresh(body);
    const Pose at = pose(id);
    Motion moving = motion(id);
    moving.velocity += cross(moving.angular_velocity, rotate(at.orientation, centre.to_float() - body.frame.centre));
    list_inner_points(body);
    set_mass(body, mass, centre, inertia);
    seat_hulls(body);
    change_pieces(body, gone, pieces);
    forget_seams(body, lost_);
    put_off_seams(body);
    bound_pieces(body);
    reseat(body, at);
    ++body.moves;
    gather_box(body);
    update_leaf(body);
    settle_born(body);
    rouse(body, moving);
    return true;
}

// The new frame where the old one stood.
void BulletWorld::reseat(Body& body, const Pose& at) {
    btRigidBody& bullet = *body.bullet;
    if (body.kind == RigidKind::Dynamic && !body.is_held) {
        bullet.setMassProps(body.mass, body.moments);
        bullet.setGravity(gravity_);
    }
    bullet.setCenterOfMassTransform(to_bullet(at, body.frame));
    body.anchor = body.far_anchor = bullet.getWorldTransform();
}

void BulletWorld::rouse(Body& body, const Motion& moving) {
    wake_touching(body.id);
    if (body.kind == RigidKind::Dynamic) wake_body(body);
    set_motion(body.id, moving);
}

// World points and boxes of a body that moved since they were made: false for one that did not.
bool BulletWorld::refresh_points(Body& body) {
    const btTransform at = body.hulls_at(body.bullet->getWorldTransform());
    if (body.leaf != kNoLeaf && at == body.fresh_at) return false;
    body.fresh_at = at;
    ++body.moves;
    const Mat3 rotation = rotation_of(at);
    for (Hull* hull = body.hulls; hull; hull = hull->next) refresh_world(*hull, rotation, from_bullet(at.getOrigin()));
    gather_box(body);
    return true;
}

void BulletWorld::refresh(Body& body) {
    if (refresh_points(body) && body.leaf != kNoLeaf) update_leaf(body);
}

void BulletWorld::update_leaf(Body& body) {
    if (holds(tree_.box(body.leaf), grown(body.shape.box, kWatched))) return;
    leave_leaf(body);
    enter_leaf(body);
}

void BulletWorld::gather_box(Body& body) {
    Box box = empty_box();
    for (const Hull* hull = body.hulls; hull; hull = hull->next) {
        include(box, hull->world_box.low);
        include(box, hull->world_box.high);
    }
    if (body.mesh) {
        include(box, body.mesh->nodes[0].box.low);
        include(box, body.mesh->nodes[0].box.high);
    }
    const Vec3 origin = from_bullet(body.fresh_at.getOrigin());
    body.shape.box = box.low.x > box.high.x ? Box{origin, origin} : box;
}

void BulletWorld::use_jobs(JobSystem& jobs) {
    InsideRigidEngine guard(counts_.allocations);
    scratches_.use_jobs(jobs);
}

void BulletWorld::detect(float dt) {
    InsideRigidEngine guard(counts_.allocations);
    work_.dt = dt;
    work_.weight_speed = gravity_.length() * dt;
    mark_all_seams();
    refresh_all();
    find_pairs();
    meet_all();
    newborn_.clear();
    list_manifolds();
    gather_contacts();
    counts_.pairs = static_cast<uint32_t>(pairs_.rows().size());
    counts_.contacts = static_cast<uint32_t>(contacts_.size());
}

// The tree in rising ids, so that it is the same for any number of threads.
void BulletWorld::refresh_all() {
    scratches_.run((body_end_ + kBodiesAJob - 1) / kBodiesAJob, [this](uint32_t job, PairScratch&) {
        const RigidId end = std::min(body_end_, (job + 1) * kBodiesAJob);
        for (RigidId id = job * kBodiesAJob; id < end; ++id) {
            Body& body = bodies_[id];
            body.is_refreshed = false;
            if (!body.is_used || body.kind == RigidKind::Static) continue;
            if (body.kind == RigidKind::Kinematic || body.bullet->isActive()) body.is_refreshed = refresh_points(body);
        }
    });
    for (RigidId id = 0; id < body_end_; ++id)
        if (bodies_[id].is_refreshed && bodies_[id].leaf != kNoLeaf) update_leaf(bodies_[id]);
}

// What is driven touches static bodies too, as pinned ones, which it may break: no solver moves either. Floors of
// triangles have no hulls to be broken.
bool BulletWorld::may_touch(const Body& a, const Body& b) {
    if (a.kind == RigidKind::Dynamic || b.kind == RigidKind::Dynamic) return true;
    const Body &driven = a.kind == RigidKind::Kinematic ? a : b, &other = &driven == &a ? b : a;
    return driven.kind == RigidKind::Kinematic && other.kind == RigidKind::Static && other.hull_count > 0;
}

// What left its leaf meets all that its new one meets, in either order of their straying. Pairs of which neither did
// are what they were.
void BulletWorld::find_pairs() {
    if (strayed_.empty()) return;
    for (const RigidId id : strayed_) {
        const Body& body = bodies_[id];
        if (!body.is_used) continue;
        has_strayed_[id] = 1;
        tree_.visit(tree_.box(body.leaf), [&](uint32_t other_id) {
            const Body& other = bodies_[other_id];
            if (other_id == id || !may_touch(body, other)) return;
            if (body.meets_layer_of(other)) pairs_.find(id, other_id);
        });
    }
    pairs_.renew(work_, [this](RigidId a, RigidId b) {
        if (!has_strayed_[a] && !has_strayed_[b]) return true;
        return overlap(tree_.box(bodies_[a].leaf), tree_.box(bodies_[b].leaf), 0);
    });
    for (const RigidId id : strayed_) has_strayed_[id] = 0;
    strayed_.clear();
}

void BulletWorld::meet_all() {
    const std::vector<Pair>& pairs = pairs_.rows();
    const auto count = static_cast<uint32_t>(pairs.size());
    scratches_.run((count + kPairsAJob - 1) / kPairsAJob, [&](uint32_t job, PairScratch& scratch) {
        const uint32_t end = std::min(count, (job + 1) * kPairsAJob);
        for (uint32_t k = job * kPairsAJob; k < end; ++k) meet(pairs[k], scratch);
    });
}

void BulletWorld::meet(const Pair& pair, PairScratch& scratch) {
    const Body &a = bodies_[pair.a], &b = bodies_[pair.b];
    if (!a.bullet->isActive() && !b.bullet->isActive()) return;
    if (a.is_soft || b.is_soft) return pair.algorithm->forget();
    if (is_ignored(pair.a, pair.b)) return pair.algorithm->forget();
    pair.algorithm->process(scratch, newborn_of(pair.a, pair.b));
}

std::span<const NewbornPieces> BulletWorld::newborn_of(RigidId a, RigidId b) const {
    const auto before = [](const NewbornPieces& n, std::pair<RigidId, RigidId> key) {
        return std::pair(n.a, n.b) < key;
    };
    const auto first = std::lower_bound(newborn_.begin(), newborn_.end(), std::pair(a, b), before);
    auto last = first;
    while (last != newborn_.end() && last->a == a && last->b == b) ++last;
    return {first, last};
}

void BulletWorld::list_manifolds() {
    manifolds_.clear();
    for (const Pair& pair : pairs_.rows())
        pair.algorithm->visit_manifolds([&](btPersistentManifold& m, const PairRecord& record) {
            manifolds_.push_back({pair.a, pair.b, static_cast<uint32_t>(m.m_companionIdA),
                                  static_cast<uint32_t>(m.m_companionIdB), &m, record.crack != nullptr,
                                  pair.algorithm->grip(), pair.algorithm->is_born_deep()});
        });
}

namespace {

/// One is driven and the other static: they touch, and no solver moves them.
bool is_driven_in(const Body& a, const Body& b) {
    const auto drives = [](const Body& body) { return body.kind == RigidKind::Kinematic && body.bullet->isActive(); };
    return (drives(a) && b.kind == RigidKind::Static) || (drives(b) && a.kind == RigidKind::Static);
}

/// A body's motion now; none of what is neither free nor driven.
struct Moving {
    Vec3 centre, velocity, spin;

    explicit Moving(const Body& body) {
        if (!body.is_free() && body.kind != RigidKind::Kinematic) return;
        centre = from_bullet(body.bullet->getCenterOfMassPosition());
        velocity = from_bullet(body.bullet->getLinearVelocity());
        spin = from_bullet(body.bullet->getAngularVelocity());
    }
    Vec3 at(Vec3 point) const { return velocity + cross(spin, point - centre); }
};

}  // namespace

Vec3 BulletWorld::velocity_at(const Body& body, Vec3 point) const {
    return Moving(body).at(point);
}

void BulletWorld::gather_contacts() {
    contacts_.clear();
    for (RigidId id = 0; id < body_end_; ++id) {
        bodies_[id].is_touched = bodies_[id].is_held_up = bodies_[id].is_driven = bodies_[id].is_damped = false;
        bodies_[id].overlap = bodies_[id].sunk = 0;
    }
    for (const SortedManifold& m : manifolds_) {
        Body &a = bodies_[m.a], &b = bodies_[m.b];
        a.is_touched = b.is_touched = true;
        a.is_held_up |= is_slow(b), b.is_held_up |= is_slow(a);
        a.is_damped |= !m.is_at_crack, b.is_damped |= !m.is_at_crack;
        a.is_driven |= b.kind == RigidKind::Kinematic && b.bullet->isActive();
        b.is_driven |= a.kind == RigidKind::Kinematic && a.bullet->isActive();
        if (!a.is_free() && !b.is_free() && !is_driven_in(a, b)) continue;
        const Moving moving_a(a), moving_b(b);
        const float scale = scale_of(a, b);
        for (int k = 0; k < m.manifold->getNumContacts(); ++k) {
            const btManifoldPoint& p = m.manifold->getContactPoint(k);
            const Vec3 point = 0.5f * (from_bullet(p.m_positionWorldOnA) + from_bullet(p.m_positionWorldOnB));
            const Vec3 normal = from_bullet(p.m_normalWorldOnB);
            const float speed = dot(moving_b.at(point) - moving_a.at(point), normal);
            const bool is_pushed = !(m.grip > 0) && !m.is_born_deep;
            const float overlap = is_pushed ? -p.m_distance1 / scale : 0;
            a.overlap = std::max(a.overlap, overlap);
            b.overlap = std::max(b.overlap, overlap);
            if (b.kind == RigidKind::Static) a.sunk = std::max(a.sunk, overlap);
            if (a.kind == RigidKind::Static) b.sunk = std::max(b.sunk, overlap);
            contacts_.push_back({m.a, m.b, m.cell_a, m.cell_b, point, normal, p.m_distance1, speed});
        }
    }
}

// What is held is not solved, but lies in what it lies in.
void BulletWorld::gather_loads(float dt) {
    loads_.clear();
    for (const SortedManifold& m : manifolds_) {
        if (!m.manifold) continue;
        const Body &a = bodies_[m.a], &b = bodies_[m.b];
        const bool is_solved = a.is_free() || b.is_free();
        if (!is_solved && !a.is_held && !b.is_held && !is_driven_in(a, b)) continue;
        const Moving moving_a(a), moving_b(b);
        for (int k = 0; k < m.manifold->getNumContacts(); ++k) {
            const btManifoldPoint& p = m.manifold->getContactPoint(k);
            const Vec3 point = 0.5f * (from_bullet(p.m_positionWorldOnA) + from_bullet(p.m_positionWorldOnB));
            const Vec3 normal = from_bullet(p.m_normalWorldOnB);
            const float impulse = is_solved ? p.m_appliedImpulse : 0;
            const float closing =
                dot(moving_b.at(point) - moving_a.at(point), normal) - std::max(p.m_distance1, 0.0f) / dt;
            loads_.push_back({m.a, m.b, m.cell_a, m.cell_b, point, normal, p.m_distance1, closing, impulse});
        }
    }
}

// What sleep takes from a body counts as given to what it lies on.
void BulletWorld::set_velocities(Body& body, const btVector3& linear, const btVector3& angular) {
    to_static_ += static_cast<double>(body.mass) * Vec3d(from_bullet(body.bullet->getLinearVelocity() - linear));
    body.bullet->setLinearVelocity(linear);
    body.bullet->setAngularVelocity(angular);
}

void BulletWorld::sum_impulse_to_static() {
    for (const SortedManifold& m : manifolds_) {
        if (!m.manifold) continue;
        const bool is_a_free = bodies_[m.a].is_free(), is_b_free = bodies_[m.b].is_free();
        if (is_a_free == is_b_free) continue;
        for (int k = 0; k < m.manifold->getNumContacts(); ++k) {
            const btManifoldPoint& p = m.manifold->getContactPoint(k);
            const btVector3 impulse = p.m_appliedImpulse * p.m_normalWorldOnB +
                                      p.m_appliedImpulseLateral1 * p.m_lateralFrictionDir1 +
                                      p.m_appliedImpulseLateral2 * p.m_lateralFrictionDir2;
            to_static_ += (is_a_free ? -1.0 : 1.0) * Vec3d(from_bullet(impulse));
        }
    }
}

// A contact's impulse at the velocity of what is driven: no less than the work that it does, for the other body is no
// faster at the end than what pushes it.
void BulletWorld::sum_driven_work() {
    for (const SortedManifold& m : manifolds_) {
        if (!m.manifold) continue;
        const Body &a = bodies_[m.a], &b = bodies_[m.b];
        if (a.is_free() == b.is_free()) continue;
        const Body& driven = a.is_free() ? b : a;
        if (driven.kind != RigidKind::Kinematic || !driven.bullet->isActive()) continue;
        for (int k = 0; k < m.manifold->getNumContacts(); ++k) {
            const btManifoldPoint& p = m.manifold->getContactPoint(k);
            const btVector3 impulse =
                (a.is_free() ? 1.0f : -1.0f) *
                (p.m_appliedImpulse * p.m_normalWorldOnB + p.m_appliedImpulseLateral1 * p.m_lateralFrictionDir1 +
                 p.m_appliedImpulseLateral2 * p.m_lateralFrictionDir2);
            const Vec3 velocity = velocity_at(driven, from_bullet(p.m_positionWorldOnB));
            work_done_.driven += std::max(0.0, static_cast<double>(dot(from_bullet(impulse), velocity)));
        }
    }
}

// J, -m g . x of all free bodies.
double BulletWorld::height_energy() const {
    const Vec3d gravity(from_bullet(gravity_));
    double sum = 0;
    for (RigidId id = 0; id < body_end_; ++id) {
        const Body& body = bodies_[id];
        if (!body.is_used || !body.is_free()) continue;
        sum -= static_cast<double>(body.mass) *
               dot(gravity, Vec3d(from_bullet(body.bullet->getWorldTransform().getOrigin())));
    }
    return sum;
}

// W, m g . v of all free bodies.
double BulletWorld::falling_power() const {
    const Vec3d gravity(from_bullet(gravity_));
    double sum = 0;
    for (RigidId id = 0; id < body_end_; ++id) {
        const Body& body = bodies_[id];
        if (!body.is_used || !body.is_free()) continue;
        sum += static_cast<double>(body.mass) * dot(gravity, Vec3d(from_bullet(body.bullet->getLinearVelocity())));
    }
    return sum;
}

// Which contacts are solved last hold best: those with what stands still. Before them pairs come scattered, the same
// way in every step: rising ids would send errors through a heap from its oldest pieces to its youngest. Of 16 heaps of
// curved shards 5 have a contact deeper than 4 mm in rising order, 5 with what stands last, 3 with both; the deepest
// at the floor is 2.4, 1.5 and 1.2 mm in the mean.
void BulletWorld::solve_contacts(float dt) {
    solver_.clear();
    for (RigidId id = 0; id < body_end_; ++id) {
        Body& body = bodies_[id];
        body.number = ContactSolver::kStanding;
        if (!body.is_used) continue;
        const bool is_driver = body.kind == RigidKind::Kinematic && body.is_touched && body.bullet->isActive();
        if (body.is_free() || is_driver) body.number = solver_.add_body(*body.bullet);
    }
    scattered_.clear();
    for (uint32_t first = 0, end = 0; first < manifolds_.size(); first = end) {
        const RigidId a = manifolds_[first].a, b = manifolds_[first].b;
        uint32_t contacts = 0;
        for (; end < manifolds_.size() && manifolds_[end].a == a && manifolds_[end].b == b; ++end)
            if (manifolds_[end].manifold) contacts += static_cast<uint32_t>(manifolds_[end].manifold->getNumContacts());
        if (contacts == 0) continue;
        const bool is_a_free = bodies_[a].is_free(), is_b_free = bodies_[b].is_free();
        if (!is_a_free && !is_b_free) continue;
        const float grip = manifolds_[first].grip / static_cast<float>(contacts);
        scattered_.push_back({!is_a_free || !is_b_free, grip, scatter(a, b), first, end});
    }
    std::sort(scattered_.begin(), scattered_.end(), [](const Scattered& p, const Scattered& q) {
        if (p.is_standing != q.is_standing) return q.is_standing;
        return p.number != q.number ? p.number < q.number : p.first < q.first;
    });
    for (const Scattered& pair : scattered_) {
        const SortedManifold& first = manifolds_[pair.first];
        const Body &a = bodies_[first.a], &b = bodies_[first.b];
        const float scale = scale_of(a, b);
        const float most_push = first.is_born_deep                   ? 0
                                : is_asleep(a.id) || is_asleep(b.id) ? scale * kPushedOffSleepers
                                                                     : kFar;
        solver_.add_pair(a.number, b.number, pair.grip, most_push, !(pair.grip > 0) && are_siblings(a, b), scale);
        for (uint32_t m = pair.first; m < pair.end; ++m)
            if (manifolds_[m].manifold) solver_.add_contacts(*manifolds_[m].manifold);
    }
    solver_.solve(dt, 1 / Pace(gravity_.length()).slower, scratches_);
}

namespace {

Motion motion_now(const Body& body) {
    return {from_bullet(body.bullet->getLinearVelocity()), from_bullet(body.bullet->getAngularVelocity())};
}

void note_gain(Body& body) {
    if (!body.is_free()) return (void)(body.gained = {});
    const Motion now = motion_now(body);
    body.gained.velocity = 0.5f * (body.gained.velocity + now.velocity - body.started.velocity);
    body.gained.angular_velocity =
        0.5f * (body.gained.angular_velocity + now.angular_velocity - body.started.angular_velocity);
}

}  // namespace

void BulletWorld::solve(float dt) {
    InsideRigidEngine guard(counts_.allocations);
    mark_all_seams();
    wake_struck();
    for (RigidId id = 0; id < body_end_; ++id) {
        Body& body = bodies_[id];
        if (!body.is_used) continue;
        body.started = motion_now(body);  // also of sleepers: this solve() may wake them
        if (!body.is_free()) continue;
        body.bullet->applyGravity();
        turn_freely(*body.bullet, dt);
        if (body.is_damped) body.bullet->applyDamping(dt);
    }
    const double before = CULLET_CHECKS_ON ? height_energy() : 0;
    solve_contacts(dt);
    still_settling();
    gather_loads(dt);
    sum_impulse_to_static();
    if (CULLET_CHECKS_ON) sum_driven_work();
    const double lifted = CULLET_CHECKS_ON ? height_energy() : 0, falling = CULLET_CHECKS_ON ? dt * falling_power() : 0;
    integrate(dt);
    work_done_.lifted += lifted - before;
    work_done_.ahead += CULLET_CHECKS_ON ? height_energy() - lifted + falling : 0;
    update_sleep(dt);
    for (RigidId id = 0; id < body_end_; ++id) {
        Body& body = bodies_[id];
        if (!body.is_used) continue;
        body.bullet->clearForces();
        body.sibling_seconds = std::max(0.0f, body.sibling_seconds - dt);
        note_gain(body);
    }
    for (IgnoredPair& pair : ignored_) pair.seconds -= dt;
    std::erase_if(ignored_, [](const IgnoredPair& p) { return !(p.seconds > 0); });
    skipped_.clear();
}

// The solver's iterations leave a heap that is hit hard with metres per second of approach. Where a contact still
// closes after them, its bodies move on only as far as takes it kPressedIn deeper; the next step goes on slowing them.
void BulletWorld::limit_closing(float dt) {
    for (const SortedManifold& m : manifolds_) {
        if (!m.manifold) continue;
        Body &a = bodies_[m.a], &b = bodies_[m.b];
        if (!a.is_free() && !b.is_free()) continue;
        const Moving moving_a(a), moving_b(b);
        const float pressed_in = scale_of(a, b) * kPressedIn;
        for (int k = 0; k < m.manifold->getNumContacts(); ++k) {
            const btManifoldPoint& p = m.manifold->getContactPoint(k);
            const Vec3 point = from_bullet(p.m_positionWorldOnB), normal = from_bullet(p.m_normalWorldOnB);
            const Vec3 closing = moving_b.at(point) + b.glance - moving_a.at(point) - a.glance;
            const float way = dot(closing, normal) * dt;
            const float allowed = std::max(p.m_distance1, 0.0f) + pressed_in;
            if (way <= allowed) continue;
            if (a.is_free()) a.moved_fraction = std::min(a.moved_fraction, allowed / way);
            if (b.is_free()) b.moved_fraction = std::min(b.moved_fraction, allowed / way);
        }
    }
}

void BulletWorld::take_back_gravity(float dt) {
    for (RigidId id = 0; id < body_end_; ++id) {
        Body& body = bodies_[id];
        if (!body.is_used || !body.is_free()) continue;
        const Vec3 glance = std::exchange(body.glance, {});
        if (!(body.moved_fraction < 1 || dot(glance, glance) > 0)) continue;
        const btVector3 before = body.bullet->getLinearVelocity(),
                        now = velocity_of_stopped(before, gravity_, body.moved_fraction, dt, glance);
        set_velocities(body, now, body.bullet->getAngularVelocity());
        if (CULLET_CHECKS_ON)
            work_done_.ahead -=
                0.5 * static_cast<double>(body.mass) * static_cast<double>(before.length2() - now.length2());
    }
}

void BulletWorld::carry(const Body& body, btTransform& moved, float dt) {
    const Vec3 by = sweeper_.carry(*this, body, dt);
    moved.setOrigin(moved.getOrigin() + to_bullet(by));
    if (!CULLET_CHECKS_ON) return;
    const double work = -static_cast<double>(body.mass) * static_cast<double>(dot(from_bullet(gravity_), by));
    work_done_.driven += work, work_done_.ahead -= work;
}

void BulletWorld::integrate(float dt) {
    std::sort(newborn_.begin(), newborn_.end(), [](const NewbornPieces& p, const NewbornPieces& q) {
        return std::tie(p.a, p.b, p.piece_a, p.piece_b) < std::tie(q.a, q.b, q.piece_a, q.piece_b);
    });
    counts_.sweeps += sweeper_.sweep(*this, dt);
    limit_closing(dt);
    for (RigidId id = 0; id < body_end_; ++id) {
        Body& body = bodies_[id];
        if (!body.is_used) continue;
        const bool is_driven = body.kind == RigidKind::Kinematic && body.bullet->isActive();
        if (!is_driven && !body.is_free()) continue;
        btTransform moved;
        btTransformUtil::integrateTransform(body.bullet->getWorldTransform(),
                                            body.bullet->getLinearVelocity() + to_bullet(body.glance),
                                            body.bullet->getAngularVelocity(), body.moved_fraction * dt, moved);
        if (body.moved_fraction < 1) carry(body, moved, dt);
        body.bullet->proceedToTransform(moved);
    }
    bring_all_back();
    // Twice: the first blows of a pair turn its bodies to others'.
    sweeper_.slow_down(*this);
    take_back_gravity(dt);
    sweeper_.slow_down(*this);
    farthest_way_ = 0;
    for (RigidId id = 0; id < body_end_; ++id)
        if (bodies_[id].is_used)
            farthest_way_ = std::max(farthest_way_, static_cast<float>(travel(mover_of(bodies_[id]), dt)));
}

}  // namespace cullet::bullet

namespace cullet {

std::unique_ptr<RigidWorld> make_bullet_world(uint32_t body_limit) {
    InsideRigidEngine guard;
    return std::make_unique<bullet::BulletWorld>(body_limit);
}

}  // namespace cullet
