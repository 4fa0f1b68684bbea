#include "engine/hash.hpp"

#include <xxhash.h>

namespace cullet {

uint64_t hash_bytes(const void* bytes, size_t size, uint64_t seed) {
    return XXH3_64bits_withSeed(bytes, size, seed);
}

}  // namespace cullet
