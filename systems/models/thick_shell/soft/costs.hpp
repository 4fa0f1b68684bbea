// What soft bodies cost, measured on scenes tear and steel, in units of 2 ns of one thread. Constants measured by
// perf/, never adapted while running, so that the same hit takes the same frames on every machine.
#pragma once
#include <cstdint>

namespace cullet {

inline constexpr uint64_t kUnitsSoftTenSprings = 20;  // ten springs of one layer through a substep
inline constexpr uint64_t kUnitsSoftTenPairs = 45;    // ten edges of two layers
inline constexpr uint64_t kUnitsSoftFrame = 150;      // a vertex: whom it may meet, its shape at the end

}  // namespace cullet
