#include "systems/models/thick_shell/stiffness/refresh.hpp"

#include <algorithm>

#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "systems/models/thick_shell/stiffness/costs.hpp"
#include "systems/models/thick_shell/stiffness/element_bending.hpp"
#include "systems/models/thick_shell/stiffness/element_stress.hpp"
#include "systems/models/thick_shell/stiffness/pair_cells.hpp"

namespace cullet {

namespace {

/// A grain couples the hinges of a triangle. What changes at a vertex changes the rows of all vertices that a triangle
/// with a hinge at it holds. Cut off ones are among them, because both ends of a cut edge are among the rows.
struct WideRows {
    static constexpr uint32_t kMostElements = 1024;  // more than that is about as much as the whole of most bodies
    uint32_t element_count = 0, count = 0;
    uint32_t element[2 * kMostElements];
    uint32_t vertex[6 * 2 * kMostElements];

    static void drop_repeats(uint32_t* rows, uint32_t& n) {
        std::sort(rows, rows + n);
        n = static_cast<uint32_t>(std::unique(rows, rows + n) - rows);
    }
    /// False: too many.
    bool gather(const ShellView& shell, std::span<const uint32_t> rows) {
        Ring ring;
        HingeElements held;
        for (const uint32_t v : rows) {
            collect_ring(shell, v, ring);
            collect_hinge_elements(shell, ring, held);
            if (element_count + held.count > 2 * kMostElements) drop_repeats(element, element_count);
            if (element_count + held.count > 2 * kMostElements) return false;
            std::copy(held.element, held.element + held.count, element + element_count);
            element_count += held.count;
        }
        drop_repeats(element, element_count);
        for (uint32_t i = 0; i < element_count; ++i) {
            const BendingVertices vertices(shell, element[i]);
            std::copy(vertices.vertex, vertices.vertex + vertices.count, vertex + count);
            count += vertices.count;
        }
        std::copy(rows.begin(), rows.end(), vertex + count);  // dead ones lose what they held
        count += static_cast<uint32_t>(rows.size());
        drop_repeats(vertex, count);
        return true;
    }
};
static_assert(6 * WideRows::kMostElements >= VertexList::kMost);

bool rebuild_grained_rows(ShellView shell, Touched& touched) {
    const Scratch<WideRows> work(shell.state.scratch);
    WideRows& wide = *work;
    const bool is_local = !touched.rows.has_overflowed && wide.gather(shell, touched.rows.span());
    touched.units += kUnitsGrainRow * (is_local ? wide.count : shell.vertex_count());
    return is_local && rebuild_rows(shell, {wide.vertex, wide.count});
}

bool can_rename(const Structures& structures, Row<Structures> shell) {
    return !stores_pairs_once(structures, shell);
}

}  // namespace

const CutRepair kStiffnessRepair{[]([[maybe_unused]] const CutRepair& repair, ShellView shell, uint32_t element) {
                                     assemble_element(shell, element);
                                 },
                                 assemble_hinge, can_rename, rename_neighbour, limit_all_stiffness};

bool refresh_stiffness(ShellView shell, Touched& touched) {
    if (touched.marks_elements) mark_touched(shell, touched);
    link_slopes(shell, touched.weighed.span());
    bool is_whole = true;
    if (touched.weighed.count > 0 && shell.shells().packs[shell.row].count > 0) {
        limit_stiffness(shell, touched.weighed.span(), touched.rows);
        touched.rows.sort();  // in which order packs move to the spare end must not depend on what was cut first
        const bool has_grain = material_traits(shell.state, shell.structures().material[shell.structure]).has_grain();
        is_whole = has_grain ? rebuild_grained_rows(shell, touched)
                             : !touched.rows.has_overflowed && rebuild_rows(shell, touched.rows.span());
        // Packs that moved to the spare end leave holes behind: when there is no end left, all are laid anew.
        is_whole = is_whole || assemble_stiffness(shell);
    }
    touched.clear();
    return is_whole;
}

}  // namespace cullet
