#include <algorithm>

#include "systems/damage/assemble.hpp"
#include "systems/damage/task_cost.hpp"
#include "systems/damage/working_room.hpp"
#include "systems/rigid/body_id.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

// Inverse of the mass that a body sets against a push along the unit normal at a world point: 1/m + (r x n) . I^-1 (r x
// n). Static and kinematic bodies, and bodies held by another task, do not yield.
float effective_inverse_mass(const Bodies& bodies, Row<Bodies> striker, Vec3 point, Vec3 normal) {
    if (!striker.exists() || static_cast<BodyKind>(bodies.kind[striker]) != BodyKind::Dynamic) return 0;
    if (bodies.hold_count[striker]) return 0;
    const Vec3d n(rotate(conjugate(bodies.orientation[striker]), normal));
    const Vec3d arm = Vec3d(to_body(pose_of(bodies, striker), point)) - bodies.centre[striker];
    const Vec3d turn = cross(arm, n);
    return static_cast<float>(1.0 / bodies.mass[striker] + dot(turn, inverse(bodies.inertia[striker]) * turn));
}

Vec3 velocity_at(const Bodies& bodies, Row<Bodies> b, Vec3 point) {
    if (!b.exists()) return {};
    const Vec3 centre = to_world(pose_of(bodies, b), bodies.centre[b].to_float());
    return bodies.velocity[b] + cross(bodies.spin[b], point - centre);
}

ImpactEvent event_of(const Bodies& bodies, const Impact& impact, double inverse_mass) {
    ImpactEvent e;
    e.body = body_id(bodies, impact.body);
    e.striker = body_id(bodies, impact.striker);
    e.body_user_data = bodies.user_data[impact.body];
    e.striker_user_data = impact.striker.exists() ? bodies.user_data[impact.striker] : 0;
    e.place = impact.point;
    e.normal = impact.normal;
    e.approach_speed = impact.approach_speed;
    const double speed = impact.approach_speed;
    e.energy = 0.5 * speed * speed / (inverse_mass + 1.0 / bodies.mass[impact.body]);
    return e;
}

// Contacts of one body, fastest first: those within a patch radius of one already taken belong to its patch (6.3).
void lay_contacts(std::span<const Impact> impacts, const Bodies& bodies, const Shells& shells, Tasks& tasks,
                  TaskContacts& contacts, Row<Tasks> task) {
    const Row<Bodies> body = tasks.body[task];
    const Row<Shells> shell = tasks.source[task];
    const Pose pose = pose_of(bodies, body);
    uint32_t count = 0;
    for (const Impact& impact : impacts) {
        if (count == kMostContacts) break;
        const Vec3 point = to_body(pose, impact.point);
        const float striker_radius =
            impact.striker.exists() && bodies.is_sphere[impact.striker] ? bodies.radius[impact.striker] : 0.0f;
        const float radius =
            std::max({3 * shells.thickness[shell], 1.3f * shells.mean_edge[shell], 0.35f * striker_radius});
        const uint32_t first = tasks.first_contact[task];
        const auto is_taken = [&](uint32_t c) { return length(contacts.point[c] - point) < radius; };
        bool joins = false;
        for (uint32_t c = first; c < first + count; ++c) joins = joins || is_taken(c);
        if (joins) continue;
        const uint32_t c = first + count++;
        contacts.clear_rows(c, 1);
        contacts.point.set(c, point);
        contacts.normal.set(c, rotate(conjugate(pose.orientation), impact.normal));
        contacts.striker[c] = impact.striker;
        contacts.striker_inverse_mass[c] = effective_inverse_mass(bodies, impact.striker, impact.point, impact.normal);
        contacts.striker_radius[c] = striker_radius;
        contacts.start_speed[c] = dot(velocity_at(bodies, impact.striker, impact.point), impact.normal);
        contacts.radius[c] = radius;
    }
    tasks.contact_count[task] = count;
}

}  // namespace

void open_tasks(Serial, Step step, const Events<Impact>& impacts, ShellTables shells, const Materials& materials,
                Bodies& bodies, Tasks& tasks, TaskContacts& contacts, const DamageSettings& settings,
                DamageCounts& counts, Events<TaskOpened>& opened, Events<ImpactEvent>& impact_events,
                Events<RefusedEvent>& refused) {
    State& state = shells.state;
    opened.clear();
    const auto all = impacts.all();
    for (size_t i = 0, next; i < all.size(); i = next) {
        next = i + 1;
        while (next < all.size() && all[next].body == all[i].body) ++next;
        const Row<Bodies> body = all[i].body;
        const ImpactEvent event =
            event_of(bodies, all[i], effective_inverse_mass(bodies, all[i].striker, all[i].point, all[i].normal));
        if (settings.allows && !settings.allows(settings.allows_user, event)) continue;
        uint32_t t = 0;
        while (t < tasks.size() && static_cast<TaskState>(tasks.state[t]) != TaskState::Free) ++t;
        if (t == tasks.size()) {
            refused.push({body_id(bodies, body), "limits.open_hits"});
            continue;
        }
        const char* full = nullptr;
        const Row<Shells> source = bodies.shell[body];
        const Row<Shells> working = make_shell(state, working_room(ShellView(state, source)), &full);
        if (!working.exists()) {
            refused.push({body_id(bodies, body), full});
            continue;
        }
        const Row<Tasks> task(t);
        tasks.clear_rows(t, 1);
        tasks.state[t] = static_cast<uint8_t>(TaskState::Running);
        tasks.body[t] = body;
        tasks.source[t] = source;
        ++state.shells.users[source];
        tasks.shell[t] = working;
        tasks.opened_frame[t] = step.frame;
        tasks.first_contact[t] = t * kMostContacts;
        tasks.approach_speed[t] = all[i].approach_speed;
        const Quat to_body_axes = conjugate(bodies.orientation[body]);
        tasks.start_velocity.set(t, rotate(to_body_axes, bodies.velocity[body]));
        tasks.start_spin.set(t, rotate(to_body_axes, bodies.spin[body]));
        tasks.strength_scale[t] = bodies.strength_scale[body];
        set_task_times(state, materials, task);
        lay_contacts(all.subspan(i, next - i), bodies, state.shells, tasks, contacts, task);
        tasks.units_owed[t] = state.shells.vertices[source].count * kUnitsOpen;
        bodies.task[body] = t;
        opened.push({task});
        impact_events.push(event);
        ++counts.opened;
    }
}

}  // namespace cullet
