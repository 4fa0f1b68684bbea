#include "systems/models/thick_shell/thresholds.hpp"

#include <algorithm>

#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "systems/models/thick_shell/run_hit.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "systems/models/thick_shell/shared/working_room.hpp"
#include "systems/models/thick_shell/stiffness/costs.hpp"
#include "systems/structures/shell/costs.hpp"
#include "systems/structures/shell/rest_of_body.hpp"

namespace cullet {
namespace {

constexpr uint32_t kThresholdPlaces = 4;
// Of the force that a blow may pass, so much is borne for long: hidden runs give a wall twice the strength that the
// table has for seconds (thick shell note, B7).
constexpr float kForLong = 0.5f;

// (2/3) sigma_t h^2: what a square of the wall bears in its middle that lies on two of its edges.
float estimated_force(const RunRows& state, Row<Structures> shell) {
    const float h = state.shells.thickness[state.shell_of(shell)];
    return 0.667f * state.materials.tensile_strength[state.structures.material[shell]] * h * h;
}

// 0.1 sigma_d / (rho c): what a wave in a bar carries; only where nothing was measured. 0 of what does not crack.
float estimated_threshold(const RunRows& state, Row<Structures> shell) {
    const uint32_t m = state.structures.material[shell];
    const Materials& materials = state.materials;
    return 0.2f * materials.tensile_strength[m] / std::sqrt(materials.young_modulus[m] * materials.density[m]);
}

}  // namespace

uint64_t units_of_a_hit(const RunRows& state, Row<Structures> shell) {
    const Row<Shells> row = state.shell_of(shell);
    const bool is_local = is_for_cut_outs(state, shell, false);
    const uint32_t vertices = is_local ? kWholeCopyVertices : state.shells.vertices[row].count;
    const float run = run_seconds(state, state.structures.material[shell], state.structures.area[shell]);
    const auto steps = static_cast<uint64_t>(run / state.shells.time_step[row]) + 1;
    return steps * units_a_step(vertices + vertices / 10, 64) + 300 * kUnitsCut +
           vertices * (kUnitsOpen + (is_local ? kUnitsAssemble : 0));  // a blow that breaks grows it by a tenth
}

void measure_thresholds(RunRows& state, Row<Structures> shell, const Cooking& from) {
    float speeds[kThresholdPlaces], forces[kThresholdPlaces];
    for (uint32_t place = 0; place < kThresholdPlaces; ++place) {
        const FirstCrack crack = first_crack(state, shell, seeded_direction(from.settings.seed, place));
        if (!(crack.speed > 0)) return estimate_thresholds(state, shell);  // no room: else any touch would be a hit
        speeds[place] = crack.speed;
        forces[place] = crack.force;
        from.tell(0.4f + 0.6f * static_cast<float>(place + 1) / kThresholdPlaces);
    }
    std::sort(speeds, speeds + kThresholdPlaces);
    std::sort(forces, forces + kThresholdPlaces);
    state.structures.first_crack_speed[shell] = 0.5f * (speeds[1] + speeds[2]);
    state.structures.first_crack_force[shell] = kForLong * 0.5f * (forces[1] + forces[2]);
}

void estimate_thresholds(RunRows& state, Row<Structures> shell) {
    state.structures.first_crack_speed[shell] = estimated_threshold(state, shell);
    state.structures.first_crack_force[shell] =
        state.structures.first_crack_speed[shell] > 0 ? estimated_force(state, shell) : 0;
}

}  // namespace cullet
