// What bodies are made of, whatever it is: what the rest of the program asks of it. A model's intact structure is one
// row, shared by all of its bodies. A body that cracked or broke has a row of its own, and so has a damage task.
#pragma once
#include <array>

#include "components/materials.hpp"
#include "engine/range_table.hpp"

namespace cullet {

/// Whose table has what only this kind of structure has: Structures::rows is a row of it.
enum class StructureKind : uint8_t { Shell = 0, Tetrahedra = 1 };  // Shells, Solids

/// What stands for a structure in the rigid world: hulls of its cells, or one hull or box for all of it.
enum class ShapeKind : uint8_t { Cells = 0, Hull = 1, Box = 2 };

inline constexpr uint32_t kMostCellParts = 4;     // convex pieces of a cell
inline constexpr uint32_t kMostCellPoints = 128;  // corners of all of them

/// One row is what a body is made of, or several are, and what breaks it.
struct Structures : RangeTable<Structures> {
    using RangeTable::RangeTable;
    CULLET_TABLE(structures);
    template <class T>
    using Own = RowColumn<Structures, T>;
    /// What breaks it: its place in the world's list of damage models. Copies and pieces inherit it.
    Own<uint8_t> damage_model{*this, "damage_model"};
    Own<uint8_t> kind{*this, "kind"};     // StructureKind
    Own<uint32_t> rows{*this, "rows"};    // its row in the table of its kind
    Own<uint32_t> users{*this, "users"};  // models, bodies and tasks that hold the row; 0 = free
    Own<Row<Materials>> material{*this, "material"};
    Own<double> mass{*this, "mass", "kg"};                // sum over elements, ordered
    Own<double> intact_mass{*this, "intact_mass", "kg"};  // of the model that it came from
    Own<Vec3d> centre{*this, "centre", "m"};              // body frame
    Own<Sym3d> inertia{*this, "inertia", "kg m2"};        // about the centre, body axes
    Own<float> area{*this, "area", "m2"};
    /// The smallest parts that it can come apart into, of a shell its triangles, without those that left with pieces.
    Own<uint32_t> live_elements{*this, "live_elements"};
    Own<float> first_crack_speed{*this, "first_crack_speed", "m/s"};  // measured by cooking against a floor
    Own<float> first_crack_force{*this, "first_crack_force", "N"};    // that one place bears for long, likewise
    Own<uint8_t> generation{*this, "generation"};                     // 0 intact, fragments one more than their parent
    Own<uint8_t> has_cracks{*this, "has_cracks"};
    Own<float> margin{*this, "margin", "m"};           // that hulls are grown by; what breaks keeps its own
    Own<uint8_t> shape{*this, "shape"};                // ShapeKind
    Own<uint8_t> shape_points{*this, "shape_points"};  // of the one hull or box; 0: cells have their own
    Own<float> box_ratio{*this, "box_ratio"};          // volume of the tightest box over the solid's; 0: not measured
    Own<float> hull_ratio{*this, "hull_ratio"};        // the same of the one hull
    Own<uint32_t> made_shape{*this, "made_shape", "1", Keep::Scratch};  // of the one hull, as Cells.shape
    Own<Range> cells{*this, "cells"};
    Own<Range> points{*this, "points"};  // HullPoints of its cells, or of the one hull or box
};

/// Of Cells::is_changed: cracks passed, or elements of pieces were in it.
inline constexpr uint8_t kCracked = 1, kLeft = 2;

/// One row is a patch of neighbouring vertices, or a convex cell of a solid. It is the chunk of a job, and has bounds.
/// It has a few convex pieces of the collision shape, but none where one hull or box stands for the structure.
struct Cells : RangeTable<Cells> {
    using RangeTable::RangeTable;
    CULLET_TABLE(cells);
    Column<uint32_t> first_point{*this, "first_point"};  // relative to the shell's points
    Column<uint32_t> point_count{*this, "point_count"};  // <= 128; 0: the cell has lost all of its elements
    Column<std::array<uint8_t, kMostCellParts>> part_points{*this, "part_points"};  // of each hull in turn; sum: count
    Column<uint32_t> element_count{*this, "element_count"};                         // live ones
    Column<uint8_t> is_stale{*this, "is_stale"};  // cracked since its points were chosen; the next break chooses anew
    // Scratch of make_piece: the part's elements of this cell as a list, and the cell that it is merged into.
    Column<uint32_t> first_element{*this, "first_element", "1", Keep::Scratch};
    Column<uint32_t> last_element{*this, "last_element", "1", Keep::Scratch};
    Column<uint32_t> list_count{*this, "list_count", "1", Keep::Scratch};
    Column<uint32_t> merged{*this, "merged", "1", Keep::Scratch};
    // Scratch of cell_hulls: a cell whose hull is to be chosen anew, kCracked or kLeft; the parent's cell that has the
    // same points, kNone.
    Column<uint8_t> is_changed{*this, "is_changed", "1", Keep::Scratch};
    Column<uint32_t> same_cell{*this, "same_cell", "1", Keep::Scratch};
    Column<uint32_t> shape{*this, "shape", "1", Keep::Scratch};  // RigidWorld's, of a hull chosen in this step; kNone
};

/// One row is a corner of one of a cell's hulls, or of a whole structure's, body frame, pulled in by the collision
/// margin.
struct HullPoints : RangeTable<HullPoints> {
    using RangeTable::RangeTable;
    CULLET_TABLE(hull_points);
    Column<Vec3> point{*this, "point", "m"};
};

}  // namespace cullet
