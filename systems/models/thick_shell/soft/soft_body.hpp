// Bodies that can be awake: made, woken, frozen, given back.
#pragma once
#include "components/body_rows.hpp"
#include "cullet/result.hpp"
#include "engine/arena.hpp"
#include "engine/rigid_world.hpp"

namespace cullet {

inline constexpr uint32_t kLeastSubsteps = 8, kMostSubsteps = 1000;  // of a frame; with 200 steel is seen to be rubber
inline constexpr float kElasticWakeSpeed = 0.2f;                     // m/s of a contact
inline constexpr float kLeastWakeSpeed = 0.5f;                       // m/s, of ductile ones
inline constexpr float kWakeYieldShare = 0.3f;  // of the speed c eps_y at which a bar that is stopped begins to flow
inline constexpr float kQuietSeconds = 0.25f;
inline constexpr float kQuietSpeed = 0.003f;  // m/s, root mean square about the rigid motion; 0.02 leaves sheets bulged
inline constexpr uint64_t kSoftShare = 5;     // of the frame's units one soft body may use a part of so many

/// What a body that flows or stretches needs to know of its material.
struct SoftMaterial {
    bool is_elastic = false, is_sheet = false;  // a sheet has one layer, and a bending stiffness of its own
    float density = 0, young_modulus = 0, yield_strain = 0, break_strain = 0, restitution = 0;
};
/// False: brittle, and `out` is not written.
bool soft_material(const MaterialRows& state, Row<Materials> material, SoftMaterial& out);

/// A copy of the shell with room to tear; nothing else has it. A row that does not exist: `full` names the limit.
Row<Structures> copy_soft_shell(ShellRows& state, Row<Structures> source, const char** full);

/// The body's shell, which it does not share, gets springs, and the body a row. One layer where the material has its
/// own bending stiffness (cloth), else a sandwich. A frame's step is cut into as many substeps as the true modulus asks
/// for, 8 to 1,000, and no more than `units` (a frame's) allow. Where that is too few, the springs are softened: E_eff
/// = E (stable step / step)^2, s = E / E_eff. Strains at yield and break are sqrt(s) times the true ones. But no spring
/// is shown stretched by more than the true strain at break, or twice its length where that is more. Allocates rows
/// alone.
Result<Row<SoftBodies>> make_soft(SoftRows& state, Row<Bodies> body, const LayerSettings& layers, float step_seconds,
                                  uint64_t units);
/// A row for a piece of `parent`, whose shell has springs already: like it, rigid so far, and called to wake.
void inherit_soft(SoftRows& state, Row<SoftBodies> parent, Row<Bodies> body);
/// The row goes, if the body has one; its springs go with its shell.
void release_soft(SoftRows& state, Row<Bodies> body);

/// Springs of a row: those of its body's shell.
Row<ShellSprings> springs_of(const SoftRows& state, Row<SoftBodies> soft);

/// From rigid to awake: points where the body stands, moving as it moves. The rigid world has no more contacts of it.
void wake_soft(SoftRows& state, RigidWorld& rigid, Row<SoftBodies> soft);
/// Mass properties and hulls of the shape that it has now.
void reshape_soft(SoftRows& state, RigidWorld& rigid, Row<SoftBodies> soft, Arena& arena);
/// From awake to rigid, reshaped. Springs keep their lengths.
void freeze_soft(SoftRows& state, RigidWorld& rigid, Row<SoftBodies> soft, Arena& arena);
/// A blow of the game's at a point of the body frame wakes the body: N s, body axes, shared out over the vertices
/// within `radius` by m (1 - (r / radius)^2). Where that would make any faster than `fastest`, m/s, the radius is
/// doubled; and a body that is too light as a whole (of what its pins leave free) gets less.
void push_soft(SoftRows& state, RigidWorld& rigid, Row<SoftBodies> soft, Vec3 point, Vec3 impulse, float radius,
               float fastest);
/// The game has put an awake body somewhere, or given it another motion: its points follow as a rigid body's.
void follow_body(SoftRows& state, Row<Bodies> body);

}  // namespace cullet
