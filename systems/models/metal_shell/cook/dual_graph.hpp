// Which triangles of a surface are neighbours, and how far they are from each other: what sub-shells are cut along
// (metal shell note A0 to A2).
#pragma once
#include <span>
#include <vector>

#include "systems/cook/surface.hpp"

namespace cullet {

/// How far two neighbours are apart.
enum class FaceDistance : uint8_t {
    Normalised,  // angle and way, each over its mean: free of scale and tessellation
    Paper,       // sine squared of the angle, beside a way in metres
};

struct DualSettings {
    FaceDistance distance = FaceDistance::Normalised;
    double way_share = 0.5;       // delta, 0 to 1: what the way counts for beside the angle
    double convex_weight = 1;     // eta of convex edges, 0.05 to 1; 0.2 finds parts of a toy
    double link_distance = 0.01;  // of the box diagonal, 0 to 0.1: sheets that are so near are tied to each other
};

/// Two vertices of sheets that lie on each other: skin and lining, trim and door.
struct SheetLink {
    uint32_t a, b;
    double gap;  // m
};

struct DualEdge {
    uint32_t face;
    double distance;  // above 0
};
/// Neighbours of face f stand at [first[f], first[f + 1]), rising.
struct DualGraph {
    std::vector<uint32_t> first;
    std::vector<DualEdge> edges;
    std::vector<SheetLink> links;        // by a, then b; each once
    std::vector<uint32_t> component_of;  // of a face: connected over edges and links
    uint32_t component_count = 0;

    uint32_t face_count() const { return static_cast<uint32_t>(first.size()) - 1; }
    std::span<const DualEdge> of(uint32_t face) const {
        return {edges.data() + first[face], edges.data() + first[face + 1]};
    }
};

/// Edges of three or more faces join all pairs of them. A face without area has no angle.
DualGraph build_dual_graph(const Surface& surface, const DualSettings& settings = {});

/// Centroid, unit normal (zero without area) and area of a triangle.
struct FaceShape {
    Vec3d centroid, normal;
    double area = 0;  // m2
};
FaceShape shape_of(const Surface& surface, uint32_t face);

}  // namespace cullet
