#include "systems/models/thick_shell/restore_calls.hpp"

#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/shared/working_room.hpp"
#include "systems/structures/shell/vertex_sums.hpp"

namespace cullet {

void restore_sums(BodyRows& state, Row<Bodies> body) {
    const Row<Structures> shell = state.bodies.structure[body];
    const bool is_brittle = material_traits(state, state.structures.material[shell]).kind == MaterialKind::Brittle;
    if (!is_brittle || !may_cut_out(state, body)) return;
    keep_vertex_sums(ShellView(state, shell));
    measure_outdated(ShellView(state, shell));
}

ShellRoom room_of_hit(BodyRows& state, Row<Bodies> body) {
    const ShellView shell(state, state.bodies.structure[body]);
    return is_quick_body(state, body) ? quick_room(shell) : working_room(shell);
}

}  // namespace cullet
