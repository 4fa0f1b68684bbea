// What shells cost a row, in units of 2 ns of one thread. Constants measured by perf/, never adapted while running, so
// that the same hit takes the same frames on every machine.
#pragma once
#include <cstdint>

namespace cullet {

inline constexpr uint64_t kUnitsOpen = 220;   // a vertex when a task opens: copy, patches
inline constexpr uint64_t kUnitsCut = 15000;  // a cut edge: inserts, splits, about 12 rows; 20 microseconds, 50 at most
inline constexpr uint64_t kUnitsCutElement = 200;  // an element that a cut of the game looks at, a segment of its line
inline constexpr uint64_t kUnitsCompact = 1600;    // a live element of a shell that is compacted: 1.2 us, others wait

}  // namespace cullet
