#include "engine/checksum.hpp"

#include <xxhash.h>

namespace cullet {

Checksum checksum_of(std::span<const uint8_t> bytes) {
    const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
    return {hash.low64, hash.high64};
}

}  // namespace cullet
