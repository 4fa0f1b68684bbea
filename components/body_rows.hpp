// What bodies own: their row, what is drawn of them, what holds them, and all that runs on them.
#pragma once
#include "components/ages.hpp"
#include "components/bodies.hpp"
#include "components/run_rows.hpp"
#include "components/soft.hpp"
#include "components/squeezes.hpp"

namespace cullet {

struct TablesOfBodies {
    Limits limits;
    Bodies bodies{limits.bodies, limits.bodies};
    PinBoxes pin_boxes{4 * limits.bodies + 64};
    FragmentAges fragment_ages{limits.bodies};
    ViewVertices view_vertices{limits.view_vertices, limits.bodies + limits.models};
    ViewIndices view_indices{limits.view_vertices * 2, limits.bodies + limits.models};
    QuickBodies quick_bodies{limits.bodies};
    ModelMeshes model_meshes{limits.models + limits.bodies, limits.models + limits.bodies};
    Squeezes squeezes{limits.bodies};
};
struct BodyRows : RunRows, TablesOfBodies {
    BodyRows(const Limits& l, const MaterialRows& of_what) : RunRows(l, of_what), TablesOfBodies{l} {}

    using Below = RunRows;
    using Own = TablesOfBodies;
};

/// And what moves by its springs.
struct TablesOfSoftBodies {
    Limits limits;
    SoftBodies soft_bodies{limits.bodies};
    SoftStrikers soft_strikers{limits.bodies * kMostStrikers};
    SoftContacts soft_contacts{first_contact_row(limits.vertices + kLanes)};
};
struct SoftRows : BodyRows, TablesOfSoftBodies {
    SoftRows(const Limits& l, const MaterialRows& of_what) : BodyRows(l, of_what), TablesOfSoftBodies{l} {}

    using Below = BodyRows;
    using Own = TablesOfSoftBodies;
};

}  // namespace cullet
