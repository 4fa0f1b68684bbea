#include <algorithm>
#include <cmath>

#include "systems/impacts/open_ahead.hpp"
#include "systems/impacts/opening.hpp"
#include "systems/systems.hpp"
#include "systems/tasks/cancel_task.hpp"

namespace cullet {
namespace {

constexpr uint64_t kLateFrames = 1;  // by which it may come later

struct Meeting {
    Step step;
    const WorldRows& state;
    const Blows& blows;
    std::span<Impact> impacts;  // by body

    std::span<Impact> on(Row<Bodies> body) const {
        const auto is_before = [](const Impact& i, Row<Bodies> b) { return i.body.index < b.index; };
        const auto first = std::lower_bound(impacts.begin(), impacts.end(), body, is_before);
        auto end = first;
        while (end != impacts.end() && end->body == body) ++end;
        return {first, end};
    }
    /// Somebody who strikes two bodies at once gives each a share of itself: nobody foresaw that.
    bool is_shared(const Impact& impact) const {
        return std::any_of(impacts.begin(), impacts.end(), [&](const Impact& i) {
            return i.striker == impact.striker && i.body != impact.body &&
                   static_cast<BodyKind>(state.bodies.kind[i.striker]) == BodyKind::Dynamic;
        });
    }
    /// What comes where and as fast as a contact was foreseen, or null.
    const Impact* find(std::span<const Impact> all, uint32_t contact) const {
        const TaskContacts& contacts = state.task_contacts;
        const float speed = contacts.approach_speed[contact];
        for (const Impact& i : all)
            if (i.striker == contacts.striker[contact] && i.cell == contacts.cell[contact])
                return !is_shared(i) && std::fabs(i.approach_speed - speed) <= kForeseenShare * speed ? &i : nullptr;
        return nullptr;
    }
    /// The fastest impact that was foreseen, or null: it is elsewhere or not as fast, or another on the body is faster
    /// by more than that, or another striker that was to come with it does not.
    const Impact* find(uint32_t task) const {
        const TaskContacts& contacts = state.task_contacts;
        const uint32_t first = state.tasks.first_contact[task], end = first + state.tasks.contact_count[task];
        const auto all = on(state.tasks.body[task]);
        if (all.empty() || all.front().approach_speed > (1 + kForeseenShare) * contacts.approach_speed[first])
            return nullptr;
        for (uint32_t c = first + 1; c < end; ++c) {
            const Row<Bodies> striker = contacts.striker[c];
            const auto is_his = [&](uint32_t before) { return contacts.striker[before] == striker; };
            bool is_known = false;
            for (uint32_t before = first; before < c; ++before) is_known = is_known || is_his(before);
            if (!is_known && !find(all, c)) return nullptr;
        }
        return find(all, first);
    }
    bool waits_for_a_blow(Row<Bodies> body) const {
        for (uint32_t b = 0; b < blows.size(); ++b)
            if (blows.body[b] == body && blows.task[b] == kNone) return true;
        return false;
    }
    /// Whatever comes, it is not what was foreseen.
    bool is_off(uint32_t task) const {
        const Row<Bodies> body = state.tasks.body[task];
        return static_cast<TaskState>(state.tasks.state[task]) == TaskState::Dropped || state.bodies.hold_count[body] ||
               waits_for_a_blow(body);
    }
    /// In time, and nothing else hits the body meanwhile but bumps that leave it whole: these wait.
    bool may_still_come(uint32_t task) const {
        const Tasks& tasks = state.tasks;
        const auto all = on(tasks.body[task]);
        if (step.frame > tasks.due_frame[task] + kLateFrames) return false;
        const float speed = state.task_contacts.approach_speed[tasks.first_contact[task]];
        return all.empty() || (is_bump(state, all.front(), speed) && !strikes(task, all));
    }
    bool strikes(uint32_t task, std::span<const Impact> all) const {
        const Row<Bodies> striker = state.task_contacts.striker[state.tasks.first_contact[task]];
        return std::any_of(all.begin(), all.end(), [&](const Impact& i) { return i.striker == striker; });
    }
};

}  // namespace

void meet_foreseen(Serial, Step step, WorldRows& rows, const Blows& blows, DamageLedger ledger, Events<Impact>& impacts,
                   Events<ImpactEvent>& impact_events) {
    const DamageSettings& settings = ledger.settings;
    Tasks& tasks = rows.tasks;
    TaskContacts& contacts = rows.task_contacts;
    const Meeting meeting{step, rows, blows, impacts.all()};
    for (uint32_t t = 0; t < tasks.size(); ++t) {
        if (static_cast<TaskState>(tasks.state[t]) == TaskState::Free || !is_ahead(tasks, t)) continue;
        const bool is_off = meeting.is_off(t);
        if (!is_off && meeting.may_still_come(t)) continue;
        const Impact* const met = is_off ? nullptr : meeting.find(t);
        if (!met) {
            ++ledger.counts.ahead_misses;
            cancel_task(ledger.models, rows, Row<Tasks>(t));
            continue;
        }
        const Impact impact = aimed(rows, *met);
        const uint32_t first = tasks.first_contact[t], end = first + tasks.contact_count[t];
        const ImpactEvent event = event_of(rows.bodies, impact, contacts.striker_inverse_mass[first]);
        const bool is_allowed = !settings.allows || settings.allows(settings.allows_user, event);
        for (Impact& i : meeting.on(tasks.body[t]))
            for (uint32_t c = first; c < end; ++c)
                i.is_settled = i.is_settled || !is_allowed || contacts.striker[c] == i.striker;
        if (!is_allowed) {
            cancel_task(ledger.models, rows, Row<Tasks>(t));
            continue;
        }
        ++ledger.counts.ahead_hits;
        ++ledger.counts.opened;
        impact_events.push(event);
        tasks.due_frame[t] = 0;
        tasks.opened_frame[t] = step.frame;
    }
    const auto all = impacts.all();
    impacts.clear();
    for (const Impact& i : all)
        if (!i.is_settled) impacts.push(i);
}

}  // namespace cullet
