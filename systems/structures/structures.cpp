// The kinds of structures that there are.
#include "systems/models.hpp"
#include "systems/structures/shell/structure.hpp"
#include "systems/structures/tetrahedra/structure.hpp"

namespace cullet {

std::vector<SlotList> structures() {
    return {shell_structure(), tetrahedra_structure()};
}

const StructureCalls& calls_of(const Structures& structures, Row<Structures> structure) {
    static const StructureCalls* const calls[] = {&shell_calls(), &tetrahedra_calls()};  // by StructureKind
    return *calls[structures.kind[structure]];
}

}  // namespace cullet
