#include "systems/damage/open_ahead.hpp"

#include <algorithm>
#include <numeric>

#include "systems/damage/cancel_task.hpp"
#include "systems/damage/fragile.hpp"
#include "systems/rigid/body_id.hpp"

namespace cullet {
namespace {

/// The body's row as it will be at the touch, while this lives.
class AtTheTouch {
 public:
    AtTheTouch(Bodies& bodies, const ForeseenHit& hit)
        : bodies_(bodies),
          body_(hit.body),
          pose_(pose_of(bodies, hit.body)),
          motion_{bodies.velocity[hit.body], bodies.spin[hit.body]} {
        put(hit.touch.pose, hit.touch.motion);
    }
    ~AtTheTouch() { put(pose_, motion_); }
    AtTheTouch(const AtTheTouch&) = delete;
    AtTheTouch& operator=(const AtTheTouch&) = delete;

 private:
    void put(const Pose& pose, const Motion& motion) {
        bodies_.position.set(body_, pose.position);
        bodies_.orientation[body_] = pose.orientation;
        bodies_.velocity.set(body_, motion.velocity);
        bodies_.spin.set(body_, motion.angular_velocity);
    }
    Bodies& bodies_;
    Row<Bodies> body_;
    Pose pose_;
    Motion motion_;
};

uint32_t free_tasks(const Tasks& tasks) {
    uint32_t count = 0;
    for (uint32_t t = 0; t < tasks.size(); ++t) count += static_cast<TaskState>(tasks.state[t]) == TaskState::Free;
    return count;
}

/// A task that this touch will prove wrong: it comes earlier, or at the same time and faster by more than may be. Not
/// of this frame, whose rows are on their way.
bool is_forestalled(const Opening& opening, Row<Tasks> task, uint64_t due, float speed) {
    const Tasks& tasks = opening.state.tasks;
    if (!is_ahead(tasks, task)) return false;
    for (const TaskOpened& now : opening.opened)
        if (now.task == task) return false;
    return due < tasks.due_frame[task] ||
           (due == tasks.due_frame[task] && speed > (1 + kForeseenShare) * tasks.foreseen_speed[task]);
}

/// A hit that has come already and waits for its turn goes first.
bool has_queued_hit(const QueuedHits& queued, Row<Bodies> body) {
    for (uint32_t q = 0; q < queued.size(); ++q)
        if (queued.is_used[q] && queued.body[q] == body) return true;
    return false;
}

// The impacts on one body, the fastest first.
void open_one(Opening& opening, std::span<const Impact> impacts, uint64_t due_frame) {
    State& state = opening.state;
    Tasks& tasks = state.tasks;
    const Row<Bodies> body = impacts.front().body;
    if (2 * free_tasks(tasks) <= tasks.size() || has_queued_hit(state.queued_hits, body)) return;
    if (const Row<Tasks> task(state.bodies.task[body]); task.exists()) {
        ++opening.counts.ahead_misses;
        cancel_task(state, task);
    }
    const Impact first = aimed(state, impacts.front());
    const Row<Tasks> task = opening.open(body, first.approach_speed, true);
    if (!task.exists()) return;
    lay_contacts(impacts, first, state, task);
    tasks.due_frame[task] = tasks.opened_frame[task] = due_frame;
    tasks.foreseen_cell[task] = impacts.front().cell;
    tasks.foreseen_speed[task] = impacts.front().approach_speed;
}

}  // namespace

void open_ahead(Opening& opening, const Events<ForeseenHit>& foreseen, const DamageSettings& settings) {
    State& state = opening.state;
    const Bodies& bodies = state.bodies;
    // A body has one task: for what comes first.
    const auto all = foreseen.all();
    std::array<uint32_t, kMostFlights> order;
    const auto in_order = std::span(order).first(all.size());
    std::iota(in_order.begin(), in_order.end(), 0u);
    std::sort(in_order.begin(), in_order.end(), [&](uint32_t i, uint32_t j) {
        return std::pair(all[i].touch.steps, i) < std::pair(all[j].touch.steps, j);
    });
    for (const uint32_t k : in_order) {
        const ForeseenHit& hit = all[k];
        const uint64_t due = opening.frame + hit.touch.steps;
        const AtTheTouch then(state.bodies, hit);
        std::array<Impact, 2 * kMostForeseenContacts> impacts;
        uint32_t count = 0;
        for (uint32_t c = 0; c < hit.touch.contact_count; ++c) {
            for (int side = 0; side < 2; ++side) {
                const Impact impact = impact_of(hit.touch.contacts[c], side);
                const Row<Tasks> task(bodies.task[impact.body]);
                const bool has_room = !task.exists() || is_forestalled(opening, task, due, impact.approach_speed);
                const bool is_free =
                    has_room && !bodies.hold_count[impact.body] && due >= bodies.retry_frame[impact.body];
                if (is_free && is_blow(impact, bodies, state.shells, settings)) impacts[count++] = impact;
            }
        }
        std::sort(impacts.begin(), impacts.begin() + count, comes_first);
        for (uint32_t i = 0, next; i < count; i = next) {
            next = i + 1;
            while (next < count && impacts[next].body == impacts[i].body) ++next;
            open_one(opening, {impacts.data() + i, next - i}, due);
        }
    }
}

}  // namespace cullet
