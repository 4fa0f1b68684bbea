// A thick shell: a surface of triangles, each extruded inward to a prism. Who holds one names its row of Structures.
//
// Indices inside a shell (corners, neighbours, hinges, blocks) are relative to the shell's first row in that table. So
// a range is copied, saved and moved without renumbering.
#pragma once
#include <array>

#include "components/structures.hpp"
#include "engine/range_table.hpp"

namespace cullet {

/// Of an element: the outer face, the inner one, two of the wall below each edge.
inline constexpr uint32_t kMostDrawnTriangles = 8;
inline constexpr uint32_t kLanes = 8;  // vertices in a pack, on every machine
inline constexpr uint32_t kVerticesPerCell =
    64;  // 8 packs, about 128 elements: a few convex pieces of the collision shape

struct ShellSprings;

/// One row is one shell. What is not of shells alone stands in the row of Structures that names it.
struct Shells : RangeTable<Shells> {
    using RangeTable::RangeTable;
    CULLET_TABLE(shells);
    template <class T>
    using Own = RowColumn<Shells, T>;
    Own<Range> vertices{*this, "vertices"};  // first row is a multiple of 64
    Own<Range> elements{*this, "elements"};  // and TriangleSprings, the same rows
    Own<Range> hinges{*this, "hinges"};
    Own<Range> packs{*this, "packs"};    // StiffnessPacks: one a pack of 8 vertices; count 0: not assembled
    Own<Range> blocks{*this, "blocks"};  // StiffnessBlocks
    Own<Range> links{*this, "links"};    // StiffnessLinks
    Own<Row<ShellSprings>> springs{*this, "springs"};  // kNone: it has none
    Own<float> thickness{*this, "thickness", "m"};     // mean depth over elements by area
    Own<float> depth_floor{*this, "depth_floor",
                           "m"};  // least h of stiffness and contact: 0.05 eps; 0: 0.05 of the thickness
    Own<float> mean_edge{*this, "mean_edge", "m"};  // l, of the intact model; fragments inherit it
    Own<float> time_step{*this, "time_step", "s"};  // of the hidden run: 0.6 * 2 / omega_max; fragments inherit it
    Own<float> triangle_limit{*this, "triangle_limit",
                              "1/s2"};  // bounds of stiffness/mass ratios, from the intact model
    Own<float> hinge_limit{*this, "hinge_limit", "1/s2"};
    Own<float> vertex_limit{*this, "vertex_limit", "1/s2"};
    Own<uint32_t> dead_elements{*this, "dead_elements"};  // of pieces that moved, until the shell is compacted
    /// So many first elements stand in order of cells, at least; 0: nobody has looked (cell_elements.hpp). What cracks
    /// add comes behind them.
    Own<uint32_t> sorted_elements{*this, "sorted_elements", "1", Keep::Scratch};
};

enum class CrackState : uint8_t { None = 0, Tip = 1, Cracked = 2 };  // Cracked: a crack passes through, or started here

struct Float4 {
    float x = 0, y = 0, z = 0, w = 0;
};
template <>
struct ColumnType<Float4> : ColumnLayout<Float4, Scalar::F32, 4> {};

/// One row is one point of the outer surface; its inner twin is rest + depth * inward. 8 rows are one pack of a kernel.
struct Vertices : RangeTable<Vertices, kVerticesPerCell> {
    using RangeTable::RangeTable;
    CULLET_TABLE(vertices);
    Column<Vec3> rest{*this, "rest", "m"};     // body frame
    Column<Vec3> inward{*this, "inward"};      // unit
    Column<float> depth{*this, "depth", "m"};  // >= 0; 0 where no direction sees all faces
    /// From rest to where the point is drawn and collides: cracks are smoothed when their run has ended.
    Column<Vec3> crack_shift{*this, "crack_shift", "m"};
    Column<uint32_t> element{*this, "element"};  // one incident element (any: a vertex has one fan); kNone = dead row
    Column<double> mass{*this, "mass", "kg"};    // a third of each incident element, summed over the ring
    Column<float> inverse_mass{*this, "inverse_mass", "1/kg"};  // 0 pinned or dead
    Column<uint8_t> is_pinned{*this, "is_pinned"};
    Column<float> strength_factor{*this, "strength_factor"};  // Weibull, modulus 12, in [0.5, 1.5]
    // Cracks; kept between hits.
    Column<uint8_t> crack{*this, "crack"};               // CrackState
    Column<Vec3> heading{*this, "heading"};              // of a tip: the direction chosen at its last advance, unit
    Column<float> ready_time{*this, "ready_time", "s"};  // a tip may advance from this time of the run on
    Column<uint32_t> crack_start{*this, "crack_start"};  // vertex where the tip's crack started (its own root)
    Column<uint8_t> is_start_banned{*this, "is_start_banned"};  // within 3 l of a cut of this run
    // Hidden run: displacements about the rest shape, body axes. Zero while no task runs.
    Column<Vec3> displacement{*this, "displacement", "m"};    // u
    Column<Vec3> velocity{*this, "velocity", "m/s"};          // v
    Column<Float4, Buffers::Two> probe{*this, "probe", "m"};  // u + beta v, where forces are evaluated; .w is 0
    Column<float> crush{*this, "crush", "m"};  // how deep a striker has crushed the face in this run, along its blow
    Column<float> stiffness_scale{*this, "stiffness_scale"};   // share that the time step bears here, in (0, 1]
    Column<uint32_t> copy{*this, "copy", "1", Keep::Scratch};  // make_piece: row in the piece being made
};

enum class EdgeKind : uint8_t { Interior = 0, Border = 1, Crack = 2 };
/// Bits of Elements.flags. kIsTouched, in a cut-out only: the run cut at one of the element's corners, or put a vertex
/// beside it. Elements without it are as they were. So are hinges that no touched element has.
enum ElementFlag : uint8_t { kDegenerate = 1, kDead = 2, kIsTouched = 4 };

/// One row is one prism (a, b, c, a', b', c'). Edge k runs from corner k to corner (k + 1) % 3.
struct Elements : RangeTable<Elements, 16> {
    using RangeTable::RangeTable;
    CULLET_TABLE(elements);
    Column<std::array<uint32_t, 3>> corner{*this, "corner"};  // vertices, counter-clockwise from outside
    Column<std::array<uint32_t, 3>> neighbour{*this,
                                              "neighbour"};        // element across edge k, kNone at borders and cracks
    Column<std::array<uint32_t, 3>> hinge{*this, "hinge"};         // across edge k, or kNone
    Column<std::array<uint8_t, 3>> edge_kind{*this, "edge_kind"};  // EdgeKind
    Column<double> mass{*this, "mass", "kg"};                      // rest prism; shared by area when an edge is split
    Column<double> volume{*this, "volume", "m3"};
    Column<uint8_t> flags{*this, "flags"};
    Column<uint32_t> cell{*this, "cell"};                      // of its lowest corner
    Column<uint32_t> part{*this, "part"};                      // component, written by group_fragments
    Column<uint32_t> next{*this, "next", "1", Keep::Scratch};  // group_fragments: next of the part, or kNone
    Column<uint32_t> copy{*this, "copy", "1", Keep::Scratch};  // make_piece: row in the piece being made
    Column<uint32_t> next_in_cell{*this, "next_in_cell", "1", Keep::Scratch};  // make_piece
    Column<uint8_t> drawn_edges{*this, "drawn_edges", "1", Keep::Scratch};  // draw_shell: bit k, side quad k is written
    /// Where its triangles stand in the drawn mesh (drawn_triangles.hpp). A hint: ViewIndices.source has the last word.
    Column<std::array<uint32_t, kMostDrawnTriangles>> drawn{*this, "drawn", "1", Keep::Scratch};
    // The game's own surface, three entries a triangle, interpolated when an edge is split.
    Column<std::array<float, 9>> normal{*this, "normal"};
    Column<std::array<float, 6>> uv{*this, "uv"};
    Column<uint16_t> drawn_material{*this, "drawn_material"};
    // Scratch of the stress check: both faces, (xx, yy, xy) in the triangle's own axes.
    /// Of the edges: how the normal displacement falls towards the corner opposite. A hinge's angle is the sum of two.
    Column<std::array<float, 3>> slope{*this, "slope", "rad", Keep::Scratch};
    /// Of edge k: 3 * element + edge, relative to the shell, of the other half of its hinge; its own number where there
    /// is no hinge. link_slopes follows it up when neighbours change.
    Column<std::array<uint32_t, 3>> other_slope{*this, "other_slope", "1", Keep::Scratch};
    /// Least strength factor of the corners where a crack may start, or lower; 1e30 where none may.
    Column<float> start_strength{*this, "start_strength", "1", Keep::Scratch};
    Column<Vec3> outer_stress{*this, "outer_stress", "Pa", Keep::Scratch};
    Column<Vec3> inner_stress{*this, "inner_stress", "Pa", Keep::Scratch};
    Column<float> principal{*this, "principal", "Pa", Keep::Scratch};  // largest of both faces
    /// Of 8 rows, kept in the first of them: bit i is set where the principal stress of row + i may start a crack.
    Column<uint8_t> over_limit{*this, "over_limit", "1", Keep::Scratch};
};

/// One row is the three coupled springs of the element in the same row of Elements. They give constant strain from the
/// edge elongations, and plane stress with the true E and nu. With d1 = u_b - u_a, d2 = u_c - u_a and (i0, i1, i2) =
/// inverse_edges: du/dx = i0 d1, du/dy = i1 d1 + i2 d2. The strain is xx = x.du/dx, yy = y.du/dy, xy = x.du/dy +
/// y.du/dx.
struct TriangleSprings : Table<TriangleSprings> {
    using Table::Table;
    CULLET_TABLE(triangle_springs);
    Column<Vec3> axis_x{*this, "axis_x"};                       // along edge 0, unit
    Column<Vec3> axis_y{*this, "axis_y"};                       // in the plane, unit
    Column<Vec3> inverse_edges{*this, "inverse_edges", "1/m"};  // i0, i1, i2
    Column<float> area{*this, "area", "m2"};
    Column<float> thickness{*this, "thickness", "m"};  // mean depth of the corners, at least 0.05 of the wanted depth
    Column<float> scale{*this, "scale"};  // share of the stiffness that the time step bears, (0, 1]; of the stress, too
    /// Of edge k: 1 / |gradient of the shape function of the corner opposite|. A radian of the hinge across edge k
    /// gives the curvature altitude * gradient gradient^T, which is length / (2 area) * p p^T.
    Column<Vec3> altitude{*this, "altitude", "m"};
};

/// One row is one interior edge that resists bending: theta = sum of gradient . u over its four vertices.
struct Hinges : RangeTable<Hinges, 16> {
    using RangeTable::RangeTable;
    CULLET_TABLE(hinges);
    Column<std::array<uint32_t, 4>> vertex{*this,
                                           "vertex"};  // 0, 1: the edge; 2, 3: the corners opposite; [0] == kNone: dead
    Column<std::array<float, 12>> gradient{*this, "gradient", "1/m"};
    Column<float> stiffness{*this, "stiffness", "J"};  // D L^2 / (A1 + A2), unscaled
    Column<float> scale{*this, "scale"};               // share of the stiffness that the time step bears, in (0, 1]
};

/// One row is 8 vertices' share of the stiffness: f_i = sum_j K_ij (w_j - w_i), difference form.
struct StiffnessPacks : RangeTable<StiffnessPacks, 8> {
    using RangeTable::RangeTable;
    CULLET_TABLE(stiffness_packs);
    Column<uint32_t> first_block{*this, "first_block"};  // relative to the shell's blocks
    Column<uint16_t> block_count{*this, "block_count"};
    Column<uint16_t> block_capacity{*this, "block_capacity"};
    Column<uint32_t> first_link{*this, "first_link"};
    Column<uint16_t> link_count{*this, "link_count"};
    Column<uint16_t> link_capacity{*this, "link_capacity"};
};

/// A slot of a pack: for each lane one neighbour of the 1-ring and the block K_ij by rows. An unused lane names its own
/// vertex.
struct alignas(64) StiffnessBlock {
    uint32_t neighbour[kLanes];
    float k[9][kLanes];  // N/m
};
/// A slot of a pack: for each lane one corner opposite across a hinge, where the block is of rank one: K_ij = -k g_i
/// g_j^T.
struct alignas(32) StiffnessLink {
    uint32_t neighbour[kLanes];
    float row[3][kLanes];     // -k g_i, N
    float column[3][kLanes];  // g_j, 1/m
};
struct StiffnessBlocks : RangeTable<StiffnessBlocks> {
    using RangeTable::RangeTable;
    CULLET_TABLE(stiffness_blocks);
    Column<StiffnessBlock> block{*this, "block"};
};
struct StiffnessLinks : RangeTable<StiffnessLinks> {
    using RangeTable::RangeTable;
    CULLET_TABLE(stiffness_links);
    Column<StiffnessLink> link{*this, "link"};
};

}  // namespace cullet
