#include <algorithm>
#include <cmath>

#include "systems/bodies/body_id.hpp"
#include "systems/impacts/fragile.hpp"
#include "systems/impacts/opening.hpp"
#include "systems/impacts/overload.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

// More than a body bears, for so long, breaks it: what falls or is struck passes more for a step or two. Between two
// that do not yield no load is borne, and in half of the time a slow press comes a centimetre.
constexpr float kOverloadSeconds = 0.06f, kDrivenSeconds = 0.03f;
// Below this share of the least that could break it nothing is looked at.
constexpr double kLookShare = 0.7;
// The blow that stands for a load: below the first crack the force of a contact goes with the speed, so that
// first_crack_speed times the share passes what presses. Twice that, since pieces come off at up to 2.5 times the speed
// of the first crack, and what presses goes on pressing; half as much more for each run that did not break the body.
constexpr float kBreakingSpeed = 2, kMostShare = 1.5f, kHarder = 1.5f, kMostSpeed = 10;
// After each such run the body is left alone twice as long, but no longer than 64 times.
constexpr uint8_t kMostLoadRuns = 6;

uint32_t steps_in(float seconds, float dt) {
    return std::clamp(static_cast<uint32_t>(std::ceil(seconds / dt)), 2u, 255u);
}

bool yields(const Bodies& bodies, Row<Bodies> b) {
    return b.exists() && static_cast<BodyKind>(bodies.kind[b]) == BodyKind::Dynamic && !bodies.hold_count[b];
}

/// Side `side` of a contact as a load of its body. A solver that has few iterations leaves what is heavy, or driven,
/// closing on the body: stopping it takes its mass times that speed, as long as the body cannot give way.
BodyLoad load_of(const Bodies& bodies, const RigidContact& c, int side, uint32_t contact, float dt) {
    const Impact as = impact_of(c, side);
    const Pose pose = pose_of(bodies, as.body);
    const Quat to_axes = conjugate(pose.orientation);
    const Row<Bodies> other = as.striker;
    BodyLoad l;
    l.contact = contact;
    l.place = Vec3d(to_body(pose, as.point)) - bodies.centre[as.body];
    l.push = Vec3d(rotate(to_axes, as.normal));
    l.stands = !yields(bodies, other);
    const double mass = l.stands ? bodies.mass[as.body] : bodies.mass[other];
    l.force = (c.impulse + mass * std::max(0.0f, c.approach_speed)) / dt;
    l.bears = l.stands ? kBearsAll : l.force;
    if (other.exists() && static_cast<BodyKind>(bodies.kind[other]) == BodyKind::Kinematic) {
        const Vec3 centre = to_world(pose_of(bodies, other), bodies.centre[other].to_float());
        l.driven_speed = dot(bodies.velocity[other] + cross(bodies.spin[other], as.point - centre), as.normal);
    }
    return l;
}

bool touches(const RigidContact& c) {
    return c.impulse > 0 || c.distance <= 0;
}

/// The contacts of a body, as a list through `next`: entry 2 c + side, in the order of contacts.
struct LoadLists {
    Bodies& bodies;
    std::span<const RigidContact> contacts;
    std::span<uint32_t> next;

    LoadLists(Bodies& of, std::span<const RigidContact> all, Arena& arena, const Shells& shells,
              const DamageSettings& settings)
        : bodies(of), contacts(all), next(arena.take<uint32_t>(2 * all.size())) {
        for (uint32_t b = 0; b < bodies.size(); ++b) bodies.first_load[b] = kNone;
        for (size_t c = next.size() / 2; c-- > 0;) {
            if (!touches(contacts[c])) continue;
            for (int side = 1; side >= 0; --side) {
                const Row<Bodies> body(side == 0 ? contacts[c].a : contacts[c].b);
                if (!is_fragile(bodies, shells, settings, body)) continue;
                const auto entry = static_cast<uint32_t>(2 * c) + static_cast<uint32_t>(side);
                next[entry] = bodies.first_load[body];
                bodies.first_load[body] = entry;
            }
        }
    }
    /// The first kMostLoads; how many.
    uint32_t take(Row<Bodies> body, float dt, std::span<BodyLoad, kMostLoads> loads) const {
        uint32_t count = 0;
        for (uint32_t entry = bodies.first_load[body]; entry != kNone && count < kMostLoads; entry = next[entry])
            loads[count++] = load_of(bodies, contacts[entry / 2], static_cast<int>(entry & 1), entry / 2, dt);
        return count;
    }
};

