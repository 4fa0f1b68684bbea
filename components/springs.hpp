// Edge springs of a shell: what ductile shells, the quick mode and sheet metal move by. A shell without them has no row
// here. A world without them hashes as if these tables were not there.
//
// Indices inside a shell's springs (ends, owners, neighbours, slots) are relative to the first row of their range, as
// in the tables of shells. In motion, Vertices.probe holds the place of the outer points. It is two-sided; .w is the
// largest elongation among the point's springs, -1 without one. Vertices.velocity holds their velocity. Both are in the
// working frame of the row: axes of the world about `origin`.
#pragma once
#include "components/shells.hpp"
#include "cullet/layers.hpp"
#include "engine/system.hpp"

namespace cullet {

enum class SpringLayout : uint8_t {
    OneLayer = 0,
    Sandwich = 1,  // two layers; mid springs and shear pairs bend and stretch them as the thickness says
    Crossed = 2,   // two layers as in the paper: cross springs
};

inline SpringLayout spring_layout(bool has_layers, LayerLayout layout) {
    return !has_layers                      ? SpringLayout::OneLayer
           : layout == LayerLayout::Crossed ? SpringLayout::Crossed
                                            : SpringLayout::Sandwich;
}

/// One row is the springs of one shell.
struct ShellSprings : RangeTable<ShellSprings> {
    using RangeTable::RangeTable;
    CULLET_TABLE(shell_springs);
    Column<uint8_t> is_used{*this, "is_used"};
    Column<Row<Structures>> structure{*this, "structure"};  // whose shell has them: Shells::springs says it again
    Column<Range> springs{*this, "springs"};
    Column<Range> layers{*this, "layers"};            // LayerSprings, row for row of springs; capacity 0: one layer
    Column<Range> edges{*this, "edges"};              // ElementSprings, row for row of the shell's elements
    Column<Range> packs{*this, "packs"};              // SpringPacks: one for 8 vertices of the shell's capacity
    Column<Range> slots{*this, "slots"};              // SpringSlots
    Column<Range> layer_slots{*this, "layer_slots"};  // LayerSlots, row for row of slots; capacity 0: one layer
    Column<Range> twins{*this, "twins"};              // one a vertex of the shell's capacity; capacity 0: one layer
    Column<uint8_t> layout{*this, "layout"};          // SpringLayout
    Column<float> young_modulus{*this, "young_modulus", "Pa"};  // of the springs: the material's, or softened
    Column<float> damping_ratio{*this, "damping_ratio"};        // zeta
    Column<float> length_factor{*this, "length_factor"};        // gamma: depth in motion over the true one
    Column<float> area_energy{*this, "area_energy"};            // kappa_A of an element over E h A
    Column<float> volume_energy{*this, "volume_energy"};        // kappa_V of an element over E h A, before its bound
    Column<uint8_t> keeps_lengths{*this,
                                  "keeps_lengths"};  // bits of edge_stiffness.hpp; 1: rest is the shape now, 2: slender
    Column<float> time_step{*this, "time_step", "s"};
    Column<Vec3> gravity{*this, "gravity", "m/s2"};
    Column<Vec3> origin{*this, "origin", "m"};         // of the working frame, in the world
    Column<uint32_t> steps{*this, "steps"};            // done; its parity is the side of the positions that is current
    Column<uint32_t> no_lengths{*this, "no_lengths"};  // springs whose rest length is 0: they have no stiffness
};

/// One row is one spring along an edge, of the outer skin where there are two.
struct Springs : RangeTable<Springs, 16> {
    using RangeTable::RangeTable;
    CULLET_TABLE(springs);
    Column<uint32_t> a{*this, "a"};                              // vertices; kNone in both: a row that is not used
    Column<uint32_t> b{*this, "b"};                              // a != b
    Column<uint32_t> element{*this, "element"};                  // the lowest that has the edge, kNone: of no element
    Column<float> rest_length{*this, "rest_length", "m"};        // L0, of the cooked surface
    Column<float> plastic_length{*this, "plastic_length", "m"};  // where the force is 0; L0 until it flows
    Column<float> stiffness{*this, "stiffness", "N/m"};          // >= 0
    Column<float> damping{*this, "damping", "N s/m"};            // c = 2 zeta sqrt(k mu)
    Column<uint8_t> can_crack{*this, "can_crack"};               // coarse fracture clears it near a crack
    Column<std::array<uint32_t, 2>> place{*this, "place"};       // 8 * slot + lane in the lists of a and of b
    Column<float> length{*this, "length", "m", Keep::Scratch};   // rebuild_springs: what the slots remember
};

/// One row is what two layers add to the spring in the same row: its inner skin, and what ties the skins.
struct LayerSprings : RangeTable<LayerSprings, 16> {
    using RangeTable::RangeTable;
    CULLET_TABLE(layer_springs);
    Column<float> inner_length{*this, "inner_length", "m"};    // at rest
    Column<float> inner_plastic{*this, "inner_plastic", "m"};  // where the inner skin's force is 0
    Column<float> inner_stiffness{*this, "inner_stiffness", "N/m"};
    Column<float> inner_damping{*this, "inner_damping", "N s/m"};
    Column<float> mid_length{*this, "mid_length", "m"};  // Sandwich: between the middles of both ends' pairs
    Column<float> mid_stiffness{*this, "mid_stiffness", "N/m"};
    Column<std::array<float, 2>> cross_length{*this, "cross_length", "m"};  // of (a, b') and (b, a'), both layouts
    /// Sandwich: of the shear pair, energy k/2 (e1 - e2)^2 over the elongations of the two diagonals. Crossed: of each.
    Column<float> cross_stiffness{*this, "cross_stiffness", "N/m"};
    Column<float> length{*this, "length", "m", Keep::Scratch};  // of the inner skin, as Springs.length
};

/// One row is the springs of the edges of the element in the same row of the shell's elements.
struct ElementSprings : RangeTable<ElementSprings, 16> {
    using RangeTable::RangeTable;
    CULLET_TABLE(element_springs);
    Column<std::array<uint32_t, 3>> spring{*this, "spring"};  // of edge k; kNone: not made yet
    /// For the outer and the inner skin: plastic over cooked length, the mean of the springs that it had when it was
    /// re-meshed. 0: it never was.
    Column<std::array<float, 2>> flow{*this, "flow"};
};

/// One row is the list of 8 vertices.
struct SpringPacks : RangeTable<SpringPacks, 8> {
    using RangeTable::RangeTable;
    CULLET_TABLE(spring_packs);
    Column<uint32_t> first_slot{*this, "first_slot"};  // relative to the shell's slots
    Column<uint16_t> slot_count{*this, "slot_count"};
    Column<uint16_t> slot_capacity{*this, "slot_capacity"};
    Column<uint32_t> zero_lengths{*this, "zero_lengths"};  // ends of springs of length 0 that were skipped, ever
};

/// A slot of a pack: for each lane one neighbour and the spring to it. An unused lane has no stiffness and names a
/// neighbour that its vertex has already. Where the vertex has no springs, it names one of another's in the pack, or
/// the vertex itself.
struct alignas(32) SpringSlot {
    uint32_t neighbour[kLanes];
    float inverse_rest[kLanes];    // 1 / plastic length, 1/m
    float stiffness_rest[kLanes];  // k times the plastic length, N
    float damping[kLanes];         // c / dt, N/m
    float length[kLanes];          // at the start of the last step, m
};
/// The rest of a slot where there are two layers.
struct alignas(32) LayerSlot {
    float inverse_rest[kLanes], stiffness_rest[kLanes], damping[kLanes], length[kLanes];  // inner skin
    /// Sandwich: of twice the mid edge, 1 / (2 L) and k L / 2. Crossed: of the spring from the outer point.
    float first_inverse[kLanes], first_stiffness[kLanes];
    /// Sandwich: the shear pair, K = k / (4 L^2) in N/m3 and |d1|^2 - |d2|^2 at rest. Crossed: from the inner point.
    float second_inverse[kLanes], second_stiffness[kLanes];
};
struct SpringSlots : RangeTable<SpringSlots> {
    using RangeTable::RangeTable;
    CULLET_TABLE(spring_slots);
    Column<SpringSlot> slot{*this, "slot"};
};
struct LayerSlots : RangeTable<LayerSlots> {
    using RangeTable::RangeTable;
    CULLET_TABLE(layer_slots);
    Column<LayerSlot> slot{*this, "slot"};
};

/// One row is the inner point of the vertex in the same row of the shell, and the internal spring between both.
struct Twins : RangeTable<Twins, kVerticesPerCell> {
    using RangeTable::RangeTable;
    CULLET_TABLE(twins);
    Column<Float4, Buffers::Two> position{*this, "position", "m"};  // working frame; .w as Vertices.probe
    Column<Vec3> velocity{*this, "velocity", "m/s"};
    Column<float> mass_share{*this, "mass_share", "kg"};         // of each of the two points: a sixth of each element
    Column<float> inverse_mass{*this, "inverse_mass", "1/kg"};   // of each; 0 pinned or dead
    Column<float> inverse_rest{*this, "inverse_rest", "1/m"};    // 1 / (gamma depth); 0 without depth
    Column<float> stiffness_rest{*this, "stiffness_rest", "N"};  // k times gamma depth
    Column<float> damping{*this, "damping", "N/m"};              // c / dt
    Column<float> length{*this, "length", "m"};                  // at the start of the last step
    /// Body frame, from the outer point to the inner one when the springs last stopped: where start_springs puts it.
    /// Zero: they never ran, it stands gamma times the depth inward.
    Column<Vec3> through{*this, "through", "m"};
};

template <>
inline constexpr uint32_t kRowsPerChunk<SpringPacks> = 32;  // 256 vertices; 1,024 give two threads only 1.45 times one

}  // namespace cullet
