// Gives a surface thickness: a direction and a depth for every vertex, so that the inner surface meets neither itself
// nor the outer one and every prism between them is the right way round. Guarded front of thick shell note A5.
#pragma once
#include "systems/cook/surface.hpp"

namespace cullet {

struct ExtrusionSettings {
    uint32_t rounds = 5;         // 3 to 50; steps to the full depth
    uint32_t extra_rounds = 12;  // 0 to 100; for vertices whose step was halved
    bool has_mitre = true;       // ask for more depth at sharp edges, where depth is measured askew to the wall
    bool straightens = true;     // even out directions where opposite walls pinch, if that makes the wall thicker
};

struct ExtrusionStatistics {
    uint32_t frozen_vertices = 0;  // no direction sees all faces, or one-sided component: depth 0
    uint32_t depth_zero_vertices = 0;
    uint32_t degenerate_elements = 0;
    uint32_t straightened_vertices = 0;
    uint32_t pairs = 0;  // face pairs no certificate could drop
    uint32_t rounds = 0;
    uint32_t collisions = 0;  // vertices set back, counted each time
    uint32_t repeats = 0;     // components done again with halved caps, because the inner surface had turned inside out
};

/// Inner position of vertex v: positions[v] + depth[v] * direction[v].
struct Extrusion {
    std::vector<Vec3d> direction;  // unit, inward
    std::vector<double> depth;     // m, >= 0
    std::vector<double> cap;       // m, depth allowed by opposite walls and by sharp corners; depth <= cap
    std::vector<uint8_t> is_degenerate_element;  // has a corner of depth 0, so one to three flat tetrahedra
    ExtrusionStatistics statistics;
};

/// Thickness in metres. A cap never exceeds thickness / max(0.5, cosine of the worst face at the vertex), twice the
/// thickness.
Result<Extrusion> extrude(const Surface& surface, double thickness, const ExtrusionSettings& settings = {});

}  // namespace cullet
