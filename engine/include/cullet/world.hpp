// A world: rigid bodies, some of which break.
//
// Threads: a world belongs to one thread at a time; different worlds may be used from different threads at once. Calls
// other than step() go between steps. Nothing here throws. step() allocates nothing of cullet's.
//
// Stack: 64 KiB are enough for any call here, for cook and for the files, and for each job that a host's job system
// runs. A host's own functions (log, zones, veto, jobs) come on top of that.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cullet/damage.hpp"
#include "cullet/events.hpp"
#include "cullet/host.hpp"
#include "cullet/model.hpp"
#include "cullet/result.hpp"
#include "cullet/rigid.hpp"
#include "cullet/settings.hpp"
#include "cullet/types.hpp"
#include "cullet/view.hpp"

namespace cullet {

/// Axis-aligned, body coordinates, m.
struct Box {
    Vec3 low, high;
};

/// How a body meets others. Two bodies collide when each one's layer is in the other's mask. Of their frictions, and of
/// their restitutions, the geometric mean counts.
struct ContactSettings {
    // At most 100. < 0: the material's; 0.45 for what has none: spheres, static triangles, kinematic boxes.
    float friction = -1;
    float restitution = -1;  // at most 1; < 0: of sheet metal the material's, else 0.2; used above 0.2 m/s
    // Of balls and what they roll on, as a share of the ball's radius. On a level floor a ball of uniform density slows
    // by rolling_friction * g / 1.4. On a slope it starts to roll where the slope's tangent is larger. Of two bodies
    // the larger one counts. At most 1; < 0: 0.01 of a ball, 0 of all else. What is no ball rolls as on the rim of a
    // chipped thing, by its shape. With 0 and more it rolls like a ball of as much surface instead.
    float rolling_friction = -1;
    uint32_t layer = 1;  // bits
    uint32_t mask = 0xffffffffu;
};

struct SpawnSettings {
    Pose pose;
    Motion motion;
    ContactSettings contact;
    uint64_t user_data = 0;    // comes back in events; fragments inherit it
    bool is_breakable = true;  // false: rigid for good, of any material
    /// Above 0; on the material's strength (soft ones: strains). Fragments inherit it. Infinity never cracks.
    float strength_scale = 1;
    /// Of where it is weak and where strong, of brittle shells. Two bodies with different seeds break differently, two
    /// with the same one alike. 0: the model's own, CookSettings::seed.
    uint64_t strength_seed = 0;
    /// Vertices inside any of these are fixed to the world. The body is then static, and `motion` counts for nothing.
    /// Refused when no vertex lies in any.
    const Box* pins = nullptr;
    uint32_t pin_count = 0;
    // Of one damage model each; those of the others count for nothing.
    ThickShellSpawnSettings thick_shell = {};
};
/// The settings that a damage model has of its own in SpawnSettings, as lists. None of a name that there is not.
std::vector<SettingGroup<SpawnSettings>> spawn_settings_of(const std::string& damage_model);

/// A solid sphere: a ball, a bullet.
struct SphereSettings {
    Pose pose;
    Motion motion;
    float radius = 0.1f;  // m, above 0, at most 1e6
    float mass = 1;       // kg, above 0, at most 1e12
    ContactSettings contact;
    uint64_t user_data = 0;
};

/// A convex solid that the game moves by its velocities: a lift, a door. It breaks a breakable body that it presses
/// against something that does not yield, however slowly it comes.
struct KinematicSettings {
    Pose pose;
    Motion motion;
    Vec3 half_extents{0.5f, 0.1f, 0.5f};  // of a box, m, above 0, at most 1e6
    ContactSettings contact;
    uint64_t user_data = 0;
};

/// What a step did, for people; reading it is optional.
struct StepReport {
    uint64_t frame = 0;
    uint64_t units_used = 0, units_left = 0;
    uint32_t open_hits = 0, held_bodies = 0;
    uint32_t bodies = 0, awake = 0, debris = 0;
    // What it costs, and what waits.
    uint32_t fragments = 0;       // alive, as World::fragments lists them
    uint32_t waiting_hits = 0;    // hits and blows that no damage task works on yet
    uint32_t waiting_bodies = 0;  // bodies with pieces that are loose and found no room
    // Since the oldest open hit or blow was opened, or the oldest waiting hit came; 0: there is none, or foreseen ones.
    uint64_t oldest_hit_frames = 0;
    uint64_t retired = 0;  // fragments, since the world was made
    uint64_t faded = 0;    // debris, since the world was made
};

/// What becomes of a fragment that the game has seen enough of.
enum class Retirement : uint8_t {
    Remove,  // it is gone, and its handle stale
    Freeze,  // it is static where it is: others still lie on it and hit it, but it never moves or breaks again
    Merge,   // it is scenery: drawn where it lies, met by nothing, found by queries alone. What it was made of is given
             // back. Its handle and its drawn mesh stay until remove()
};

struct RetireSettings {
    Retirement how = Retirement::Remove;
    uint32_t count = 0xffffffffu;  // at most so many, the oldest first
    float least_seconds = 0;       // since it broke off; 0 to 1e9
    bool only_asleep = false;
};

/// A piece that broke off something and that the game has not retired.
struct FragmentAge {
    BodyId fragment;
    uint64_t frames = 0;  // since it broke off
    double mass = 0;      // kg
    bool is_asleep = false;
};

class World {
 public:
    /// Bullet moves the bodies. In cullet::cullet alone.
    static Result<World> create(const Settings& settings, const Host& host = {});
    /// The host moves the bodies (rigid.hpp). Gravity counts for debris alone, and no sweeps are made.
    static Result<World> create_hosted(const Settings& settings, const Host& host = {});
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;
    ~World();

