// What a batch of cuts changed, and the stiffness that must follow it.
#pragma once
#include "systems/damage/ring.hpp"

namespace cullet {

/// Vertices whose mass or elements changed since the last `refresh_stiffness`.
struct Touched {
    static constexpr uint32_t kMost = 256;  // a start with six arms and six inserts touches at most 49
    uint32_t count = 0;
    uint32_t vertex[kMost];
    void add(uint32_t v) {
        for (uint32_t i = 0; i < count; ++i)
            if (vertex[i] == v) return;
        CULLET_ASSERT(count < kMost, "more than %u vertices touched between two refreshes", kMost);
        if (count < kMost) vertex[count++] = v;
    }
};

/// Limits the stiffness of what touches these vertices, then rebuilds their rows and those of every vertex that shares
/// an element or a hinge with them (a limited element changes all three of its rows, a dead hinge the rows of its
/// opposite corners). Empties the list. A shell without stiffness (no packs) is left alone. False: the shell has no
/// spare slots left for some row, and must not be stepped on.
bool refresh_stiffness(ShellView shell, Touched& touched);

}  // namespace cullet
