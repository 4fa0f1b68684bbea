#include "tests/support/break_checks.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "components/state.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "tests/support/hand_off.hpp"

namespace cullet::test {
namespace {

/// Linear and angular momentum about the rest frame's origin, and the size that rounding is measured by.
struct PartMomenta {
    Vec3d linear, angular;
    double size = 0;
};

std::vector<PartMomenta> momenta_of_vertices(const State& state, const ShellView& shell, size_t parts) {
    std::vector<PartMomenta> momenta(parts);
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v), e = state.vertices.element[row];
        if (e == kNone) continue;
        PartMomenta& of = momenta[state.elements.part[shell.element(e)]];
        const Vec3d mv = state.vertices.mass[row] * Vec3d(state.vertices.velocity[row]);
        of.linear += mv;
        of.angular += cross(Vec3d(state.vertices.rest[row]), mv);
        of.size += length(mv);
    }
    return momenta;
}

std::string of_part(const char* what, uint32_t part) {
    return std::string(what) + " of part " + std::to_string(part);
}

}  // namespace

std::string flaw_of_partition(State& state, uint32_t t) {
    const ShellView shell(state, state.tasks.working[t]);
    std::vector<uint32_t> seen(shell.element_count());
    for (uint32_t p = 0, last_first = 0; p < state.tasks.part_count[t]; ++p) {
        const FragmentPart& part = state.shell_parts.of_task(t)[p];
        if (p > 0 && part.first_element <= last_first) return of_part("order", p);
        last_first = part.first_element;
        uint32_t least = kNone;
        for (uint32_t e = part.first_element; e != kNone; e = state.elements.next[shell.element(e)]) {
            if (++seen[e] > 1) return "element " + std::to_string(e) + " is in two lists";
            least = std::min(least, e);
            if (state.elements.part[shell.element(e)] != p) return of_part("an element's number", p);
            for (const uint32_t n : state.elements.neighbour[shell.element(e)])
                if (n != kNone && state.elements.part[shell.element(n)] != p)
                    return of_part("a link that leads out", p);
        }
        if (least != part.first_element) return of_part("first element", p);
    }
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        if (seen[e] != ((state.elements.flags[shell.element(e)] & kDead) ? 0u : 1u))
            return "element " + std::to_string(e) + " is in no part, or dead and in one";
    return "";
}

// A NaN fails each comparison, and is a flaw.
std::string flaw_of_handoff(State& state, uint32_t t) {
    const ShellView shell(state, state.tasks.working[t]);
    const std::span<const FragmentPart> parts = state.shell_parts.of_task(t).first(state.tasks.part_count[t]);
    std::vector<PartMotion> motions;
    HandoffStart start{Vec3d(state.tasks.start_velocity[t]), Vec3d(state.tasks.start_spin[t]),
                       state.structures.centre[shell.structure], 1e9};
    const HandoffReport free = hand_off(shell, start, parts, motions);
    if (free.speed_clamps + free.spin_clamps != 0) return "a clamp where there is none";
    if (!(free.energy_unclamped <= free.energy_hidden)) return "energy";
    const std::vector<PartMomenta> momenta = momenta_of_vertices(state, shell, parts.size());
    for (uint32_t p = 0; p < parts.size(); ++p) {
        const PartMotion& m = motions[p];
        if (m.is_static) continue;
        if (!(length(m.mass * m.velocity - momenta[p].linear) < 1e-6 * momenta[p].size)) return of_part("momentum", p);
        const Vec3d own = cross(m.centre, m.momentum) + m.inertia * m.spin;
        if (!(length(own - momenta[p].angular) < 1e-6 * momenta[p].size * (m.radius + length(m.centre))))
            return of_part("angular momentum", p);
    }
    start.impact_speed = state.tasks.approach_speed[t];
    const HandoffReport clamped = hand_off(shell, start, parts, motions);
    if (!(clamped.energy_after <= clamped.energy_hidden)) return "energy after the clamps";
    const Vec3d lost = clamped.momentum_before - clamped.momentum_after - clamped.support_momentum;
    if (!(length(lost) < 1e-6 * length(clamped.momentum_before) + 1e-12)) return "momentum after the clamps";
    return "";
}

}  // namespace cullet::test
