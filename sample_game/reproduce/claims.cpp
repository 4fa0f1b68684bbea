#include "sample_game/reproduce/claims.hpp"

namespace cullet::reproduce {

std::span<const ClaimEntry> thick_shell_claims() {
    static constexpr ClaimEntry entries[] = {
        {"figure_1", figure_1},
        {"table_1", table_1},
        {"consistent_shells", consistent_shells},
        {"front_against_single", front_against_single},
        {"figure_7", figure_7},
        {"figure_8", figure_8},
        {"figure_2", figure_2},
        {"figure_3", figure_3},
        {"figure_4", figure_4},
        {"coarse_grained", coarse_grained},
        {"large_fragments", large_fragments},
        {"figure_5", figure_5},
        {"figure_6", figure_6},
        {"table_2", table_2},
        {"rigid_share", rigid_share},
        {"figure_9", figure_9},
        {"figure_10", figure_10},
    };
    return entries;
}

}  // namespace cullet::reproduce
