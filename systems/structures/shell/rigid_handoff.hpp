// From the hidden state to rigid motions of the parts (thick shell note 6.6).
#pragma once
#include <optional>
#include <span>

#include "components/body_rows.hpp"
#include "systems/hulls/stop_approach.hpp"
#include "systems/structures/shell/group_fragments.hpp"

namespace cullet {

inline constexpr double kMostRelativeSpeed = 2;  // times the impact speed, for shards and for their rims' spin

/// How the vertices move that the run of a large body left alone: those of blocks that do not move
/// (VertexBlocks::moves). Body axes.
struct RestMotion {
    Vec3d centre, velocity, spin;
    Vec3d at(Vec3 place) const { return velocity + cross(spin, Vec3d(place) - centre); }
};

/// What the body did before the hit, body axes.
struct HandoffStart {
    Vec3d velocity;                       // of the centre of mass, m/s
    Vec3d spin;                           // rad/s
    Vec3d centre;                         // of mass, m
    double impact_speed = 0;              // m/s, > 0
    std::optional<RestMotion> rest = {};  // none: each vertex has its velocity
    std::span<Touch> touches = {};        // of the parts, at their cracks,
    std::span<Touching> touching = {};    // and room for as many as there are parts
};

/// One part's motion, body axes. Mass, centre and inertia are those of its vertices: with them P and L are the hidden
/// state's and the energy can only fall.
struct PartMotion {
    double mass = 0;                 // kg
    Vec3d centre;                    // m, rest
    Sym3d inertia;                   // about the centre, kg m2
    double radius = 0;               // farthest vertex from the centre, m
    Vec3d momentum;                  // N s, after the clamps; velocity is momentum / mass
    Vec3d angular_momentum;          // about the centre, N m s, of the hidden state
    Vec3d velocity, spin;            // of the centre; after the clamps. Zero for a part that holds a pin
    Vec3d free_momentum, free_spin;  // before the clamps
    double hidden_energy = 0;        // sum of m v^2 / 2, J
    bool is_static = false, is_speed_clamped = false, is_spin_clamped = false;
};

struct HandoffReport {
    uint32_t largest = 0;
    uint32_t speed_clamps = 0, spin_clamps = 0;
    Vec3d momentum_before;        // N s, of the hidden state
    Vec3d momentum_after;         // of the moving parts; before = after + support, to rounding
    Vec3d support_momentum;       // what pinned parts took into the ground, and cut-offs when the largest is static
    Vec3d free_support;           // of that, before the clamps
    Vec3d spin_clamp_loss;        // angular momentum that spin clamps took, N m s
    double energy_hidden = 0;     // J
    double energy_crushed = 0;    // of the rigid motions, at cracks whose faces were on their way into each other
    double energy_unclamped = 0;  // of the rigid motions before the clamps, <= hidden
    double energy_after = 0;
};

/// Each part's mass, momenta and inertia: sums over its vertices. One motion a part; parts as group_fragments or
/// find_pieces gave them, motions at least as many. What find_pieces has not listed is summed as a difference.
HandoffReport gather_momenta(ShellView shell, const HandoffStart& start, std::span<const FragmentPart> parts,
                             std::span<PartMotion> motions);

/// The rest of the hand-off, which looks at nothing but its arguments. Hidden runs let crack faces pass through each
/// other: parts that would go on to do so are stopped where they touch (stop_approach), before the clamps. Clamps: a
/// part's speed relative to the body's motion before the hit (V + w x r at its centre) is at most twice the impact
/// speed, and what is cut off goes to the largest part, which is not clamped; a part's spin relative to the body's
/// before is at most 2 impact_speed / radius (relative, or a body that flew spinning would lose its spin on breaking).
/// Where the largest part would get more energy by that than there was, all clamps go as far as energy allows and no
/// farther.
void settle_momenta(const HandoffStart& start, std::span<PartMotion> motions, HandoffReport& report);

/// Kept where the second half waits for a thread (fill_births).
struct Handoff {
    HandoffStart start;
    HandoffReport report;
};

/// Both halves.
HandoffReport rigid_handoff(ShellView shell, const HandoffStart& start, std::span<const FragmentPart> parts,
                            std::span<PartMotion> motions);

}  // namespace cullet
