#include "systems/models/metal_shell/tear/part_torn.hpp"

#include <algorithm>

#include "systems/bodies/blows.hpp"
#include "systems/structures/shell/group_fragments.hpp"

namespace cullet {
namespace {

bool is_dead(const ShellView& shell, uint32_t e) {
    return shell.state.elements.flags[shell.element(e)] & kDead;
}

// Of the parts that are of the same part before the tear: the largest, ties to the first.
bool is_largest(const ShellView& shell, std::span<const FragmentPart> parts, uint32_t part) {
    const auto& before = shell.state.elements.copy;
    const auto of = [&](uint32_t p) { return before[shell.element(parts[p].first_element)]; };
    for (uint32_t p = 0; p < parts.size(); ++p) {
        if (p == part || of(p) != of(part)) continue;
        const uint32_t own = parts[part].element_count, other = parts[p].element_count;
        if (other > own || (other == own && p < part)) return false;
    }
    return true;
}

}  // namespace

void number_parts(const ShellView& shell, std::span<FragmentPart> parts) {
    group_fragments(shell, parts);
    Elements& elements = shell.state.elements;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        elements.copy[shell.element(e)] = elements.part[shell.element(e)];
}

uint32_t find_torn(const ShellView& shell, std::span<FragmentPart> parts) {
    const uint32_t found = group_fragments(shell, parts);
    if (found == 1) return 1;
    Elements& elements = shell.state.elements;
    if (found > parts.size()) {  // what is not described stays
        parts[0] = whole_part(shell);
        return 1;
    }
    // Of each part its new number, in a column that nobody reads until the lists are made.
    uint32_t count = 1;
    for (uint32_t p = 0; p < found; ++p)
        elements.next[shell.element(parts[p].first_element)] = is_largest(shell, parts.first(found), p) ? 0 : count++;
    for (uint32_t p = 0; p < found; ++p) parts[p].last_element = elements.next[shell.element(parts[p].first_element)];
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        if (!is_dead(shell, e)) elements.part[shell.element(e)] = parts[elements.part[shell.element(e)]].last_element;
    for (uint32_t p = 0; p < count; ++p) parts[p] = {};
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        if (!is_dead(shell, e)) add_to_part(shell, parts[elements.part[shell.element(e)]], e);
    return count;
}

namespace {

struct Lump {
    double mass = 0;
    Vec3d centre;
};
Lump lump_of(const ShellView& shell) {
    const Vertices& vertices = shell.state.vertices;
    Lump lump;
    Vec3d sum;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        lump.mass += vertices.mass[shell.vertex(v)];
        sum += vertices.mass[shell.vertex(v)] * Vec3d(vertices.rest[shell.vertex(v)]);
    }
    if (lump.mass > 0) lump.centre = (1 / lump.mass) * sum;
    return lump;
}

}  // namespace

void move_torn(MetalRows rows, Row<Tasks> task, uint32_t vertex, const Punch& punch) {
    const ShellView shell(rows, rows.tasks.working[task]);
    const Row<Bodies> body = rows.tasks.body[task];
    Vertices& vertices = shell.state.vertices;
    const bool is_free = static_cast<BodyKind>(rows.bodies.kind[body]) == BodyKind::Dynamic;
    const Lump whole = lump_of(shell);
    const std::span<FragmentPart> parts = rows.shell_rows.shell_parts.of_task(task);
    // What came off where the striker is.
    const uint32_t count = find_torn(shell, parts);
    const uint32_t element = vertices.element[shell.vertex(vertex)];
    const uint32_t part = element == kNone ? 0 : shell.state.elements.part[shell.element(element)];
    const bool is_off = count > 1 && part > 0 && !parts[part].has_pins;
    Vec3d velocity(rows.tasks.start_velocity[task]), spin(rows.tasks.start_spin[task]);
    const Vec3d arm = punch.point - whole.centre;
    const double own_speed = dot(velocity + cross(spin, arm), punch.push);
    const double faster = is_off ? std::max(0.0, punch.striker_speed - own_speed) : 0;
    // So much of the impulse, and no more, is in what goes on with the striker.
    const double taken = is_off ? std::min(faster * parts[part].mass, punch.impulse) : 0;
    const double given = is_off && parts[part].mass > 0 ? taken / parts[part].mass : 0;
    if (is_free && whole.mass > 0) {
        const Vec3d impulse = (punch.impulse - taken) * punch.push;
        velocity += (1 / whole.mass) * impulse;
        spin += inverse(rows.bodies.inertia[body]) * cross(arm, impulse);
    }
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v), e = vertices.element[row];
        if (e == kNone) continue;
        Vec3d own = is_free ? velocity + cross(spin, Vec3d(vertices.rest[row]) - whole.centre) : Vec3d{};
        if (is_off && shell.state.elements.part[shell.element(e)] == part) own += given * punch.push;
        vertices.velocity.set(row, own.to_float());
    }
}

}  // namespace cullet
