// Edge springs for a shell that has none yet.
#pragma once
#include <span>

#include "cullet/result.hpp"
#include "systems/models/thick_shell/springs/spring_view.hpp"

namespace cullet {

/// Bounds of gamma (B5): below the first a sandwich has no skins that bend as the thickness does.
inline constexpr float kLeastLengthFactor = 0.577350269f, kMostLengthFactor = 5;

/// gamma as it is taken: `wanted`, or the mean edge over the thickness where that is 0; within the bounds.
float length_factor_of(const ShellRows& state, Row<Structures> shell, float wanted);

struct SpringSettings {
    SpringLayout layout = SpringLayout::OneLayer;
    float young_modulus = 0;      // Pa; 0: the material's. Smaller: softened, for a step that a frame can afford
    float damping_ratio = 0.05f;  // zeta of c = 2 zeta sqrt(k mu), 0 to 0.3
    float length_factor = 0;      // gamma, 0.577 to 5; 0: mean edge / thickness within them
    float area_energy = 0;        // kappa_A of a triangle over E h A (B4), 0 to 100; 0: none
    float volume_energy = 0;      // kappa_V of a prism over E h A, 0 to 100; two layers only; 0: none
    float time_step = 0;          // s; 0: stable_spring_step
    bool is_slender = false;      // shear pairs at most half as stiff as the skins: a step twice as long (B5)
    float spare = 0;  // rows for springs to come, beside an eighth of those there are: a share of them, 0 to 4
};

/// Gives the shell springs along its edges by the area rule (Van Gelder): k = E h (sum of areas of the triangles at the
/// edge) / L0^2, h the mean depth of both ends. Two layers share h and are tied as `layout` says. A vertex has a third
/// of the mass of its elements. Nothing moves yet: start_springs comes next. Refused with a sentence: settings out of
/// range, a shell that has springs, no room (names the limit). Allocates nothing but rows. O(elements).
Result<Row<ShellSprings>> give_springs(ShellRows& state, Row<Structures> shell, const SpringSettings& settings);

/// A spring given by hand, between two vertices of a shell.
struct GivenSpring {
    uint32_t a = 0, b = 0;
    float rest_length = 0;  // m, >= 0
    float stiffness = 0;    // N/m, >= 0
};
/// The same for springs that no element has: chains, nets, joints. One layer; masses are the vertices' own. For setting
/// up: allocates. Refused besides: an end that is no vertex, a spring from a vertex to itself, more than 65 at one
/// vertex.
Result<Row<ShellSprings>> give_springs(ShellRows& state, Row<Structures> shell, std::span<const GivenSpring> springs,
                                       const SpringSettings& settings);

/// 0.6 * 2 / omega_max by Gershgorin's bound, omega_max^2 <= max over points of (2 / m) sum of k (B6): s. A mid spring
/// counts half, a shear pair twice as much as a spring. Damping, which works with the speed of the step before, is
/// stable while dt^2 K + 2 dt C < 4, C = (2 / m) sum of c: where it is strong, 0.9 of that. The largest float where
/// nothing resists.
float stable_spring_step(const SpringView& view);
/// Changes the step that the springs take: the damping of every slot follows.
void set_spring_step(const SpringView& view, float time_step);

}  // namespace cullet
