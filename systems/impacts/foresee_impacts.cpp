#include <algorithm>
#include <cmath>

#include "components/body_id.hpp"
#include "systems/impacts/fragile.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

struct Flights {
    Step step;
    RigidWorld& rigid;
    const Bodies& bodies;
    const Tasks& tasks;
    const TaskContacts& contacts;
    float least_speed;  // that may break anything, m/s
    uint32_t frames;
    Events<ForeseenHit>& foreseen;

    /// A task of its own or of somebody else's is open for its touch.
    bool is_expected(uint32_t b) const {
        if (bodies.task[b] != kNone) return true;
        for (uint32_t t = 0; t < tasks.size(); ++t) {
            if (static_cast<TaskState>(tasks.state[t]) == TaskState::Free || !is_ahead(tasks, t)) continue;
            for (uint32_t c = tasks.first_contact[t]; c < tasks.first_contact[t] + tasks.contact_count[t]; ++c)
                if (contacts.striker[c] == b) return true;
        }
        return false;
    }
    /// Free to move, and fast enough by the time that it may touch something.
    bool is_wanted(uint32_t b, float gained_speed) const {
        if (static_cast<BodyKind>(bodies.kind[b]) != BodyKind::Dynamic || bodies.is_asleep[b] || bodies.hold_count[b])
            return false;
        if (const uint32_t task = bodies.task[b]; task != kNone && !is_ahead(tasks, task)) return false;
        const float speed = length(bodies.velocity[b]) + length(bodies.spin[b]) * bodies.radius[b] + gained_speed;
        return speed > least_speed;
    }
    void follow(uint32_t b) {
        ForeseenHit hit{Row<Bodies>(b), rigid.is_held_up(b), {}};
        if (rigid.foresee(b, step.dt, frames, hit.touch)) foreseen.push(hit);
    }
};

float least_wake_speed(const Bodies& bodies, const Structures& structures, const DamageSettings& settings) {
    float least = 1e30f;
    for (uint32_t b = 0; b < bodies.size(); ++b)
        if (static_cast<BodyKind>(bodies.kind[b]) != BodyKind::Free && is_fragile(bodies, structures, settings, b))
            least = std::min(least, wake_speed(structures, bodies.structure[b], bodies.strength_scale[b]));
    return least;
}

}  // namespace

namespace {

struct Reach {
    Vec3 low, high;
    bool meets(const Reach& o) const {
        return low.x <= o.high.x && o.low.x <= high.x && low.y <= o.high.y && o.low.y <= high.y && low.z <= o.high.z &&
               o.low.z <= high.z;
    }
};

/// Where a whole body that may break stands.
Reach reach_of_whole(const Bodies& bodies, uint32_t b) {
    const auto& box = bodies.drawn_box[b];
    const Pose pose = pose_of(bodies, Row<Bodies>(b));
    const Vec3 centre = to_world(pose, 0.5f * Vec3{box[0] + box[3], box[1] + box[4], box[2] + box[5]});
    const Vec3 half = 0.5f * Vec3{box[3] - box[0], box[4] - box[1], box[5] - box[2]};
    const Vec3 x = rotate(pose.orientation, Vec3{half.x, 0, 0}), y = rotate(pose.orientation, Vec3{0, half.y, 0}),
               z = rotate(pose.orientation, Vec3{0, 0, half.z});
    const Vec3 wide{std::fabs(x.x) + std::fabs(y.x) + std::fabs(z.x), std::fabs(x.y) + std::fabs(y.y) + std::fabs(z.y),
                    std::fabs(x.z) + std::fabs(y.z) + std::fabs(z.z)};
    return {centre - wide, centre + wide};
}

/// Where a body in flight may be within `seconds`: start, end and top of its parabola are in the box of both ends and
/// of the way without gravity.
Reach reach_of_flight(const Bodies& bodies, uint32_t b, Vec3 gravity, float seconds) {
    const Vec3 from = to_world(pose_of(bodies, Row<Bodies>(b)), bodies.centre[b].to_float());
    const Vec3 straight = from + seconds * bodies.velocity[b], to = straight + (0.5f * seconds * seconds) * gravity;
    const float radius = bodies.radius[b];
    const Vec3 wide{radius, radius, radius};
    return {Vec3{std::min({from.x, straight.x, to.x}), std::min({from.y, straight.y, to.y}),
                 std::min({from.z, straight.z, to.z})} -
                wide,
            Vec3{std::max({from.x, straight.x, to.x}), std::max({from.y, straight.y, to.y}),
                 std::max({from.z, straight.z, to.z})} +
                wide};
}

/// Bodies that were never broken, of those that may be.
std::span<const Reach> find_whole(const Bodies& bodies, const Structures& structures, const Tasks& tasks,
                                  const DamageSettings& settings, Arena& arena) {
    const auto is_whole = [&](uint32_t b) {
        return static_cast<BodyKind>(bodies.kind[b]) != BodyKind::Free && !bodies.parent[b].exists() &&
               (bodies.task[b] == kNone || is_ahead(tasks, bodies.task[b])) &&
               is_fragile(bodies, structures, settings, b);
    };
    uint32_t count = 0;
    for (uint32_t b = 0; b < bodies.size(); ++b) count += is_whole(b);
    const auto whole = arena.take<Reach>(count);
    if (whole.empty()) return whole;
    count = 0;
    for (uint32_t b = 0; b < bodies.size(); ++b)
        if (is_whole(b)) whole[count++] = reach_of_whole(bodies, b);
    return whole;
}

}  // namespace

