// How often a program asks for memory: malloc and everything like it, operator new, on all threads. A step of a world
// is meant to ask for none, and neither is the rigid engine, whose calls are counted apart.
//
// Linking a call of these functions replaces malloc in the program (glibc), so nothing is to be switched on when built.
// A sanitizer has a malloc of its own, which tells of each call.
#pragma once
#include <cstdint>

namespace cullet {

struct AllocationCounts {
    uint64_t ours = 0, rigid = 0;  // rigid: made while inside_rigid_engine()
};

/// Counts from zero. Counting is one for the whole program; do not nest.
void start_counting_allocations();
AllocationCounts stop_counting_allocations();

}  // namespace cullet
