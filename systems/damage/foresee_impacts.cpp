#include <algorithm>

#include "systems/damage/fragile.hpp"
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

    bool is_expected(uint32_t b) const {
        if (bodies.task[b] != kNone) return true;
        for (uint32_t t = 0; t < tasks.size(); ++t) {
            if (static_cast<TaskState>(tasks.state[t]) == TaskState::Free || !is_ahead(tasks, t)) continue;
            for (uint32_t c = tasks.first_contact[t]; c < tasks.first_contact[t] + tasks.contact_count[t]; ++c)
                if (contacts.striker[c] == b) return true;
        }
        return false;
    }
    /// In flight, and fast enough by the time that it may touch something.
    bool is_wanted(uint32_t b, float gained_speed) const {
        if (static_cast<BodyKind>(bodies.kind[b]) != BodyKind::Dynamic || bodies.is_asleep[b] || bodies.hold_count[b])
            return false;
        const float speed = length(bodies.velocity[b]) + length(bodies.spin[b]) * bodies.radius[b] + gained_speed;
        return speed > least_speed && !rigid.is_touched(b) && !is_expected(b);
    }
    void follow(uint32_t b) {
        ForeseenHit hit{Row<Bodies>(b), {}};
        if (rigid.foresee(b, step.dt, frames, hit.touch)) foreseen.push(hit);
    }
};

float least_wake_speed(const Bodies& bodies, const Shells& shells, const DamageSettings& settings) {
    float least = 1e30f;
    for (uint32_t b = 0; b < bodies.size(); ++b)
        if (static_cast<BodyKind>(bodies.kind[b]) != BodyKind::Free && is_fragile(bodies, shells, settings, b))
            least = std::min(least, wake_speed(shells, bodies.shell[b], bodies.strength_scale[b]));
    return least;
}

}  // namespace

// What the game threw comes first; of pieces, which may be hundreds, so many a frame take turns.
void foresee_impacts(Serial, Step step, RigidWorld& rigid, const Bodies& bodies, const Shells& shells,
                     const Tasks& tasks, const TaskContacts& contacts, const DamageSettings& settings,
                     Events<ForeseenHit>& foreseen) {
    foreseen.clear();
    if (settings.frames_ahead == 0) return;
    const float least = least_wake_speed(bodies, shells, settings);
    const float gained = length(step.gravity) * step.dt * static_cast<float>(settings.frames_ahead);
    Flights flights{step, rigid, bodies, tasks, contacts, least, settings.frames_ahead, foreseen};
    uint32_t left = kMostFlights, pieces = 0;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        if (!flights.is_wanted(b, gained)) continue;
        if (bodies.parent[b].exists()) {
            ++pieces;
        } else if (left > 0) {
            --left;
            flights.follow(b);
        }
    }
    if (pieces == 0 || left == 0) return;
    const auto first = static_cast<uint32_t>(step.frame * kMostFlights % pieces);
    uint32_t number = 0;
    for (uint32_t b = 0; b < bodies.size() && number < pieces; ++b) {
        if (!bodies.parent[b].exists() || !flights.is_wanted(b, gained)) continue;
        if ((number++ + pieces - first) % pieces < left) flights.follow(b);
    }
}

}  // namespace cullet
