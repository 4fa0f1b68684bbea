#include "systems/models/thick_shell/soft/soft_shape.hpp"

#include <algorithm>

#include "components/body_id.hpp"
#include "engine/rigid_bounds.hpp"
#include "systems/models/thick_shell/soft/soft_body.hpp"
#include "systems/models/thick_shell/soft/soft_units.hpp"
#include "systems/models/thick_shell/springs/best_turn.hpp"
#include "systems/models/thick_shell/springs/start_springs.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

constexpr float kLeastTurnCosine = -0.9f;  // a normal that turns farther in one frame is left as it is

struct Frame {
    const SpringView& view;
    SoftRows& state;
    Row<SoftBodies> soft;
    Row<Bodies> body;
    bool is_pinned;

    template <class F>
    void for_each_live(F&& f) const {
        for (uint32_t v = 0; v < view.shell.vertex_count(); ++v)
            if (state.vertices.mass[view.shell.vertex(v)] > 0) f(v, view.shell.vertex(v));
    }
    /// Of a vertex and its twin, which have half of its mass each.
    Vec3d middle(uint32_t v) const {
        const Vec3d outer(view.position(v));
        return view.has_layers() ? 0.5 * (outer + Vec3d(view.twin_position(v))) : outer;
    }
    Vec3d rest_middle(uint32_t v) const {
        const Vec3d outer(state.vertices.rest[view.shell.vertex(v)]);
        return view.has_layers() ? outer + 0.5 * Vec3d(through_at_rest(view, v)) : outer;
    }
};

struct Motions {
    SpringMotion all;
    Vec3d velocity, spin;
    double about = 0;  // J, of motion about the rigid one
};

bool is_sound(const Frame& f) {
    bool sound = true;
    const auto look = [&](Vec3 place, Vec3 velocity) {
        sound = sound && is_within(place, kFarthest) && is_within(velocity, kFastest);
    };
    f.for_each_live([&](uint32_t v, uint32_t row) {
        look(f.view.position(v), f.state.vertices.velocity[row]);
        if (f.view.has_layers()) look(f.view.twin_position(v), f.state.twins.velocity[f.view.twin(v)]);
    });
    for (uint32_t i = 0; i < f.state.soft_bodies.striker_count[f.soft]; ++i) {
        const SoftStriker& striker = f.state.soft_strikers.striker[kMostStrikers * f.soft + i];
        look(striker.centre, striker.velocity);
        look(striker.spin, {});
    }
    return sound;
}

Sym3d inertia_about(const Frame& f, Vec3d centre) {
    Sym3d second;
    f.for_each_live([&](uint32_t v, uint32_t row) {
        const double mass = f.state.vertices.mass[row];
        const auto add = [&](double m, Vec3 place) { second = second + m * outer(Vec3d(place) - centre); };
        if (!f.view.has_layers()) return add(mass, f.view.position(v));
        add(mass / 2, f.view.position(v));
        add(mass / 2, f.view.twin_position(v));
    });
    return inertia_of(second);
}

/// Hundreds of substeps add to floats what gravity gives: together they round by 1e-4 of it. What all points have is
/// known: what they had, gravity's share, and what strikers gave.
void mend_momentum(const Frame& f, Vec3 gravity, float seconds) {
    const SoftBodies& soft = f.state.soft_bodies;
    const SpringMotion now = motion_of(f.view);
    if (f.is_pinned || !(now.mass > 0)) return;
    Vec3d wanted = soft.start_momentum[f.soft] + now.mass * double{seconds} * Vec3d(gravity);
    for (uint32_t i = 0; i < soft.striker_count[f.soft]; ++i)
        wanted += f.state.soft_strikers.striker[kMostStrikers * f.soft + i].impulse;
    const Vec3 missing = ((1 / now.mass) * (wanted - now.momentum)).to_float();
    f.for_each_live([&](uint32_t v, uint32_t row) {
        f.state.vertices.velocity.set(row, f.state.vertices.velocity[row] + missing);
        if (!f.view.has_layers()) return;
        f.state.twins.velocity.set(f.view.twin(v), f.state.twins.velocity[f.view.twin(v)] + missing);
    });
}

