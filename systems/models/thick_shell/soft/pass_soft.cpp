#include <algorithm>

#include "components/body_id.hpp"
#include "systems/bodies/body_rows.hpp"
#include "systems/models/thick_shell/shared/working_room.hpp"
#include "systems/models/thick_shell/soft/soft_body.hpp"
#include "systems/models/thick_shell/soft/soft_units.hpp"
#include "systems/models/thick_shell/soft/systems.hpp"
#include "systems/models/thick_shell/springs/start_springs.hpp"
#include "systems/structures/shell/draw_shell.hpp"

namespace cullet {
namespace {

/// Calls f(soft row, striker) for each copy that awake bodies met in this frame, by rising row.
template <class F>
void for_each_copy(const SoftBodies& soft, SoftStrikers& strikers, F&& f) {
    for (uint32_t s = 0; s < soft.size(); ++s)
        for (uint32_t i = 0; soft.is_used[s] && soft.is_awake[s] && i < soft.striker_count[s]; ++i)
            f(s, strikers.striker[kMostStrikers * s + i]);
}

/// What all copies of a body have become, beside what it would have become alone.
struct Change {
    Vec3d velocity, spin, way;
    SoftStriker* first = nullptr;
};

Change change_of(const SoftBodies& soft, SoftStrikers& strikers, uint32_t body, const Step& step) {
    Change change;
    for_each_copy(soft, strikers, [&](uint32_t s, SoftStriker& striker) {
        if (striker.body != body || !striker.is_pushed || !striker.yields) return;
        if (!change.first) change.first = &striker;
        const double share = 1.0 / striker.shares, dt = soft_seconds(soft, s, step.dt), n = soft.granted[s];
        const Vec3d gravity = striker.falls ? Vec3d(step.gravity) : Vec3d{};
        const Vec3d start_velocity(striker.start_velocity);
        const Vec3d alone = dt * start_velocity + (0.5 * dt * dt * (n + 1) / n) * gravity;
        change.velocity += share * (Vec3d(striker.velocity) - start_velocity - dt * gravity);
        change.spin += share * (Vec3d(striker.spin) - Vec3d(striker.start_spin));
        change.way += share * (Vec3d(striker.centre) - Vec3d(striker.start) - alone);
    });
    return change;
}

// An awake body that another has met moves on as a rigid one would: all of its points get the change.
void push_points(SoftRows& state, Row<SoftBodies> s, const Change& change) {
    const SpringView view(state, springs_of(state, s));
    const Vec3d centre = motion_of(view).centre;
    const auto push = [&](auto& column, uint32_t row, Vec3 place) {
        column.set(row, (Vec3d(column[row]) + change.velocity + cross(change.spin, Vec3d(place) - centre)).to_float());
    };
    for (uint32_t v = 0; v < view.shell.vertex_count(); ++v) {
        const uint32_t row = view.shell.vertex(v);
        if (!(state.vertices.inverse_mass[row] > 0)) continue;
        push(state.vertices.velocity, row, view.position(v));
        if (view.has_layers()) push(state.twins.velocity, view.twin(v), view.twin_position(v));
    }
    Bodies& bodies = state.bodies;
    const Row<Bodies> body = state.soft_bodies.body[s];
    bodies.velocity.set(body, bodies.velocity[body] + change.velocity.to_float());
    bodies.spin.set(body, bodies.spin[body] + change.spin.to_float());
}

// The rigid solver moves a body by its velocity after the step. What is free is given the velocity that takes it where
// the run took it, and the rest afterwards; what lies on something else gets all of it at once.
void push_striker(SoftRows& state, RigidWorld& rigid, const Change& change, const Step& step) {
    SoftStriker& striker = *change.first;
    const Row<Bodies> body(striker.body);
    const Row<SoftBodies> soft = state.bodies.soft[body];
    if (soft.exists() && state.soft_bodies.is_awake[soft]) return push_points(state, soft, change);
    const Vec3d now = striker.falls ? (1.0 / double{step.dt}) * change.way : change.velocity;
    const Motion motion = rigid.motion(body);
    rigid.wake(body);
    state.bodies.is_asleep[body] = 0;
    rigid.set_motion(
        body, {(Vec3d(motion.velocity) + now).to_float(), (Vec3d(motion.angular_velocity) + change.spin).to_float()});
    striker.later_velocity = (change.velocity - now).to_float();
}

// N s that soft bodies gave to what does not move by forces: floors, and pins.
void book(const BodyRows& state, const SoftBodies& soft, SoftStrikers& strikers, DamageCounts& counts) {
    for_each_copy(soft, strikers, [&](uint32_t s, SoftStriker& striker) {
        const bool is_pinned = static_cast<BodyKind>(state.bodies.kind[soft.body[s]]) == BodyKind::Static;
        if (striker.yields != is_pinned) return;
        const double sign = is_pinned ? 1 : -1;
        for (int k = 0; k < 3; ++k) counts.impulse_to_static[k] += sign * striker.impulse[k];
        if (!striker.yields) counts.work_from_outside += std::max(0.0, dot(striker.impulse, Vec3d(striker.velocity)));
    });
}

void remember_partners(SoftRows& state, uint32_t s) {
    SoftBodies& soft = state.soft_bodies;
    uint32_t count = 0;
    std::array<uint32_t, kMostPartners> partners{};
    for (uint32_t i = 0; i < soft.striker_count[s] && count < kMostPartners; ++i) {
        const SoftStriker& striker = state.soft_strikers.striker[kMostStrikers * s + i];
        if (!striker.is_pushed || static_cast<BodyKind>(state.bodies.kind[striker.body]) == BodyKind::Static) continue;
        partners[count++] = striker.body;
        // What lies in it keeps it awake: hulls bridge the hollow that a load has made.
        if (striker.yields) soft.quiet_seconds[s] = 0;
    }
    soft.partner_count[s] = count;
    soft.partners[s] = partners;
}

/// By another soft body, which asks for its surface.
bool is_met(const SoftBodies& soft, SoftStrikers& strikers, Row<Bodies> body) {
    bool found = false;
    for_each_copy(soft, strikers, [&](uint32_t, const SoftStriker& striker) { found |= striker.body == body; });
    return found;
}

}  // namespace

void pass_soft(Serial, Step step, SoftRows& rows, RigidWorld& rigid, DamageCounts& counts, Arena& arena,
               Events<FaultEvent>& faults) {
    book(rows, rows.soft_bodies, rows.soft_strikers, counts);
    for_each_copy(rows.soft_bodies, rows.soft_strikers, [&](uint32_t, SoftStriker& striker) {
        if (!striker.is_pushed || !striker.yields) return;
        const Change change = change_of(rows.soft_bodies, rows.soft_strikers, striker.body, step);
        if (change.first == &striker) push_striker(rows, rigid, change, step);
    });
    for (uint32_t s = 0; s < rows.soft_bodies.size(); ++s) {
        if (!rows.soft_bodies.is_used[s] || !rows.soft_bodies.is_awake[s]) continue;
        const Row<Bodies> body = rows.soft_bodies.body[s];
        remember_partners(rows, s);
        if (is_met(rows.soft_bodies, rows.soft_strikers, body)) reshape_soft(rows, rigid, Row<SoftBodies>(s), arena);
        if (static_cast<BodyKind>(rows.bodies.kind[body]) == BodyKind::Dynamic) {
            rigid.set_pose(body, pose_of(rows.bodies, body));
            rigid.set_motion(body, {rows.bodies.velocity[body], rows.bodies.spin[body]});
        }
        if (rows.soft_bodies.has_fault[s])
            faults.push({body_id(rows.bodies, body), rows.bodies.user_data[body], centre_of(rows.bodies, body),
                         "Springs of a rows.soft_bodies body ran away; it goes on from the shape before."});
    }
}

void return_soft(Serial, const SoftBodies& soft, const SoftStrikers& strikers, RigidWorld& rigid) {
    for (uint32_t s = 0; s < soft.size(); ++s)
        for (uint32_t i = 0; soft.is_used[s] && soft.is_awake[s] && i < soft.striker_count[s]; ++i) {
            const SoftStriker& striker = strikers.striker[kMostStrikers * s + i];
            if (dot(striker.later_velocity, striker.later_velocity) <= 0) continue;
            const Motion motion = rigid.motion(striker.body);
            rigid.set_motion(striker.body, {motion.velocity + striker.later_velocity, motion.angular_velocity});
        }
}

// Cracks have faces of their own, which need room, and so do splits: what found none is named in each such frame. What
// broke in this step is drawn already.
void show_soft(Serial, SoftRows& rows, Events<DrawnChanged>& changed, Events<RefusedEvent>& refused) {
    for (uint32_t s = 0; s < rows.soft_bodies.size(); ++s) {
        if (!rows.soft_bodies.is_used[s] || !rows.soft_bodies.is_awake[s]) continue;
        const Row<Bodies> body = rows.soft_bodies.body[s];
        if (rows.soft_bodies.lacks_room[s]) refused.push(refused_event(rows.bodies, body, kCrackRoom));
        const auto is_own = [&](const DrawnChanged& c) { return c.body == body; };
        if (std::any_of(changed.begin(), changed.end(), is_own)) continue;
        const Row<Structures> structure = rows.bodies.structure[body];
        if (rows.structures.has_cracks[structure] &&
            !take_view_rows(rows, body, most_view_rows(ShellView(rows, structure))))
            refused.push(refused_event(rows.bodies, body, "limits.view_vertices"));
        else
            changed.push({body});
    }
}

}  // namespace cullet
