// Where the shell may crack now.
#pragma once
#include "cullet/material.hpp"
#include "systems/models/thick_shell/hidden/grain.hpp"
#include "systems/models/thick_shell/hidden/heading.hpp"
#include "systems/models/thick_shell/stiffness/element_stress.hpp"

namespace cullet {

/// What a shell's material allows in this run.
struct CrackLimits {
    float start = 0;      // Pa, sigma_d = 2 sigma_t * the game's scale; times a vertex's strength factor
    float tip = 0;        // Pa, min(sigma_d, f_tip sqrt(E G_c) / sqrt(pi l)): Griffith at the mesh's resolution
    float tip_speed = 0;  // m/s, 0.35 sqrt(E / density)
    FractureKind fracture = FractureKind::Large;
    float ban_seconds = 0;  // of coarse fracture: 12 l / c
    float branching = 0;    // of the start's limit, from which tips may fork; 0: never
    /// Of a material with a grain, whose `start` and `tip` are those across it: what a stress is compared with them
    /// after is scaled by the limit in its own direction.
    GrainLimits grain;
};

/// Whether a crack may start at the vertex (a table row) at this time of the run: no crack is there, or the fracture is
/// fine, and no ban is on it.
inline bool may_start(const Vertices& vertices, uint32_t row, FractureKind fracture, float time) {
    const auto crack = static_cast<CrackState>(vertices.crack[row]);
    if (crack != CrackState::None && (fracture != FractureKind::Fine || crack == CrackState::Tip)) return false;
    // A ban of large fracture lasts; the others' end at ready_time, which such vertices have no other use for.
    return !vertices.is_start_banned[row] || (fracture != FractureKind::Large && time >= vertices.ready_time[row]);
}
CrackLimits crack_limits(StressView shell, float strength_scale);

struct Candidate {
    bool is_tip;
    uint32_t vertex;
    float ratio;  // stress over its limit, > 1
};

/// Candidates of one check. A body of 3,000 vertices has 0 to 20. When more than fit would pass, the starts' limits are
/// raised by a quarter until the list fits. So the most stressed ones are kept and the others wait for the next check.
struct Candidates {
    static constexpr uint32_t kMost = 2048;
    uint32_t count = 0;
    Candidate candidate[kMost];
};

/// Fills Elements.start_strength, which choose_candidates looks at first. Bans and cracks since then only raise it,
/// insert_vertex sets it to 0; lifted bans call for a new one.
void find_start_strengths(ShellView shell);

/// What a start at a vertex would look like.
struct StartField {
    float stress = 0;  // Pa, sigma_1 of the face that has more of it; see CrackLimits::grain
    float ratio = 0;   // sigma_2 / sigma_1 there
    Vec3 across;       // unit, direction of sigma_1
    Vec3 normal;       // of the ring
};
StartField start_field(ShellView shell, uint32_t vertex, const GrainLimits& grain);

/// The direction a tip would take, from its heading.
ChosenHeading tip_heading(ShellView shell, uint32_t vertex, const HeadingFan& fan, const GrainLimits& grain);

/// Tips first, then the largest ratio, then the lowest vertex. Elements.principal is the quick filter: the largest
/// principal value of a mean of tensors is at most the largest of theirs, so no vertex is missed. Starts: vertices
/// without crack that are not banned. Tips: those whose time has come. `fan` is made when there are tips.
void choose_candidates(ShellView shell, const CrackLimits& limits, float time, HeadingFan& fan, Candidates& candidates);

}  // namespace cullet
