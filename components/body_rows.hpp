// What bodies own: their row, what is drawn of them, what holds them, and all that runs on them.
#pragma once
#include "components/ages.hpp"
#include "components/bodies.hpp"
#include "components/run_rows.hpp"
#include "components/soft.hpp"

namespace cullet {

struct BodyRows : RunRows {
    BodyRows(const Limits& limits, const MaterialRows& of_what);

    Bodies bodies;
    PinBoxes pin_boxes;
    FragmentAges fragment_ages;
    ViewVertices view_vertices;
    ViewIndices view_indices;
    QuickBodies quick_bodies;

    using Below = RunRows;
    static constexpr auto own_tables() {
        using R = BodyRows;
        return std::tuple{&R::bodies,        &R::pin_boxes,    &R::fragment_ages,
                          &R::view_vertices, &R::view_indices, &R::quick_bodies};
    }
};

/// And what moves by its springs.
struct SoftRows : BodyRows {
    SoftRows(const Limits& limits, const MaterialRows& of_what);

    SoftBodies soft_bodies;
    SoftStrikers soft_strikers;
    SoftContacts soft_contacts;

    using Below = BodyRows;
    static constexpr auto own_tables() {
        using R = SoftRows;
        return std::tuple{&R::soft_bodies, &R::soft_strikers, &R::soft_contacts};
    }
};

}  // namespace cullet
