// What metal shells have beside the rows of a shell. Sub-shells carry creases and folds. Springs on all edges and
// between sheets limit how far it stretches. A world without metal has no rows here.
//
// Vertices and elements of the shell stand row for row in ranges of MetalVertices and MetalElements. Indices are
// relative to the shell, as in its own tables.
#pragma once
#include <array>

#include "components/shells.hpp"

namespace cullet {

struct Bodies;

inline constexpr uint32_t kMostSubShells = 512;
inline constexpr uint32_t kBlended = 8;  // sub-shells that a vertex is moved by

/// Choices of an impact that the published method makes otherwise than ours, as bits of MetalShells::published. A bit
/// that is set takes the published one.
enum PublishedChoice : uint8_t {
    kPublishedContact = 1,   // springs that push harder on the way in; not one impulse
    kPublishedDepth = 2,     // of each sub-shell by the impulse over its mass, turned by its moment
    kPublishedShape = 4,     // sub-shells that are hit move as rigid pieces; not the striker's shape
    kPublishedCells = 8,     // and that is all they do: no folds, no creases
    kPublishedBorders = 16,  // a vertex between sub-shells goes with the lowest of them; not with all by weights
    kPublishedSprings = 32,  // all edges pull towards the length they had before the impact
    kPublishedLimit = 64,    // too long an edge is cut short along the way it had, at one end
};
inline constexpr uint8_t kAllPublished = 127;

/// One row is what one shell has.
struct MetalShells : RangeTable<MetalShells> {
    using RangeTable::RangeTable;
    CULLET_TABLE(metal_shells);
    Column<Row<Structures>> structure{*this, "structure"};        // whose shell it is; MetalOwners says it again
    Column<Range> vertices{*this, "vertices"};                    // MetalVertices
    Column<Range> elements{*this, "elements"};                    // MetalElements
    Column<Range> springs{*this, "springs"};                      // MetalSprings, from vertex to vertex
    Column<Range> cells{*this, "cells"};                          // SubShells
    Column<Range> borders{*this, "borders"};                      // SubShellBorders
    Column<float> mean_edge{*this, "mean_edge", "m"};             // of the original shape
    Column<float> crush_pressure{*this, "crush_pressure", "Pa"};  // p_c of the whole body; 0: it is an open sheet
    Column<float> half_diagonal{*this, "half_diagonal", "m"};     // of the original box
    Column<uint8_t> published{*this, "published"};                // PublishedChoice
    Column<float> impulse_time{*this, "impulse_time", "s"};       // tau of the published depth; 0: by the depth of ours
    Column<float> tear_strain{*this, "tear_strain"};              // 0: by the material's
};

/// Row s says which row of MetalShells the shell in row s of Shells has. It holds that number + 1, and 0 of one that is
/// not of metal. There are no rows while nothing is.
struct MetalOwners : Table<MetalOwners> {
    using Table::Table;
    CULLET_TABLE(metal_owners);
    Column<uint32_t> metal{*this, "metal"};

