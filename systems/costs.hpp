// What each system costs a row, in units of 2 ns of one thread. Constants measured by perf/, never adapted while
// running, so that the same hit takes the same frames on every machine.
#pragma once
#include <cstdint>

namespace cullet {

inline constexpr uint64_t kUnitsHiddenStep = 5;     // a vertex through one hidden step
inline constexpr uint64_t kUnitsStressCheck = 6;    // a vertex through one stress check, both faces
inline constexpr uint64_t kUnitsEnergyCheck = 5;    // a vertex
inline constexpr uint64_t kUnitsContactVertex = 6;  // a patch vertex through one hidden step
inline constexpr uint64_t kUnitsCut = 5000;  // a cut edge, 20 rows rebuilt: 10 microseconds are the goal, 60 measured
inline constexpr uint64_t kUnitsOpen = 400;  // a vertex when a task opens: copy, patches; 0.8 microseconds
inline constexpr uint64_t kUnitsCompact = 300;  // a live element of a shell that is compacted; 0.6 microseconds

inline constexpr uint32_t kStepsAStressCheck = 3;
inline constexpr uint32_t kStepsAnEnergyCheck = 64;

}  // namespace cullet
