#include "sample_game/reproduce/metal/metal_claims.hpp"

namespace cullet::reproduce {

std::span<const ClaimEntry> metal_shell_claims() {
    static constexpr ClaimEntry entries[] = {
        {"figure_1", metal_figure_1}, {"sum_falls", metal_sum_falls}, {"table_1", metal_table_1},
        {"figure_3", metal_figure_3}, {"figure_4", metal_figure_4},   {"switches", metal_switches},
        {"figure_5", metal_figure_5}, {"figure_6", metal_figure_6},   {"fem", metal_fem},
        {"figure_7", metal_figure_7}, {"figure_8", metal_figure_8},   {"real_time", metal_real_time},
    };
    return entries;
}

}  // namespace cullet::reproduce
