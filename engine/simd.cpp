#include "engine/simd.hpp"

#include <hwy/highway.h>
#include <hwy/targets.h>

namespace cullet {
namespace {

struct Named {
    const char* name;
    SimdLevel level;
    int64_t target;  // of Highway; the baseline is plain loops
};
constexpr Named kLevels[] = {{"scalar", SimdLevel::Scalar, HWY_STATIC_TARGET},
                             {"sse4", SimdLevel::Sse4, HWY_SSE4},
                             {"avx2", SimdLevel::Avx2, HWY_AVX2},
                             {"avx512", SimdLevel::Avx512, HWY_AVX3}};

/// What this machine and this build have, whatever is chosen now.
int64_t available_targets() {
    const int64_t chosen = hwy::SupportedTargets();
    hwy::SetSupportedTargetsForTest(0);
    const int64_t available = (hwy::SupportedTargets() & HWY_TARGETS) | HWY_STATIC_TARGET;
    hwy::SetSupportedTargetsForTest(chosen);
    return available;
}

}  // namespace

bool set_simd_level(SimdLevel level) {
    int64_t wanted = 0;  // of Highway: all
    for (const Named& named : kLevels)
        if (named.level == level) wanted = named.target;
    if (wanted != 0 && (wanted & available_targets()) == 0) return false;
    hwy::SetSupportedTargetsForTest(wanted);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    return true;
}

Result<void> set_simd_level(const std::string& name) {
    if (name == "best") return {};
    const int64_t available = available_targets();
    std::string names = "best";
    for (const Named& named : kLevels) {
        if ((named.target & available) != 0) names += std::string(", ") + named.name;
        if (name == named.name && set_simd_level(named.level)) return {};
    }
    return Error{"simd=" + name + ": this machine or this build does not have it; give one of " + names + "."};
}

}  // namespace cullet
