// What a game may set of the damage model metal_shell, beside what all models have. Their ranges:
// systems/models/metal_shell/shared/settings.cpp, a line each.
#pragma once
#include <cstdint>

namespace cullet {

/// A choice of the method. The paper's are there to compare with: they do not give dents that anybody believes.
enum class MetalChoice : uint8_t { Default, Paper };

/// CookSettings::metal_shell. What impacts go by is kept by the model: bodies of it, files and snapshots have it.
struct MetalShellSettings {
    uint32_t sub_shells = 0;      // that carry folds and creases; 0: one for 110 triangles, 16 to 128
    float crush_pressure = 0;     // Pa, under which the body gives way as a whole; 0: the material's, or by its shape
    float link_distance = 0.01f;  // of the box diagonal: sheets that are so near are tied to each other
    float edge_split = 0.025f;    // of the box diagonal: longer edges are split, where longest_edge is 0
    float tear_strain = 0;        // beyond which it tears; 0: 1.25 times the strain at which the material breaks
    // Choices of the method.
    MetalChoice adjacency = MetalChoice::Default;        // how far neighbouring triangles are apart
    MetalChoice seeds = MetalChoice::Default;            // where sub-shells begin
    MetalChoice representatives = MetalChoice::Default;  // what stands for a sub-shell
    MetalChoice contact = MetalChoice::Default;          // springs that push harder on the way in
    MetalChoice depth = MetalChoice::Default;            // of sub-shells, by impulse over mass; with shape alone
    MetalChoice shape = MetalChoice::Default;            // what is hit moves as rigid sub-shells
    MetalChoice cells = MetalChoice::Default;            // and has no folds, no creases
    MetalChoice borders = MetalChoice::Default;          // between sub-shells a vertex goes with the lowest
    MetalChoice springs = MetalChoice::Default;          // edges pull towards the length before the impact
    MetalChoice limit = MetalChoice::Default;            // too long an edge is cut short along its old way
    float impulse_time = 0;                              // s, of the paper's depth; 0: such that it is as deep as ours
};

}  // namespace cullet
