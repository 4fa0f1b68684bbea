// The contact of a hidden run (thick shell note, section 6.3): each vertex of a patch has a spring of its own against
// the striker, which may only push. One step:
//
//     contact_forces(side) -> integrate_packs over all packs -> apply_contact(side)
#pragma once
#include "components/shell_groups.hpp"
#include "systems/models/thick_shell/hidden/crush.hpp"

namespace cullet {

/// PatchVertices of all contacts of the task from present masses: when it opens, and again after every split. Needs the
/// contacts' vertex, normal, striker_radius and striker_inverse_mass, and the task's time_step. A vertex belongs to a
/// patch within r_c = max(3 h, 1.3 l, 0.35 R) of its vertex, when it lies on the same side of the surface.
void build_patches(RunRows& state, Row<Tasks> task);

/// The spring of a row of PatchVertices, whose stiffness must not be 0.
PatchSpring patch_spring(const PatchVertices& patches, uint32_t row);

/// Forces along n from the depths travel - n.u_i before the step, and what they crush (crush.hpp). True when some
/// spring pushes.
bool contact_forces(PatchTables state, Row<Tasks> task);

/// After the fused pass of the step that read `side` of the probe: adds dt f/m to v, dt^2 f/m to u, dt (dt + beta) f/m
/// to the next probe; moves the strikers and books their impulse.
void apply_contact(PassedTables state, Row<Tasks> task, uint32_t side);

/// Force that the body's springs exert on its pinned vertices at side `side` of the probe, N. Times dt, step by step,
/// this is the impulse that goes to the ground: with `impulse` of the contacts, what the body's momentum changes by is
/// contact impulse - pin impulse. Cost: all packs are looked at; a task books pins once, by that balance, at its end.
Vec3d pin_force(ShellView shell, uint32_t side);

/// sum m v of the free vertices, kg m/s, in vertex order.
Vec3d momentum(ShellView shell);

}  // namespace cullet
