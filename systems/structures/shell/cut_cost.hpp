#pragma once
#include "components/blows.hpp"
#include "components/shells.hpp"
#include "systems/structures/shell/costs.hpp"

namespace cullet {

/// Units of what a cut of the game looks at: the whole shell, for every segment of its line. Its task's opening is not
/// in it.
inline uint64_t units_of_cut(const Shells& shells, Row<Shells> shell, const Blows& blows, uint32_t row) {
    const uint32_t points = blows.point_count[row];
    return shells.elements[shell].count * kUnitsCutElement * (points > 2 ? points - 1 : 1);
}

}  // namespace cullet
