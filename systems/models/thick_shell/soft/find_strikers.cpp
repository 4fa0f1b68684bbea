#include "systems/models/thick_shell/soft/find_strikers.hpp"

#include <algorithm>

#include "components/body_id.hpp"
#include "systems/models/thick_shell/soft/soft_body.hpp"
#include "systems/models/thick_shell/springs/start_springs.hpp"

namespace cullet {
namespace {

constexpr uint32_t kMostNear = 256;
constexpr float kReach = 0.01f;       // m beyond what the motion of a frame asks for
constexpr float kFarInside = -1e30f;  // a plane that nothing is behind

/// Inertia about the centre in world axes, inverted.
Sym3d inverse_inertia_of(const Bodies& bodies, Row<Bodies> b) {
    const Quat q = bodies.orientation[b];
    const Sym3d local = inverse(bodies.inertia[b]);
    const auto column = [&](Vec3 axis) {
        const Vec3 in_body = rotate(conjugate(q), axis);
        return Vec3d(rotate(q, (local * Vec3d(in_body)).to_float()));
    };
    const Vec3d x = column({1, 0, 0}), y = column({0, 1, 0}), z = column({0, 0, 1});
    return {x.x, y.y, z.z, 0.5 * (x.y + y.x), 0.5 * (x.z + z.x), 0.5 * (y.z + z.y)};
}

SoftStriker striker_of(const BodyRows& state, const RigidWorld& rigid, Row<Bodies> own, Row<Bodies> b, Vec3 origin) {
    const Bodies& bodies = state.bodies;
    SoftStriker striker;
    striker.body = b;
    const auto kind = static_cast<BodyKind>(bodies.kind[b]);
    const bool is_held = bodies.hold_count[b] > 0;
    striker.yields = kind == BodyKind::Dynamic && !is_held;
    striker.falls = striker.yields && !rigid.is_touched(b);
    striker.is_ball = bodies.is_sphere[b];
    striker.radius = bodies.radius[b];
    striker.friction = bodies.friction[own] * bodies.friction[b];
    striker.start = striker.centre = centre_of(bodies, b) - origin;
    if (kind == BodyKind::Static || is_held) return striker;
    striker.start_velocity = striker.velocity = bodies.velocity[b];
    striker.start_spin = striker.spin = bodies.spin[b];
    if (!striker.yields) return striker;
    striker.inverse_mass = static_cast<float>(1 / bodies.mass[b]);
    striker.inverse_inertia = inverse_inertia_of(bodies, b);
    return striker;
}

struct Points {
    Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
    Vec3 middle;  // the mean of its points
    float fastest = 0;
    void add(Vec3 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
};

Points points_of(const SpringView& view) {
    const ShellRows& s = view.state;
    Points points;
    float square = 0;
    Vec3d sum;
    double count = 0;
    for (uint32_t v = 0; v < view.shell.vertex_count(); ++v) {
        const uint32_t row = view.shell.vertex(v);
        if (!(s.vertices.mass[row] > 0)) continue;
        points.add(view.position(v));
        sum += Vec3d(view.position(v)), ++count;
        const Vec3 velocity = s.vertices.velocity[row];
        square = std::max(square, dot(velocity, velocity));
    }
    points.fastest = std::sqrt(square);
    if (count > 0) points.middle = ((1 / count) * sum).to_float();
    return points;
}

float fastest_body(const Bodies& bodies) {
    float square = 0;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const auto kind = static_cast<BodyKind>(bodies.kind[b]);
        if (kind != BodyKind::Dynamic && kind != BodyKind::Kinematic) continue;
        square = std::max(square, dot(bodies.velocity[b], bodies.velocity[b]));
    }
    return std::sqrt(square);
}

Vec3 inward_of(const SpringView& view, uint32_t v, Quat orientation) {
    if (view.has_layers()) return normalised(view.twin_position(v) - view.position(v));
    return rotate(orientation, view.state.vertices.inward[view.shell.vertex(v)]);
}

struct Gathering {
    SoftRows& state;
    const RigidWorld& rigid;
    Row<SoftBodies> soft;
    SpringView view;
    Step step;
    Vec3 seen_from;  // world: sheets are met on the side of the middle of the body
    uint32_t first, room, count = 0;

    /// `distance`: of the plane from the striker's centre, with the wall's offset.
    void add(uint32_t striker, uint32_t vertex, Vec3 normal, float distance, float offset) {
        const bool is_open = count > 0 && state.soft_contacts.contact[first + count - 1].striker == striker &&
                             state.soft_contacts.contact[first + count - 1].count < kLanes;
        if (!is_open) {
            if (count == room) return;
            SoftContact fresh;
            fresh.striker = striker;
            std::fill(fresh.vertex, fresh.vertex + kLanes, vertex);
            std::fill(fresh.distance, fresh.distance + kLanes, kFarInside);
            state.soft_contacts.contact[first + count++] = fresh;
        }
        SoftContact& contact = state.soft_contacts.contact[first + count - 1];
        const uint32_t lane = contact.count++;
        contact.vertex[lane] = vertex;
        contact.normal[0][lane] = normal.x, contact.normal[1][lane] = normal.y, contact.normal[2][lane] = normal.z;
        contact.distance[lane] = distance;
        contact.offset[lane] = offset;
    }