// What the game threw comes first, then pieces that may reach what is whole still, also those of a shower that touch
// each other; of the other pieces, which may be hundreds, so many a frame take turns. What is held up and topples has
// flights of its own. All that may reach something whole is followed again while a task waits for its touch: others
// may have pushed it meanwhile.
void foresee_impacts(Serial, Step step, RigidWorld& rigid, const Bodies& bodies, const Structures& structures,
                     RunsNow runs, const DamageSettings& settings, Arena& arena, Events<ForeseenHit>& foreseen) {
    foreseen.clear();
    if (settings.frames_ahead == 0) return;
    const float least = least_wake_speed(bodies, structures, settings);
    const float seconds = step.dt * static_cast<float>(settings.frames_ahead), gained = length(step.gravity) * seconds;
    Flights flights{step, rigid, bodies, runs.tasks, runs.contacts, least, settings.frames_ahead, foreseen};
    const auto whole = find_whole(bodies, structures, runs.tasks, settings, arena);
    const auto is_near_whole = [&](uint32_t b) {
        const Reach reach = reach_of_flight(bodies, b, step.gravity, seconds);
        return std::any_of(whole.begin(), whole.end(), [&](const Reach& r) { return r.meets(reach); });
    };
    // In the order of rows: the pieces that are near something whole from the front, others from the back.
    const auto pieces = arena.take<uint32_t>(bodies.size()), toppling = arena.take<uint32_t>(bodies.size());
    if (pieces.size() + toppling.size() < 2 * size_t{bodies.size()}) return;
    uint32_t left = kMostFlights - kMostToppling, near = 0, others = 0, topplers = 0;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const bool is_held_up = rigid.is_held_up(b);
        if (!flights.is_wanted(b, is_held_up ? 0 : gained)) continue;
        if (is_held_up) {
            if (is_near_whole(b)) toppling[topplers++] = b;
        } else if (!bodies.parent[b].exists()) {
            if (left == 0) continue;
            --left;
            flights.follow(b);
        } else if (is_near_whole(b)) {
            pieces[near++] = b;
        } else if (!rigid.is_touched(b) && !flights.is_expected(b)) {
            pieces[pieces.size() - ++others] = b;
        }
    }
    const auto take_turns = [&](std::span<const uint32_t> of) {
        const auto count = static_cast<uint32_t>(of.size()), turns = std::min(left, count);
        for (uint32_t k = 0; k < turns; ++k) flights.follow(of[(step.frame * left + k) % count]);
        left -= turns;
    };
    take_turns(pieces.first(near));
    take_turns(pieces.last(others));
    left = kMostToppling;
    take_turns(toppling.first(topplers));
}

}  // namespace cullet
