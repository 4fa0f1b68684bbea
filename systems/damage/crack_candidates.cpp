#include "systems/damage/crack_candidates.hpp"

#include <algorithm>

#include "systems/damage/ring.hpp"

namespace cullet {
namespace {

constexpr float kPi = 3.14159265358979f;
constexpr float kRaise = 1.25f, kMostRaise = 1e30f;  // the second ends the search for stresses that are infinite

// Vertices next to an element whose principal stress passes a limit of theirs, each once, in `candidates`. False: more
// than fit.
bool collect(ShellView shell, const CrackLimits& limits, float raise, float time, Candidates& candidates) {
    const Elements& elements = shell.state.elements;
    const Vertices& vertices = shell.state.vertices;
    const float tip_limit = raise * limits.tip, start_limit = raise * limits.start;
    const float lowest = std::min(tip_limit, static_cast<float>(kLeastStrengthFactor) * start_limit);
    const uint32_t first = shell.elements().first, count = shell.element_count();
    Candidate* const out = candidates.candidate;
    candidates.count = 0;
    const auto drop_repeats = [&] {
        std::sort(out, out + candidates.count, [](auto& a, auto& b) { return a.vertex < b.vertex; });
        const auto is_same = [](auto& a, auto& b) { return a.vertex == b.vertex; };
        candidates.count = static_cast<uint32_t>(std::unique(out, out + candidates.count, is_same) - out);
    };
    for (uint32_t e = first; e < first + count; ++e) {
        const float principal = elements.principal[e];
        if (!(principal > lowest) || (elements.flags[e] & kDead)) continue;
        for (const uint32_t v : elements.corner[e]) {
            const uint32_t row = shell.vertex(v);
            const bool is_tip = vertices.crack[row] == static_cast<uint8_t>(CrackState::Tip);
            const bool is_free =
                vertices.crack[row] == static_cast<uint8_t>(CrackState::None) && !vertices.is_start_banned[row];
            const bool passes = is_tip    ? principal > tip_limit && time >= vertices.ready_time[row]
                                : is_free ? principal > start_limit * vertices.strength_factor[row]
                                          : false;
            if (!passes) continue;
            if (candidates.count == Candidates::kMost) drop_repeats();
            if (candidates.count == Candidates::kMost) return false;
            out[candidates.count++] = {is_tip, v, 0};
        }
    }
    drop_repeats();
    return true;
}

}  // namespace

CrackLimits crack_limits(ShellView shell, float strength_scale) {
    const Materials& m = shell.state.materials;
    const uint32_t row = shell.shells().material[shell.row];
    const float strength = kShortLoadFactor * m.tensile_strength[row];
    const float griffith = m.tip_factor[row] * std::sqrt(m.young_modulus[row] * m.fracture_energy[row]) /
                           std::sqrt(kPi * shell.shells().mean_edge[shell.row]);
    // The game's scale takes Griffith's limit along: a body made unbreakable is so with its old cracks too.
    return {strength_scale * strength, strength_scale * std::min(strength, griffith),
            kTipSpeed * std::sqrt(m.young_modulus[row] / m.density[row])};
}

StartField start_field(ShellView shell, uint32_t vertex) {
    StartField field;
    for (int face = 0; face < 2; ++face) {
        const VertexStress s = vertex_stress(shell, vertex, face);
        float s1, s2;
        Vec3 across;
        principal(s, s1, s2, across);
        if (!(s1 > field.stress)) continue;
        field = {s1, s2 / s1, across, s.normal};
    }
    return field;
}

ChosenHeading tip_heading(ShellView shell, uint32_t vertex, const HeadingFan& fan) {
    const Vec3 heading = shell.state.vertices.heading[shell.vertex(vertex)];
    FaceStress face[2];
    Vec3 x, y;
    for (int f = 0; f < 2; ++f) {
        const VertexStress s = vertex_stress(shell, vertex, f);
        x = into_plane(heading, s.normal);
        y = cross(s.normal, x);
        face[f] = in_axes(s, x, y);
    }
    return choose_heading(fan, x, y, face);
}

void choose_candidates(ShellView shell, const CrackLimits& limits, const HeadingFan& fan, float time,
                       Candidates& candidates) {
    float raise = 1;
    while (!collect(shell, limits, raise, time, candidates) && raise < kMostRaise) raise *= kRaise;
    // Equally stressed everywhere: the first of them by element, as many as fit.
    if (candidates.count == 0 && raise > 1) collect(shell, limits, raise / kRaise, time, candidates);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < candidates.count; ++i) {
        Candidate c = candidates.candidate[i];
        const float limit =
            c.is_tip ? limits.tip : limits.start * shell.state.vertices.strength_factor[shell.vertex(c.vertex)];
        c.ratio = (c.is_tip ? tip_heading(shell, c.vertex, fan).stress : start_field(shell, c.vertex).stress) / limit;
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
