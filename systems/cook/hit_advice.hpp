// What to change about a model whose hits take more units than a hold has (design page, section 1).
#pragma once
#include <cstdint>
#include <string>

namespace cullet {

/// Default budget of the frame of the touch and of the six that a hold of 0.1 s lasts.
inline constexpr uint64_t kDefaultHoldUnits = 8'000'000ull * 7;

/// Mean edge, m, with which a hit would take `wanted` units instead of `units`: vertices go with the inverse square of
/// the edge and steps with its inverse, so units with the inverse cube. Where edges are shorter than the wall is thick
/// hinges limit the step, and units fall up to the fourth power: what is asked for is then on the safe side, by a fifth
/// of the units for a vase of 5 mm and edges of 4.5 mm.
double edge_for_units(double mean_edge, uint64_t units, uint64_t wanted);

/// One sentence, or nothing where a hit fits the default budget. Edges above twice the thickness are not asked for:
/// thresholds would move by more than 30 % (thick shell note, section 8). `longest_edge`: the setting, m, where it set
/// the model's edges, and 0 where they are those of the mesh. What is longer than it is halved, so that means lie a
/// good part below it: it is asked to grow by the factor by which the mean has to.
std::string hit_advice(uint64_t units, double mean_edge, double thickness, double longest_edge);

}  // namespace cullet
