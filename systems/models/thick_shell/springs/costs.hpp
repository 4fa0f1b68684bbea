// What areas and volumes that resist cost, in units of 2 ns of one thread. Constants measured by perf/, never adapted
// while running, so that the same hit takes the same frames on every machine.
#pragma once
#include <cstdint>

namespace cullet {

inline constexpr uint64_t kUnitsAreaEnergy = 110;    // an edge of a layer through one substep, where areas resist
inline constexpr uint64_t kUnitsVolumeEnergy = 350;  // an edge of two layers, where volumes do

}  // namespace cullet
