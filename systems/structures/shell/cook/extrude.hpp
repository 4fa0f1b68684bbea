// Gives a surface thickness: a direction and a depth for every vertex, so that the inner surface meets neither itself
// nor the outer one and every prism between them is the right way round. Guarded front of thick shell note A5, and
// beside it the published ways (A3, A4), which do not keep all of that.
#pragma once
#include "cullet/model.hpp"
#include "systems/cook/surface.hpp"

namespace cullet {

struct ExtrusionSettings {
    uint32_t rounds = 5;         // 3 to 50; steps to the full depth
    uint32_t extra_rounds = 12;  // 0 to 100; for vertices whose step was halved
    bool has_mitre = true;       // ask for more depth at sharp edges, where depth is measured askew to the wall
    bool straightens = true;     // even out directions where opposite walls pinch, if that makes the wall thicker
    Propagation propagation = Propagation::GuardedFront;
    bool has_certificates = true;  // drop pairs that can never meet before the rounds (A6); the paper has none
    bool keeps_path = false;       // the depths after each round, for tests
};

struct ExtrusionStatistics {
    uint32_t frozen_vertices = 0;  // no direction sees all faces, or one-sided component: depth 0
    uint32_t depth_zero_vertices = 0;
    uint32_t degenerate_elements = 0;
    uint32_t straightened_vertices = 0;
    uint32_t pairs = 0;  // face pairs no certificate could drop
    uint32_t rounds = 0;
    uint32_t collisions = 0;  // counted each time: vertices set back; Front: pairs that met; SingleVertex: moves undone
    uint32_t repeats = 0;     // components done again with halved caps, because the inner surface had turned inside out
    uint32_t inverted_elements = 0;  // with a tetrahedron not above 0 although its corner has depth
    uint32_t crossings = 0;          // pairs of faces (inner, outer, rim) that meet in the end
};

/// Inner position of vertex v: positions[v] + depth[v] * direction[v].
struct Extrusion {
    std::vector<Vec3d> direction;  // unit, inward
    std::vector<double> depth;     // m, >= 0
    std::vector<double> cap;       // m, depth allowed by opposite walls and by sharp corners; depth <= cap
    std::vector<uint8_t> is_degenerate_element;  // has a corner of depth 0, so one to three flat tetrahedra
    ExtrusionStatistics statistics;
    std::vector<std::vector<double>> path;  // m, depths after each round, when asked for
};

/// The inner wall of a mesh that models both. Where a ray from the outer wall meets it, the whole way is the depth.
struct InnerSkin {
    std::vector<Vec3d> positions;  // m
    std::vector<Triangle> triangles;
    std::vector<uint8_t> is_of_component;  // components of the surface that is extruded: those whose inner wall it is
    std::vector<Vec3d> into_the_wall;      // unit, one a triangle of that surface; 0: against its normal
};

/// Thickness in metres. A cap never exceeds thickness / max(0.5, cosine of the worst face at the vertex), twice the
/// thickness; with an inner skin it is the way to the skin. Front and SingleVertex have the caps of opposite walls and
/// slopes alone; the other two also those of each element's shape.
Result<Extrusion> extrude(const Surface& surface, double thickness, const ExtrusionSettings& settings = {},
                          const InnerSkin* skin = nullptr);

}  // namespace cullet
