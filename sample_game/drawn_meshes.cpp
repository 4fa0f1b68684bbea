#include "sample_game/drawn_meshes.hpp"

#include <fmt/format.h>

#include "components/state.hpp"
#include "systems/structures/shell/draw_shell.hpp"
#include "systems/structures/tetrahedra/skin.hpp"
#include "systems/world_contents.hpp"

namespace cullet {

std::string DrawnMeshes::check_changed(World& world) {
    State& state = world.contents().data.state;
    const Bodies& bodies = state.bodies;
    seen_.resize(bodies.size());
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const std::array<uint32_t, 2> now{bodies.generation[b], bodies.view_stamp[b]};
        const bool is_free =
            static_cast<BodyKind>(bodies.kind[b]) == BodyKind::Free;  // such rows keep their shell's number
        if (seen_[b] == now || is_free || !bodies.structure[b].exists()) continue;
        seen_[b] = now;
        ++checked_;
        const Row<Structures> structure = bodies.structure[b];
        const Result<void> sound =
            is_shell(state.structures, structure)
                ? check_drawn_mesh(ShellView(state, structure), {state.view_vertices, state.view_indices},
                                   bodies.view_vertices[b], bodies.view_indices[b])
                : check_skin(state, structure);
        if (!sound.ok()) return fmt::format("body {}: {}", b, sound.error());
    }
    return "";
}

}  // namespace cullet
