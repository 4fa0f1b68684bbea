// One hit on one shell, from touch to end, without a world: what cooking measures with and truth is told by.
#pragma once
#include <span>

#include "components/bodies.hpp"
#include "components/run_rows.hpp"
#include "cullet/layers.hpp"
#include "cullet/quick.hpp"

namespace cullet {

/// Body axes; the body flies with `velocity`, the striker stands or moves along the normal.
struct HitDescription {
    Vec3 point;                      // m, near the surface
    Vec3 normal;                     // unit, the way the body is pushed
    Vec3 velocity, spin;             // of the body, m/s, rad/s
    float striker_speed = 0;         // m/s along the normal
    float striker_inverse_mass = 0;  // 1/kg, 0: floor
    float striker_radius = 0;        // m, 0: flat
    float strength_scale = 1;
    float step_scale = 1;          // on the shell's time step; its damping time, the body's own, stays. Truth halves it
    uint32_t region_vertices = 0;  // of the cut-out that the run begins on, as a large body's; 0: the whole shell
    const QuickSettings* quick = nullptr;  // the quick mode takes the hidden run's place
    LayerSettings layers;                  // of it
};

struct HitReport {
    bool cracked = false, broke = false, dropped = false;
    uint32_t steps = 0, cuts = 0, starts = 0, redos = 0, parts = 1;
    uint32_t moving = 0;                     // vertices of the task's shell at the end
    uint32_t awake = 0;                      // vertices that the quick mode's region began with
    double start_energy = 0;                 // J, of body and strikers, all of it kinetic
    double end_energy = 0, end_kinetic = 0;  // J, with and without what the springs hold
    double impulse = 0;                      // N s, to the body along the normal
    float striker_speed_after = 0;           // m/s along the normal
};

/// The three parts of run_hit, for those who drive the loop themselves: open_hit fills task row 0 (false: no room),
/// the task runs until its state is no longer Running, finish_hit counts its parts.
///
/// `parts` gets their masses, boxes and points when it has kMostParts places; when it is empty nobody wants them.
bool open_hit(RunRows& state, Row<Structures> shell, const HitDescription& hit);
/// A run that has come to the border of its region (hidden_region.hpp) begins again on a larger one. False: no room.
bool widen_hit(RunRows& state);
HitReport finish_hit(RunRows& state, std::span<FragmentPart> parts = {});

/// Takes task row 0 of `state`, which must be free, and leaves it with the end's shell (close_hit). `is_over`, when
/// given, ends the run early; it is asked after each repetition.
HitReport run_hit(RunRows& state, Row<Structures> shell, const HitDescription& hit,
                  bool (*is_over)(const RunRows&) = nullptr, std::span<FragmentPart> parts = {});
void close_hit(RunRows& state);

/// Lowest vertex in direction `down`, and what a fall on a floor in that direction looks like.
HitDescription fall_on_floor(const ShellRows& state, Row<Structures> shell, Vec3 down, float speed);

/// A direction from (seed, n), even over the sphere.
Vec3 seeded_direction(uint64_t seed, uint64_t n);

struct FirstCrack {
    float speed = 0;  // m/s
    float force = 0;  // N, the most that the contact has passed until then
};
/// Of a fall on a floor, when the first crack starts. Up to it the hidden run is homogeneous of degree one in the speed
/// (linear shell, springs without a gap that only push). So one run that may not crack gives it exactly. It is the
/// speed, and the force, over the largest ratio of stress to limit.
FirstCrack first_crack(RunRows& state, Row<Structures> shell, Vec3 down);

}  // namespace cullet
