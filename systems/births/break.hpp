// What the systems that make pieces hand to each other in one step.
#pragma once
#include <span>

#include "components/body_rows.hpp"
#include "systems/structures/shell/group_fragments.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/structures/shell/rigid_handoff.hpp"

namespace cullet {

/// A body that comes apart: some of its parts leave as bodies or crumbs. Spans are of the frame's arena, one entry a
/// part but for `order`.
struct Break {
    Row<Tasks> task;         // or none: a body whose loose pieces found no room asks again
    Row<Bodies> body;        // the largest part keeps it, and its rows in `broken`
    Row<Structures> broken;  // the body's own, or a task's that has the same cells
    Row<Structures> before;  // the body's so far
    std::span<FragmentPart> parts;
    std::span<PartMotion> motions;
    std::span<uint32_t> order;     // parts, heaviest first
    std::span<Row<Bodies>> child;  // new bodies
    std::span<uint8_t> is_crumb;
    std::span<uint32_t> debris;  // rows of crumbs once they are made, or kNone
    uint32_t largest = 0;
    std::span<Handoff> handoff = {};  // one or none: what the motions came from
    bool is_settled = true;           // the motions are final, or will be when births are filled
    std::span<Touch> touches = {};    // of the parts, at their cracks
    double waited = 0;                // J that pieces which waited for this break have beyond the body's motion
    uint32_t left_elements = 0;       // of all parts that leave
    ShellSums whole;                  // of `broken` before they do
    float margin = 0;                 // of the body's hulls so far
    Range points = {};                // for the hulls of what is left
    bool had_cells = true;            // with hulls of their own, not one shape for all of them
    bool chooses_shape = false;       // what is left of the body, too (piece_shape.hpp)
    /// The body keeps its rows, and hulls and drawn mesh but for the cells that changed (Cells::is_changed).
    bool keeps_hulls = false, keeps_mesh = false;
    bool is_refused = false;  // some part stays for want of room
    bool lets_go = false;     // the body stood on pins, and what is left of it has none
    /// Its damage model moves the body, and it tore: what has pins keeps the body, and goes on moving.
    bool is_torn = false;

    bool leaves(uint32_t part) const { return child[part].exists() || is_crumb[part]; }
    bool is_broken() const {
        for (uint32_t p = 0; p < parts.size(); ++p)
            if (leaves(p)) return true;
        return lets_go;
    }
    /// More is gone than stays: what stays is measured anew, not as a difference.
    bool is_rest_smaller(const StructureRows& state) const {
        return left_elements > state.structures.live_elements[broken] - left_elements;
    }
};

/// One part of a break, whose rows are to be filled; kNone: the hand-off is to be settled, which goes with the longest
/// of them in time.
struct Birth {
    uint32_t of;  // in Events<Break>
    uint32_t part;
};

/// A cell of a body that came apart, whose hull is to be chosen; kNone: the one shape of all of it, which is.
struct HullWanted {
    Row<Structures> shell;
    uint32_t cell;
};

}  // namespace cullet
