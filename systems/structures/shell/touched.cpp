#include "systems/structures/shell/touched.hpp"

#include "systems/structures/shell/elements_at.hpp"

namespace cullet {

const CutRepair kNoRepair{[]([[maybe_unused]] const CutRepair& repair, ShellView, uint32_t) {},
                          [](ShellView, uint32_t) { return 0u; },
                          []([[maybe_unused]] const Structures& structures, Row<Structures>) { return true; },
                          [](ShellView, uint32_t, uint32_t, uint32_t) {}, [](ShellView) {}};

void mark_touched(const ShellView& shell, const Touched& touched) {
    uint8_t* const flags = shell.state.elements.flags.data() + shell.elements().first;
    const auto mark = [&](uint32_t e) { flags[e] |= kIsTouched; };
    for (const VertexList* list : {&touched.weighed, &touched.rows}) {
        for (const uint32_t v : list->span()) for_each_element_at(shell, v, mark);
        for (uint32_t e = 0; list->has_overflowed && e < shell.element_count(); ++e) mark(e);
    }
}

}  // namespace cullet
