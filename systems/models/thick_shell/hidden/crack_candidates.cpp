#include "systems/models/thick_shell/hidden/crack_candidates.hpp"

#include <algorithm>
#include <cstring>

#include "systems/cook/materials.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

constexpr float kPi = 3.14159265358979f;
constexpr float kNoStart = 1e30f;                    // finite, because columns are checked for it
constexpr float kRaise = 1.25f, kMostRaise = 1e30f;  // the second ends the search for stresses that are infinite

// Ready tips with an element whose principal stress passes their limit. A byte a vertex is looked at, eight at a time.
void collect_tips(ShellView shell, const CrackLimits& limits, float time, Candidates& candidates) {
    const Vertices& vertices = shell.state.vertices;
    const uint32_t first = shell.vertices().first, count = shell.vertex_count();
    const uint8_t* crack = vertices.crack.data() + first;
    Ring ring;
    for (uint32_t v = 0; v < count; ++v) {
        uint64_t flags = 1;
        if (v % 8 == 0 && v + 8 <= count) std::memcpy(&flags, crack + v, 8);
        if (flags == 0) {
            v += 7;
            continue;
        }
        if (crack[v] != static_cast<uint8_t>(CrackState::Tip) || time < vertices.ready_time[first + v]) continue;
        walk_ring(shell, v, ring);
        bool passes = false;
        for (uint32_t i = 0; i < ring.count; ++i)
            passes |= shell.state.elements.principal[shell.element(ring.element[i])] > limits.tip;
        if (passes && candidates.count < Candidates::kMost) candidates.candidate[candidates.count++] = {true, v, 0};
    }
}

// Vertices that may start a crack next to an element whose principal stress passes their limit, each once, behind the
// first `tips` candidates. False: more than fit.
bool collect_starts(ShellView shell, const CrackLimits& limits, float limit, float time, uint32_t tips,
                    Candidates& candidates) {
    const Elements& elements = shell.state.elements;
    const uint32_t first = shell.elements().first, end = first + shell.element_count();
    Candidate* const out = candidates.candidate;
    candidates.count = tips;
    const auto drop_repeats = [&] {
        std::sort(out + tips, out + candidates.count, [](auto& a, auto& b) { return a.vertex < b.vertex; });
        const auto is_same = [](auto& a, auto& b) { return a.vertex == b.vertex; };
        candidates.count = static_cast<uint32_t>(std::unique(out + tips, out + candidates.count, is_same) - out);
    };
    const float *principal = elements.principal.data(), *strength = elements.start_strength.data();
    const uint8_t* flags = elements.flags.data();
    const float* strength_factor = shell.state.vertices.strength_factor.data() + shell.vertex(0);
    for (uint32_t block = first; block < end; block += kLanes) {
        if (elements.over_limit[block] == 0) continue;  // nearly everywhere
        for (uint32_t e = block; e < std::min(block + kLanes, end); ++e) {
            if (!(principal[e] > limit * strength[e]) || (flags[e] & kDead)) continue;
            for (const uint32_t v : elements.corner[e]) {
                if (!may_start(shell.state.vertices, shell.vertex(v), limits.fracture, time)) continue;
                if (!(principal[e] > limit * strength_factor[v])) continue;
                if (candidates.count == Candidates::kMost) drop_repeats();
                if (candidates.count == Candidates::kMost) return false;
                out[candidates.count++] = {false, v, 0};
            }
        }
    }
    drop_repeats();
    return true;
}

/// With a grain g: sigma_gg / P + lambda / Q, tensions alone, where lambda is the largest principal stress in the plane
/// upright on the grain. For a pull at an angle this is Hankinson's formula, (cos^2 / P + sin^2 / Q) sigma = 1. (The
/// tension of each plane over the strength for its own normal is not: a pull along the grain of wood would open planes
/// at 44 degrees to it at a seventh of P.) The larger of the two terms opens the crack: along the grain, or through it.
/// A crack along the grain opens no other arms. Where both terms are large `principal`, by which collect_starts looks
/// for candidates, is the smaller one by Q / P at most, 4 % of wood.
StartField grained_field(ShellView shell, uint32_t vertex, const GrainLimits& limits) {
    StartField field;
    const float least = std::min(limits.start_along, limits.start_across);
    for (const VertexStress& s : vertex_stress(shell, vertex)) {
        // In the tangent plane a lies along the grain's projection, b across it; m is upright on grain and b.
        const Vec3 projection = limits.grain - dot(limits.grain, s.normal) * s.normal;
        const float p = std::min(1.0f, dot(projection, projection)), q = 1 - p, a_m = std::sqrt(q);
        const Vec3 a = p > 1e-6f ? normalised(projection) : s.axis_x, b = cross(s.normal, a);
        const FaceStress t = in_axes(s, a, b);
        const float mm = q * t.xx, bb = t.yy, mb = a_m * t.xy;
        const float mean = 0.5f * (mm + bb), d = 0.5f * (mm - bb), radius = std::sqrt(d * d + mb * mb);
        const float along = std::max(0.0f, p * t.xx) * (least / limits.start_along);
        const float across = std::max(0.0f, mean + radius) * (least / limits.start_across);
        if (!(along + across > field.stress)) continue;
        // Principal direction (m, b), as in principal().
        const float m_part = a_m * (d >= 0 ? radius + d : mb), b_part = d >= 0 ? mb : radius - d;
        const bool splits = across > along && (m_part != 0 || b_part != 0);
        field = {along + across, 0, splits ? normalised(m_part * a + b_part * b) : across > along ? b : a, s.normal};
    }
    return field;
}

}  // namespace

