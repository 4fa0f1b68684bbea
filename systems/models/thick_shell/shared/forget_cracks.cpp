#include "systems/models/thick_shell/shared/forget_cracks.hpp"

namespace cullet {

void forget_cracks(ShellView shell, bool is_fragment) {
    Vertices& vertices = shell.state.vertices;
    for (uint32_t v = shell.vertices().first; v < shell.vertices().first + shell.vertex_count(); ++v) {
        vertices.is_start_banned[v] = 0;
        vertices.ready_time[v] = 0;
        if (!is_fragment) continue;
        vertices.crack_start[v] = kNone;
        if (vertices.crack[v] == static_cast<uint8_t>(CrackState::Cracked))
            vertices.crack[v] = static_cast<uint8_t>(CrackState::None);
    }
}

}  // namespace cullet
