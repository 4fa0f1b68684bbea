// What cullet asks of a rigid-body engine. Bullet stands behind it (engine/bullet/), or a host's own engine
// (engine/host_rigid_world.hpp). One step is: sweep and detect(), then the gap in which damage is decided and bodies
// are born, held, released or removed, then solve().
//
// A body frame is the frame of the mesh it was cooked from: fragments keep their parent's. Its centre of mass and its
// inertia tensor are given in that frame; principal axes are the bridge's own affair.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "cullet/result.hpp"

#include "engine/math.hpp"

namespace cullet {

struct ByteWriter;
class ByteReader;
class JobSystem;

using RigidId = uint32_t;  // the caller's own small integer (a row of Bodies), below the limit given at creation
inline constexpr RigidId kNoRigid = 0xffffffffu;
inline constexpr uint32_t kNoShape = 0xffffffffu;

enum class RigidKind : uint8_t { Static, Kinematic, Dynamic };

/// One convex piece: at most 32 points in the body frame. Its corners are already pulled in by `margin`.
struct ConvexPiece {
    std::span<const Vec3> points;
    uint32_t cell = 0;  // the caller's name for it, comes back in contacts
    /// Where not kNoRigid: the points are, one by one, those that this body's piece `same_cell` was made of, so that
    /// its faces need not be found again. Only a hint: a body or piece that is not there, or has another number of
    /// points, costs the search.
    RigidId same_body = kNoRigid;
    uint32_t same_cell = 0;
    uint32_t shape = kNoShape;  // of make_shape: the faces of these points are found already
};

struct RigidDescription {
    RigidKind kind = RigidKind::Dynamic;
    Pose pose;
    Motion motion;          // velocity of the centre of mass
    double mass = 1;        // kg, dynamic bodies only
    Vec3d centre;           // centre of mass, body frame, m
    Sym3d inertia;          // about the centre, body axes, kg m2
    float margin = 0.001f;  // m
    float friction = 0.45f;
    float restitution = 0.2f;     // used above 0.2 m/s
    float rolling_friction = 0;   // of its own shape: a length, m; both bodies' count together, but beside a ball
    float rolling_share = 0;      // of a ball's radius, of balls and of what they roll on: the larger one counts
    uint32_t layer = 1;           // bits
    uint32_t mask = 0xffffffffu;  // layers it meets
    float radius = 0;             // > 0: a sphere about the body frame's origin, pieces unused
    RigidId parent = kNoRigid;    // it was part of this body until now, and is where it was in it
    std::span<const ConvexPiece> pieces;
};

/// One contact point of this step, before the solve. Sorted by (a, b, cell_a, cell_b, order of Bullet's cache), a < b.
struct RigidContact {
    RigidId a = kNoRigid, b = kNoRigid;
    uint32_t cell_a = 0, cell_b = 0;
    Vec3 point;          // world, midway, m
    Vec3 normal;         // world, unit, from b towards a
    float distance = 0;  // m, negative when they overlap
    float approach_speed =
        0;              // m/s along the normal, > 0 when they close, from the velocities before gravity of this step
    float impulse = 0;  // N s along the normal: of the last solve, in loads() alone
};

/// A place on the crack between two bodies: world axes.
struct CrackTouch {
    Vec3 point, normal;  // normal: unit, from b towards a, or zero where there is none
    float reach = 0;     // m, of this part of the crack to both sides of the point
};

struct LeftOut {
    uint32_t count = 0, first = 0;  // triangles; the first of them
};

/// The plane of a body's surface that is nearest to a point: world axes.
struct RigidSurface {
    Vec3 point, normal;  // normal: unit, out of the body
    float distance = 0;  // m, negative inside
};

/// Where something small meets a body on its way.
struct RigidTouch {
    float share = 0;        // of the way, 0 to 1
    Vec3 place;             // of its centre then, free of the body: world
    Vec3 normal, velocity;  // of the surface there: unit, out of the body; m/s
    bool is_still = false;  // the body does not move: static, held or asleep
};

inline constexpr uint32_t kMostForeseenContacts = 24;

/// The first touch of a body that flies, before it comes.
struct ForeseenTouch {
    uint32_t steps = 0;  // calls of detect() until one finds these contacts: 1 is the next
    Pose pose;           // of the body then; what it meets is where it is now
    Motion motion;
    uint32_t contact_count = 0;
    std::array<RigidContact, kMostForeseenContacts> contacts;  // ordered as contacts() is
};

struct RigidCounts {
    uint32_t sweeps = 0;  // bodies placed at their time of impact, since creation
    uint32_t pairs = 0, contacts = 0;
    // Calls for memory inside of the rigid engine since creation, where the program counts them: 0 elsewhere (see
    // rigid_allocations.hpp).
    uint64_t allocations = 0;
};

/// Work that came into the rigid world by other ways than forces, J, of all solves since creation. Without it contacts
/// take energy and never give any. Measured in Checked and Debug builds alone.
struct RigidWork {
    double lifted = 0;  // against gravity, by moving overlapping bodies apart
    double ahead = 0;   // gravity's on bodies that were stopped on their way, less what was taken back: hardly above 0
    double driven = 0;  // kinematic bodies', at their contacts: at most so much
    double sum() const { return lifted + ahead + driven; }
};

class RigidWorld {
 public:
    virtual ~RigidWorld() = default;

