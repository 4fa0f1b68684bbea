#include "systems/impacts/open_ahead.hpp"

#include <algorithm>
#include <cmath>

#include "components/body_id.hpp"
#include "systems/bodies/thresholds.hpp"
#include "systems/impacts/fragile.hpp"
#include "systems/tasks/cancel_task.hpp"

namespace cullet {
namespace {

constexpr float kBumpShare = 0.5f;         // of a foreseen speed
constexpr uint32_t kStepsToBeginAnew = 3;  // to the touch; a task of a house takes about so many frames

/// A foreseen impact, and the hit that brings it.
struct Foreseen {
    Impact impact;
    const ForeseenHit* hit;
    uint32_t steps() const { return hit->touch.steps; }
};
constexpr uint32_t kMostForeseen = 2 * kMostFlights * kMostForeseenContacts, kMostAtOnce = 64;

/// Rows of bodies in flight as they will be at the touch, while this lives.
class AtTheTouch {
 public:
    explicit AtTheTouch(Bodies& bodies) : bodies_(bodies) {}
    ~AtTheTouch() {
        while (count_ > 0) {
            const Flying& f = flying_[--count_];
            put(f.body, f.pose, f.motion);
        }
    }
    AtTheTouch(const AtTheTouch& other) = delete;
    AtTheTouch& operator=(const AtTheTouch& other) = delete;

    void put(const ForeseenHit& hit) {
        for (uint32_t k = 0; k < count_; ++k)
            if (flying_[k].body == hit.body) return;
        flying_[count_++] = {
            hit.body, pose_of(bodies_, hit.body), {bodies_.velocity[hit.body], bodies_.spin[hit.body]}};
        put(hit.body, hit.touch.pose, hit.touch.motion);
    }

