#include <algorithm>
#include <cmath>

#include "components/body_id.hpp"
#include "systems/bodies/blows.hpp"
#include "systems/impacts/bending.hpp"
#include "systems/impacts/between_two.hpp"
#include "systems/impacts/fragile.hpp"
#include "systems/impacts/load_lists.hpp"
#include "systems/impacts/opening.hpp"
#include "systems/impacts/overload.hpp"
#include "systems/models.hpp"
#include "systems/systems.hpp"
#include "systems/tasks/cancel_task.hpp"

namespace cullet {
namespace {

// More than a body bears, for so long, breaks it: what falls or is struck passes more for a step or two. Between two
// that do not yield no load is borne, and in half of the time a slow press comes a centimetre.
// What is crushed by so many times what it bears hardly slows what falls on it, which comes 2 cm in the first of them.
constexpr float kOverloadSeconds = 0.06f, kDrivenSeconds = 0.03f, kCrushedSeconds = 0.045f;
constexpr double kCrushed = 4;
// Below this share of the least that could break it nothing is looked at, and below the second no sleeper is woken.
constexpr double kLookShare = 0.7, kLaidOn = 0.25;
// Each time that a load wakes it, it takes twice as much to wake it again, from this share of the load on: what rocks
// on it would keep both awake for ever. When all that lies on it sleeps the count begins anew. Its own weight wakes it
// once.
constexpr double kFirstWaking = 1.0 / 256, kOwnWaking = 1.25;
// Each time so much is over half of it is enough again, so that no load goes unseen for longer than twice that.
constexpr float kForgettingSeconds = 10;
// The blow that stands for a load: below the first crack the force of a contact goes with the speed, so that
// first_crack_speed times the share passes what presses. Twice that, since pieces come off at up to 2.5 times the speed
// of the first crack, and what presses goes on pressing; half as much more for a second run.
constexpr float kBreakingSpeed = 2, kMostShare = 1.5f, kHarder = 1.5f;
// What no such blow breaks snaps. A bar that bears tonnes in its middle takes blows of 100 m/s, which bore holes; what
// drives does not wait for a second run, nor for a first one while it comes so far, as a share of the size.
constexpr float kFastestRun = 15, kDeepest = 0.05f, kWithCracks = 1.6f;
// What lies deeper in it than these shares of its size and of its wall has crushed it, whatever the solver says.
// What is filled has no wall.
constexpr float kSunkInAll = 0.03f, kSunkInWall = 0.5f;
constexpr uint8_t kMostRuns = 2, kMostDrivenRuns = 1;
// A piece that is still whole after so many cuts cannot be cut.
constexpr uint8_t kMostCuts = 2;
// Of fewer elements a blow knocks out a corner, and what is left may have too few to break again.
constexpr uint32_t kFewestForARun = 200;
// A dent is laid once two would lie so deep in the sheet, as a share of its size, after the next step.
constexpr double kPressedDeep = 0.004;
constexpr float kPressedSpeed = 1e-3f;  // m/s: what has none is a snap
// After each such run the body is left alone twice as long, but no longer than 64 times; what is crushed 4 times.
constexpr uint8_t kMostLoadRuns = 6, kMostCrushedRuns = 2;

// Steps are counted once a sixtieth of a second and no more often, so that what is counted fits into a byte.
constexpr float kLeastCounted = 1.0f / 60;
// In place of a number of steps: it slept until something was laid on it.
constexpr uint8_t kWasWoken = 255;

uint32_t counts_in(float seconds, float dt) {
    return std::clamp(static_cast<uint32_t>(std::ceil(seconds / std::max(dt, kLeastCounted))), 2u, kWasWoken - 1u);
}
// A period of so many seconds ends with this step.
bool is_period_over(Step step, float seconds) {
    const double of_one = double{step.dt} / double{seconds}, frame = static_cast<double>(step.frame);
    return std::floor(frame * of_one) < std::floor((frame + 1) * of_one);
}
bool is_counted(Step step) {
    return step.dt > 0.99f * kLeastCounted || is_period_over(step, kLeastCounted);
}

bool is_deep(const Bodies& bodies, Row<Bodies> body, double way) {
    return way > kDeepest * 2 * bodies.radius[body];
}
bool is_sunk(const LoadedBody& of, double deep) {
    return deep > kSunkInAll * 2 * of.bodies.radius[of.body] && (of.is_filled() || deep > kSunkInWall * of.wall());
}

// Whether there is anything to look at.
double least_load(const LoadedBody& of) {
    return std::min(2 * force_borne(of), least_bending_force(of));
}
bool is_any_driven(std::span<const BodyLoad> loads) {
    return std::any_of(loads.begin(), loads.end(), [](const BodyLoad& l) { return l.driven_speed > 0; });
}
bool is_pressed(const LoadedBody& of, std::span<const BodyLoad> loads) {
    return is_any_driven(loads) || is_sunk(of, sunk_into(of, loads));
}
bool may_be_overloaded(const LoadedBody& of, std::span<const BodyLoad> loads) {
    return sum_of(loads) > kLookShare * least_load(of) || is_pressed(of, loads);
}

// It may break, and is not held.
bool may_be_loaded(const LoadedBody& of, const DamageSettings& settings) {
    return of.structure().exists() && of.bodies.is_breakable[of.body] && of.bears_loads() &&
           may_be_crushed(of.structures, of.structure(), settings) && !of.bodies.hold_count[of.body] &&
           of.structures.first_crack_force[of.structure()] > 0 && force_borne(of) < kBearsAll;
}

// It has broken too often for a blow. It still gives way to what does not yield: a door does not stop for it. Nothing
// else wakes it, for what lies in a heap would be woken to bear what it may not break by.
bool is_past_blows(const LoadedBody& of, const DamageSettings& settings) {
    return !may_break_again(of.structures, of.structure(), settings);
}

// What is not worth breaking gives way to what the game moves alone. In a heap that comes down shards lie half a wall
// deep below slabs for a while, or between two stumps, and were ground by the dozen.
bool is_small(const LoadedBody& of, const DamageSettings& settings) {
    return !may_snap_again(of.structures, of.structure(), settings);
}
bool may_be_pressed(const LoadedBody& of, const LoadLists& lists, bool is_any_driven) {
    return is_any_driven || is_sunk(of, 2 * lists.deepest(of.body));
}

// What comes apart no further.
bool is_at_its_end(const LoadedBody& of, const DamageSettings& settings) {
    return is_small(of, settings) &&
           (!may_be_halved(of.structures, of.structure(), settings) || of.bodies.overload_runs[of.body] >= kMostCuts);
}

// What is laid on a sleeper little by little is not to find it asleep for ever: its supports tell their loads only
// awake.
bool is_to_wake(const LoadedBody& of, double load) {
    return load > double{of.bodies.waking_load[of.body]} && load > kLaidOn * least_load(of);
}

// The share of a load from which on it wakes again. Its own weight wakes it once, to see whether it bears itself: thin
// panes that lay flat were woken by theirs ten times.
double first_waking(const LoadedBody& of, double load, Vec3 gravity) {
    const double laid_on = load - of.bodies.mass[of.body] * double{length(gravity)};
    return laid_on > kLaidOn * least_load(of) ? kFirstWaking : kOwnWaking;
}

// What sleeps on it weighs nothing in the solver, and is told of once the body is awake.
void wake_touchers(Bodies& bodies, RigidWorld& rigid, std::span<const BodyLoad> loads) {
    for (const BodyLoad& l : loads) {
        if (!bodies.is_asleep[l.toucher]) continue;
        rigid.wake(l.toucher);
        bodies.is_asleep[l.toucher] = 0;
    }
}

// N, body axes.
Vec3d weight_of(const Bodies& bodies, Row<Bodies> body, Vec3 gravity) {
    return bodies.mass[body] * Vec3d(rotate(conjugate(bodies.orientation[body]), gravity));
}

float speed_of(const BodyRows& state, Row<Bodies> body, const Overload& over) {
    const float share = over.is_driven ? kMostShare : std::clamp(static_cast<float>(over.share), 1.0f, kMostShare);
    return kBreakingSpeed * share * (state.bodies.overload_runs[body] ? kHarder : 1) *
           first_crack_speed(state.structures, state.bodies.structure[body], state.bodies.strength_scale[body]);
}

// s, of a run on the whole body when it gets all units; cracks and pieces take half as much again.
double seconds_of_run(const RunLength& run, const DamageSettings& settings, float dt) {
    const double steps = kWithCracks * run.seconds / run.step_seconds;
    const auto units = steps * static_cast<double>(run.units_a_step);
    return dt * units / static_cast<double>(std::max<uint64_t>(settings.units_a_frame, 1));
}

// It goes on however the body gives, and as fast.
bool is_crushed(const Overload& over) {
    return !over.is_driven && over.share > kCrushed;
}

// m, that what drives, or falls, is in it in so many seconds.
double way_in(const Overload& over, Vec3 gravity, double seconds) {
    if (over.is_driven) return over.sunk + over.driven_speed * seconds;
    if (!is_crushed(over)) return over.sunk;
    return over.sunk + over.falling_speed * seconds + 0.5 * length(gravity) * seconds * seconds;
}

bool is_for_a_run(const WorldRows& state, const LoadedBody& of, const Overload& over, DamageRules rules, Step step) {
    const Bodies& bodies = state.bodies;
    const Row<Bodies> body = of.body;
    if (is_sunk(of, over.sunk) || is_past_blows(of, rules.settings)) return false;
    if (bodies.overload_runs[body] >= (over.is_driven ? kMostDrivenRuns : kMostRuns)) return false;
    // A load on what is filled is told as one, and cracks it at any speed.
    if (!of.is_filled() && speed_of(state, body, over) > kFastestRun) return false;
    if (of.elements_of_run() < kFewestForARun) return false;
    const std::optional<RunLength> run = rules.models.length(state, body);
    return !run || !is_deep(bodies, body, way_in(over, step.gravity, seconds_of_run(*run, rules.settings, step.dt)));
}

// A striker of twenty masses stands for who presses. Against what is free it stands still: the body comes to it.
QueuedHit hit_of(const BodyRows& state, Row<Bodies> body, const RigidContact& c, const Overload& over, uint64_t frame) {
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

QueuedHit snap_of(QueuedHit hit, const Overload& over) {
    hit.point = over.section.to_float();
    hit.normal = over.section_normal.to_float();
    hit.approach_speed = 0;
    return hit;
}

Crushed crushed_by(const Bodies& bodies, const QueuedHit& hit) {
    const Pose pose = pose_of(bodies, hit.body);
    return {hit.body, hit.striker, to_world(pose, hit.point), rotate(pose.orientation, hit.normal), hit.load};
}
bool is_to_be_cut(const QueuedHits& queued, const Blows& blows, Row<Bodies> body) {
    return has_waiting_load(queued, body) || has_waiting_cut(blows, body);
}

// So many counted steps in a row a load has to be too much.
uint32_t counts_of_load(const LoadedBody& of, const Overload& over, float dt) {
    const Bodies& bodies = of.bodies;
    const Row<Bodies> body = of.body;
    const uint8_t runs = bodies.overload_runs[body];
    if (over.is_between) {
        const uint32_t counts = counts_in(kDrivenSeconds, dt);
        const double seconds = counts * double{std::max(dt, kLeastCounted)};
        return is_deep(bodies, body, over.driven_speed * seconds) ? 1 : counts;
    }
    if (over.is_driven) return counts_in(kOverloadSeconds, dt);
    if (is_crushed(over)) return counts_in(kCrushedSeconds, dt) << std::min(runs, kMostCrushedRuns);
    return counts_in(kOverloadSeconds, dt) << std::min(runs, kMostLoadRuns);
}

// The same of what is sunk into, whether it is too much besides or not. What moves in spite of that is held by nothing:
// a pane that leaves its place below a slab is a centimetre deeper each sixtieth.
uint32_t counts_of_sinking(const LoadedBody& of, const Overload& over, bool is_too_much, float dt) {
    const uint8_t runs = of.bodies.overload_runs[of.body];
    if (is_too_much) return 1u << std::min(runs, kMostCrushedRuns);
    const double way = double{kLeastCounted} * double{length(of.bodies.velocity[of.body])};
    if (of.yields_to_weights && is_deep(of.bodies, of.body, over.sunk + way))
        return 1u << std::min(runs, kMostLoadRuns);
    const float seconds = is_deep(of.bodies, of.body, over.sunk) ? kDrivenSeconds : kOverloadSeconds;
    return counts_in(seconds, dt) << std::min(runs, kMostLoadRuns);
}

// The run on it stands for a load, which has come deep in since it began: other hits had their share of the units.
bool is_too_late(const BodyRows& rows, Row<Bodies> body, const Overload& over, Step step) {
    const Row<Tasks> task(rows.bodies.task[body]);
    const double seconds = step.dt * static_cast<double>(step.frame - rows.tasks.opened_frame[task]);
    return rows.tasks.load[task] > 0 && is_deep(rows.bodies, body, way_in(over, step.gravity, seconds));
}

// What works off a blow that has cracked nothing yet, and holds nobody, makes way for a load: of a fine mesh such a run
// of the first touch takes half a second.
bool makes_way(const RunRows& rows, const Blows& blows, Row<Tasks> task, bool has_pressed_on) {
    const Tasks& tasks = rows.tasks;
    if (static_cast<TaskState>(tasks.state[task]) != TaskState::Running) return false;
    if (is_ahead(tasks, task) || !tasks.is_late[task]) return false;
    for (uint32_t b = 0; b < blows.size(); ++b)
        if (blows.task[b] == task.index) return false;
    return tasks.load[task] > 0 ? has_pressed_on : tasks.crack_count[task] == 0;
}

// The veto is asked about the blow that is to come, told as it will be.
bool is_allowed(const Bodies& bodies, const QueuedHit& hit, const DamageSettings& settings) {
    if (!settings.allows) return true;
    const Pose pose = pose_of(bodies, hit.body);
    ImpactEvent event = event_of(
        bodies,
        {hit.body, hit.striker, to_world(pose, hit.point), rotate(pose.orientation, hit.normal), hit.approach_speed},
        hit.striker_inverse_mass);
    event.load = hit.load;
    return settings.allows(settings.allows_user, event);
}

/// One body after the other.
struct Weighing {
    Step step;
    RigidWorld& rigid;
    WorldRows& rows;
    QueuedHits& queued;
    const Blows& blows;
    DamageRules rules;
    ToldOfLoads told;
    bool counts, forgets;  // in this step

    void wake_if_loaded(const LoadedBody& of, std::span<const BodyLoad> loads);
    /// The load has lasted long enough.
    bool is_due(const LoadedBody& of, const Overload& over);
    void give_way(const LoadedBody& of, const Overload& over, const RigidContact& worst);
    /// What yields in its shape, and does not come apart.
    void press(const LoadedBody& of, std::span<const BodyLoad> loads, std::span<BodyLoad> room);
};

void Weighing::wake_if_loaded(const LoadedBody& of, std::span<const BodyLoad> loads) {
    Bodies& bodies = rows.bodies;
    float& waking_load = bodies.waking_load[of.body];
    if (forgets) waking_load *= 0.5f;
    const double load = sum_of(loads);
    if (!is_to_wake(of, load) || (is_past_blows(of, rules.settings) && !is_any_driven(loads))) return;
    waking_load =
        static_cast<float>(std::clamp(2 * double{waking_load}, first_waking(of, load, step.gravity) * load, 1e30));
    rigid.wake(of.body);
    bodies.is_asleep[of.body] = 0;
    bodies.overloaded_steps[of.body] = kWasWoken;
}

bool Weighing::is_due(const LoadedBody& of, const Overload& over) {
    Bodies& bodies = rows.bodies;
    uint8_t& steps = bodies.overloaded_steps[of.body];
    const bool is_busy = bodies.task[of.body] != kNone;
    const bool is_too_much = over.is_driven || (over.share > 1 && !is_past_blows(of, rules.settings)),
               is_sunk_into = is_sunk(of, over.sunk);
    if (!is_too_much && !is_sunk_into) {
        if (!counts) return false;
        steps = 0;
        if (!is_busy && over.share < 0.5) bodies.overload_runs[of.body] = 0;
        return false;
    }
    uint32_t wanted = kWasWoken - 1;
    if (is_too_much) wanted = std::min(wanted, counts_of_load(of, over, step.dt));
    if (is_sunk_into) wanted = std::min(wanted, counts_of_sinking(of, over, is_too_much, step.dt));
    if (!counts && wanted > 1) return false;
    if (steps < kWasWoken - 1) ++steps;
    return steps >= wanted;
}

// It gets a hit, snaps, or is ground. What is worked off on it may go on.
void Weighing::give_way(const LoadedBody& of, const Overload& over, const RigidContact& worst) {
    Bodies& bodies = rows.bodies;
    const Row<Bodies> body = of.body;
    const bool is_busy = bodies.task[body] != kNone;
    const bool has_pressed_on = is_busy && is_too_late(rows, body, over, step);
    if (is_busy && !makes_way(rows, blows, Row<Tasks>(bodies.task[body]), has_pressed_on)) return;
    bodies.overloaded_steps[body] = 0;
    // What cannot be cut gives way by blows alone, however often. A load parts what is filled all the same.
    const bool is_uncut = !of.is_filled() && rules.models.why_not_cut(rows, body);
    const bool is_at_end = !is_uncut && is_at_its_end(of, rules.settings);
    if (is_at_end && of.is_pinned()) return;  // it goes nowhere
    const QueuedHit blow = hit_of(rows, body, worst, over, step.frame);
    const bool is_ground = is_at_end && !is_to_be_cut(queued, blows, body);
    const bool runs = is_uncut || (!is_ground && !has_pressed_on && is_for_a_run(rows, of, over, rules, step));
    const QueuedHit hit = runs ? blow : snap_of(blow, over);
    if (!is_allowed(bodies, hit, rules.settings)) return;
    if (is_busy) cancel_task(rules.models, rows, Row<Tasks>(bodies.task[body]));
    uint8_t& times = bodies.overload_runs[body];
    times = std::min<uint8_t>(static_cast<uint8_t>(times + 1), kMostLoadRuns);
    if (is_ground)
        told.crushed.push(crushed_by(bodies, blow));
    else if (!queue_hit(queued, hit))
        told.refused.push(refused_event(bodies, body, "limits.queued_hits"));
}

// One dent after the other: each is there before who presses has moved in the step after it was asked for.
void Weighing::press(const LoadedBody& of, std::span<const BodyLoad> loads, std::span<BodyLoad> room) {
    Bodies& bodies = rows.bodies;
    const Row<Bodies> body = of.body;
    if (bodies.task[body] != kNone || has_waiting_load(queued, body)) return;
    const double soon = double{step.dt};
    const Between between = between_two(bodies, body, loads, soon, room);
    if (!between.exists() || !(between.sunk_in(soon) > kPressedDeep * 2 * double{bodies.radius[body]})) return;
    const bool is_by = !between.against || !between.against->stands ||
                       between.by->depth + between.closing * soon >= between.against->depth;
    const BodyLoad& at = is_by ? *between.by : *between.against;
    Press press;
    press.depth = std::max(0.0, at.depth);
    const double width = width_along(rows, body, rotate(bodies.orientation[body], at.push.to_float()));
    const double left = width - between.sunk - rules.models.least_width(rows, body).value_or(0);
    press.ahead = is_by ? std::clamp(between.closing * soon, 0.0, std::max(0.0, left)) : 0;
    Overload over;
    for (const BodyLoad& l : loads)
        if (l.toucher == at.toucher) over.load += l.force;
    if (!between.is_driven) press.force = over.load;
    QueuedHit hit = hit_of(rows, body, rigid.loads()[at.contact], over, step.frame);
    hit.approach_speed = kPressedSpeed, hit.striker_inverse_mass = kPressedSpeed;  // who presses is not slowed by it
    if (!is_allowed(bodies, hit, rules.settings) || !rules.models.is_pressed(rows, body, press)) return;
    if (!queue_hit(queued, hit)) told.refused.push(refused_event(bodies, body, "limits.queued_hits"));
}

bool yields_in_shape(const LoadedBody& of, const DamageRules& rules, const WorldRows& rows) {
    return of.structure().exists() && of.bodies.is_breakable[of.body] && !of.bodies.hold_count[of.body] &&
           may_be_crushed(of.structures, of.structure(), rules.settings) &&
           rules.models.least_width(rows, of.body).has_value();
}

}  // namespace

void weigh_loads(Serial, Step step, RigidWorld& rigid, WorldRows& rows, QueuedHits& queued, const Blows& blows,
                 DamageRules rules, Arena& arena, ToldOfLoads told) {
    told.crushed.clear();
    const DamageSettings& settings = rules.settings;
    Bodies& bodies = rows.bodies;
    const auto contacts = rigid.loads();
    const LoadLists lists(bodies, rows.squeezes, contacts, step, arena);
    const auto found = arena.take<BodyLoad>(lists.longest());
    const OverloadRoom room{arena.take<BodyLoad>(lists.longest()), arena.take<AxisForce>(lists.longest())};
    Weighing weighing{
        step, rigid, rows, queued, blows, rules, told, is_counted(step), is_period_over(step, kForgettingSeconds)};
    const bool is_driven = is_anything_driven(bodies);
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const Row<Bodies> body(b);
        LoadedBody of(rows, body);
        if (lists.has_loads(body) && yields_in_shape(of, rules, rows))
            weighing.press(of, found.first(lists.take(body, found)), room.loads);
        bool is_looked_at = lists.has_loads(body) && !yields_in_shape(of, rules, rows) && may_be_loaded(of, settings);
        of.yields_to_weights = !is_looked_at || !is_small(of, settings);
        is_looked_at = is_looked_at && (of.yields_to_weights || may_be_pressed(of, lists, is_driven));
        const bool was_woken = bodies.overloaded_steps[b] == kWasWoken;
        // Between counts only what sinks in fast is looked at.
        if (!weighing.counts &&
            (!is_looked_at || was_woken || bodies.is_asleep[b] || !is_sunk(of, 2 * lists.deepest(body))))
            continue;
        if (!is_looked_at) {
            bodies.overloaded_steps[b] = 0;
            bodies.waking_load[b] = 0;
            continue;
        }
        const auto loads = found.first(lists.take(body, found));
        if (bodies.is_asleep[b]) {
            weighing.wake_if_loaded(of, loads);
            continue;
        }
        if (was_woken) {
            wake_touchers(bodies, rigid, loads);
            bodies.overloaded_steps[b] = 0;
            continue;
        }
        const bool is_loaded = of.yields_to_weights ? may_be_overloaded(of, loads) : is_pressed(of, loads);
        const Overload over =
            is_loaded ? overload_of(of, rigid, loads, weight_of(bodies, body, step.gravity), room) : Overload{};
        if (weighing.is_due(of, over)) weighing.give_way(of, over, contacts[over.contact]);
    }
}

}  // namespace cullet
