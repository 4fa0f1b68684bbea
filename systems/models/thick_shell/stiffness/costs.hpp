// What assembled stiffness costs, in units of 2 ns of one thread. Constants measured by perf/, never adapted while
// running, so that the same hit takes the same frames on every machine.
#pragma once
#include <cstdint>

namespace cullet {

inline constexpr uint64_t kUnitsAssemble = 550;   // a vertex of a shell whose stiffness is not assembled yet
inline constexpr uint64_t kUnitsGrainRow = 3000;  // a row of a material with a grain, rebuilt after a cut

}  // namespace cullet