    virtual void set_gravity(Vec3 gravity) = 0;

    /// Triangles in world axes that never move. `id` names it in contacts.
    /// Triangles that are no closed convex part bear from both sides, unless `one_sided`: then only the side that sees
    /// the corners counter-clockwise does.
    virtual void add_static_triangles(RigidId id, std::span<const Vec3> positions,
                                      std::span<const std::array<uint32_t, 3>> triangles, float friction,
                                      float restitution, uint32_t layer, uint32_t mask, bool one_sided = false) = 0;
    /// What of these triangles has no area, or was there before: nothing meets it.
    virtual LeftOut left_out(RigidId) const { return {}; }
    /// RigidDescription::rolling_share of a body that is there: for static triangles.
    virtual void set_rolling_share(RigidId, float) {}
    virtual void add(RigidId id, const RigidDescription& description) = 0;
    virtual void remove(RigidId id) = 0;
    /// The body is another one from now on, where it is: what sleeps on it sleeps on.
    virtual void replace(RigidId id, const RigidDescription& description) {
        remove(id);
        add(id, description);
    }

    virtual Pose pose(RigidId id) const = 0;
    virtual Motion motion(RigidId id) const = 0;  // velocity at the centre of mass
    virtual void set_pose(RigidId id, const Pose& pose) = 0;
    virtual void set_motion(RigidId id, const Motion& motion) = 0;
    /// Every place there is moves by this, contacts too; nothing wakes, and no body is seen to have moved.
    virtual void shift(Vec3 by) = 0;
    /// New mass, centre, inertia and pieces for a body whose frame and pose stay (pieces came off, cells changed).
    virtual void set_shape(RigidId id, double mass, Vec3d centre, Sym3d inertia,
                           std::span<const ConvexPiece> pieces) = 0;
    /// The same where most pieces stay: those named in `gone` (ConvexPiece::cell, rising; who is not there is passed
    /// over) are taken out, `pieces`, rising too, come in. What it costs goes with the pieces that change. All pieces
    /// that the body has were given by rising names. False: nothing is done, this world wants all pieces.
    virtual bool change_shape(RigidId, double, Vec3d, Sym3d, std::span<const uint32_t>, std::span<const ConvexPiece>) {
        return false;
    }

    /// Shapes for pieces of this gap, numbered from 0: what finds the faces of a piece, most of the price of adding it,
    /// may run ahead and on all threads. Those of the last call that no piece took are forgotten.
    virtual void reserve_shapes(uint32_t count) = 0;
    /// Finds the faces of these points. Writes to this shape alone: different ones may be made at once.
    virtual void make_shape(uint32_t shape, std::span<const Vec3> points) const = 0;

    /// Where detect() and solve() may share their work out; without it they run on the calling thread alone. What they
    /// find and make is the same. It must outlive the world.
    virtual void use_jobs(JobSystem&) {}
    /// Finds contacts at the poses that bodies have now. Fast bodies, kinematic ones too, were stopped at their time of
    /// impact by the solve() before, half a millimetre away and with their velocities whole. At most 12 contacts a
    /// pair.
    virtual void detect(float dt) = 0;
    virtual std::span<const RigidContact> contacts() const = 0;

    // The gap.
    /// Where a body in flight first touches another one, should nothing push it before: the next `steps` steps are made
    /// for it alone, among bodies that stand still or move slower than 1 m/s, where those are now. One that is held up
    /// goes on as it did in the last steps, as slabs that topple do, and does not meet what it touches already. False:
    /// it touches nobody, or does not move (asleep, held), or this world cannot tell. Changes nothing.
    virtual bool foresee(RigidId, float, uint32_t, ForeseenTouch&) { return false; }
    /// Stands still with infinite mass for everybody until released; its velocities are kept. Hold and release both
    /// belong in the gap: a release is then bit for bit as if never held.
    virtual void hold(RigidId id) = 0;
    virtual void release(RigidId id) = 0;
    virtual bool is_held(RigidId id) const = 0;
    /// What is held stands elsewhere, wherever that is. A host moves its bodies itself.
    virtual void carry(RigidId, Vec3) {}
    /// Contacts between these two are not solved in this step.
    virtual void skip_contacts(RigidId a, RigidId b) = 0;
    /// Contacts between these two have at least this restitution in this step. A host's are its own affair.
    virtual void set_bounce(RigidId, RigidId, float) {}
    /// No narrow phase between these two for so long (a striker and the shards it made).
    virtual void ignore_pair(RigidId a, RigidId b, float seconds) = 0;
    /// These were one body until now. For half a second what they do to each other does not throw them: it takes speed
    /// from their flight beside each other and from their spins, and gives none. A host's contacts are its own affair.
    virtual void name_siblings(std::span<const RigidId>) {}
    /// The two were one body until now, and are where they were in it. Some convex pieces of theirs lie in each other,
    /// as hulls about the teeth of a crack do, or are nearer than contacts reach. They meet at those of `touches` that
    /// are near, or not at all, until they are farther apart, for a quarter of a second at most.
    virtual void part_siblings(RigidId a, RigidId b, std::span<const CrackTouch> touches) = 0;

