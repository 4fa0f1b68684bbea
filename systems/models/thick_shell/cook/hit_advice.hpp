// What to change about a model whose hits take more units than a hold has (design page, section 1).
#pragma once
#include <cstdint>
#include <functional>
#include <string>

namespace cullet {

/// Units that a hold has at the default settings: seven frames.
inline constexpr uint64_t kDefaultHoldUnits = 8'000'000ull * 7;

/// What is known of a model's hit.
struct HitOfModel {
    uint64_t units = 0;
    uint32_t vertices = 0;  // of the body
    bool is_local = false;  // only the neighbourhood of the hit is simulated
    double mean_edge = 0, thickness = 0;
    double longest_edge = 0;  // the setting, m, where it set the model's edges; 0 where they are those of the mesh
};

/// Mean edge, m, with which a hit would take `wanted` units: vertices go with the inverse square of the edge and steps
/// with its inverse, so units with the inverse cube. Where edges are shorter than the wall is thick hinges limit the
/// step, and units fall up to the fourth power. What is asked for is then on the safe side, by a fifth of the units for
/// a vase of 5 mm and edges of 4.5 mm. Of a local hit only the steps count until the body is small enough for a whole
/// one.
double edge_for_units(const HitOfModel& hit, uint64_t wanted);

/// The mean edge, m, of the mesh when all edges above a length are split.
using MeanEdgeWhenSplitAt = std::function<double(double length)>;

/// One sentence, or nothing where a hit fits the default budget; the cheapest remedy first. Each works alone. Edges
/// above twice the thickness are not asked for: thresholds would move by more than 30 % (thick shell note, section 8).
/// A longest edge is named only where `split` shows that it gives long enough ones: it never lengthens the mesh's own.
std::string hit_advice(const HitOfModel& hit, const MeanEdgeWhenSplitAt& split);

}  // namespace cullet
