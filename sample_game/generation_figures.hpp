// What giving a surface its thickness costs and yields, for every way of propagation: the table of thick shell note 11.
#pragma once
#include <string>
#include <vector>

#include "cullet/model.hpp"
#include "engine/mesh.hpp"

namespace cullet {

/// One way at one thickness.
struct GenerationFigure {
    Propagation propagation = Propagation::GuardedFront;
    double share = 0;  // of the diagonal that the thickness is
    double seconds =
        0;  // of the processor, one thread; the crossing test of the input included; the least of the rounds
    uint32_t collisions = 0;  // what one is, see ExtrusionStatistics
    double wall = 0;          // mean over the area of the distance between inner points and surface, over the thickness
    uint32_t inverted = 0;    // elements
    uint32_t crossings = 0;   // pairs of faces
};

/// One mesh, every way at every thickness asked for: shares in the order given, ways in the order of Propagation.
struct GenerationFigures {
    std::string mesh;
    uint32_t vertices = 0, triangles = 0;
    double embree_build = 0;   // s, one rtcCommitScene on one thread; the least of twenty times the rounds
    double crossing_test = 0;  // s
    std::vector<GenerationFigure> rows;
};

/// The yardstick: one commit of Embree's default tree, s, without the making of a device and the copying of the mesh.
/// The least of `rounds`.
double embree_build(const Mesh& mesh, uint32_t rounds);

/// Five rounds to the depth and no mitre, as in the note's table. Takes clocks, so no state may depend on it.
Result<GenerationFigures> measure_generation_of(const Mesh& mesh, const std::vector<double>& shares, uint32_t rounds);

/// Six made meshes: vase (one sheet), piggy bank, bowl (both walls), pleated sheet, ring, box of square cells.
std::vector<Mesh> generation_meshes();

/// One line a thickness and way: ms (Embree builds) / collisions / wall / inverted, crossings.
std::string describe(const GenerationFigures& figures);

}  // namespace cullet
