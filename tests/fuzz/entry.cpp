// A fuzz program of one format, CULLET_FUZZ_FORMAT.
#include <cstdlib>

#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    (void)cullet::fuzz::run(cullet::fuzz::CULLET_FUZZ_FORMAT, {data, size});
    return 0;
}