    // Planes of the surface near each vertex, as far off as the two can come together in a frame.
    void gather(uint32_t i, const SoftStriker& striker) {
        const Vec3 origin = view.own().origin[view.row];
        const Quat orientation = state.bodies.orientation[state.soft_bodies.body[soft]];
        const float fall = 0.5f * length(step.gravity) * step.dt * step.dt;
        for (uint32_t v = 0; v < view.shell.vertex_count(); ++v) {
            const uint32_t row = view.shell.vertex(v);
            if (!(state.vertices.mass[row] > 0)) continue;
            if (!striker.yields && !(state.vertices.inverse_mass[row] > 0)) continue;  // neither can give way
            const Vec3 p = view.position(v), arm = p - striker.centre;
            const Vec3 closing = state.vertices.velocity[row] - striker.velocity - cross(striker.spin, arm);
            const float depth = state.vertices.depth[row];
            const float reach = kReach + depth + fall + length(closing) * step.dt;
            Vec3 normal, point;
            if (striker.is_ball) {
                const float distance = length(arm);
                if (distance - striker.radius > reach || !(distance > 0)) continue;
                normal = (1 / distance) * arm;
            } else {
                RigidSurface surface;
                if (!rigid.nearest_surface(striker.body, p + origin, reach, surface, &seen_from)) continue;
                normal = surface.normal;
                point = surface.point - origin - striker.centre;
            }
            const float offset = std::max(0.0f, -depth * dot(normal, inward_of(view, v, orientation)));
            add(i, v, normal, dot(normal, point) + offset, offset);
        }
    }
};

}  // namespace

void find_strikers(SoftRows& state, const RigidWorld& rigid, Row<SoftBodies> s, const Step& step) {
    SoftBodies& soft = state.soft_bodies;
    const Row<Bodies> body = soft.body[s];
    const SpringView view(state, springs_of(state, s));
    const Vec3 origin = view.own().origin[view.row];
    const Range vertices = view.shell.vertices();
    const Points points = points_of(view);
    Gathering gathering{state,
                        rigid,
                        s,
                        view,
                        step,
                        points.middle + origin,
                        first_contact_row(vertices.first),
                        kContactsAVertex * (vertices.capacity / kLanes)};
    view.own().gravity.set(view.row, step.gravity);
    const float wide = kReach + view.shell.shells().thickness[view.shell.row] +
                       (points.fastest + fastest_body(state.bodies)) * step.dt;
    RigidId near[kMostNear];
    const Vec3 grown{wide, wide, wide};
    const uint32_t found = rigid.near_bodies(points.low + origin - grown, points.high + origin + grown, near);
    soft.striker_count[s] = 0;
    soft.start_momentum.set(s, motion_of(view).momentum);
    soft.has_fault[s] = soft.lacks_room[s] = 0;
    for (uint32_t k = 0; k < found && soft.striker_count[s] < kMostStrikers; ++k) {
        const Row<Bodies> other(near[k]);
        if (other == body || !rigid.may_meet(body, other) || rigid.is_ignored(body, other)) continue;
        const uint32_t i = soft.striker_count[s], before = gathering.count;
        SoftStriker& striker = state.soft_strikers.striker[kMostStrikers * s + i];
        striker = striker_of(state, rigid, body, other, origin);
        gathering.gather(i, striker);
        if (gathering.count > before) ++soft.striker_count[s];
    }
    soft.contact_count[s] = gathering.count;
}

void share_strikers(Tables<const Bodies, const SoftBodies, SoftStrikers> state) {
    const SoftBodies& soft = state.soft_bodies;
    const auto for_each = [&](auto&& f) {
        for (uint32_t s = 0; s < soft.size(); ++s)
            for (uint32_t i = 0; soft.is_used[s] && soft.is_awake[s] && i < soft.striker_count[s]; ++i)
                f(state.soft_strikers.striker[kMostStrikers * s + i]);
    };
    for_each([&](SoftStriker& striker) {
        if (!striker.yields) return;
        uint32_t shares = 0;
        for_each([&](const SoftStriker& other) { shares += other.body == striker.body; });
        const Row<SoftBodies> own = state.bodies.soft[striker.body];
        if (own.exists() && soft.is_awake[own]) ++shares;  // its own run
        striker.shares = shares;
    });
    for_each([&](SoftStriker& striker) {
        striker.inverse_mass *= static_cast<float>(striker.shares);
        striker.inverse_inertia = double(striker.shares) * striker.inverse_inertia;
    });
}

}  // namespace cullet
