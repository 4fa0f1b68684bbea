// What the quick mode costs, measured at scene castle, in units of 2 ns of one thread. Constants measured by perf/,
// never adapted while running, so that the same hit takes the same frames on every machine.
#pragma once
#include <cstdint>

namespace cullet {

inline constexpr uint64_t kUnitsQuickOpen = 230;     // a vertex of a cut-out when a task opens: flood, copy
inline constexpr uint64_t kUnitsQuickCopy = 60;      // a vertex of a body that is copied whole
inline constexpr uint64_t kUnitsQuickWake = 470;     // a vertex of the region: flood, springs, lists
inline constexpr uint64_t kUnitsQuickWakeTwo = 720;  // the same with two layers
inline constexpr uint64_t kUnitsQuickSpring = 3;     // an edge through one substep, with looking at strains and energy
inline constexpr uint64_t kUnitsQuickPair = 7;       // the same with two layers, which are 4 springs an edge
// A cut edge: inserts, splits, springs made anew; 13 microseconds in which the other of two workers waits.
inline constexpr uint64_t kUnitsQuickCut = 13000;
inline constexpr uint64_t kUnitsQuickEnd = 400;  // a vertex of the copy when cracks are handed on: rows, pieces

}  // namespace cullet
