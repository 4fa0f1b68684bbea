// Which of the compiled versions of a kernel runs. Kernels give the same bits at every level.
#pragma once

namespace cullet {

enum class SimdLevel { Best = 0, Scalar, Sse4, Avx2, Avx512 };

/// For tests and measurements, process-wide: kernels run at this level from now on; Best undoes it. False, and nothing
/// changes, when this machine or this build has no such level.
bool set_simd_level(SimdLevel level);

}  // namespace cullet
