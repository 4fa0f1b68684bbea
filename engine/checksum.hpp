// XXH3-128 over a file's bytes: finds damage, does not stop a forger. Readers check every value behind it all the same.
#pragma once
#include <cstdint>
#include <span>

namespace cullet {

struct Checksum {
    uint64_t low = 0, high = 0;
    friend bool operator==(const Checksum&, const Checksum&) = default;
};

Checksum checksum_of(std::span<const uint8_t> bytes);

}  // namespace cullet
