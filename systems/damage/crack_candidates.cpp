#include "systems/damage/crack_candidates.hpp"

#include <algorithm>
#include <cstring>

#include "systems/damage/ring.hpp"

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
bool collect_starts(ShellView shell, float limit, uint32_t tips, Candidates& candidates) {
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
    const uint8_t *flags = elements.flags.data(), *crack = shell.state.vertices.crack.data() + shell.vertex(0),
                  *is_banned = shell.state.vertices.is_start_banned.data() + shell.vertex(0);
    const float* strength_factor = shell.state.vertices.strength_factor.data() + shell.vertex(0);
    for (uint32_t block = first; block < end; block += kLanes) {
        if (elements.over_limit[block] == 0) continue;  // nearly everywhere
        for (uint32_t e = block; e < std::min(block + kLanes, end); ++e) {
            if (!(principal[e] > limit * strength[e]) || (flags[e] & kDead)) continue;
            for (const uint32_t v : elements.corner[e]) {
                if (crack[v] != static_cast<uint8_t>(CrackState::None) || is_banned[v]) continue;
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

void find_start_strengths(ShellView shell) {
    const Vertices& vertices = shell.state.vertices;
    Elements& elements = shell.state.elements;
    const uint32_t first = shell.vertices().first;
    for (uint32_t e = shell.elements().first; e < shell.elements().first + shell.element_count(); ++e) {
        float least = kNoStart;
        for (const uint32_t v : elements.corner[e])
            if (vertices.crack[first + v] == static_cast<uint8_t>(CrackState::None) &&
                !vertices.is_start_banned[first + v])
                least = std::min(least, vertices.strength_factor[first + v]);
        elements.start_strength[e] = least;
    }
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

void choose_candidates(ShellView shell, const CrackLimits& limits, float time, HeadingFan& fan,
                       Candidates& candidates) {
    candidates.count = 0;
    collect_tips(shell, limits, time, candidates);
    const uint32_t tips = candidates.count;
    if (tips > 0) fan = HeadingFan(shell.state.materials.heading_power[shell.shells().material[shell.row]]);
    float raise = 1;
    while (!collect_starts(shell, raise * limits.start, tips, candidates) && raise < kMostRaise) raise *= kRaise;
    // Equally stressed everywhere: the first of them by element, as many as fit.
    if (candidates.count == tips && raise > 1) collect_starts(shell, raise / kRaise * limits.start, tips, candidates);
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
