// The elements round a vertex, found over neighbour links, in ascending order.
#pragma once
#include "components/state.hpp"

namespace cullet {

inline constexpr uint32_t kMostFan = 64;  // elements at a vertex; cooking refuses more

struct Fan {
    uint32_t count = 0;
    uint32_t element[kMostFan];
    uint8_t corner[kMostFan];  // which corner of the element the vertex is
};

/// Every vertex has one fan (C3), so walking from any of its elements finds all. A dead vertex has none. Ascending
/// element order makes sums over a fan independent of the element that the walk started from.
void collect_fan(const ShellView& shell, uint32_t vertex, Fan& fan);

/// Hinges that hold the vertex, as an end of the edge or as a corner opposite; ascending, each once.
struct FanHinges {
    uint32_t count = 0;
    uint32_t hinge[2 * kMostFan + 1];
};
void collect_hinges(const ShellView& shell, const Fan& fan, FanHinges& hinges);

}  // namespace cullet
