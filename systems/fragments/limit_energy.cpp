#include "systems/fragments/limit_energy.hpp"

#include <algorithm>
#include <cmath>

#include "systems/rigid/body_id.hpp"

namespace cullet {
namespace {

bool is_dynamic(const Bodies& bodies, Row<Bodies> b) {
    return b.exists() && static_cast<BodyKind>(bodies.kind[b]) == BodyKind::Dynamic;
}

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

// Calls visit(row) for the bodies that came of the break, the one that keeps the handle too.
template <class Visit>
void for_each_piece(const Bodies& bodies, const Break& plan, Visit visit) {
    for (uint32_t p = 0; p < plan.parts.size(); ++p)
        if (is_dynamic(bodies, plan.child[p])) visit(plan.child[p]);
}

struct Common {
    Vec3d centre, velocity, spin;
    Sym3d inertia;
    Vec3d momentum, turning;
    double energy() const { return 0.5 * (dot(momentum, velocity) + dot(turning, spin)); }
};

void turn_by(Common& common, Vec3d turning) {
    common.turning = turning;
    const double scale = trace(common.inertia);
    common.spin =
        determinant(common.inertia) > 1e-12 * scale * scale * scale ? inverse(common.inertia) * turning : Vec3d{};
}

// The rigid motion that has the pieces' momentum and angular momentum.
Common common_motion(const Bodies& bodies, const Break& plan) {
    Common common;
    double mass = 0;
    for_each_piece(bodies, plan, [&](Row<Bodies> b) {
        mass += bodies.mass[b];
        common.centre += bodies.mass[b] * Vec3d(centre_of(bodies, b));
        common.momentum += bodies.mass[b] * Vec3d(bodies.velocity[b]);
    });
    if (!(mass > 0)) return common;
    common.centre = (1 / mass) * common.centre;
    common.velocity = (1 / mass) * common.momentum;
    for_each_piece(bodies, plan, [&](Row<Bodies> b) {
        const Vec3d arm = Vec3d(centre_of(bodies, b)) - common.centre;
        const Sym3d own = world_inertia(bodies, b);
        common.inertia = common.inertia + own + bodies.mass[b] * inertia_of(outer(arm));
        common.turning += own * Vec3d(bodies.spin[b]) + bodies.mass[b] * cross(arm, Vec3d(bodies.velocity[b]));
    });
    turn_by(common, common.turning);
    return common;
}

double energy_of_crumbs(const Break& plan) {
    double energy = 0;
    for (uint32_t p = 0; p < plan.parts.size(); ++p)
        if (plan.is_crumb[p])
            energy += 0.5 * plan.motions[p].mass * dot(plan.motions[p].velocity, plan.motions[p].velocity);
    return energy;
}

}  // namespace

double rigid_energy(const Bodies& bodies, Row<Bodies> body) {
    if (!is_dynamic(bodies, body)) return 0;
    const Vec3d v(bodies.velocity[body]), w(rotate(conjugate(bodies.orientation[body]), bodies.spin[body]));
    return 0.5 * (bodies.mass[body] * dot(v, v) + dot(w, bodies.inertia[body] * w));
}

void limit_energy(Births& births, const Break& plan, double allowed) {
    Bodies& bodies = births.state.bodies;
    double energy = 0;
    bool is_pinned = false;
    for_each_piece(bodies, plan, [&](Row<Bodies> b) { energy += rigid_energy(bodies, b); });
    for (const PartMotion& m : plan.motions) is_pinned = is_pinned || m.is_static;
    const double most = allowed - energy_of_crumbs(plan);
    if (!(energy > most)) return;
    const Common common = is_pinned ? Common{} : common_motion(bodies, plan);
    Common kept = common;
    if (common.energy() > most) {
        const double straight = 0.5 * dot(common.momentum, common.velocity), turning = common.energy() - straight;
        turn_by(kept, turning > 0 ? std::sqrt(std::max(0.0, most - straight) / turning) * common.turning : Vec3d{});
    }
    const double beyond = energy - common.energy();
    const double s = beyond > 0 ? std::sqrt(std::max(0.0, most - kept.energy()) / beyond) : 1;
    for_each_piece(bodies, plan, [&](Row<Bodies> b) {
        const Vec3d arm = Vec3d(centre_of(bodies, b)) - common.centre;
        const Vec3d beside = Vec3d(bodies.velocity[b]) - common.velocity - cross(common.spin, arm);
        const Vec3d v = kept.velocity + cross(kept.spin, arm) + s * beside;
        const Vec3d w = kept.spin + s * (Vec3d(bodies.spin[b]) - common.spin);
        const Vec3d lost = bodies.mass[b] * (Vec3d(bodies.velocity[b]) - v);
        if (is_pinned) {
            births.counts.impulse_to_static[0] += lost.x;
            births.counts.impulse_to_static[1] += lost.y;
            births.counts.impulse_to_static[2] += lost.z;
        }
        bodies.velocity.set(b, v.to_float());
        bodies.spin.set(b, w.to_float());
        const Motion motion{bodies.velocity[b], bodies.spin[b]};
        births.rigid.set_motion(b, motion);
        for (FragmentBornEvent& e : births.born.all())
            if (e.fragment.index == b.index) e.motion = motion;
    });
}

}  // namespace cullet
