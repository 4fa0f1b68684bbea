#include "systems/bodies/blows.hpp"

#include "engine/rigid_bounds.hpp"
#include "systems/bodies/rigid_energy.hpp"

namespace cullet {

double inverse_mass_at(const Bodies& bodies, Row<Bodies> body, Vec3d point, Vec3d normal) {
    if (static_cast<BodyKind>(bodies.kind[body]) != BodyKind::Dynamic) return 0;
    const Vec3d turn = cross(point - bodies.centre[body], normal);
    return 1 / bodies.mass[body] + dot(turn, inverse(bodies.inertia[body]) * turn);
}

void push_body(Bodies& bodies, RigidWorld& rigid, DamageCounts& counts, Row<Bodies> body, Vec3d impulse,
               Vec3d turning) {
    if (static_cast<BodyKind>(bodies.kind[body]) != BodyKind::Dynamic) return;
    const Quat q = bodies.orientation[body];
    const Vec3 pushed = rotate(q, impulse.to_float()), before = bodies.velocity[body];
    Vec3 velocity = before + static_cast<float>(1 / bodies.mass[body]) * pushed;
    Vec3 spin = bodies.spin[body] + rotate(q, (inverse(bodies.inertia[body]) * turning).to_float());
    const bool is_too_fast = shorten(velocity, kFastest), spins_too_fast = shorten(spin, kFastest);
    counts.clamped += is_too_fast || spins_too_fast;
    const double energy = rigid_energy(bodies, body);
    bodies.velocity.set(body, velocity);
    bodies.spin.set(body, spin);
    counts.work_from_outside += rigid_energy(bodies, body) - energy;
    rigid.wake(body);
    bodies.is_asleep[body] = 0;
    rigid.set_motion(body, {velocity, spin});
    const Vec3d booked = is_too_fast ? bodies.mass[body] * (Vec3d(velocity) - Vec3d(before)) : Vec3d(pushed);
    for (int k = 0; k < 3; ++k) counts.impulse_to_static[k] -= booked[k];
}

void pay_blow(Blows& blows, Bodies& bodies, RigidWorld& rigid, DamageCounts& counts, uint32_t row) {
    if (blows.is_paid[row]) return;
    blows.is_paid[row] = 1;
    if (is_kind(blows, row, BlowKind::Cut)) return;
    push_body(bodies, rigid, counts, blows.body[row], blows.impulse[row], blows.turning[row]);
}

void pay_blows(Blows& blows, Bodies& bodies, RigidWorld& rigid, DamageCounts& counts, Row<Tasks> task) {
    for (uint32_t b = 0; b < blows.size(); ++b)
        if (blows.task[b] == task.index) pay_blow(blows, bodies, rigid, counts, b);
}

void close_blows(Blows& blows, Bodies& bodies, const Tasks& tasks, RigidWorld& rigid, DamageCounts& counts,
                 Row<Tasks> task) {
    pay_blows(blows, bodies, rigid, counts, task);
    for (uint32_t b = 0; b < blows.size();) {
        if (blows.task[b] != task.index) {
            ++b;
        } else if (blows.goes_on[b] && (tasks.crack_count[task] > 0 || !tasks.working[task].exists())) {
            blows.task[b] = kNone;
            blows.goes_on[b++] = 0;
        } else {
            remove_blow(blows, b);
        }
    }
}

bool has_waiting_cut(const Blows& blows, Row<Bodies> body) {
    for (uint32_t b = 0; b < blows.size(); ++b)
        if (blows.body[b] == body && blows.task[b] == kNone && is_kind(blows, b, BlowKind::Cut)) return true;
    return false;
}

bool has_explosion(const Blows& blows, Row<Tasks> task) {
    for (uint32_t b = 0; b < blows.size(); ++b)
        if (blows.task[b] == task.index && is_kind(blows, b, BlowKind::Explosion)) return true;
    return false;
}

Vec3d take_explosions(Blows& blows, Row<Tasks> task) {
    Vec3d sum;
    for (uint32_t b = 0; b < blows.size(); ++b) {
        if (blows.task[b] != task.index || blows.is_paid[b]) continue;
        if (is_kind(blows, b, BlowKind::Explosion)) sum += blows.impulse[b];
        blows.is_paid[b] = 1;
    }
    return sum;
}

}  // namespace cullet
