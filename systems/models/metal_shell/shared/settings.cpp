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
    number<&M::tear_strain>("tear_strain", "1", zero_or(0.01, 10),
                            "beyond which it tears; 0: 1.25 times the strain at which the material breaks"),
    word<&M::adjacency>("adjacency", kChoices, "how far neighbouring triangles are apart, for sub-shells"),
    word<&M::seeds>("seeds", kChoices, "where sub-shells begin"),
    word<&M::representatives>("representatives", kChoices, "what stands for a sub-shell"),
    word<&M::contact>("contact", kChoices, "one impulse, or springs that push harder on the way in"),
    word<&M::depth>("depth", kChoices, "by energy, or of each sub-shell by impulse over mass; with shape alone"),
    word<&M::shape>("shape", kChoices, "the striker's, or rigid sub-shells that are hit"),
    word<&M::cells>("cells", kChoices, "carry folds and creases, or nothing more"),
    word<&M::borders>("borders", kChoices, "vertices between sub-shells go with all, or with the lowest"),
    word<&M::springs>("edge_springs", kChoices, "only limit edges, or pull them towards the length before the impact"),
    word<&M::limit>("limit", kChoices, "of edges: at both ends, or along the old way at one"),
    number<&M::impulse_time>("impulse_time", "s", zero_or(1e-7, 1),
                             "of the paper's depth; 0: such that it is as deep as ours"),
};

static_assert(std::size(kSettings) == member_count<M>(), "a member of the settings has no line");

}  // namespace

template <>
SettingList setting_list<MetalShellSettings>() {
    return {kSettings, std::size(kSettings)};
}

}  // namespace cullet
