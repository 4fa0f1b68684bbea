#include <algorithm>

#include "systems/models/thick_shell/soft/soft_lanes.hpp"
#include "systems/models/thick_shell/soft/systems.hpp"
#include "systems/models/thick_shell/springs/spring_view.hpp"

namespace cullet {
namespace {

constexpr float kSlop = 0.0005f;  // m that a vertex may lie in a striker
constexpr float kPushOut = 0.1f;  // m/s at which what lies deeper is put outside, without speed

using MeetingView = SpringsIn<MeetingTables>;

/// One vertex and its inner twin, moved as one.
struct Point {
    const MeetingTables& state;
    const MeetingView& view;
    uint32_t vertex, row, twin;
    int side;
    float inverse_mass;

    Point(const MeetingView& v, uint32_t at, int new_side)
        : state(v.state),
          view(v),
          vertex(at),
          row(v.shell.vertex(at)),
          twin(v.has_layers() ? v.twin(at) : 0),
          side(new_side),
          inverse_mass(v.state.vertices.inverse_mass[row]) {}
    Vec3 place() const {
        const Float4 p = state.vertices.probe.get(row, side);
        return {p.x, p.y, p.z};
    }
    Vec3 velocity() const {
        const Vec3 outer = state.vertices.velocity[row];
        return view.has_layers() ? 0.5f * (outer + state.twins.velocity[twin]) : outer;
    }
    void add(Vec3 velocity_change, Vec3 way) const {
        state.vertices.velocity.set(row, state.vertices.velocity[row] + velocity_change);
        const auto shift = [&](auto& column, uint32_t at) {
            Float4 p = column.get(at, side);
            p.x += way.x, p.y += way.y, p.z += way.z;
            column.set(at, p, side);
        };
        shift(state.vertices.probe, row);
        if (!view.has_layers()) return;
        state.twins.velocity.set(twin, state.twins.velocity[twin] + velocity_change);
        shift(state.twins.position, twin);
    }
};

void move_striker(SoftStriker& s, float dt, Vec3 gravity) {
    if (s.falls) s.velocity += dt * gravity;
    s.centre += dt * s.velocity;
    const Vec3 half = (0.5f * dt) * s.spin;
    s.turn = normalised(Quat{half.x, half.y, half.z, 1} * s.turn);
}

float inverse_mass_along(const SoftStriker& s, Vec3 arm, Vec3 n) {
    if (!s.yields) return 0;
    const Vec3d turning(cross(arm, n));
    return s.inverse_mass + static_cast<float>(dot(turning, s.inverse_inertia * turning));
}

struct Meeting {
    SoftStriker& striker;
    const Point& point;
    Vec3 arm;
    float dt;

    Vec3 relative() const { return point.velocity() - striker.velocity - cross(striker.spin, arm); }
    /// N s on the vertex, and the other way on the striker; both are moved by what it changes in the substep.
    void push(Vec3 impulse) const {
        const Vec3 change = point.inverse_mass * impulse;
        point.add(change, dt * change);
        striker.impulse += Vec3d(impulse);
        striker.is_pushed = true;
        if (!striker.yields) return;
        const Vec3 back = -striker.inverse_mass * impulse;
        striker.velocity += back;
        striker.centre += dt * back;
        striker.spin -= (striker.inverse_inertia * Vec3d(cross(arm, impulse))).to_float();
    }
};

// The vertex stands where the springs took it in this substep. Where that is inside of the striker, an impulse takes
// away what brought it there, at most all of the speed at which the two close: inelastic, so energy falls. Then
// friction (Coulomb), which at most stops the sliding.
void meet(const SoftContact& contact, uint32_t lane, SoftStriker& striker, const Point& point, float dt) {
    const Vec3 place = point.place();
    const float offset = contact.offset[lane];
    Vec3 n;
    float gap;
    if (striker.is_ball) {
        const Vec3 from = place - striker.centre;
        const float distance = length(from);
        if (!(distance > 0)) return;
        n = (1 / distance) * from;
        gap = distance - striker.radius - offset;
    } else {
        n = rotate(striker.turn, {contact.normal[0][lane], contact.normal[1][lane], contact.normal[2][lane]});
        gap = dot(n, place - striker.centre) - contact.distance[lane];
    }
    if (!(gap < 0)) return;
    Meeting meeting{striker, point, place - (gap + offset) * n - striker.centre, dt};
    const float closing = -dot(n, meeting.relative());
    const float both = point.inverse_mass + inverse_mass_along(striker, meeting.arm, n);
    if (closing > 0 && both > 0) {
        const float size = std::min(closing, -gap / dt) / both;
        meeting.push(size * n);
        const Vec3 moving = meeting.relative(), sliding = moving - dot(moving, n) * n;
        const float speed = length(sliding);
        if (speed > 0) {
            const Vec3 along = (1 / speed) * sliding;
            const float yields = point.inverse_mass + inverse_mass_along(striker, meeting.arm, along);
            meeting.push(-std::min(striker.friction * size, speed / yields) * along);
        }
    }
    const float deep = -gap - std::min(closing > 0 ? closing : 0, -gap / dt) * dt - kSlop;
    if (deep > 0 && point.inverse_mass > 0) point.add({}, std::min(deep, kPushOut * dt) * n);
}

}  // namespace

void meet_strikers(Of<SoftBodies> soft_body, Of<ShellSprings> springs, Turn turn, MeetingTables rows,
                   const SoftBodies& soft, SoftStrikers& strikers, SoftContacts& contacts) {
    const uint32_t s = soft_body.row;
    const MeetingView view(rows, springs.row);
    const float dt = view.own().time_step[view.row];
    const Vec3 gravity = view.own().gravity[view.row];
    SoftStriker* const own = strikers.striker.data() + size_t{kMostStrikers} * s;
    for (uint32_t i = 0; i < soft.striker_count[s]; ++i) move_striker(own[i], dt, gravity);
    const int side = static_cast<int>(turn.new_side);
    const Float4* const places = rows.vertices.probe.data(side) + view.shell.vertex(0);
    SoftContact* row = contacts.contact.data() + first_contact_row(view.shell.vertices().first);
    for (SoftContact* const end = row + soft.contact_count[s]; row != end;) {
        SoftStriker& striker = own[row->striker];
        SoftContact* last = row;
        while (last != end && last->striker == row->striker) ++last;
        mark_inside(row, static_cast<uint32_t>(last - row), places,
                    {striker.centre, striker.turn, striker.is_ball, striker.radius});
        for (; row != last; ++row)
            for (uint32_t bits = row->inside; bits != 0; bits &= bits - 1) {
                const auto lane = static_cast<uint32_t>(__builtin_ctz(bits));
                meet(*row, lane, striker, Point(view, row->vertex[lane], side), dt);
            }
    }
}

}  // namespace cullet
