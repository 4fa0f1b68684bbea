#include "systems/structures/shell/systems.hpp"
#include "systems/structures/shell/vertex_sums.hpp"

namespace cullet {

void measure_blocks(Each<DrawnChanged> changed, const Bodies& bodies, MeasuredBlocks rows) {
    if (static_cast<BodyKind>(bodies.kind[changed->body]) == BodyKind::Free) return;
    if (!is_shell(rows.structures, bodies.structure[changed->body])) return;
    measure_outdated(BlockView(rows, bodies.structure[changed->body]));
}

}  // namespace cullet
