// A load that no piece of a solid bears parts it along planes, without asking where it is weakest. What is pressed
// together by those that yield to nothing has no time for that, and may be too small for a solve.
#pragma once
#include "systems/models/lattice/crack/break_run.hpp"

namespace cullet {

struct Parting {
    Vec3d place, normal;
    uint32_t parts = 2;  // about so many
};

/// Parts each piece that the plane goes through, and then the largest through its middle, across its longest side,
/// until there are enough. That parts any two cells: run.crack_count 0 means that there was but one. `own`: as for
/// begin_break.
void part_body(const BreakableSolid& body, const Parting& parting, std::span<const uint8_t> own, BreakRun& run);

}  // namespace cullet
