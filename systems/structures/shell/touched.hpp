// What a batch of cuts changed, and what must follow it at once in the rows of the model.
#pragma once
#include "systems/structures/shell/costs.hpp"
#include "systems/structures/shell/ring.hpp"
#include "systems/structures/shell/vertex_list.hpp"

namespace cullet {

/// Calls to the model whose springs hold the shell together, at once while it is being cut.
struct CutRepair {
    /// `repair`: this one, which may know more.
    void (*element)(const CutRepair& repair, ShellView shell,
                    uint32_t element);                   // its corners are others, or elsewhere
    uint32_t (*hinge)(ShellView shell, uint32_t hinge);  // its vertices are written and new
    bool (*can_rename)(const Structures& structures,
                       Row<Structures> shell);  // `rename` does; else the row is made anew
    /// What `vertex` has with `from` it has with `to` now.
    void (*rename)(ShellView shell, uint32_t vertex, uint32_t from, uint32_t to);
    void (*limit)(ShellView shell);  // all of a shell without stiffness rows, after many cuts
};

/// Of a model that holds its shells together by nothing that is kept in rows.
extern const CutRepair kNoRepair;

/// What changed since the model made its rows anew.
struct Touched {
    explicit Touched(const CutRepair& r) : repair(r) {}
    const CutRepair& repair;
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

}  // namespace cullet
