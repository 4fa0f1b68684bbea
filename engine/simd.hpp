// Which of the compiled versions of a kernel runs. Kernels give the same bits at every level.
#pragma once
#include <string>

#include "cullet/result.hpp"

namespace cullet {

enum class SimdLevel { Best = 0, Scalar, Sse4, Avx2, Avx512 };

/// For tests and measurements, process-wide: kernels run at this level from now on; Best undoes it. False, and nothing
/// changes, when this machine or this build has no such level. Not while another thread steps a world.
bool set_simd_level(SimdLevel level);

/// The same by name: best, scalar, sse4, avx2, avx512. "best" leaves the level as it is. Refused with a sentence that
/// lists the levels that there are.
Result<void> set_simd_level(const std::string& name);

}  // namespace cullet
