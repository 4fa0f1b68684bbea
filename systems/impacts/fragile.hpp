// Which contacts are blows that a body may not survive.
#pragma once
#include "systems/bodies/thresholds.hpp"

namespace cullet {

inline bool is_fragile(const Bodies& bodies, const Structures& structures, const DamageSettings& settings, uint32_t b) {
    const Row<Structures> structure = bodies.structure[b];
    return structure.exists() && bodies.is_breakable[b] && may_break_again(structures, structure, settings);
}

/// The contact as a blow on its body a (side 0) or b (side 1).
inline Impact impact_of(const RigidContact& c, int side) {
    const bool is_a = side == 0;
    return {Row<Bodies>(is_a ? c.a : c.b),
            Row<Bodies>(is_a ? c.b : c.a),
            c.point,
            is_a ? c.normal : -c.normal,
            c.approach_speed,
            (is_a ? c.cell_a : c.cell_b) / kMostCellParts};
}

/// Fast enough to open a task on its body, and not by somebody who stands still in the grip of another task.
inline bool is_blow(const Impact& impact, const Bodies& bodies, const Structures& structures,
                    const DamageSettings& settings) {
    const Row<Bodies> body = impact.body;
    return is_fragile(bodies, structures, settings, body) && !bodies.hold_count[impact.striker] &&
           impact.approach_speed > wake_speed(structures, bodies.structure[body], bodies.strength_scale[body]);
}

/// Body by body, the fastest first. No two are equal.
bool comes_first(const Impact& a, const Impact& b);

}  // namespace cullet