    /// One fixed step of Settings::step_seconds. Of a world of create_hosted: logs that it does nothing.
    void step();
    /// The same where the host moves the bodies. Refuses rows that are not finite, and worlds that Bullet moves.
    Result<void> step(const HostFrame& frame);
    /// What the host is to do after step(frame), before it solves; empty in a world that Bullet moves.
    HostChanges host_changes() const;
    StepReport report() const;
    /// What the rigid bodies behind the world cost.
    RigidReport rigid_report() const;
    StepEvents events() const;
    /// A number for the whole state: equal on any number of threads.
    uint64_t hash() const;

    /// m/s2, at most 10000 a component. Wakes all that sleeps, unless it is the gravity that there is already.
    Result<void> set_gravity(Vec3 gravity);
    /// `allows` is asked before damage is looked at. False lets the hit pass as between rigid bodies. It is called on
    /// the thread that steps, between the parallel parts, and must not call the world.
    void set_veto(bool (*allows)(void* user, const ImpactEvent& impact), void* user);

    // All calls below refuse with a sentence what is wrong, and then change nothing. Wrong are handles of what is gone
    // or never was. So are poses that are not finite, farther than 1e6 m from the origin along an axis, or turned by no
    // unit quaternion. So are velocities above 1e5 m/s or rad/s a component, values out of the ranges above, and what a
    // limit has no room for.
    /// Models can go at any time; bodies made of them live on. Refused: an empty one, and one for which a table of the
    /// world has no room.
    Result<ModelId> add_model(const Model& model);
    Result<void> remove_model(ModelId model);

    /// A sheet of static triangles may cut the body where it is put. Then the body comes at once to the side that its
    /// centre of mass is on. A body that merely reaches around a sheet stays. pose() tells where a body is.
    Result<BodyId> spawn(ModelId model, const SpawnSettings& settings = {});
    Result<BodyId> add_sphere(const SphereSettings& settings);
    Result<BodyId> add_kinematic_box(const KinematicSettings& settings);
    /// Triangles in world coordinates that never move: floors, tables, level geometry. They bear from both sides,
    /// however they are wound. Nothing passes one. What a step, a break or a spawn has put a little way behind one
    /// comes back. `one_sided`: only the side that sees the corners counter-clockwise bears, and things come out
    /// through it freely. Closed convex parts of at most 32 corners that are wound outwards are solid in either case.
    /// Triangles without area, and those that were given before, are left out; Host::log tells how many. Refused: no
    /// triangles, indices beyond the positions, positions that are not finite or beyond 1e6 m.
    Result<BodyId> add_static(const MeshView& triangles, const ContactSettings& contact = {}, uint64_t user_data = 0,
                              bool one_sided = false);
    /// Hits on it that are still being worked off go with it.
    Result<void> remove(BodyId body);

    /// Fragments go, the oldest first, those of one frame by row. Returns how many went. A fragment is passed over
    /// while a hit on it is being worked off, or while it is the striker of one. One with loose pieces that wait is
    /// not frozen or merged. Refused: what is out of range.
    Result<uint32_t> retire(const RetireSettings& settings);
    /// Fills `out` with up to `capacity` fragments, the oldest first, those of one frame by row, and returns how many
    /// there are. What was frozen or merged is no more among them.
    uint32_t fragments(FragmentAge* out, uint32_t capacity) const;

