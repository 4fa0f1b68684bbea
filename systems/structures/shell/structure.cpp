#include "systems/structures/shell/structure.hpp"

#include "systems/structures/shell/fragment_calls.hpp"
#include "systems/structures/shell/load_calls.hpp"
#include "systems/structures/shell/rest_calls.hpp"
#include "systems/structures/shell/surface_calls.hpp"
#include "systems/structures/shell/systems.hpp"

namespace cullet {

SlotList shell_structure() {
    SlotList structure("shell");
    structure.at(Slot::Fill).then<fill_births>();
    structure.at(Slot::Hull).then<fill_hulls>();
    structure.at(Slot::Draw).then<draw_shells>().then<measure_blocks>();
    structure.at(Slot::Compact).then<compact_shells>();
    return structure;
}

const StructureCalls& shell_calls() {
    static const StructureCalls calls = [] {
        StructureCalls c;
        add_fragment_calls(c);
        add_rest_calls(c);
        add_surface_calls(c);
        add_load_calls(c);
        return c;
    }();
    return calls;
}

}  // namespace cullet
