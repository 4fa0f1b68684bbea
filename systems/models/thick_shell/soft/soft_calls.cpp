#include "systems/models/thick_shell/soft/soft_calls.hpp"

#include "systems/models/thick_shell/soft/sheet_energy.hpp"
#include "systems/models/thick_shell/soft/soft_body.hpp"
#include "systems/models/thick_shell/springs/start_springs.hpp"
#include "systems/structures/shell/explosion.hpp"

namespace cullet {

std::optional<MechanicalEnergy> soft_energy(SoftRows& state, Row<Bodies> body, Vec3 gravity) {
    const Row<SoftBodies> soft = state.bodies.soft[body];
    if (!soft.exists() || !state.soft_bodies.is_awake[soft]) return {};
    const SpringView view(state, springs_of(state, soft));
    const SpringMotion motion = motion_of(view);
    const Vec3d centre = motion.centre + Vec3d(view.own().origin[view.row]);
    return MechanicalEnergy{
        motion.kinetic, -motion.mass * dot(Vec3d(gravity), centre), spring_energy(view) + sheet_energy(view), 0, 1,
        motion.mass};
}

bool push_soft_body(SoftRows& state, RigidWorld& rigid, Row<Bodies> body, const PointPush& push) {
    const Row<SoftBodies> soft = state.bodies.soft[body];
    if (!soft.exists()) return false;
    push_soft(state, rigid, soft, push.point, push.impulse, push.radius, push.fastest);
    return true;
}

bool explode_soft_body(SoftRows& state, RigidWorld& rigid, Row<Bodies> body, const Explosion& explosion) {
    const Row<SoftBodies> soft = state.bodies.soft[body];
    if (!soft.exists()) return false;
    if (!state.soft_bodies.is_awake[soft]) wake_soft(state, rigid, soft);
    state.soft_bodies.quiet_seconds[soft] = 0;
    const SpringView view(state, springs_of(state, soft));
    kick_points(view.shell, view.has_layers() ? view.twin(0) : kNone, explosion, state.bodies.orientation[body]);
    return true;
}

bool call_up_soft_body(SoftRows& state, Row<Bodies> body) {
    const Row<SoftBodies> soft = state.bodies.soft[body];
    if (!soft.exists()) return false;
    state.soft_bodies.is_called[soft] = 1;
    return true;
}

bool is_soft_driven_into(const SoftRows& state) {
    const SoftBodies& soft = state.soft_bodies;
    for (uint32_t s = 0; s < soft.size(); ++s)
        for (uint32_t i = 0; soft.is_used[s] && soft.is_awake[s] && i < soft.striker_count[s]; ++i) {
            const SoftStriker& striker = state.soft_strikers.striker[kMostStrikers * s + i];
            if (striker.is_pushed && !striker.yields &&
                dot(striker.velocity, striker.velocity) + dot(striker.spin, striker.spin) > 0)
                return true;
        }
    return false;
}

}  // namespace cullet
