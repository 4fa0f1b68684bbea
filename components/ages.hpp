// When pieces were born. World::retire and the fading of debris go by it. So it is state: two worlds that differ in it
// alone do not go on alike.
#pragma once
#include "engine/table.hpp"

namespace cullet {

/// One row is one row of Bodies.
struct FragmentAges : Table<FragmentAges> {
    using Table::Table;
    CULLET_TABLE(fragment_ages);
    Column<uint64_t> born{*this, "born"};  // 1 + the step in which it broke off; 0: no fragment, or retired
};

inline uint64_t born_of(const FragmentAges& ages, uint32_t body) {
    return body < ages.size() ? ages.born[body] : 0;
}

/// One row is one row of Debris.
struct DebrisAges : Table<DebrisAges> {
    using Table::Table;
    CULLET_TABLE(debris_ages);
    Column<uint64_t> born{*this, "born"};  // the step
};

/// Of either table, which grows to the row.
template <class Ages>
void set_born(Ages& ages, uint32_t row, uint64_t born) {
    if (row >= ages.size()) ages.append(row + 1 - ages.size());
    ages.born[row] = born;
}

}  // namespace cullet