CrackLimits crack_limits(StressView shell, float strength_scale) {
    const Materials& m = shell.state.materials;
    const uint32_t row = shell.structures().material[shell.structure];
    const float strength = kShortLoadFactor * m.tensile_strength[row];
    const float griffith = m.tip_factor[row] * std::sqrt(m.young_modulus[row] * m.fracture_energy[row]) /
                           std::sqrt(kPi * shell.shells().mean_edge[shell.row]);
    const float c = std::sqrt(m.young_modulus[row] / m.density[row]);
    // The game's scale takes Griffith's limit along: a body made unbreakable is so with its old cracks too.
    CrackLimits limits;
    limits.start = strength_scale * strength;
    limits.tip = strength_scale * std::min(strength, griffith);
    limits.tip_speed = kTipSpeed * c;
    const TraitsRow traits = material_traits({shell.state.materials, shell.state.material_traits}, Row<Materials>(row));
    limits.fracture = traits.fracture;
    limits.ban_seconds = kCoarseBanEdges * shell.shells().mean_edge[shell.row] / c;
    limits.branching = traits.branching;
    if (!traits.has_grain()) return limits;
    const float across = kShortLoadFactor * traits.across_strength;
    const float splits = m.tip_factor[row] * std::sqrt(traits.across_young_modulus * traits.across_fracture_energy) /
                         std::sqrt(kPi * shell.shells().mean_edge[shell.row]);
    limits.grain = {true,         traits.grain,
                    limits.start, strength_scale * across,
                    limits.tip,   strength_scale * std::min(across, splits)};
    limits.start = std::min(limits.grain.start_along, limits.grain.start_across);
    limits.tip = std::min(limits.grain.tip_along, limits.grain.tip_across);
    return limits;
}

// Bans of coarse fracture end by themselves, so they count as if they had: too low does no harm.
void find_start_strengths(ShellView shell) {
    const FractureKind fracture =
        material_traits(shell.state, Row<Materials>(shell.structures().material[shell.structure])).fracture;
    constexpr float kEndOfBans = 1e30f;
    const Vertices& vertices = shell.state.vertices;
    Elements& elements = shell.state.elements;
    const uint32_t first = shell.vertices().first;
    for (uint32_t e = shell.elements().first; e < shell.elements().first + shell.element_count(); ++e) {
        float least = kNoStart;
        for (const uint32_t v : elements.corner[e])
            if (may_start(vertices, first + v, fracture, kEndOfBans))
                least = std::min(least, vertices.strength_factor[first + v]);
        elements.start_strength[e] = least;
    }
}

StartField start_field(ShellView shell, uint32_t vertex, const GrainLimits& grain) {
    StartField field;
    if (grain.has_grain) return grained_field(shell, vertex, grain);
    for (const VertexStress& s : vertex_stress(shell, vertex)) {
        float s1, s2;
        Vec3 across;
        principal(s, s1, s2, across);
        if (!(s1 > field.stress)) continue;
        field = {s1, s2 / s1, across, s.normal};
    }
    return field;
}

ChosenHeading tip_heading(ShellView shell, uint32_t vertex, const HeadingFan& fan, const GrainLimits& grain) {
    const Vec3 heading = shell.state.vertices.heading[shell.vertex(vertex)];
    FaceStress face[2];
    Vec3 x, y;
    const std::array<VertexStress, 2> stress = vertex_stress(shell, vertex);
    for (int f = 0; f < 2; ++f) {
        const VertexStress& s = stress[f];
        x = into_plane(heading, s.normal);
        y = cross(s.normal, x);
        face[f] = in_axes(s, x, y);
    }
    return choose_heading(fan, x, y, face, grain);
}

void choose_candidates(ShellView shell, const CrackLimits& limits, float time, HeadingFan& fan,
                       Candidates& candidates) {
    candidates.count = 0;
    collect_tips(shell, limits, time, candidates);
    const uint32_t tips = candidates.count;
    if (tips > 0) fan = HeadingFan(shell.state.materials.heading_power[shell.structures().material[shell.structure]]);
    float raise = 1;
    while (!collect_starts(shell, limits, raise * limits.start, time, tips, candidates) && raise < kMostRaise)
        raise *= kRaise;
    // Equally stressed everywhere: the first of them by element, as many as fit.
    if (candidates.count == tips && raise > 1)
        collect_starts(shell, limits, raise / kRaise * limits.start, time, tips, candidates);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < candidates.count; ++i) {
        Candidate c = candidates.candidate[i];
        const float limit =
            c.is_tip ? limits.tip : limits.start * shell.state.vertices.strength_factor[shell.vertex(c.vertex)];
        c.ratio = (c.is_tip ? tip_heading(shell, c.vertex, fan, limits.grain).stress
                            : start_field(shell, c.vertex, limits.grain).stress) /
                  limit;
        if (c.ratio > 1) candidates.candidate[kept++] = c;
    }
    candidates.count = kept;
    std::sort(candidates.candidate, candidates.candidate + kept, [](const Candidate& a, const Candidate& b) {
        if (a.is_tip != b.is_tip) return a.is_tip;
        if (a.ratio != b.ratio) return a.ratio > b.ratio;
        return a.vertex < b.vertex;
    });
}

}  // namespace cullet
