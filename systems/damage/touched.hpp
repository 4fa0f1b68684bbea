// What a batch of cuts changed, and the stiffness that must follow it.
#pragma once
#include "systems/damage/ring.hpp"

namespace cullet {

/// What changed since the last `refresh_stiffness`.
struct Touched {
    static constexpr uint32_t kMost = 256;  // a start with six arms and six inserts touches about 100
    uint32_t count = 0;
    uint32_t vertex[kMost];        // each once
    bool has_changed_rows[kMost];  // false: only the vertex's stiffness over mass may have changed

    /// Mass or elements of the vertex changed.
    void add(uint32_t v) { add(v, true); }
    /// A hinge that holds the vertex changed or died. Some other vertex of that hinge was added by `add`.
    void add_hinge_end(uint32_t v) { add(v, false); }

 private:
    void add(uint32_t v, bool rows) {
        for (uint32_t i = 0; i < count; ++i) {
            if (vertex[i] != v) continue;
            has_changed_rows[i] |= rows;
            return;
        }
        CULLET_ASSERT(count < kMost, "more than %u vertices touched between two refreshes", kMost);
        if (count == kMost) return;
        vertex[count] = v;
        has_changed_rows[count++] = rows;
    }
};

/// Limits the stiffness of what touches these vertices, then rebuilds their rows and those of every vertex that shares
/// an element or a hinge with them (a limited element changes all three of its rows, a dead hinge the rows of its
/// opposite corners). Vertices of `add_hinge_end` spread further only when their limit changed. Empties the list. A
/// shell without stiffness (no packs) is left alone. False: the shell has no spare slots left for some row, and must
/// not be stepped on.
bool refresh_stiffness(ShellView shell, Touched& touched);

}  // namespace cullet
