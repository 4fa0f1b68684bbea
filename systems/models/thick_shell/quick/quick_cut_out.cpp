#include "systems/models/thick_shell/quick/quick_cut_out.hpp"

#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/quick/region_motion.hpp"
#include "systems/models/thick_shell/quick/run_on.hpp"

namespace cullet {
namespace {

// A split vertex may be one ring outside of what is awake; re-meshing changes the elements beyond its ring, and the
// fans at the ends of the cut are one ring further. One more to spare.
// Coarse cracks run on beyond that.
uint32_t border_rings(FractureKind kind) {
    return kCutOutBorderRings + (kind == FractureKind::Coarse ? kCoarseRunSteps + 1 : 0);
}

}  // namespace

CutOutSize quick_cut_out_size(const RunRows& state, Row<Tasks> task) {
    const Row<Structures> source = state.tasks.source[task];
    const FractureKind kind = material_traits(state, state.structures.material[source]).fracture;
    return {region_rings(state.quick_runs.steps[task]) + 1 + border_rings(kind), kNone};
}

}  // namespace cullet
