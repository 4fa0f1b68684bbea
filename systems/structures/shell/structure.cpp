#include "systems/structures/shell/structure.hpp"

#include "systems/systems.hpp"

namespace cullet {

SlotList shell_structure() {
    SlotList structure("shell");
    structure.at(Slot::Fill).then<fill_births>();
    structure.at(Slot::Hull).then<fill_hulls>();
    structure.at(Slot::Draw).then<draw_shells>();
    structure.at(Slot::Compact).then<compact_shells>();
    return structure;
}

}  // namespace cullet
