// Case 9: how fast a vase, a pane and a wall must be hit before they crack, and before a piece comes loose. It goes by
// bisection, over seeded placements, at the hidden run's step and at half of it, beside the speeds that are known.
#pragma once
#include <nlohmann/json.hpp>

#include "cullet/result.hpp"
#include "sample_game/truth.hpp"
#include "sample_game/truth_cases.hpp"

namespace cullet {

struct HitTruth {
    std::vector<Verdict> verdicts;
    nlohmann::json json;
};
/// Prints what it finds on the way; takes minutes with 40 placements.
Result<HitTruth> tell_hits(const TruthSettings& settings);

}  // namespace cullet
