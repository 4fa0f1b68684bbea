// What each system of thick shells costs a row, in units of 2 ns of one thread. Constants measured by perf/, never
// adapted while running, so that the same hit takes the same frames on every machine.
#pragma once
#include <cstdint>

namespace cullet {

inline constexpr uint64_t kUnitsHiddenStep = 5;     // a vertex through one hidden step
inline constexpr uint64_t kUnitsStressCheck = 5;    // a vertex through one stress check, both faces
inline constexpr uint64_t kUnitsEnergyCheck = 5;    // a vertex
inline constexpr uint64_t kUnitsContactVertex = 6;  // a patch vertex through one hidden step
inline constexpr uint64_t kUnitsAssemble = 550;     // a vertex of a shell whose stiffness is not assembled yet
inline constexpr uint64_t kUnitsGrainRow = 3000;    // a row of a material with a grain, rebuilt after a cut
inline constexpr uint32_t kStepsAStressCheck = 3;
inline constexpr uint32_t kStepsAnEnergyCheck = 64;

// Of the quick mode, measured at scene castle.
inline constexpr uint64_t kUnitsQuickOpen = 230;     // a vertex of a cut-out when a task opens: flood, copy
inline constexpr uint64_t kUnitsQuickCopy = 60;      // a vertex of a body that is copied whole
inline constexpr uint64_t kUnitsQuickWake = 470;     // a vertex of the region: flood, springs, lists
inline constexpr uint64_t kUnitsQuickWakeTwo = 720;  // the same with two layers
inline constexpr uint64_t kUnitsQuickSpring = 3;     // an edge through one substep, with looking at strains and energy
inline constexpr uint64_t kUnitsQuickPair = 7;       // the same with two layers, which are 4 springs an edge
inline constexpr uint64_t kUnitsAreaEnergy = 110;    // an edge of a layer through one substep, where areas resist
inline constexpr uint64_t kUnitsVolumeEnergy = 350;  // an edge of two layers, where volumes do
// A cut edge: inserts, splits, springs made anew; 13 microseconds in which the other of two workers waits.
inline constexpr uint64_t kUnitsQuickCut = 13000;
inline constexpr uint64_t kUnitsQuickEnd = 400;  // a vertex of the copy when cracks are handed on: rows, pieces

// Of soft bodies, measured on scenes tear and steel.
inline constexpr uint64_t kUnitsSoftTenSprings = 20;  // ten springs of one layer through a substep
inline constexpr uint64_t kUnitsSoftTenPairs = 45;    // ten edges of two layers
inline constexpr uint64_t kUnitsSoftFrame = 150;      // a vertex: whom it may meet, its shape at the end

}  // namespace cullet
