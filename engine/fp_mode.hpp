// The floating-point mode of all state: round to nearest, denormals flushed and read as zero, no traps. Bodies at rest
// run into denormals, which cost a hundred times a normal number.
#pragma once
#include <xmmintrin.h>

namespace cullet {

class FpMode {
 public:
    FpMode() : before_(_mm_getcsr()) { _mm_setcsr(kOurs); }
    ~FpMode() { _mm_setcsr(before_); }
    FpMode(const FpMode&) = delete;
    FpMode& operator=(const FpMode&) = delete;

    static constexpr unsigned kOurs = 0x9fc0;

 private:
    unsigned before_;
};

}  // namespace cullet