/// Momentum stays, angular momentum too: what is taken has neither.
Motions slow_down(const Frame& f, float share) {
    Motions m;
    m.all = motion_of(f.view);
    if (!f.is_pinned && m.all.mass > 0) {
        m.velocity = (1 / m.all.mass) * m.all.momentum;
        m.spin = inverse(inertia_about(f, m.all.centre)) * m.all.angular;
    }
    const auto slow = [&](double mass, Vec3 place, auto& column, uint32_t at) {
        const Vec3d rigid = m.velocity + cross(m.spin, Vec3d(place) - m.all.centre);
        const Vec3d about = double{1 - share} * (Vec3d(column[at]) - rigid);
        m.about += 0.5 * mass * dot(about, about);
        column.set(at, (rigid + about).to_float());
    };
    f.for_each_live([&](uint32_t v, uint32_t row) {
        if (f.state.vertices.is_pinned[row]) return;
        const double mass = f.state.vertices.mass[row];
        slow(f.view.has_layers() ? mass / 2 : mass, f.view.position(v), f.state.vertices.velocity, row);
        if (f.view.has_layers()) slow(mass / 2, f.view.twin_position(v), f.state.twins.velocity, f.view.twin(v));
    });
    return m;
}

/// Where the body frame stands: in the working frame.
Pose fit_pose(const Frame& f) {
    const Bodies& bodies = f.state.bodies;
    const Vec3 origin = f.view.own().origin[f.view.row];
    if (f.is_pinned) return {bodies.position[f.body] - origin, bodies.orientation[f.body]};
    double mass = 0;
    Vec3d rest, now;
    f.for_each_live([&](uint32_t v, uint32_t row) {
        const double m = f.state.vertices.mass[row];
        mass += m;
        rest += m * f.rest_middle(v);
        now += m * f.middle(v);
    });
    if (!(mass > 0)) return {bodies.position[f.body] - origin, bodies.orientation[f.body]};
    rest = (1 / mass) * rest, now = (1 / mass) * now;
    double products[3][3] = {};
    f.for_each_live([&](uint32_t v, uint32_t row) {
        const double m = f.state.vertices.mass[row];
        const Vec3d r = f.rest_middle(v) - rest, x = f.middle(v) - now;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) products[i][j] += m * r[i] * x[j];
    });
    const Quat turn = best_turn(products);
    return {now.to_float() - rotate(turn, rest.to_float()), turn};
}

/// The least turn that takes one unit vector into the other, on a third.
Vec3 turned_between(Vec3 from, Vec3 to, Vec3 v) {
    const float cosine = dot(from, to);
    if (cosine < kLeastTurnCosine) return v;
    const Vec3 axis = cross(from, to);
    return cosine * v + cross(axis, v) + (dot(axis, v) / (1 + cosine)) * axis;
}

/// Area-weighted normal of the ring where place(v) says that vertices stand; zero where the areas cancel.
template <class Place>
Vec3 normal_of(const Frame& f, const Ring& ring, Place&& place) {
    Vec3 sum;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const auto& corner = f.state.elements.corner[f.view.shell.element(ring.element[i])];
        const Vec3 a = place(corner[0]);
        sum += cross(place(corner[1]) - a, place(corner[2]) - a);
    }
    return normalised(sum);
}

