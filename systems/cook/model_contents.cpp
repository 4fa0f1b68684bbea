#include "systems/cook/model_contents.hpp"

namespace cullet {

Limits cooking_limits(uint32_t vertices, uint32_t elements) {
    Limits limits;
    limits.bodies = limits.models = limits.debris = 1;
    limits.structures = 8;
    limits.tasks = 1;
    limits.vertices = 5 * vertices + 8192;
    limits.elements = 5 * elements + 16384;
    limits.view_vertices = 64;
    return limits;
}

Row<Structures> import_bare_shell(ShellRows& to, const ShellRows& from, Row<Structures> shell, const char** full) {
    const ShellRoom room = room_of(from, shell);
    const Row<Structures> copy = make_shell(to, room, full);
    if (copy.exists()) copy_shell_rows(to, from, shell, copy, room.blocks > 0);
    return copy;
}

Row<Structures> import_shell(MetalShellRows to, Read<MetalShellRows> from, Row<Structures> shell, const char** full) {
    const Row<Structures> copy = import_bare_shell(to, from, shell, full);
    if (!copy.exists() || !metal_of(from, shell).exists()) return copy;
    if (make_metal(to, copy, metal_room_of(from, shell), full).exists()) {
        copy_metal_rows(to, from, shell, copy);
        return copy;
    }
    release_shell(to, copy);
    return {};
}

}  // namespace cullet