    /// A soft body stands as it is put and has no contacts; nothing is swept against it. Who runs its springs asks for
    /// the surfaces of what it may meet. Belongs in the gap, and on ends before detect().
    virtual void set_soft(RigidId, bool) {}
    /// Whether the questions below have answers: a host keeps its shapes to itself.
    virtual bool knows_surfaces() const { return false; }
    /// Bodies whose bounds meet this box, rising; how many, at most as many as `out` has room for.
    virtual uint32_t near_bodies(Vec3, Vec3, std::span<RigidId>) const { return 0; }
    /// The nearest face within `reach` m of the point, at the pose that the body has now. Of a compound that of the
    /// piece whose faces are nearest, seams left out. May be asked on all threads at once. Balls have none. A triangle
    /// that bears from both sides shows the one that sees `seen_from`, or the point where that is null.
    virtual bool nearest_surface(RigidId, Vec3, float, RigidSurface&, const Vec3* = nullptr) const { return false; }
    /// Of something small that comes off a body at this place: where it is on the side of static triangles that the
    /// body is on.
    virtual Vec3 to_side_of(RigidId, Vec3 place) const { return place; }
    /// The first touch of a ball of `radius` on its way from one place to the other, in the `seconds` in which bodies
    /// came to where they are. It is with those that reach at least `least_reach` m from their centres, and with all
    /// that never move. What it begins too deep in is passed over. Changes nothing; may be asked on all threads at
    /// once.
    virtual bool first_touch(Vec3, Vec3, float, float, float, RigidTouch&) const { return false; }
    /// By ignore_pair().
    virtual bool is_ignored(RigidId, RigidId) const { return false; }
    /// Layers and masks let them meet.
    virtual bool may_meet(RigidId, RigidId) const { return false; }
    /// Something rigid touches it in this step.
    virtual bool is_touched(RigidId) const { return false; }
    /// Touches something that stands or moves slowly, so that it does not fly on as it flies now. Pieces of one shower
    /// touch each other all the way down.
    virtual bool is_held_up(RigidId) const { return false; }

    virtual void solve(float dt) = 0;
    /// The contacts of the last solve, until the next detect(): what they bore, and in `approach_speed` how fast they
    /// close after it, beyond what is still apart: what the solver could not hold. In the order of contacts(), and with
    /// those of what is held and whatever does not move, which bear nothing. A host tells both with the contacts of the
    /// next step.
    virtual std::span<const RigidContact> loads() const { return contacts(); }

    /// Height of the highest static triangle straight below `point`, or `fallback`: where debris comes to rest in a
    /// world that does not know surfaces, and asked of no other.
    virtual float height_below(Vec3, float fallback) const { return fallback; }
    virtual bool is_asleep(RigidId id) const = 0;
    virtual void wake(RigidId id) = 0;
    virtual RigidCounts counts() const = 0;
    /// N s, of all solves since creation: what dynamic bodies gave through contacts to whatever did not move by forces:
    /// static, kinematic and held bodies. What sleep took from slow bodies is in it. With it the momentum of
    /// the dynamic bodies changes by gravity's share alone.
    virtual Vec3d impulse_to_static() const = 0;
    virtual RigidWork work() const { return {}; }

    /// Of a body that is there.
    virtual std::optional<RigidKind> kind(RigidId id) const = 0;
    /// An empty world of the same kind; null when only a host can make one.
    virtual std::unique_ptr<RigidWorld> make_another(uint32_t body_limit) const = 0;
    /// Between steps: all that the next steps depend on. A world that was just made and then loads these bytes goes on
    /// as any other that loads them, bit for bit; whether as this one does, too, is not said.
    virtual void save(ByteWriter& out) const = 0;
    /// Believes nothing. After a refusal the world is good for nothing but to be thrown away.
    virtual Result<void> load(ByteReader& in) = 0;
};

/// A world of Bullet's for at most `body_limit` ids. `step_seconds` is the fixed step that sleep timers count in.
std::unique_ptr<RigidWorld> make_bullet_world(uint32_t body_limit);

}  // namespace cullet
