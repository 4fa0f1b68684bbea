// Bodies, models and what is drawn of them.
#pragma once
#include "components/shells.hpp"
#include "cullet/view.hpp"

namespace cullet {

/// Scenery is drawn where it lies and stands in no rigid world.
enum class BodyKind : uint8_t { Free = 0, Static, Kinematic, Dynamic, Scenery };

struct Models;
struct ModelMeshes;
struct SoftBodies;

/// Of Bodies::is_owed_births. The second: its drawn mesh found no room either, and is still the one before the hit. The
/// third: it was dented, and collides as before; its contacts of that step are solved first.
inline constexpr uint8_t kOwedBirths = 1, kOwedDrawing = 2, kOwedShape = 3;

/// One row is one thing that the rigid world moves. Rows are reused; the generation tells a stale handle.
struct Bodies : RangeTable<Bodies> {
    using RangeTable::RangeTable;
    CULLET_TABLE(bodies);
    Column<uint32_t> generation{*this, "generation"};
    Column<uint8_t> kind{*this, "kind"};                    // BodyKind
    Column<Row<Models>> model{*this, "model"};              // kNone: no structure (a ball, static triangles)
    Column<Row<Structures>> structure{*this, "structure"};  // the model's intact one until it cracks or breaks
    Column<Row<Bodies>> parent{*this, "parent"};            // row of the body it broke off, kNone for spawned ones
    // Rigid state, read back after each solve. The body frame is the frame of the cooked mesh, for fragments too.
    Column<Vec3> position{*this, "position", "m"};
    Column<Quat> orientation{*this, "orientation"};
    Column<Vec3> velocity{*this, "velocity", "m/s"};  // of the centre of mass
    Column<Vec3> spin{*this, "spin", "rad/s"};
    Column<Vec3> previous_position{*this, "previous_position", "m"};
    Column<Quat> previous_orientation{*this, "previous_orientation"};
    Column<double> mass{*this, "mass", "kg"};
    Column<Vec3d> centre{*this, "centre", "m"};        // body frame
    Column<Sym3d> inertia{*this, "inertia", "kg m2"};  // about the centre, body axes
    Column<float> radius{*this, "radius", "m"};        // > 0: a sphere; else no point is farther from the centre
    Column<uint8_t> is_sphere{*this, "is_sphere"};
    Column<float> friction{*this, "friction"};
    Column<float> restitution{*this, "restitution"};
    Column<float> rolling_friction{*this, "rolling_friction"};  // < 0: by its shape
    Column<uint32_t> layer{*this, "layer"};
    Column<uint32_t> mask{*this, "mask"};
    Column<uint64_t> user_data{*this, "user_data"};
    Column<uint8_t> is_breakable{*this, "is_breakable"};
    Column<float> strength_scale{*this, "strength_scale"};
    Column<uint64_t> strength_seed{*this, "strength_seed"};  // of what is intact; 0: as its model has it
    Column<uint8_t> is_asleep{*this, "is_asleep"};
    Column<uint8_t> hold_count{*this, "hold_count"};  // open tasks that hold it, as body or as striker
    Column<uint8_t> has_pins{*this, "has_pins"};      // some vertex is pinned: the body is static in the rigid world
    Column<Range> pins{*this, "pins"};                // of PinBoxes; pieces that keep pins share the rows
    Column<uint8_t> is_owed_births{*this, "is_owed_births"};  // some limit refused pieces that are loose: asks again
    Column<uint64_t> retry_frame{*this, "retry_frame"};       // no new task before this frame (20 ms between tries)
    // Steps in a row whose loads were more than it bears, and runs for such loads that did not break it.
    Column<uint8_t> overloaded_steps{*this, "overloaded_steps"};
    Column<uint8_t> overload_runs{*this, "overload_runs"};
    // What is laid on it while it sleeps wakes it above this load.
    Column<float> waking_load{*this, "waking_load", "N"};
    Column<uint32_t> first_load{*this, "first_load", "1", Keep::Scratch};  // of the list of its loads, or kNone
    Column<uint32_t> task{*this, "task"};                                  // open task or kNone
    Column<Row<SoftBodies>> soft{*this, "soft"};                           // kNone: it never moves by springs
    Column<uint32_t> colour{*this, "colour"};                              // stable number for pictures
    // Drawn mesh in view space.
    Column<std::array<float, 6>> drawn_box{*this, "drawn_box", "m", Keep::Scratch};  // low, high; body frame
    Column<Row<ModelMeshes>> model_mesh{*this,
                                        "model_mesh"};    // what it shows while it is intact; none: rows of its own
    Column<Range> view_vertices{*this, "view_vertices"};  // of capacity 0 where they are those of model_mesh
    Column<Range> view_indices{*this, "view_indices"};
    Column<std::array<uint32_t, kMostRuns>> run_indices{*this, "run_indices"};  // by kind, then by drawn material
    Column<std::array<uint16_t, kMostDrawnMaterials>> drawn_materials{*this, "drawn_materials"};  // rising; rest 0
    Column<std::array<uint32_t, 2>> redrawn{*this, "redrawn", "1",
                                            Keep::Scratch};  // triangles [first, end) that the last change wrote
    Column<uint32_t> view_stamp{*this, "view_stamp"};        // changes when the drawn mesh changes
    Column<uint64_t> drawn_frame{*this, "drawn_frame"};      // the step that drew it, or before which it was drawn
};

/// One row is a box whose vertices a spawn pinned: body frame, borders included. A cut asks where it runs among them.
struct PinBoxes : Table<PinBoxes> {
    using Table::Table;
    CULLET_TABLE(pin_boxes);
    Column<Vec3> low{*this, "low", "m"};
    Column<Vec3> high{*this, "high", "m"};
};

/// One row is one cooked model in this world. It can go while bodies of it live.
struct Models : Table<Models> {
    using Table::Table;
    CULLET_TABLE(models);
    Column<uint32_t> generation{*this, "generation"};
    Column<Row<Structures>> structure{*this, "structure"};
    Column<Row<ModelMeshes>> mesh{*this, "mesh"};  // none before its first body
    Column<uint8_t> is_used{*this, "is_used"};
};

/// One row is the drawn mesh of a model, which its intact bodies show. Its users: the model, and each of them.
struct ModelMeshes : RangeTable<ModelMeshes> {
    using RangeTable::RangeTable;
    CULLET_TABLE(model_meshes);
    Column<uint32_t> users{*this, "users"};
    Column<Range> vertices{*this, "vertices"};
    Column<Range> indices{*this, "indices"};
    // As of a body.
    Column<std::array<uint32_t, kMostRuns>> run_indices{*this, "run_indices"};
    Column<std::array<uint16_t, kMostDrawnMaterials>> drawn_materials{*this, "drawn_materials"};
    Column<std::array<float, 6>> drawn_box{*this, "drawn_box", "m"};
};

template <>
struct ColumnType<ViewVertex> : ColumnLayout<ViewVertex, Scalar::F32, 8> {};

/// One row is one corner of a drawn mesh, as the game reads it.
struct ViewVertices : RangeTable<ViewVertices, 16> {
    using RangeTable::RangeTable;
    CULLET_TABLE(view_vertices);
    Column<ViewVertex> vertex{*this, "vertex", "m, 1, 1"};
};

struct ViewIndices : RangeTable<ViewIndices, 16> {
    using RangeTable::RangeTable;
    CULLET_TABLE(view_indices);
    Column<uint32_t> index{*this, "index"};    // relative to the body's first view vertex
    Column<uint32_t> source{*this, "source"};  // of its triangle: 8 times the shell's element, plus which of its own
};

/// One row is one piece too small to be a body: a point with mass and momentum.
struct Debris : Table<Debris> {
    using Table::Table;
    CULLET_TABLE(debris);
    Column<uint8_t> is_used{*this, "is_used"};
    Column<Vec3> position{*this, "position", "m"};
    Column<Vec3> velocity{*this, "velocity", "m/s"};
    Column<double> mass{*this, "mass", "kg"};
    Column<float> radius{*this, "radius", "m"};
    // Height of what is static below the place of its birth, where a host keeps its shapes to itself.
    Column<float> floor{*this, "floor", "m"};
    Column<uint8_t> is_resting{*this, "is_resting"};
    Column<uint32_t> colour{*this, "colour"};
};

}  // namespace cullet
