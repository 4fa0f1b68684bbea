// How many rows a world has room for.
#pragma once
#include <cstdint>

namespace cullet {

/// A full table refuses the later rows and names the limit; nothing is lost.
struct Limits {
    uint32_t bodies = 4096;
    uint32_t structures = 4096;
    uint32_t vertices = 1u << 20;
    uint32_t elements = 1u << 21;
    uint32_t tasks = 64;
    uint32_t models = 256;
    uint32_t view_vertices = 1u << 23;
    uint32_t debris = 8192;
    uint32_t queued_hits = 256;
};

}  // namespace cullet
