#include "systems/structures/shell/draw_shell.hpp"
#include "systems/structures/shell/redraw_body.hpp"
#include "systems/systems.hpp"

namespace cullet {

void draw_shells(Each<ShellChanged> changed, Step step, ShellTables shells, Bodies& bodies, ViewVertices&, ViewIndices&,
                 ViewBoxes& boxes) {
    const Row<Bodies> body = changed->body;
    if (static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Free) return;
    if (!changed->is_local || !redraw_body(shells.state, body, boxes)) draw_body(shells.state, body);
    bodies.drawn_frame[body] = step.frame;
}

}  // namespace cullet
