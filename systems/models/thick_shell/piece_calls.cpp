#include "systems/models/thick_shell/piece_calls.hpp"

#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/soft/soft_pieces.hpp"

namespace cullet {

RestMotion motion_of_rest(const RunRows& state, Row<Tasks> task) {
    const BodyMotion motion = is_quick_task(state, task) ? BodyMotion(state, task) : rest_motion(state, task);
    return {motion.centre, motion.velocity, motion.spin};
}

bool is_awake(const SoftRows& state, Row<Bodies> body) {
    const Row<SoftBodies> soft = state.bodies.soft[body];
    return soft.exists() && state.soft_bodies.is_awake[soft];
}

void look_for_pieces(SoftRows& state, Row<Bodies> body) {
    state.soft_bodies.is_torn[state.bodies.soft[body]] = 1;
}

Row<Bodies> take_torn(SoftRows& state) {
    SoftBodies& soft = state.soft_bodies;
    for (uint32_t s = 0; s < soft.size(); ++s)
        if (soft.is_torn[s]) {
            soft.is_torn[s] = 0;
            return soft.body[s];
        }
    return {};
}

void hand_off_torn(const SoftRows& state, const Break& torn, Fragments& fragments) {
    const Row<SoftBodies> soft = state.bodies.soft[torn.body];
    if (soft.exists()) soft_handoff(state, soft, fragments, torn.fragments);
}

void give_torn_pieces(SoftRows& state, const Break& torn, const Fragments& fragments) {
    const Row<SoftBodies> soft = state.bodies.soft[torn.body];
    if (soft.exists()) give_pieces_springs(state, soft, torn, fragments);
}

void keep_torn_body(SoftRows& state, RigidWorld& rigid, Row<Bodies> body) {
    const Row<SoftBodies> soft = state.bodies.soft[body];
    if (soft.exists()) keep_torn(state, rigid, soft, body);
}

}  // namespace cullet
