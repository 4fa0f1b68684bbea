// The vase of the sample game, cooked as the game does.
#pragma once
#include <optional>

#include "components/state.hpp"
#include "cullet/model.hpp"

namespace cullet::perf {

/// With these edges (m) and of this height (m): 7.5 mm give 3,200 vertices at 0.30 m, 4.05 mm give 11,000, and 98,000
/// at 0.89 m. Its threshold is not measured. Without a kind of fracture it has its material's, large.
Result<Model> cook_vase(float edge, float height = 0.30f, std::optional<FractureKind> fracture = {});

/// The cooked model's shell in tables of its own, with room for a hit.
struct CookedVase {
    explicit CookedVase(const Model& model);
    ShellView view() { return {state, shell}; }
    State state;
    Row<Structures> shell;
};

}  // namespace cullet::perf