    Row<MetalShells> of(Row<Shells> shell) const {
        return shell < size() && metal[shell] > 0 ? Row<MetalShells>(metal[shell] - 1) : Row<MetalShells>();
    }
};

/// One row is one sub-shell: a connected group of elements that moves as one piece where the sheet folds and creases.
struct SubShells : RangeTable<SubShells> {
    using RangeTable::RangeTable;
    CULLET_TABLE(sub_shells);
    Column<uint32_t> representative{*this, "representative"};  // element
    Column<uint32_t> element_count{*this, "element_count"};
    Column<float> area{*this, "area", "m2"};
    Column<Vec3> centre{*this, "centre", "m"};   // by area, original shape
    Column<Vec3> axis{*this, "axis"};            // of largest inertia, unit, away from the body's centre
    Column<float> extent{*this, "extent", "m"};  // 1.5 times the mean distance of its elements from the centre
    Column<float> gate{*this, "gate"};           // of folds, 0 to 1: slivers cannot follow one
    Column<uint32_t> first_border{*this, "first_border"};  // of the shell's SubShellBorders
    Column<uint32_t> border_count{*this, "border_count"};
    // Of the impact that is worked off.
    Column<Vec3> moved{*this, "moved", "m", Keep::Scratch};   // mean displacement of its elements
    Column<Vec3> place{*this, "place", "m", Keep::Scratch};   // centre by area at the start of the impact
    Column<Vec3> turn{*this, "turn", "rad", Keep::Scratch};   // rotation that fits it best
    Column<float> field{*this, "field", "m", Keep::Scratch};  // mean of its vertices' fields
    Column<float> shortening{*this, "shortening", "1", Keep::Scratch};
    Column<float> fold{*this, "fold", "m", Keep::Scratch};      // height along the axis
    Column<float> crease{*this, "crease", "1", Keep::Scratch};  // chi: how much it moves as one piece
    Column<uint8_t> is_touched{*this, "is_touched", "1", Keep::Scratch};
    Column<float> weights{*this, "weights", "1", Keep::Scratch};          // of a mean that is being taken: their sum
    Column<float> least_field{*this, "least_field", "m", Keep::Scratch};  // that what strikes it leaves it
    Column<Vec3> impulse{*this, "impulse", "N s", Keep::Scratch};         // of the published method: sum over contacts
    Column<Vec3> moment{*this, "moment", "N m s", Keep::Scratch};         // of them about its centre
};

/// One row is one neighbour of a sub-shell, of which there are two a border.
struct SubShellBorders : RangeTable<SubShellBorders> {
    using RangeTable::RangeTable;
    CULLET_TABLE(sub_shell_borders);
    Column<uint16_t> other{*this, "other"};
    Column<float> length{*this, "length", "m"};  // a tie between sheets counts half a mean edge
};

/// Row v is of the shell's vertex v.
struct MetalVertices : RangeTable<MetalVertices> {
    using RangeTable::RangeTable;
    CULLET_TABLE(metal_vertices);
    Column<Vec3> original{*this, "original", "m"};           // where it was before all impacts
    Column<Vec3> before{*this, "before", "m"};               // and before the last one, which may go on
    Column<float> pin_distance{*this, "pin_distance", "m"};  // to the nearest pin, original shape; 1e30: there is none
    Column<uint32_t> first_spring{*this, "first_spring"};    // of the shell's MetalSprings
    Column<uint16_t> spring_count{*this, "spring_count"};
    Column<std::array<uint16_t, kBlended>> cell{*this, "cell"};   // nearest first
    Column<std::array<float, kBlended>> weight{*this, "weight"};  // sum 1
    // Of the impact that is worked off.
    Column<Vec3> start{*this, "start", "m", Keep::Scratch};        // q
    Column<Vec3> place{*this, "place", "m", Keep::Scratch};        // x
    Column<Vec3> next{*this, "next", "m", Keep::Scratch};          // of a pass that reads place
    Column<float> field{*this, "field", "m", Keep::Scratch};       // u, along the push; 0: it stays where it is
    Column<float> way{*this, "way", "m", Keep::Scratch};           // along the sheet from what is touched
    Column<uint32_t> queued{*this, "queued", "1", Keep::Scratch};  // a ring of vertices whose way became shorter
    Column<uint8_t> is_queued{*this, "is_queued", "1", Keep::Scratch};
    Column<float> area{*this, "area", "m2", Keep::Scratch};      // a third of its triangles, original shape
    Column<uint16_t> mover{*this, "mover", "1", Keep::Scratch};  // the sub-shell that it goes with; kNoMover: none
};
inline constexpr uint16_t kNoMover = 0xffff;

/// Row e is of the shell's element e.
struct MetalElements : RangeTable<MetalElements> {
    using RangeTable::RangeTable;
    CULLET_TABLE(metal_elements);
    Column<uint16_t> cell{*this, "cell"};  // sub-shell
};

/// One row is one end of a spring along an edge, or of a tie between two sheets: the other end has a row, too.
struct MetalSprings : RangeTable<MetalSprings> {
    using RangeTable::RangeTable;
    CULLET_TABLE(metal_springs);
    Column<uint32_t> other{*this, "other"};       // vertex
    Column<float> length{*this, "length", "m"};   // of the original shape
    Column<float> stiffness{*this, "stiffness"};  // of the field: cotangents, 0.05 to 3; of a tie 1
    Column<uint8_t> is_tie{*this, "is_tie"};      // between two sheets
};

/// Row t is the impact that task t works off, body axes.
struct MetalRuns : Table<MetalRuns> {
    using Table::Table;
    CULLET_TABLE(metal_runs);
    Column<uint8_t> shape{*this, "shape"};           // StrikerShape
    Column<Vec3> point{*this, "point", "m"};         // of the touch
    Column<Vec3> push{*this, "push"};                // unit: the way the striker goes
    Column<float> radius{*this, "radius", "m"};      // of a round striker
    Column<double> energy{*this, "energy", "J"};     // kinetic, in the effective mass; 0: nothing to work off
    Column<float> impulse{*this, "impulse", "N s"};  // along the push
    Column<float> depth{*this, "depth", "m"};        // of the dent
    Column<float> contact{*this, "contact", "m"};    // radius of its bottom
    Column<Row<Bodies>> striker{*this, "striker"};
    Column<float> speed{*this, "speed", "m/s"};
    Column<float> restitution{*this, "restitution"};  // at least, by the sheet
    Column<uint8_t> goes_on{*this, "goes_on"};  // it is more of the body's last impact: from the shape before that
    // Of a striker that is neither flat nor round: how its front lies in StrikerFronts.
    Column<Vec3> across{*this, "across"};                       // unit, square to the push: the way of a row
    Column<std::array<float, 4>> frame{*this, "frame", "m"};    // StrikerFront: low ends and steps
    Column<std::array<float, 4>> extent{*this, "extent", "m"};  // and how far the striker reaches
};

/// Row b is the last impact on body b. What strikes at the same place again before it is over is more of it. A dent
/// hangs on the whole energy, not on the steps that it comes in. There are no rows while nothing was struck.
struct MetalImpacts : Table<MetalImpacts> {
    using Table::Table;
    CULLET_TABLE(metal_impacts);
    Column<uint64_t> frame{*this, "frame"};         // of its last touch
    Column<float> seconds{*this, "seconds", "s"};   // in which there may be another; 0: there was none
    Column<uint8_t> has_shape{*this, "has_shape"};  // it moved vertices: MetalVertices.before is of it
    Column<Row<Bodies>> striker{*this, "striker"};  // kNone: the game's
    Column<uint8_t> shape{*this, "shape"};          // these as in MetalRuns, of its first touch
    Column<Vec3> point{*this, "point", "m"};
    Column<Vec3> push{*this, "push"};
    Column<float> radius{*this, "radius", "m"};
    Column<float> contact{*this, "contact", "m"};  // radius of the dent's bottom
    Column<double> energy{*this, "energy", "J"};   // of all touches
};

/// Row b is what presses on body b slowly, until its task works it off. There are no rows while nothing was pressed.
struct MetalPresses : Table<MetalPresses> {
    using Table::Table;
    CULLET_TABLE(metal_presses);
    Column<uint8_t> is_on{*this, "is_on"};     // 0: nothing presses
    Column<float> depth{*this, "depth", "m"};  // that it lies in the body
    Column<float> ahead{*this, "ahead", "m"};  // that it comes until the dent is there
    Column<float> force{*this, "force", "N"};  // of who makes way itself; 0: it comes as far as it is in
};

inline constexpr uint32_t kFrontRows = 64;

/// Rows [64 t, + 64) are the front of what strikes in task t. They say how far it has come along the push at each place
/// of a grid across it, from the point of touch. They are kNoFront where there is nothing of it.
struct StrikerFronts : Table<StrikerFronts> {
    using Table::Table;
    CULLET_TABLE(striker_fronts);
    Column<std::array<float, kFrontRows>> front{*this, "front", "m"};
};
inline constexpr float kNoFront = -1e30f;

}  // namespace cullet
