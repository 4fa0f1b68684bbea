// Everything that the bridge and Bullet remember of places, moved at once, so that nobody sees a body move: pairs that
// stood still keep their contacts, sleepers their sleep.
#include "engine/bullet/bullet_world.hpp"
#include "engine/rigid_allocations.hpp"

namespace cullet::bullet {
namespace {

void shift_box(Box& box, Vec3 by) {
    box = {box.low + by, box.high + by};
}

void shift_transform(btTransform& transform, Vec3 by) {
    transform.setOrigin(transform.getOrigin() + to_bullet(by));
}

// Rounding is monotone: what lay in a box lies in it after.
void shift_mesh(StaticMesh& mesh, Vec3 by) {
    for (StaticTriangle& triangle : mesh.triangles)
        for (Vec3& corner : triangle.corner) corner += by;
    for (StaticMesh::Node& node : mesh.nodes) shift_box(node.box, by);
}

void shift_manifold(btPersistentManifold& manifold, bool is_level_a, bool is_level_b, const btVector3& by) {
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
        btManifoldPoint& point = manifold.getContactPoint(k);
        point.m_positionWorldOnA += by;
        point.m_positionWorldOnB += by;
        if (is_level_a) point.m_localPointA += by;
        if (is_level_b) point.m_localPointB += by;
    }
}

// Level geometry keeps its frame and moves in it: triangles are met in world axes.
void shift_level(Body& body, Vec3 by) {
    for (Hull* hull = body.hulls; hull; hull = hull->next) {
        hull->local.centre += by;
        shift_box(hull->local_box, by);
    }
    shift_box(body.local_box, by);
    if (body.mesh) shift_mesh(*body.mesh, by);
}

void shift_frame(Body& body, Vec3 by) {
    shift_transform(body.bullet->getWorldTransform(), by);
    btTransform between = body.bullet->getInterpolationWorldTransform();
    shift_transform(between, by);
    body.bullet->setInterpolationWorldTransform(between);
    shift_transform(body.anchor, by);
    shift_transform(body.far_anchor, by);
    shift_transform(body.fresh_at, by);
}

void shift_body(Body& body, Vec3 by) {
    if (body.is_level)
        shift_level(body, by);
    else
        shift_frame(body, by);
    for (Hull* hull = body.hulls; hull; hull = hull->next) {
        hull->world.centre += by;
        shift_box(hull->world_box, by);
    }
    shift_box(body.shape.box, by);
}

}  // namespace

void BulletWorld::shift(Vec3 by) {
    InsideRigidEngine guard(counts_.allocations);
    for (RigidId id = 0; id < body_end_; ++id) {
        Body& body = bodies_[id];
        if (!body.is_used) continue;
        shift_body(body, by);
    }
    tree_.shift(by);
    firm_tree_.shift(by);
    for (const Pair& pair : pairs_.rows())
        pair.algorithm->visit_manifolds([&](btPersistentManifold& manifold, const PairRecord&) {
            shift_manifold(manifold, bodies_[pair.a].is_level, bodies_[pair.b].is_level, to_bullet(by));
        });
    for (RigidContact& contact : contacts_) contact.point += by;
    for (RigidContact& load : loads_) load.point += by;
}

}  // namespace cullet::bullet
