// The vase of the sample game, cooked as the game does.
#pragma once
#include "components/state.hpp"
#include "cullet/model.hpp"

namespace cullet::perf {

/// Of 0.30 m, with these edges (m): 7.5 mm give 3,200 vertices, 4.05 mm give 11,000. Its threshold is not measured.
Result<Model> cook_vase(float edge);

/// The cooked model's shell in tables of its own, with room for a hit.
struct CookedVase {
    explicit CookedVase(const Model& model);
    ShellView view() { return {state, shell}; }
    State state;
    Row<Shells> shell;
};

}  // namespace cullet::perf
