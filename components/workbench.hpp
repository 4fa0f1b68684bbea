// Rows of structures of all kinds and of runs on them without a world around: what cooking works in, and what keeps a
// cooked model.
#pragma once
#include "components/metal_rows.hpp"
#include "components/run_rows.hpp"
#include "components/solid_rows.hpp"

namespace cullet {

/// Structures of all kinds, on a workbench or in a world.
using StructuresOfAllKinds = All<ShellRows, MetalTables, SolidRows>;

struct Workbench : RunRows, TablesOfMetal, TablesOfSolids {
    explicit Workbench(const Limits& limits);

    Materials materials{kMostMaterials};
    MaterialTraits material_traits{kMostMaterials};
    mutable SolidWork solid_work;
};

}  // namespace cullet
