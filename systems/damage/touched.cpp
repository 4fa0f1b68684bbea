#include "systems/damage/touched.hpp"

#include "systems/cook/materials.hpp"
#include "systems/damage/assemble.hpp"
#include "systems/damage/stress_check.hpp"

namespace cullet {

bool refresh_stiffness(ShellView shell, Touched& touched) {
    link_slopes(shell, touched.weighed.span());
    bool is_whole = true;
    if (touched.weighed.count > 0 && shell.shells().packs[shell.row].count > 0) {
        limit_stiffness(shell, touched.weighed.span(), touched.rows);
        touched.rows.sort();  // in which order packs move to the spare end must not depend on what was cut first
        // A grain couples the hinges of a triangle, so a change reaches twice as far: all rows are assembled anew.
        const bool has_grain = material_traits(shell.state, shell.shells().material[shell.row]).has_grain();
        is_whole = !has_grain && !touched.rows.has_overflowed && rebuild_rows(shell, touched.rows.span());
        // Packs that moved to the spare end leave holes behind: when there is no end left, all are laid anew.
        is_whole = is_whole || assemble_stiffness(shell);
    }
    touched.clear();
    return is_whole;
}

}  // namespace cullet
