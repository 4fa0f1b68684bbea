// The floating-point mode of all state: round to nearest, denormals flushed and read as zero, no traps. Bodies at rest
// run into denormals, which cost a hundred times a normal number.
#pragma once
#include <xmmintrin.h>

namespace cullet {

class FpMode {
 public:
    FpMode() : before_(_mm_getcsr()) { set(kOurs); }
    ~FpMode() { set(before_); }
    FpMode(const FpMode&) = delete;
    FpMode& operator=(const FpMode&) = delete;

    static constexpr unsigned kOurs = 0x9fc0;

 private:
    /// What is read from memory behind this is read behind it: no comparison of an argument is moved before.
    static void set(unsigned mode) {
        asm volatile("" ::: "memory");
        _mm_setcsr(mode);
        asm volatile("" ::: "memory");
    }
    unsigned before_;
};

}  // namespace cullet