// Smooth where it was smooth, creased where it was creased: each vertex turns its corners' normals by one turn, the
// least that takes its mean normal before into the one now.
void take_shape(const Frame& f, const Pose& pose) {
    SoftRows& s = f.state;
    const Quat back = conjugate(pose.orientation);
    const auto in_body = [&](Vec3 p) { return rotate(back, p - pose.position); };
    // Two passes: all rings are looked at before any rest place changes.
    f.for_each_live([&](uint32_t v, uint32_t row) { s.vertices.displacement.set(row, in_body(f.view.position(v))); });
    f.for_each_live([&](uint32_t v, uint32_t row) {
        Ring ring;
        walk_ring(f.view.shell, v, ring);
        const auto row_of = [&](uint32_t n) { return f.view.shell.vertex(n); };
        const Vec3 before = normal_of(f, ring, [&](uint32_t n) { return s.vertices.rest[row_of(n)]; });
        const Vec3 now = normal_of(f, ring, [&](uint32_t n) { return s.vertices.displacement[row_of(n)]; });
        for (uint32_t i = 0; i < ring.count; ++i) {
            auto& normal = s.elements.normal[f.view.shell.element(ring.element[i])];
            float* const n = &normal[3 * size_t{ring.corner[i]}];
            const Vec3 turned = normalised(turned_between(before, now, {n[0], n[1], n[2]}));
            n[0] = turned.x, n[1] = turned.y, n[2] = turned.z;
        }
        Vec3 inward = turned_between(before, now, s.vertices.inward[row]);
        if (f.view.has_layers()) {
            const Vec3 through = rotate(back, f.view.twin_position(v) - f.view.position(v));
            s.twins.through.set(f.view.twin(v), through);
            if (dot(through, through) > 0) inward = through;
        }
        s.vertices.inward.set(row, normalised(inward));
    });
    f.for_each_live([&](uint32_t, uint32_t row) {
        s.vertices.rest.set(row, s.vertices.displacement[row]);
        s.vertices.displacement.set(row, {});
    });
}

/// What is not finite goes out of every row that the run writes, those of lanes that no vertex has included.
void forget_motion(const SpringView& view) {
    ShellRows& s = view.state;
    for (uint32_t v = 0; v < view.pack_count() * kLanes; ++v) {
        view.place(v, {});
        if (!view.has_layers()) continue;
        view.place_twin(v, {});
        s.twins.length[view.twin(v)] = 0;
    }
    for (uint32_t i = 0; i < view.spring_count(); ++i) {
        s.springs.length[view.spring(i)] = 0;
        if (view.has_layers()) s.layer_springs.length[view.layer(i)] = 0;
    }
}

/// The run counts for nothing, for what it met neither; what made it run away would do so again in the next frame, so
/// the body freezes in the shape before, until something wakes it.
void put_back(const Frame& f) {
    SoftBodies& soft = f.state.soft_bodies;
    soft.has_fault[f.soft] = 1;
    soft.striker_count[f.soft] = soft.contact_count[f.soft] = 0;
    soft.quiet_seconds[f.soft] = kQuietSeconds;
    forget_motion(f.view);
    const Bodies& bodies = f.state.bodies;
    start_springs(f.view, {pose_of(bodies, f.body), bodies.velocity[f.body], bodies.spin[f.body]});
}

}  // namespace

void end_soft_frame(SoftRows& state, Row<SoftBodies> s, const Step& step) {
    SoftBodies& soft = state.soft_bodies;
    Bodies& bodies = state.bodies;
    const SpringView view(state, springs_of(state, s));
    const Frame f{view, state, s, soft.body[s], static_cast<BodyKind>(bodies.kind[soft.body[s]]) == BodyKind::Static};
    const float seconds = soft_seconds(soft, s, step.dt);
    soft.awake_seconds[s] += seconds;
    if (!is_sound(f)) return put_back(f);
    mend_momentum(f, step.gravity, seconds);
    const Motions m = slow_down(f, seconds / (seconds + soft.drag_time[s]));
    const Pose pose = fit_pose(f);
    take_shape(f, pose);
    soft.is_moved[s] = 1;
    if (!f.is_pinned) {
        bodies.position.set(f.body, view.own().origin[view.row] + pose.position);
        bodies.orientation[f.body] = pose.orientation;
        bodies.velocity.set(f.body, m.velocity.to_float());
        bodies.spin.set(f.body, m.spin.to_float());
    }
    soft.most_motion[s] = std::max(soft.most_motion[s], m.about);
    const bool is_quiet = m.about < 0.5 * m.all.mass * double{kQuietSpeed * kQuietSpeed};
    soft.quiet_seconds[s] = is_quiet ? soft.quiet_seconds[s] + seconds : 0;
}

}  // namespace cullet
