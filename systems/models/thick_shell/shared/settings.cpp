#include "systems/models/thick_shell/shared/settings.hpp"

#include <iterator>

#include "systems/settings/lines.hpp"

namespace cullet {
namespace {

using C = ThickShellCookSettings;
constexpr Setting kCook[] = {
    word<&C::propagation>("propagation", "guarded_front, front, single_vertex, single_vertex_tets",
                          "how the inner surface is pushed in; all but the first to compare"),
    yes_or_no<&C::joins_walls>("joins_walls", "a mesh that models both of its walls becomes one sheet, as measured"),
    yes_or_no<&C::measures_threshold>("measures_threshold",
                                      "finds the speed of the first crack; takes 10 to 50 hits' time"),
};

using S = ThickShellSpawnSettings;
constexpr Setting kSpawn[] = {
    word<&S::fracture>("fracture", "hidden, quick",
                       "hidden: elastic waves, over some frames; quick: softened springs near the hit"),
};

// Members that have a column of their name (components/quick.hpp) are kept for bodies and runs.
using Q = QuickSettings;
constexpr Setting kQuick[] = {
    number<&Q::layers>("layers", "1", {1, 2}, "of springs, in quick fracture; 2 feel the wall bend"),
    number<&Q::steps>("steps", "1", {8, 100}, "of a quick run; the neighbourhood is a third of it wide, in edges"),
    number<&Q::crack_frequency>("crack_frequency", "1", {0, 1000},
                                "vertices that split in a quick step; 0: by the kind"),
    number<&Q::strain_limit>("strain_limit", "1", zero_or(1e-5, 1),
                             "stretch at which a quick edge splits; 0: as found when cooked"),
    number<&Q::compression_limit>("compression_limit", "1", zero_or(1, 1e6),
                                  "squeeze at which it does, in strain limits; 0: none"),
    number<&Q::crack_length>("crack_length", "1", {0, 4}, "how far large quick cracks run on, of the body's diagonal"),
    number<&Q::bump_angle>("bump_angle", "degrees", {0, 30}, "by which they may turn at each vertex"),
};

using L = LayerSettings;
constexpr Setting kLayers[] = {
    word<&L::layout>("layout", "sandwich, crossed",
                     "of two layers, quick or soft; crossed: the paper's, too stiff in bending"),
    number<&L::length_factor>("length_factor", "1", zero_or(0.577, 5),
                              "distance of two layers over the thickness; 0: by the mesh"),
    number<&L::area_energy>("area_energy", "1", {0, 100}, "of springs, quick or soft: against a change of area"),
    number<&L::volume_energy>("volume_energy", "1", {0, 100}, "the same of volume, between two layers"),
};

static_assert(std::size(kCook) == member_count<C>() && std::size(kQuick) == member_count<Q>() &&
                  std::size(kLayers) == member_count<L>() && std::size(kSpawn) + 2 == member_count<S>(),
              "a member of the settings has no line");

}  // namespace

template <>
SettingList setting_list<ThickShellCookSettings>() {
    return {kCook, std::size(kCook)};
}
template <>
SettingList setting_list<ThickShellSpawnSettings>() {
    return {kSpawn, std::size(kSpawn)};
}
template <>
SettingList setting_list<QuickSettings>() {
    return {kQuick, std::size(kQuick)};
}
template <>
SettingList setting_list<LayerSettings>() {
    return {kLayers, std::size(kLayers)};
}

}  // namespace cullet
