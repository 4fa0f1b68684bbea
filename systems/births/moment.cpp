#include "systems/births/moment.hpp"

#include "components/body_id.hpp"

namespace cullet {
namespace {

struct Mean {
    double mass = 0;
    Vec3d centre, velocity, spin;  // body axes; at rest when some part is pinned
};

Mean mean_of(const Fragments& f, Rows<Fragments> of) {
    Mean mean;
    bool is_pinned = false;
    Vec3d momentum, turning;
    for (const Row<Fragments> row : of) {
        mean.mass += f.moving_mass[row];
        mean.centre += f.moving_mass[row] * f.centre[row];
        momentum += f.momentum[row];
        is_pinned = is_pinned || f.has_pins[row];
    }
    if (!(mean.mass > 0)) return mean;
    mean.centre = (1 / mean.mass) * mean.centre;
    if (is_pinned) return mean;
    mean.velocity = (1 / mean.mass) * momentum;
    Sym3d inertia;
    for (const Row<Fragments> row : of) {
        if (!(f.moving_mass[row] > 0)) continue;
        const Vec3d arm = f.centre[row] - mean.centre;
        inertia = inertia + f.inertia[row] + f.moving_mass[row] * inertia_of(outer(arm));
        turning += f.inertia[row] * f.spin[row] + cross(arm, f.momentum[row]);
    }
    if (can_turn(inertia)) mean.spin = inverse(inertia) * turning;
    return mean;
}

}  // namespace

Moment moment_of(const BodyRows& state, const Fragments& fragments, const Break& of) {
    const Row<Bodies> body = of.body;
    const Row<Tasks> task = of.task;
    const Mean mean = mean_of(fragments, of.fragments);
    Moment m{pose_of(state.bodies, body), mean.centre, {}, {}, state.tasks.is_late[task] != 0};
    const Quat to_body_axes = conjugate(m.pose.orientation);
    m.velocity_change = Vec3d(rotate(to_body_axes, state.bodies.velocity[body])) -
                        (m.is_late ? mean.velocity : Vec3d(state.tasks.start_velocity[task]));
    m.spin_change = Vec3d(rotate(to_body_axes, state.bodies.spin[body])) -
                    (m.is_late ? mean.spin : Vec3d(state.tasks.start_spin[task]));
    return m;
}

Motion world_motion(const Moment& m, const PartMotion& part) {
    if (part.is_static) return {};
    const Vec3d velocity = part.velocity + m.velocity_change + cross(m.spin_change, part.centre - m.centre);
    return {rotate(m.pose.orientation, velocity.to_float()),
            rotate(m.pose.orientation, (part.spin + m.spin_change).to_float())};
}

}  // namespace cullet
