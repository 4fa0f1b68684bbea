#include "engine/simd.hpp"

#include <hwy/highway.h>
#include <hwy/targets.h>

namespace cullet {

bool set_simd_level(SimdLevel level) {
    hwy::SetSupportedTargetsForTest(0);
    const int64_t available = hwy::SupportedTargets() & HWY_TARGETS;
    int64_t wanted = available;
    if (level == SimdLevel::Scalar) wanted = HWY_STATIC_TARGET;  // the baseline: plain loops with g++
    if (level == SimdLevel::Sse4) wanted = HWY_SSE4;
    if (level == SimdLevel::Avx2) wanted = HWY_AVX2;
    if (level == SimdLevel::Avx512) wanted = HWY_AVX3;
    const bool is_known = level == SimdLevel::Scalar || (wanted & available) != 0;
    if (is_known && level != SimdLevel::Best) hwy::SetSupportedTargetsForTest(wanted);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    return is_known;
}

}  // namespace cullet
