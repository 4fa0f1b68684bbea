// What each system of the hidden run costs a row, in units of 2 ns of one thread. Constants measured by perf/, never
// adapted while running, so that the same hit takes the same frames on every machine.
#pragma once
#include <cstdint>

namespace cullet {

inline constexpr uint64_t kUnitsHiddenStep = 5;     // a vertex through one hidden step
inline constexpr uint64_t kUnitsStressCheck = 5;    // a vertex through one stress check, both faces
inline constexpr uint64_t kUnitsEnergyCheck = 5;    // a vertex
inline constexpr uint64_t kUnitsContactVertex = 6;  // a patch vertex through one hidden step

inline constexpr uint32_t kStepsAStressCheck = 3;
inline constexpr uint32_t kStepsAnEnergyCheck = 64;

}  // namespace cullet
