#include "systems/models/metal_shell/dent/ways.hpp"

namespace cullet {

void spread_ways(const MetalView& metal, float limit) {
    const MetalSprings& springs = metal.springs();
    spread_ways(metal, limit, [&](uint32_t, uint32_t, uint32_t spring) { return springs.length[spring]; });
}

}  // namespace cullet
