// What is to be true of a model: the verification cases of its method (truth_cases.hpp), and how fast a body must be
// hit before it cracks, and before a piece comes loose: by bisection, over seeded placements, beside the figures to be
// met.
#pragma once
#include <cstdint>
#include <string>

namespace cullet {

struct TruthSettings {
    uint32_t placements = 40;
    uint32_t threads = 2;  // share the placements; the figures are the same on any number. 0: 2
    std::string out;       // a folder for truth.json; empty: only printed
};

/// Names of the damage models that have cases: "thick_shell, ...".
std::string truth_models();
/// Prints a table for one of them and returns the exit code: 0 when all figures are met, 1 when some are not,
/// 2 for a model that is not known or a folder that cannot be written.
int run_truth(const std::string& model, const TruthSettings& settings);

}  // namespace cullet