// Whether there is anything to look at.
bool may_be_overloaded(const State& state, Row<Bodies> body, std::span<const BodyLoad> loads) {
    double sum = 0;
    bool is_driven = false;
    for (const BodyLoad& l : loads) sum += l.force, is_driven = is_driven || l.driven_speed > 0;
    return is_driven || sum > kLookShare * std::min(2 * force_borne(state, body), least_bending_force(state, body));
}

float speed_of(const State& state, Row<Bodies> body, const Overload& over) {
    float times =
        kBreakingSpeed * (over.is_driven ? kMostShare : std::clamp(static_cast<float>(over.share), 1.0f, kMostShare));
    for (uint8_t run = 0; run < state.bodies.overload_runs[body]; ++run) times *= kHarder;
    return std::min(times, kMostSpeed) *
           first_crack_speed(state.shells, state.bodies.shell[body], state.bodies.strength_scale[body]);
}

// A striker of twenty masses stands for who presses. Against what is free it stands still: the body comes to it.
QueuedHit hit_of(const State& state, Row<Bodies> body, const RigidContact& c, const Overload& over, uint64_t frame) {
    const Bodies& bodies = state.bodies;
    const Impact as = impact_of(c, body.index == c.a ? 0 : 1);
    const Pose pose = pose_of(bodies, body);
    const bool is_pinned = static_cast<BodyKind>(bodies.kind[body]) != BodyKind::Dynamic;
    QueuedHit hit{frame,
                  body,
                  as.striker,
                  to_body(pose, as.point),
                  rotate(conjugate(pose.orientation), as.normal),
                  speed_of(state, body, over),
                  is_pinned ? static_cast<float>(0.05 / bodies.mass[body]) : 0.0f,
                  as.striker.exists() && bodies.is_sphere[as.striker] ? bodies.radius[as.striker] : 0.0f};
    hit.load = static_cast<float>(std::clamp(over.load, 1e-6, 1e30));
    return hit;
}

}  // namespace

void weigh_loads(Serial, Step step, const RigidWorld& rigid, ShellTables shells, Bodies& bodies, QueuedHits&,
                 const DamageSettings& settings, Arena& arena, Events<RefusedEvent>& refused) {
    State& state = shells.state;
    const auto contacts = rigid.loads();
    const LoadLists lists(bodies, contacts, arena, state.shells, settings);
    BodyLoad room[kMostLoads];
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const Row<Bodies> body(b);
        if (bodies.first_load[b] == kNone || bodies.is_asleep[b] || bodies.hold_count[b] || bodies.task[b] != kNone ||
            !(state.shells.first_crack_force[bodies.shell[b]] > 0) || !(force_borne(state, body) < kBearsAll)) {
            bodies.overloaded_steps[b] = 0;
            continue;
        }
        const std::span<const BodyLoad> loads(room, lists.take(body, step.dt, room));
        const Overload over = may_be_overloaded(state, body, loads) ? overload_of(state, body, loads) : Overload{};
        if (!over.is_driven && !(over.share > 1)) {
            bodies.overloaded_steps[b] = 0;
            if (over.share < 0.5) bodies.overload_runs[b] = 0;
            continue;
        }
        const uint32_t wanted = steps_in(over.is_driven ? kDrivenSeconds : kOverloadSeconds, step.dt)
                                << std::min(bodies.overload_runs[b], kMostLoadRuns);
        if (bodies.overloaded_steps[b] < 255) ++bodies.overloaded_steps[b];
        if (bodies.overloaded_steps[b] < std::min(wanted, 255u)) continue;
        bodies.overloaded_steps[b] = 0;
        const QueuedHit hit = hit_of(state, body, contacts[over.contact], over, step.frame);
        if (settings.allows) {
            const Impact as = impact_of(contacts[over.contact], contacts[over.contact].a == b ? 0 : 1);
            ImpactEvent event = event_of(bodies, as, hit.striker_inverse_mass);
            event.load = hit.load;
            if (!settings.allows(settings.allows_user, event)) continue;
        }
        bodies.overload_runs[b] = std::min<uint8_t>(static_cast<uint8_t>(bodies.overload_runs[b] + 1), kMostLoadRuns);
        if (!queue_hit(state, hit)) refused.push(refused_event(bodies, body, "limits.queued_hits"));
    }
}

}  // namespace cullet
