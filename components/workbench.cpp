#include "components/workbench.hpp"

namespace cullet {

Workbench::Workbench(const Limits& limits)
    : RunRows(limits, MaterialRows{materials, material_traits}), TablesOfMetal{limits}, TablesOfSolids{limits} {}

}  // namespace cullet
