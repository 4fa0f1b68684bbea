#include "systems/models/lattice/shared/settings.hpp"

#include <iterator>

#include "systems/settings/lines.hpp"

namespace cullet {
namespace {

using L = LatticeSettings;
constexpr Setting kSettings[] = {
    number<&L::cells>("wanted_cells", "1", {200, 20000}, "what the solid can come apart into"),
    number<&L::most_cells>("most_cells", "1", {200, 100000}, "a thin body that needs more of them is refused"),
    number<&L::element_edges>("element_edges", "1", {2, 4},
                              "a finite element's edge over that of a cell, 2 or 4; 2 is more accurate and slower"),
    number<&L::jitter>("jitter", "1", {0, 0.15}, "of the lattice, of an element's edge"),
    number<&L::largest_filled>("largest_filled", "1", {0, 1}, "of the closed surface that may be new, to close holes"),
    number<&L::strength_modulus>("strength_modulus", "1", zero_or(1, 100),
                                 "Weibull's, of the spread of strength: 6 glass, 10 ceramics and stone; 0: none"),
    number<&L::hull_excess>("hull_excess", "1", {1.02, 10},
                            "a convex piece's volume over that of the solid in it, before it is halved"),
};

static_assert(std::size(kSettings) == member_count<L>(), "a member of the settings has no line");

}  // namespace

template <>
SettingList setting_list<LatticeSettings>() {
    return {kSettings, std::size(kSettings)};
}

}  // namespace cullet
