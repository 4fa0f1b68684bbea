#include "systems/structures/shell/draw_shell.hpp"
#include "systems/structures/shell/redraw_body.hpp"
#include "systems/structures/shell/systems.hpp"

namespace cullet {

void draw_shells(Each<DrawnChanged> changed, Step step, BodyRows& rows, ViewBoxes& boxes) {
    const Row<Bodies> body = changed->body;
    if (static_cast<BodyKind>(rows.bodies.kind[body]) == BodyKind::Free) return;
    if (!is_shell(rows.structures, rows.bodies.structure[body])) return;
    if (!changed->is_local || !redraw_body(rows, body, boxes)) draw_body(rows, body);
    rows.bodies.drawn_frame[body] = step.frame;
}

}  // namespace cullet
