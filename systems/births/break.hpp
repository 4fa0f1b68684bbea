// What the systems that make pieces hand to each other in one step: rows, and no pointers.
#pragma once
#include "components/body_rows.hpp"
#include "components/fragments.hpp"

namespace cullet {

/// What the body did before the hit, along its own axes, and where its fragments lie at each other: what settles their
/// motions.
struct HandoffStart {
    Vec3d velocity;           // of the centre of mass, m/s
    Vec3d spin;               // rad/s
    Vec3d centre;             // of mass, m
    double impact_speed = 0;  // m/s, > 0
    Rows<Touches> touches = {};
};

/// A body that comes apart: some of its fragments leave as bodies or debris.
struct Break {
    Row<Bodies> body;  // the largest fragment keeps it, and its rows in `broken`
    Row<Tasks> task;   // or none: a body whose loose pieces found no room asks again
    Rows<Fragments> fragments;
    Row<Fragments> largest;
    Row<Structures> broken;  // the body's own, or a task's that has the same cells
    Row<Structures> before;  // the body's so far
    HandoffStart start;
    bool is_settled = true;      // the motions are final, or will be when births are filled
    double waited = 0;           // J that pieces which waited for this break have beyond the body's motion
    uint32_t left_elements = 0;  // of all fragments that leave
    float margin = 0;            // of the body's hulls so far
    Range points = {};           // for the hulls of what is left
    bool had_cells = true;       // with hulls of their own, not one shape for all of them
    bool chooses_shape = false;  // what is left of the body, too
    /// The body keeps its rows, and hulls and drawn mesh but for the cells that changed (Cells::is_changed).
    bool keeps_hulls = false, keeps_mesh = false;
    bool is_refused = false;  // some fragment stays for want of room
    bool lets_go = false;     // the body stood on pins, and what is left of it has none
    /// Its damage model moves the body, and it tore: what has pins keeps the body, and goes on moving.
    bool is_torn = false;
    /// Nothing leaves: it was dented in an earlier step, and gets the hulls and the mass properties of its new shape.
    bool is_reshaped = false;

    /// More is gone than stays: what stays is measured anew, not as a difference.
    bool is_rest_smaller(const Structures& structures) const {
        return left_elements > structures.live_elements[broken] - left_elements;
    }
    /// The i-th heaviest of its fragments.
    Row<Fragments> in_order(const Fragments& rows, uint32_t i) const { return rows.order[fragments.first + i]; }
};

/// A fragment whose rows are to be filled; none: the motions of all of them are to be settled, which goes with the
/// longest of them in time.
struct Birth {
    uint32_t of;  // in Events<Break>
    Row<Fragments> fragment;
};

/// A cell of a body that came apart, whose hull is to be chosen; kNone: the one shape of all of it, which is.
struct HullWanted {
    Row<Structures> structure;
    uint32_t cell;
};

}  // namespace cullet