 private:
    struct Flying {
        Row<Bodies> body;
        Pose pose;
        Motion motion;
    };
    void put(Row<Bodies> body, const Pose& pose, const Motion& motion) {
        bodies_.position.set(body, pose.position);
        bodies_.orientation[body] = pose.orientation;
        bodies_.velocity.set(body, motion.velocity);
        bodies_.spin.set(body, motion.angular_velocity);
    }
    Bodies& bodies_;
    std::array<Flying, kMostFlights> flying_;
    uint32_t count_ = 0;
};

uint32_t free_tasks(const Tasks& tasks) {
    uint32_t count = 0;
    for (uint32_t t = 0; t < tasks.size(); ++t) count += static_cast<TaskState>(tasks.state[t]) == TaskState::Free;
    return count;
}

/// A hit that has come already and waits for its turn goes first, unless it is a bump.
bool has_queued_hit(const BodyRows& state, const QueuedHits& queued, Row<Bodies> body) {
    const float bump =
        first_crack_speed(state.structures, state.bodies.structure[body], state.bodies.strength_scale[body]);
    for (uint32_t q = 0; q < queued.size(); ++q)
        if (queued.is_used[q] && queued.body[q] == body && queued.approach_speed[q] >= bump) return true;
    return false;
}

/// Blows on bodies that may have a task for them.
std::span<Foreseen> find_blows(const Opening& opening, std::span<const ForeseenHit> hits,
                               const DamageSettings& settings, std::span<Foreseen> room) {
    auto& state = opening.state;
    const Bodies& bodies = state.bodies;
    uint32_t count = 0;
    for (const ForeseenHit& hit : hits)
        for (uint32_t c = 0; c < hit.touch.contact_count; ++c)
            for (int side = 0; side < 2; ++side) {
                const Impact impact = impact_of(hit.touch.contacts[c], side);
                const Row<Tasks> task(bodies.task[impact.body]);
                const bool has_room = !task.exists() || is_ahead(state.tasks, task);
                const bool is_free = has_room && !bodies.hold_count[impact.body] &&
                                     opening.frame + hit.touch.steps >= bodies.retry_frame[impact.body];
                if (is_free && is_blow(impact, bodies, state.structures, settings)) room[count++] = {impact, &hit};
            }
    return room.first(count);
}

/// Of what is foreseen of one body the blows that come together, those that come first, but for bumps that are not
/// worth to wait for: a body has one task.
std::span<const Foreseen> first_together(const BodyRows& state, std::span<const Foreseen> all) {
    std::span<const Foreseen> chosen;
    for (size_t i = 0, next; i < all.size(); i = next) {
        for (next = i; next < all.size() && all[next].steps() == all[i].steps();) ++next;
        if (chosen.empty() || is_bump(state, chosen.front().impact, all[i].impact.approach_speed))
            chosen = all.subspan(i, next - i);
    }
    return chosen;
}

/// As the contact of a task says, by as much as a touch may differ.
bool is_same(const TaskContacts& contacts, uint32_t c, const Impact& impact) {
    const float speed = contacts.approach_speed[c];
    return contacts.striker[c] == impact.striker && contacts.cell[c] == impact.cell &&
           std::fabs(impact.approach_speed - speed) <= kForeseenShare * speed;
}

/// Whether a task is still for what is foreseen of its body: `all`, of which `together` is what a new task would be
/// for. Whoever is not among them may not have been followed in this frame.
bool still_holds(const Opening& opening, Row<Tasks> task, std::span<const Foreseen> all,
                 std::span<const Foreseen> together) {
    const Tasks& tasks = opening.state.tasks;
    const TaskContacts& contacts = opening.state.task_contacts;
    const uint32_t c = tasks.first_contact[task], end = c + tasks.contact_count[task];
    const auto frame_of = [&](const Foreseen& f) { return opening.frame + f.steps(); };
    // The striker comes otherwise than it was thought.
    const uint64_t due = tasks.due_frame[task];
    bool is_followed = false, is_true = false;
    for (const Foreseen& f : all)
        if (f.impact.striker == contacts.striker[c]) {
            is_followed = true;
            is_true = is_true || (is_same(contacts, c, f.impact) && frame_of(f) + 1 >= due && frame_of(f) <= due + 1);
        }
    if (is_followed && !is_true) return false;
    // Another one comes before it, or with it: faster, or while there is time to begin anew with both.
    const auto comes_now = [&](Row<Bodies> striker) {
        return std::any_of(together.begin(), together.end(),
                           [&](const Foreseen& f) { return f.impact.striker == striker; });
    };
    bool are_together = true;
    for (uint32_t k = c; k < end; ++k) are_together = are_together && comes_now(contacts.striker[k]);
    for (const Foreseen& f : together) {
        const auto is_his = [&](uint32_t k) { return contacts.striker[k] == f.impact.striker; };
        bool is_known = false;
        for (uint32_t k = c; k < end; ++k) is_known = is_known || is_his(k);
        if (is_known) continue;
        if (frame_of(f) < due && !is_bump(opening.state, f.impact, contacts.approach_speed[c])) return false;
        if (frame_of(f) != due) continue;
        if (f.impact.approach_speed > (1 + kForeseenShare) * contacts.approach_speed[c]) return false;
        if (are_together && !f.hit->is_toppling && f.steps() >= kStepsToBeginAnew) return false;
    }
    return true;
}

/// The fastest of them first. What topples comes with others only if it is the fastest: it may come otherwise, and
/// would take their task with it.
void open_one(Opening& opening, std::span<const Foreseen> together) {
    auto& state = opening.state;
    Tasks& tasks = state.tasks;
    const Row<Bodies> body = together.front().impact.body;
    if (const Row<Tasks> task(state.bodies.task[body]); task.exists()) {
        ++opening.counts.ahead_misses;
        cancel_task(opening.models, state, task);
    }
    AtTheTouch then(state.bodies);
    std::array<Impact, kMostAtOnce> impacts;
    uint32_t count = 0;
    for (const Foreseen& f : together) {
        if (count == kMostAtOnce) break;
        if (f.hit->is_toppling && f.hit != together.front().hit) continue;
        then.put(*f.hit);
        impacts[count++] = f.impact;
    }
    const Impact aimed_first = aimed(state, impacts.front());
    const uint64_t due = opening.frame + together.front().steps();
    bool is_nothing = true;
    for (uint32_t k = 0; k < count && is_nothing; ++k) {
        float bounce = 0;
        is_nothing = opening.leaves_nothing(k == 0 ? aimed_first : aimed(state, impacts[k]), due, bounce);
    }
    if (is_nothing) return;
    const Row<Tasks> task = opening.open(body, aimed_first.approach_speed, true);
    if (!task.exists()) return;
    lay_contacts({impacts.data(), count}, aimed_first, state, task);
    tasks.due_frame[task] = tasks.opened_frame[task] = due;
}

}  // namespace

bool is_bump(const BodyRows& state, const Impact& impact, float foreseen) {
    const float scale = state.bodies.strength_scale[impact.body];
    return impact.approach_speed <
           std::min(first_crack_speed(state.structures, state.bodies.structure[impact.body], scale),
                    kBumpShare * foreseen);
}

void open_ahead(Opening& opening, const Events<ForeseenHit>& foreseen, const DamageSettings& settings) {
    if (foreseen.all().empty()) return;  // clearing the room below was a third of a quiet frame
    auto& state = opening.state;
    const Scratch<std::array<Foreseen, kMostForeseen>> room(state.scratch);
    const auto all = find_blows(opening, foreseen.all(), settings, *room);
    std::sort(all.begin(), all.end(), [](const Foreseen& p, const Foreseen& q) {
        if (p.impact.body != q.impact.body) return p.impact.body.index < q.impact.body.index;
        if (p.steps() != q.steps()) return p.steps() < q.steps();
        return comes_first(p.impact, q.impact);
    });
    for (size_t i = 0, next; i < all.size(); i = next) {
        const Row<Bodies> body = all[i].impact.body;
        for (next = i; next < all.size() && all[next].impact.body == body;) ++next;
        if (2 * free_tasks(state.tasks) <= state.tasks.size() || has_queued_hit(state, opening.queued, body)) continue;
        const std::span<const Foreseen> on_body = all.subspan(i, next - i), together = first_together(state, on_body);
        const Row<Tasks> task(state.bodies.task[body]);
        if (!task.exists() || !still_holds(opening, task, on_body, together)) open_one(opening, together);
    }
}

}  // namespace cullet
