#include "systems/systems.hpp"
#include "systems/view/draw_shell.hpp"

namespace cullet {

void draw_shells(Each<ShellChanged> changed, ShellTables shells, Bodies& bodies, ViewVertices&, ViewIndices&) {
    const Row<Bodies> body = changed->body;
    if (static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Free) return;
    bodies.run_indices[body] =
        draw_shell(ShellView(shells.state, bodies.shell[body]), bodies.view_vertices[body], bodies.view_indices[body])
            .indices;
    ++bodies.view_stamp[body];
}

}  // namespace cullet
