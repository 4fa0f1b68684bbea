// What a batch of cuts changed, and the stiffness that must follow it.
#pragma once
#include "systems/structures/shell/ring.hpp"
#include "systems/structures/shell/vertex_list.hpp"

namespace cullet {

/// What changed since the last `refresh_stiffness`.
struct Touched {
    /// A start with six arms and six inserts touches about 100.
    static constexpr uint32_t kEnough = VertexList::kMost / 2;
    VertexList weighed;           // whose mass, elements or hinges changed: B7's limits are found anew
    VertexList rows;              // whose rows hold a changed element or hinge
    bool marks_elements = false;  // the shell is a cut-out: refreshing marks what was touched
    uint64_t units = 0;  // what refreshing cost beyond kUnitsCut: rows of materials with a grain; for the task to owe

    /// Mass or elements of the vertex changed.
    void add(uint32_t v) {
        weighed.add(v);
        rows.add(v);
    }
    /// The hinge came, changed or is about to die.
    void add_hinge(ShellView shell, uint32_t hinge) {
        for (const uint32_t v : shell.state.hinges.vertex[shell.hinge(hinge)])
            if (v != kNone) add(v);
    }
    bool is_enough() const { return weighed.count > kEnough || rows.count > kEnough; }
    void clear() {
        weighed.clear();
        rows.clear();
    }
};

/// Marks the elements at the listed vertices with kIsTouched, for put_back: no others have changed, nor have hinges
/// that none of them has.
void mark_touched(const ShellView& shell, const Touched& touched);

/// Limits the stiffness of what touches the weighed vertices, then rebuilds the rows, and those of each vertex of an
/// element or hinge whose limit changed. Empties the lists. A shell without stiffness (no packs) is left alone. False:
/// the shell has no spare slots left for some row, and must not be stepped on.
bool refresh_stiffness(ShellView shell, Touched& touched);

}  // namespace cullet
