// Cuts a surface into sub-shells: connected groups of triangles round representatives, by k-medoids over the distance
// of faces (metal shell note A3 to A6).
#pragma once
#include "components/metal.hpp"
#include "systems/models/metal_shell/cook/dual_graph.hpp"

namespace cullet {

enum class Seeding : uint8_t {
    Farthest,  // from all seeds so far
    Paper,     // of the largest mean distance to them: puts seeds side by side
};
enum class Representatives : uint8_t {
    CentroidThenExact,  // cheap rounds until the sum would rise, then exact ones
    Exact,              // the face of least sum within its cell, by descent over its neighbours
    Centroid,           // the face nearest to the cell's centroid
};

struct SubShellSettings {
    uint32_t count = 0;  // k, up to 512; 0: a cell for 110 faces, 16 to 128
    double threshold =
        0;  // of the largest distance to a representative, where cells are added until it is met; 0: none
    Seeding seeding = Seeding::Farthest;
    Representatives representatives = Representatives::CentroidThenExact;
    uint32_t rounds = 30;     // at most
    double least_area = 0.1;  // of the mean; smaller cells join a neighbour
};

struct Segmentation {
    std::vector<uint16_t> cell_of;         // of a face
    std::vector<uint32_t> representative;  // a face, one a cell
    std::vector<double> sums;              // of all faces' distances to their representative: seeds, then each round
    double radius = 0;                     // the largest of them, in the end
    uint32_t wanted = 0;                   // k, as it was taken
    uint32_t count() const { return static_cast<uint32_t>(representative.size()); }
};

/// At least one cell a component. Ties go to the lowest face and cell, so the same surface gives the same cells.
Segmentation find_sub_shells(const Surface& surface, const DualGraph& graph, const SubShellSettings& settings = {});

}  // namespace cullet
