// XXH3 over bytes: one number for a world's whole state.
#pragma once
#include <cstddef>
#include <cstdint>

namespace cullet {

uint64_t hash_bytes(const void* bytes, size_t size, uint64_t seed);

}  // namespace cullet