    bool is_alive(BodyId body) const;
    Result<Pose> pose(BodyId body) const;
    Result<Motion> motion(BodyId body) const;
    Result<double> mass(BodyId body) const;  // kg
    Result<uint64_t> user_data(BodyId body) const;
    Result<bool> is_asleep(BodyId body) const;
    /// Puts the body there at once. Wakes it and what touches it, unless it is there already. Where a sheet cuts it, it
    /// comes to another place, as in spawn(). Refused for static triangles.
    Result<void> set_pose(BodyId body, const Pose& pose);
    /// Of its centre of mass. Wakes the body, unless it sleeps and this is its motion already, or none. Refused for
    /// static and pinned bodies.
    Result<void> set_motion(BodyId body, const Motion& motion);
    /// At a world place, N s: any finite impulse that leaves the body's velocities in range. Wakes the body, unless the
    /// impulse is none. Does nothing to a body that forces do not move.
    Result<void> apply_impulse(BodyId body, Vec3 impulse, Vec3 place);
    Result<void> wake(BodyId body);

    // Blows (damage.hpp), taken at the start of the next step. Refused: what is not finite or out of range, a body that
    // is gone, and more blows than can wait. That many are limits.queued_hits and one a body.
    /// As if a rigid striker hit the body there.
    Result<void> push_impact(BodyId body, const PushSettings& push);
    /// On all bodies in reach.
    Result<void> explode(const ExplosionSettings& explosion);
    /// Cuts one breakable body of a brittle material, down to any size. When `body` is null, cuts all of them that the
    /// surface passes through. Ductile, elastic and unbreakable bodies are refused by name. Otherwise they are passed
    /// over, and a RefusedEvent tells of those that dent.
    Result<void> cut(BodyId body, const CutSettings& cut);

    /// The place `by` becomes the origin: every coordinate c of the world, of events and of drawn poses becomes c - by.
    /// Views and body frames stay. May be called between steps at any time, also while hits are worked off. Nothing
    /// wakes. Places round to floats of the new size: far from the origin (0.25 mm at 4 km) a little is lost, near it
    /// nothing more. A host that moves the bodies shifts its own. O(bodies + static triangles).
    Result<void> shift_origin(Vec3 by);

    /// Fills `out` with up to `capacity` bodies in row order and returns how many there are.
    uint32_t bodies(BodyId* out, uint32_t capacity) const;
    /// The drawn mesh of a breakable body; empty for others.
    Result<BodyView> view(BodyId body) const;
    /// Cracks that have not parted the body: both of their faces lie in one place, so that triangles do not show them.
    /// Writes pairs of indices into view(body).vertices, in the order of their places. Each pair is one line. It comes
    /// once along the outer wall (uv.y is 0) and once along the inner one. Draw it thin and dark, a little towards the
    /// eye. Returns how many indices. Half of the view's index_count is always room enough; too little is refused. Ask
    /// when the stamp has changed. Costs 0.2 microseconds an edge of the crack faces, and allocates nothing.
    Result<uint32_t> hairlines(BodyId body, uint32_t* indices, uint32_t room) const;

    // A snapshot holds all that later steps depend on, in the middle of a hit too. It does not hold the host's
    // functions, nor the veto. A world that loads it and the one that saved it go on with the same bytes. For that the
    // one that saves makes its rigid bodies anew. This costs about as much as a frame in which all of them are born. It
    // may change what comes after in the last digits. Handles stay good; views, events and addresses do not.
    // In a world of create_hosted, host_changes() after a load names all breakable bodies as born, and all balls and
    // boxes as moved. It also names all pairs that are apart, and what the game removed since the step before the save.
    Result<std::vector<uint8_t>> snapshot();
    /// `name` stands in sentences. What is refused leaves the world as it was. Limits and settings are the snapshot's.
    Result<void> restore(const uint8_t* bytes, size_t size, const char* name = "snapshot");
    /// The same, to and from a file. The file is packed by Zstandard: 200 intact pots of one model take 3 MB in place
    /// of 200. load reads the bytes of snapshot() as well. It refuses what unpacks to more than 8 GiB.
    Result<void> save(const std::string& path);
    Result<void> load(const std::string& path);

    /// From now on every call that changes the world, and a hash after each step, go to this file, a step at a time.
    /// Models go to the folder `path`.models. recording.hpp plays it again. Costs two hashes of the state a step. A
    /// recording ends when it can be written no further, and the log is told.
    Result<void> start_recording(const std::string& path);
    /// Empty, or a sentence: why it ended before.
    Result<void> stop_recording();

    /// The systems of a frame in order, with what each reads and writes.
    static std::string describe_frame();

    struct Contents;
    /// For the sample game, tests and measurements: tables and profiler. Not part of the stable interface.
    Contents& contents();
    const Contents& contents() const;

 private:
    explicit World(std::unique_ptr<Contents> contents);
    std::unique_ptr<Contents> contents_;
};

}  // namespace cullet
