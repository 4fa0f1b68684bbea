// Rows of shells and of runs on them without a world around: what cooking works in, and what keeps a cooked model.
#pragma once
#include "components/run_rows.hpp"

namespace cullet {

struct Workbench : RunRows {
    explicit Workbench(const Limits& limits);

    Materials materials{kMostMaterials};
    MaterialTraits material_traits{kMostMaterials};
};

}  // namespace cullet
