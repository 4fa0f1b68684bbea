#include "systems/births/limit_energy.hpp"

#include <algorithm>
#include <cmath>

#include "components/body_id.hpp"
#include "systems/births/part_motion.hpp"

namespace cullet {
namespace {

// The inertia about the centre, in world axes.
Sym3d world_inertia(const Bodies& bodies, Row<Bodies> b) {
    const Quat q = bodies.orientation[b];
    const Vec3d x(rotate(q, {1, 0, 0})), y(rotate(q, {0, 1, 0})), z(rotate(q, {0, 0, 1}));
    const Sym3d& i = bodies.inertia[b];
    const auto turned = [&](Vec3d w) {
        const Vec3d own = i * Vec3d{dot(x, w), dot(y, w), dot(z, w)};
        return own.x * x + own.y * y + own.z * z;
    };
    const Vec3d a = turned({1, 0, 0}), b_ = turned({0, 1, 0}), c = turned({0, 0, 1});
    return {a.x, b_.y, c.z, a.y, a.z, b_.z};
}

// A piece, the body that keeps the handle among them, or debris, which is a point. World axes.
struct Mover {
    Row<Bodies> body;
    uint32_t debris = kNone;
    double mass = 0;
    Vec3d place, velocity, spin;
    Sym3d inertia;
    double energy() const { return 0.5 * (mass * dot(velocity, velocity) + dot(spin, inertia * spin)); }
};

template <class Visit>
void for_each_mover(const Bodies& bodies, const Debris& debris, const Fragments& fragments, const Break& plan,
                    Visit visit) {
    for (const Row<Fragments> f : plan.fragments) {
        const Row<Bodies> b = fragments.child[f];
        const uint32_t d = fragments.debris[f];
        if (is_dynamic(bodies, b))
            visit(Mover{b, kNone, bodies.mass[b], Vec3d(centre_of(bodies, b)), Vec3d(bodies.velocity[b]),
                        Vec3d(bodies.spin[b]), world_inertia(bodies, b)});
        else if (d != kNone)
            visit(Mover{{}, d, debris.mass[d], Vec3d(debris.position[d]), Vec3d(debris.velocity[d]), {}, {}});
    }
}

struct Common {
    Vec3d centre, velocity, spin;
    Sym3d inertia;
    Vec3d momentum, turning;
    double energy() const { return 0.5 * (dot(momentum, velocity) + dot(turning, spin)); }
};

void turn_by(Common& common, Vec3d turning) {
    common.turning = turning;
    common.spin = can_turn(common.inertia) ? inverse(common.inertia) * turning : Vec3d{};
}

// The rigid motion that has the pieces' momentum and angular momentum.
Common common_motion(const Bodies& bodies, const Debris& debris, const Fragments& fragments, const Break& plan) {
    Common common;
    double mass = 0;
    for_each_mover(bodies, debris, fragments, plan, [&](const Mover& m) {
        mass += m.mass;
        common.centre += m.mass * m.place;
        common.momentum += m.mass * m.velocity;
    });
    if (!(mass > 0)) return common;
    common.centre = (1 / mass) * common.centre;
    common.velocity = (1 / mass) * common.momentum;
    Vec3d turning;
    for_each_mover(bodies, debris, fragments, plan, [&](const Mover& m) {
        const Vec3d arm = m.place - common.centre;
        common.inertia = common.inertia + m.inertia + m.mass * inertia_of(outer(arm));
        turning += m.inertia * m.spin + m.mass * cross(arm, m.velocity);
    });
    turn_by(common, turning);
    return common;
}

void move(Births& births, const Mover& m, Vec3d velocity, Vec3d spin, BodyId parent) {
    auto& state = births.state;
    if (m.debris != kNone) {
        const Vec3 place = births.debris.position[m.debris];
        births.debris.velocity.set(m.debris, velocity.to_float());
        for (DebrisEvent& e : births.debris_events.all())
            if (e.parent.index == parent.index && e.place.x == place.x && e.place.y == place.y && e.place.z == place.z)
                e.velocity = velocity.to_float();
        return;
    }
    state.bodies.velocity.set(m.body, velocity.to_float());
    state.bodies.spin.set(m.body, spin.to_float());
    const Motion motion{state.bodies.velocity[m.body], state.bodies.spin[m.body]};
    births.rigid.set_motion(m.body, motion);
    for (FragmentBornEvent& e : births.born.all())
        if (e.fragment.index == m.body.index) e.motion = motion;
}

bool holds_pins(const Fragments& fragments, const Break& plan) {
    for (const Row<Fragments> f : plan.fragments)
        if (fragments.has_pins[f]) return true;
    return false;
}

// Of the energy of the blow that stands for a load, and of what the whole body would hold at its strength: what is
// squeezed bursts with what its springs held, and who presses follows slowly. A bar that is bent holds a ninth.
constexpr double kFreedByLoad = 0.1, kHeldByLoad = 0.1;

// J. sigma^2 / 2 E of the volume.
double held_energy(const BodyRows& state, Row<Bodies> body) {
    const uint32_t m = state.structures.material[state.bodies.structure[body]];
    const Materials& materials = state.materials;
    const double strength = double{state.bodies.strength_scale[body]} * materials.tensile_strength[m];
    const double volume = state.bodies.mass[body] / materials.density[m];
    return kHeldByLoad * 0.5 * strength * strength / materials.young_modulus[m] * volume;
}

}  // namespace

double pieces_energy(const Bodies& bodies, const Debris& debris, const Fragments& fragments, const Break& plan) {
    double energy = 0;
    for_each_mover(bodies, debris, fragments, plan, [&](const Mover& m) { energy += m.energy(); });
    return energy;
}

double owed_to_late(const BodyRows& state, Row<Tasks> task) {
    if (state.tasks.load[task] > 0) {
        const double speed = double{state.tasks.approach_speed[task]};
        const Row<Bodies> body = state.tasks.body[task];
        return std::min(kFreedByLoad * 0.5 * state.bodies.mass[body] * speed * speed, held_energy(state, body));
    }
    double owed = state.hidden_runs.start_energy[task] - rigid_energy(state.bodies, state.tasks.body[task]);
    const uint32_t first = state.tasks.first_contact[task], end = first + state.tasks.contact_count[task];
    const auto& strikers = state.task_contacts.striker;
    for (uint32_t c = first; c < end; ++c) {
        bool is_counted = false;
        for (uint32_t b = first; b < c; ++b) is_counted = is_counted || strikers[b] == strikers[c];
        if (!is_counted) owed -= rigid_energy(state.bodies, strikers[c]);
    }
    return std::max(0.0, owed);
}

void limit_energy(Births& births, const Break& plan, double allowed) {
    const Bodies& bodies = births.state.bodies;
    const Debris& debris = births.debris;
    const Fragments& fragments = births.fragments;
    const double energy = pieces_energy(bodies, debris, fragments, plan);
    const bool is_pinned = holds_pins(fragments, plan);
    if (!(energy > allowed)) return;
    const Common common = is_pinned ? Common{} : common_motion(bodies, debris, fragments, plan);
    Common kept = common;
    if (common.energy() > allowed) {
        const double straight = 0.5 * dot(common.momentum, common.velocity), turning = common.energy() - straight;
        turn_by(kept, turning > 0 ? std::sqrt(std::max(0.0, allowed - straight) / turning) * common.turning : Vec3d{});
    }
    const double beyond = energy - common.energy();
    const double s = beyond > 0 ? std::sqrt(std::max(0.0, allowed - kept.energy()) / beyond) : 1;
    for_each_mover(bodies, debris, fragments, plan, [&](const Mover& m) {
        const Vec3d arm = m.place - common.centre;
        const Vec3d beside = m.velocity - common.velocity - cross(common.spin, arm);
        const Vec3d velocity = kept.velocity + cross(kept.spin, arm) + s * beside;
        const Vec3d lost = m.mass * (m.velocity - velocity);
        if (is_pinned) {
            births.counts.impulse_to_static[0] += lost.x;
            births.counts.impulse_to_static[1] += lost.y;
            births.counts.impulse_to_static[2] += lost.z;
        }
        move(births, m, velocity, kept.spin + s * (m.spin - common.spin), body_id(bodies, plan.body));
    });
}

// Of the relative motion u of masses M and m, M m / (M + m) u^2 / 2 goes to s^2 of it.
void share_with_strikers(Births& births, const Break& plan, double allowed) {
    const Tasks& tasks = births.state.tasks;
    Bodies& bodies = births.state.bodies;
    const Debris& debris = births.debris;
    const Fragments& fragments = births.fragments;
    const uint32_t first = tasks.first_contact[plan.task], end = first + tasks.contact_count[plan.task];
    if (holds_pins(fragments, plan)) return;  // the support has taken what was too much
    double excess = pieces_energy(bodies, debris, fragments, plan) - allowed;
    for (uint32_t c = first; c < end && excess > 1e-9 * allowed; ++c) {
        const Row<Bodies> striker = births.state.task_contacts.striker[c];
        if (!is_dynamic(bodies, striker)) continue;
        double mass = 0;
        for_each_mover(bodies, debris, fragments, plan, [&](const Mover& m) { mass += m.mass; });
        const Common common = common_motion(bodies, debris, fragments, plan);
        const double other = bodies.mass[striker];
        const Vec3d relative = common.velocity - Vec3d(bodies.velocity[striker]);
        const double motion = 0.5 * mass * other / (mass + other) * dot(relative, relative);
        if (!(motion > 0)) continue;
        const Vec3d given =
            (1 - std::sqrt(std::max(0.0, 1 - excess / motion))) * mass * other / (mass + other) * relative;
        excess -= std::min(excess, motion);
        for_each_mover(bodies, debris, fragments, plan, [&](const Mover& m) {
            move(births, m, m.velocity - (1 / mass) * given, m.spin, body_id(bodies, plan.body));
        });
        const Vec3d velocity = Vec3d(bodies.velocity[striker]) + (1 / other) * given;
        bodies.velocity.set(striker, velocity.to_float());
        births.rigid.set_motion(striker, {bodies.velocity[striker], bodies.spin[striker]});
    }
}

}  // namespace cullet
