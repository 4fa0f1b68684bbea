// Bodies of ductile and elastic materials. They are rigid in the rigid world until something hits them hard enough.
// Then their springs are run each frame, and their mesh is shown as it moves.
//
// While a body is awake Vertices.probe and Twins.position hold its points, in the working frame of its springs. After
// each frame Vertices.rest is the shape that they have, in the body frame. So drawing, queries, hulls and births see a
// rigid body whose shape changes. What its springs remember is in Springs: lengths as cooked, lengths after flowing.
#pragma once
#include "components/bodies.hpp"
#include "components/springs.hpp"

namespace cullet {

inline constexpr uint32_t kMostStrikers =
    16;                                       // bodies that one soft body meets in a frame; the later rows are left out
inline constexpr uint32_t kMostPartners = 8;  // bodies that one frozen body lies against
inline constexpr uint32_t kContactsAVertex = 2;

/// One row is one body that can be awake: as long as the body lives.
struct SoftBodies : Table<SoftBodies> {
    using Table::Table;
    CULLET_TABLE(soft_bodies);
    Column<uint8_t> is_used{*this, "is_used"};
    Column<Row<Bodies>> body{*this, "body"};  // Bodies::soft says it again
    Column<uint8_t> is_awake{*this, "is_awake"};
    Column<uint8_t> is_called{*this, "is_called"};  // wakes in the next step, whatever touches it
    Column<uint8_t> is_elastic{*this, "is_elastic"};
    Column<float> wake_speed{*this, "wake_speed", "m/s"};  // of a contact
    Column<uint32_t> substeps{*this, "substeps"};          // of a frame, 8 to 1,000
    Column<uint32_t> slow_frames{*this, "slow_frames"};    // that had units for fewer: it ran slower than the world
    Column<float> softening{*this, "softening"};           // s = E / E_eff, at least 1
    Column<float> yield_strain{*this, "yield_strain"};     // shown: of the softened springs; 0: never flows
    Column<float> break_strain{*this, "break_strain"};     // shown
    Column<float> drag_time{*this, "drag_time", "s"};      // in which motion about the rigid one falls to 1/e
    Column<float> quiet_seconds{*this, "quiet_seconds", "s"};
    Column<float> awake_seconds{*this, "awake_seconds", "s"};
    Column<double> most_motion{*this, "most_motion",
                               "J"};                   // largest energy of motion about the rigid one since it woke
    Column<uint8_t> is_torn{*this, "is_torn"};         // split since its pieces were looked for
    Column<uint8_t> is_moved{*this, "is_moved"};       // its shape is not the cooked one any more
    Column<uint32_t> tear_count{*this, "tear_count"};  // vertices split, ever
    Column<uint32_t> partner_count{*this, "partner_count"};
    Column<std::array<uint32_t, kMostPartners>> partners{*this, "partners"};  // rows that it lay against when it froze
    // Of the frame.
    Column<uint32_t> striker_count{*this, "striker_count", "1", Keep::Scratch};
    Column<uint32_t> contact_count{*this, "contact_count", "1", Keep::Scratch};   // rows of SoftContacts
    Column<uint8_t> has_fault{*this, "has_fault", "1", Keep::Scratch};            // something was not finite
    Column<uint8_t> lacks_room{*this, "lacks_room", "1", Keep::Scratch};          // a split found none
    Column<Vec3d> start_momentum{*this, "start_momentum", "N s", Keep::Scratch};  // of its points, as the frame began
    Column<uint32_t> granted{*this, "granted", "1", Keep::Scratch};  // substeps of this frame, at most `substeps`
};

/// A body that a soft one may meet in this frame, as the run sees it: a copy that its contacts move. Row
/// kMostStrikers s + i is the i-th of soft body s.
struct SoftStriker {
    uint32_t body = 0;
    uint32_t shares = 1;  // runs that have a copy of it in this frame: each has this part of its mass
    bool yields = false;  // moves by forces
    bool falls = false;   // nothing rigid bears it
    bool is_ball = false;
    float radius = 0;        // of a ball, m
    float friction = 0;      // of the pair
    float inverse_mass = 0;  // of the copy, 1/kg
    Sym3d inverse_inertia;   // of the copy, world axes as the frame began
    Vec3 start, centre;      // of mass, working frame: as the frame began, now
    Quat turn;               // since then
    Vec3 start_velocity, velocity, start_spin, spin;
    Vec3d impulse;                    // N s, given to the soft body
    Vec3 later_velocity, later_spin;  // what the body gets when it has been moved
    bool is_pushed = false;
};
struct SoftStrikers : Table<SoftStrikers> {
    using Table::Table;
    CULLET_TABLE(soft_strikers);
    Column<SoftStriker> striker{*this, "striker", "1", Keep::Scratch};
};

/// Eight vertices that may meet one striker in this frame. Each has the plane of the striker's surface that is nearest
/// to it. Let x be a vertex, seen from the striker's centre. Its axes are the world's as the frame began, and turn with
/// the striker. The vertex is inside where normal . x < distance; at a ball, where |x| < radius + offset.
struct alignas(32) SoftContact {
    uint32_t vertex[kLanes] = {};  // of the shell; lanes that are not used say the first's
    float normal[3][kLanes] = {};
    float distance[kLanes] = {};  // m; of lanes that are not used far below 0
    float offset[kLanes] = {};    // m that the wall reaches towards the striker beyond the outer point
    uint32_t striker = 0;         // of the soft body's
    uint32_t count = 0;           // lanes in use
    uint32_t inside = 0;          // a bit for each lane whose vertex is in the striker: what a substep looks at
};
/// Rows from first_contact_row of the shell's first vertex on.
struct SoftContacts : Table<SoftContacts> {
    using Table::Table;
    CULLET_TABLE(soft_contacts);
    Column<SoftContact> contact{*this, "contact", "1", Keep::Scratch};
};
inline constexpr uint32_t first_contact_row(uint32_t vertex) {
    return kContactsAVertex * (vertex / kLanes);
}

template <>
inline constexpr uint32_t kRowsPerChunk<Springs> = 1024;
template <>
inline constexpr uint32_t kRowsPerChunk<SoftBodies> = 1;  // the vertices of a whole body

}  // namespace cullet
