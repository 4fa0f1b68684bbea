#include <algorithm>

#include "components/body_id.hpp"
#include "systems/bodies/rigid_shape.hpp"
#include "systems/bodies/settled_pose.hpp"
#include "systems/models/thick_shell/soft/soft_body.hpp"
#include "systems/models/thick_shell/springs/start_springs.hpp"
#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/structures/shell/mass_properties.hpp"

namespace cullet {
namespace {

RigidMotion motion_of_body(const Bodies& bodies, Row<Bodies> body) {
    return {pose_of(bodies, body), bodies.velocity[body], bodies.spin[body]};
}

// All cells anew: every one has another shape. Elements of pieces that left are dead, so they are linked as in a break.
void choose_hulls(ShellRows& state, Row<Structures> row) {
    const ShellView shell(state, row);
    const Range cells = state.structures.cells[row];
    for (uint32_t c = cells.first; c < cells.first + cells.count; ++c) state.cells.is_changed[c] = 1;
    copy_rest_hulls(shell, state.structures.points[row], shell);
    for (uint32_t c = 0; c < cells.count; ++c) {
        choose_hull(shell, c);
        state.cells.shape[cells.first + c] = kNone;
    }
    pack_hulls(shell);
}

}  // namespace

void wake_soft(SoftRows& state, RigidWorld& rigid, Row<SoftBodies> s) {
    SoftBodies& soft = state.soft_bodies;
    const Row<Bodies> body = soft.body[s];
    const SpringView view(state, springs_of(state, s));
    start_springs(view, motion_of_body(state.bodies, body));
    state.bodies.is_asleep[body] = 0;
    rigid.set_soft(body, true);
    soft.is_awake[s] = 1;
    soft.is_called[s] = 0;
    soft.quiet_seconds[s] = soft.awake_seconds[s] = 0;
    soft.most_motion[s] = 0;
    soft.partner_count[s] = 0;
}

void reshape_soft(SoftRows& state, RigidWorld& rigid, Row<SoftBodies> s, Arena& arena) {
    Bodies& bodies = state.bodies;
    const Row<Bodies> body = state.soft_bodies.body[s];
    const Row<Structures> row = bodies.structure[body];
    measure_shell(ShellView(state, row));
    choose_hulls(state, row);
    take_mass_properties(state.bodies, state.structures, body,
                         radius_of(ShellView(state, state.bodies.structure[body])));
    rigid.set_shape(body, bodies.mass[body], bodies.centre[body], bodies.inertia[body],
                    convex_pieces(state, row, arena));
}

void freeze_soft(SoftRows& state, RigidWorld& rigid, Row<SoftBodies> s, Arena& arena) {
    SoftBodies& soft = state.soft_bodies;
    Bodies& bodies = state.bodies;
    const Row<Bodies> body = soft.body[s];
    const SpringView view(state, springs_of(state, s));
    for (uint32_t v = 0; v < view.shell.vertex_count(); ++v) {
        state.vertices.velocity.set(view.shell.vertex(v), {});
        if (view.has_layers()) state.twins.velocity.set(view.twin(v), {});
    }
    reshape_soft(state, rigid, s, arena);
    rigid.set_soft(body, false);
    if (static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Dynamic) {
        rigid.set_pose(body, pose_of(bodies, body));
        take_settled_pose(bodies, rigid, body);
        rigid.set_motion(body, {bodies.velocity[body], bodies.spin[body]});
    }
    soft.is_awake[s] = 0;
    soft.quiet_seconds[s] = 0;
}

// A blow takes some milliseconds, in which the sheet round it comes along; given at once to what lies under a heavy
// striker it is kilometres a second for vertices of some grams.
void push_soft(SoftRows& state, RigidWorld& rigid, Row<SoftBodies> s, Vec3 point, Vec3 impulse, float radius,
               float fastest) {
    constexpr int kMostDoublings = 16;
    if (!state.soft_bodies.is_awake[s]) wake_soft(state, rigid, s);
    state.soft_bodies.quiet_seconds[s] = 0;
    const SpringView view(state, springs_of(state, s));
    const Vec3 along = rotate(state.bodies.orientation[state.soft_bodies.body[s]], impulse);
    const auto weight = [&](uint32_t row) {
        if (!(state.vertices.inverse_mass[row] > 0)) return 0.0;
        const Vec3 away = state.vertices.rest[row] - point;
        const float left = 1 - dot(away, away) / (radius * radius);
        return left > 0 ? state.vertices.mass[row] * double{left} : 0;
    };
    const auto sum_weights = [&] {
        double sum = 0;
        for (uint32_t v = 0; v < view.shell.vertex_count(); ++v) sum += weight(view.shell.vertex(v));
        return sum;
    };
    const double wanted = double{length(along)} / double{fastest};
    double sum = sum_weights();
    for (int k = 0; k < kMostDoublings && sum < wanted; ++k) radius *= 2, sum = sum_weights();
    sum = std::max(sum, wanted);
    for (uint32_t v = 0; v < view.shell.vertex_count(); ++v) {
        const uint32_t row = view.shell.vertex(v);
        const double own = weight(row);
        if (!(own > 0)) continue;
        const Vec3 gained = static_cast<float>(own / sum * double{state.vertices.inverse_mass[row]}) * along;
        state.vertices.velocity.set(row, state.vertices.velocity[row] + gained);
        if (view.has_layers()) state.twins.velocity.set(view.twin(v), state.twins.velocity[view.twin(v)] + gained);
    }
}

void follow_body(SoftRows& state, Row<Bodies> body) {
    const Row<SoftBodies> s = state.bodies.soft[body];
    if (!s.exists() || !state.soft_bodies.is_awake[s]) return;
    state.soft_bodies.quiet_seconds[s] = 0;
    start_springs(SpringView(state, springs_of(state, s)), motion_of_body(state.bodies, body));
}

}  // namespace cullet
