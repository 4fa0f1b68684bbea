#include "systems/structures/shell/cook/apply_pins.hpp"

namespace cullet {
namespace {

bool pin(ShellView shell, uint32_t v) {
    if (v >= shell.vertex_count()) return false;
    Vertices& vertices = shell.state.vertices;
    const uint32_t row = shell.vertex(v);
    if (vertices.element[row] == kNone || vertices.is_pinned[row]) return false;
    vertices.is_pinned[row] = 1;
    vertices.inverse_mass[row] = 0;
    return true;
}

}  // namespace

uint32_t apply_pins(ShellView shell, std::span<const uint32_t> vertices) {
    uint32_t count = 0;
    for (uint32_t v : vertices) count += pin(shell, v);
    return count;
}

uint32_t apply_pins(ShellView shell, Vec3 low, Vec3 high) {
    uint32_t count = 0;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const Vec3 p = shell.state.vertices.rest[shell.vertex(v)];
        const bool is_inside =
            p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y && p.z <= high.z;
        if (is_inside) count += pin(shell, v);
    }
    return count;
}

bool has_pins(const ShellView& shell) {
    for (uint32_t v = 0; v < shell.vertex_count(); ++v)
        if (shell.state.vertices.is_pinned[shell.vertex(v)]) return true;
    return false;
}

}  // namespace cullet
