// Which edges of a region have stretched too far (thick shell note C1, paper mode).
#pragma once
#include "systems/models/thick_shell/quick/region.hpp"

namespace cullet {

struct StrainedEdge {
    float urgency;       // strain over the limit, or squeeze over that of squeezes; above 1
    uint32_t low, high;  // vertices
};
/// More urgent first, then by vertices: no two are equal.
inline bool is_before(const StrainedEdge& a, const StrainedEdge& b) {
    if (a.urgency != b.urgency) return a.urgency > b.urgency;
    return a.low != b.low ? a.low < b.low : a.high < b.high;
}

/// The most urgent ones of a step, in order.
struct StrainedEdges {
    static constexpr uint32_t kMost = 1024;
    uint32_t count = 0, most = kMost;
    StrainedEdge edge[kMost];
    void add(const StrainedEdge& e);
    void sort();
};

/// Springs whose strain before the last step is above the limit of the task times the mean strength factor of its ends,
/// or below minus the compression limit times it. Edges at a vertex that is closed to cracks (is_start_banned) do not
/// count. At most `most`.
void find_strained_edges(const RegionView& region, uint32_t most, StrainedEdges& found);

}  // namespace cullet
