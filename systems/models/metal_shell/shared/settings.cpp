#include "systems/models/metal_shell/shared/settings.hpp"

#include <iterator>

#include "components/metal.hpp"
#include "systems/settings/lines.hpp"

namespace cullet {
namespace {

using M = MetalShellSettings;
constexpr const char* kChoices = "default, paper";
constexpr Setting kSettings[] = {
    number<&M::sub_shells>("sub_shells", "1", zero_or(2, kMostSubShells),
                           "that carry folds and creases; 0: one for 110 triangles, 16 to 128"),
    number<&M::crush_pressure>("crush_pressure", "Pa", zero_or(1e2, 1e9),
                               "under which the body gives way as a whole; 0: the material's, or by its shape"),
    number<&M::link_distance>("link_distance", "1", {0, 0.1},
                              "of the box diagonal: sheets that are so near are tied to each other"),
    number<&M::edge_split>("edge_split", "1", {0.005, 0.1},
                           "of the box diagonal: longer edges are split, where no longest edge is given"),
    word<&M::adjacency>("adjacency", kChoices, "how far neighbouring triangles are apart, for sub-shells"),
    word<&M::seeds>("seeds", kChoices, "where sub-shells begin"),
    word<&M::representatives>("representatives", kChoices, "what stands for a sub-shell"),
};

static_assert(std::size(kSettings) == member_count<M>(), "a member of the settings has no line");

}  // namespace

template <>
SettingList setting_list<MetalShellSettings>() {
    return {kSettings, std::size(kSettings)};
}

}  // namespace cullet
