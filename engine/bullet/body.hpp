// A row of the bridge: one body, static mesh or sphere, with its Bullet body in place.
#pragma once
#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <memory>
#include <optional>

#include "engine/bullet/bullet_types.hpp"
#include "engine/bullet/contact_patch.hpp"
#include "engine/bullet/hull.hpp"
#include "engine/bullet/static_mesh.hpp"
#include "engine/rigid_world.hpp"

namespace cullet::bullet {

struct Body;

inline constexpr uint32_t kNoLeaf = 0xffffffffu;

/// What Bullet sees of a body: the bounds of its points, grown by the range of contacts.
class BodyShape : public btCollisionShape {
 public:
    BodyShape() { m_shapeType = INVALID_SHAPE_PROXYTYPE; }
    void getAabb(const btTransform&, btVector3& low, btVector3& high) const override {
        const Box wide = grown(box, kContactRange);
        low = to_bullet(wide.low);
        high = to_bullet(wide.high);
    }
    void setLocalScaling(const btVector3&) override {}
    const btVector3& getLocalScaling() const override {
        static const btVector3 one(1, 1, 1);
        return one;
    }
    void calculateLocalInertia(btScalar, btVector3& inertia) const override { inertia.setZero(); }
    const char* getName() const override { return "cullet"; }
    void setMargin(btScalar) override {}
    btScalar getMargin() const override { return 0; }

    Box box = empty_box();  // world, of all pieces with their margins
};

struct Body {
    RigidId id = kNoRigid;
    bool is_used = false;
    RigidKind kind = RigidKind::Dynamic;
    std::optional<btRigidBody> bullet;
    BodyShape shape;
    uint32_t layer = 0, mask = 0;
    uint32_t leaf = kNoLeaf;       // in the tree of boxes
    uint32_t firm_leaf = kNoLeaf;  // in that of what no solver moves
    BodyFrame frame;
    // Where the local points of the hulls stand: `frame` as it was when they were last made all at once. A small change
    // of shape moves the centre of mass and turns the axes; the hulls that stay then keep their points.
    BodyFrame hull_frame;
    bool has_offset = false;  // hull_frame is not frame
    btTransform hull_offset;  // hull frame -> Bullet frame, where they differ
    Vec3 hull_centre;         // the centre of mass in the hull frame
    float mass = 0;
    btVector3 moments{0, 0, 0};
    float friction = 0, restitution = 0, rolling_friction = 0, rolling_share = 0;
    float margin = 0;
    Hull* hulls = nullptr;  // in the order of the caller's pieces
    uint32_t hull_count = 0;
    bool lacks_seams = false;          // pieces came or went since they were marked, see seams.hpp
    std::unique_ptr<StaticMesh> mesh;  // static triangles only
    LeftOut left_out;                  // of what they were made of; not saved
    bool is_level = false;             // of static triangles: its frame is the world's, also after a shift
    Box local_box = empty_box();       // of the points with margins, hull frame
    float thickness = 0;               // least width of a piece
    float reach = 0;                   // of the farthest point from the centre of mass, at least
    float scale = 1;                   // of its thinnest piece, see lengths.hpp

    btTransform fresh_at;  // the hull frame's transform that world points stand for
    uint32_t moves = 0;    // counts changes of world points; pairs of unmoved bodies keep their contacts
    uint32_t shape_changes = 0;

    uint32_t number = 0;         // the solver's, in this step
    bool is_refreshed = false;   // in this detect()
    bool is_touched = false;     // has a contact in this step,
    bool is_held_up = false;     // one with what stands or moves slowly
    bool is_damped = false;      // has one that is not at the crack of its birth
    bool is_driven = false;      // has one with a kinematic body that moves
    float slow_seconds = 0;      // touched and nearly at rest
    float overlap = 0;           // m, of its deepest contact in this step, by the contact's scale
    float sunk = 0;              // the same, in what never moves
    float pressed_seconds = 0;   // that it was kept awake because something lay too deep in it
    float settling_seconds = 0;  // that it was laid to rest, and pushed out of what it lies in
    bool is_held = false;
    bool is_soft = false;  // has no contacts
    Motion kept;           // velocities of a held body

    btTransform anchor;  // the sleep timer's pose
    float still_seconds = 0;
    btTransform far_anchor;  // of the timer of what creeps and trembles
    float creep_seconds = 0;
    bool has_left = false;    // its anchor, in this step
    uint32_t idle_wakes = 0;  // by neighbours, since it last left its anchor or was struck
    float load = 0;           // N s of this step, see sum_loads()
    float slept_load = 0;     // of the step in which it fell asleep

    uint32_t birth = 0;         // siblings have the same,
    float sibling_seconds = 0;  // while this lasts

    Motion started;  // with which it came into this step
    Motion gained;   // m/s and rad/s a step, of what is held up: over the last steps, the last one counts half

    float moved_fraction = 1;     // of this step, less than 1 when stopped at a time of impact
    bool is_fast = false;         // swept in this step
    Vec3 glance;                  // m/s beside its velocity on this step's way, along what it glances over
    bool is_put_through = false;  // a sheet, by this step

    /// The hull frame's transform where the Bullet frame's is `at`.
    btTransform hulls_at(const btTransform& at) const { return has_offset ? at * hull_offset : at; }
    bool is_free() const { return kind == RigidKind::Dynamic && !is_held && bullet->isActive(); }
    bool meets_layer_of(const Body& other) const { return (layer & other.mask) != 0 && (other.layer & mask) != 0; }
};

inline bool is_ball(const Body& body) {
    return body.hull_count == 1 && body.hulls->point_count == 1;
}

/// Of its margin and width, whenever one of them is new: each contact asks for it.
inline void set_scale(Body& body) {
    body.scale = scale_of_width(body.margin, body.thickness, is_ball(body));
}
inline float scale_of(const Body& body) {
    return body.scale;
}
inline float scale_of(const Body& a, const Body& b) {
    return std::min(scale_of(a), scale_of(b));
}

/// No solver moves it.
inline bool is_firm(const Body& body) {
    return body.kind != RigidKind::Dynamic;
}

/// They were one body, and may not throw each other yet.
inline bool are_siblings(const Body& a, const Body& b) {
    return a.birth == b.birth && a.sibling_seconds > 0 && b.sibling_seconds > 0;
}

/// Its fastest point moves at less than a metre a second, or it does not move: what flies meets it about where it is.
bool is_slow(const Body& body);

inline Mat3 rotation_of(const btTransform& transform) {
    const btMatrix3x3& b = transform.getBasis();
    return {{from_bullet(b[0]), from_bullet(b[1]), from_bullet(b[2])}};
}

}  // namespace cullet::bullet
