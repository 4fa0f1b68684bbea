// What the systems of a frame see: the tables, and the few things beside them.
#pragma once
#include <memory>
#include <tuple>

#include "components/state.hpp"
#include "components/view_boxes.hpp"
#include "cullet/events.hpp"
#include "cullet/settings.hpp"
#include "engine/arena.hpp"
#include "engine/events.hpp"
#include "engine/rigid_world.hpp"
#include "systems/births/break.hpp"
#include "systems/checks/energy_balance.hpp"

namespace cullet {

/// A blow predicted from one contact of this step, before the solve.
struct Impact {
    Row<Bodies> body, striker;
    Vec3 point;               // world, m
    Vec3 normal;              // world, unit, the way the body is pushed
    float approach_speed;     // m/s
    uint32_t cell = 0;        // of the body's shell
    bool is_settled = false;  // an open task knows it already
};
inline constexpr uint32_t kMostFlights = 48;   // that are foreseen in a frame
inline constexpr uint32_t kMostToppling = 16;  // of those, at least for what is held up
/// The first touch of a body in flight, some frames before it comes.
struct ForeseenHit {
    Row<Bodies> body;
    bool is_toppling = false;  // held up: it will not come as surely as from flight
    ForeseenTouch touch;
};
/// A damage task that took its rows in this step and must be filled.
struct TaskOpened {
    Row<Tasks> task;
    uint32_t owner = 0;  // the damage model of its body
};
/// Packs of an opened task's shell, from this one on, whose stiffness is to be assembled: a chunk of StiffnessPacks.
struct StiffnessWanted {
    Row<Tasks> task;
    uint32_t first_pack;
};
/// Rows of MarkedPacks of a region that wakes in this step, from this one on: a chunk of them.
struct RegionPart {
    Row<Tasks> task;
    uint32_t first_row;
};
/// A damage task that ended in this step.
struct TaskEnded {
    Row<Tasks> task;
    uint32_t owner = 0;  // the damage model of its body
};
/// A body whose drawn mesh is to be made anew.
struct DrawnChanged {
    Row<Bodies> body;
    bool is_local = false;  // only cells that are changed (Cells::is_changed) are drawn otherwise than they were
};

struct RunLoops;
class DamageModels;
class QueryIndex;

/// A piece that nothing makes way for, and that is too small to come apart.
struct Crushed {
    Row<Bodies> body, toucher;
    Vec3 point, normal;  // world: where it is pushed, and which way
    float load;          // N, see ImpactEvent
};

/// What the game set, as the systems read it.
struct DamageSettings {
    uint64_t units_a_frame = 0;
    float hold_seconds = 0;
    uint32_t frames_ahead = 0;
    uint32_t generations = 0;
    float break_share = 0;
    uint32_t break_elements = 0;
    float debris_share = 0;
    uint32_t debris_elements = 0;
    uint32_t fragments = 0, births_a_frame = 0;
    float debris_seconds = 0;
    bool (*allows)(void* user, const ImpactEvent& impact) = nullptr;
    void* allows_user = nullptr;
};

/// Counts since the world was made; not state.
struct DamageCounts {
    uint64_t opened = 0, broke = 0, whole = 0, dropped = 0, redone = 0, late = 0, frames_held = 0, clamped = 0;
    // Touches that were foreseen: they came as they were, or they did not and the task was dropped.
    uint64_t ahead_hits = 0, ahead_misses = 0;
    uint64_t first_breaks = 0, first_ready = 0;  // bodies that broke for the first time, by touch; in its very frame
    uint64_t cuts = 0, starts = 0, cuts_refused = 0;  // refused: quick runs whose shell had no room for more
    uint64_t units_used = 0, units_left = 0;          // of the last frame
    uint64_t slow_soft_frames = 0;    // soft bodies that had units for fewer substeps than a frame asks for
    uint64_t retired = 0, faded = 0;  // fragments and debris
    double worst_rounding = 0;        // momentum that hidden runs lost, share of what the body had or got
    // J, at most: of the game's blows, of what it moves, and what late breaks get back of what their touch took.
    double work_from_outside = 0;
    double crushing_energy = 0;               // J that pieces lost because their crack faces met at birth
    double impulse_to_static[3] = {0, 0, 0};  // N s, from damage to floors, pins and kinematic bodies
};

// What systems take together.

/// What waits for its turn.
struct WaitingHits {
    QueuedHits& queued;
    Blows& blows;
};
/// Open tasks, with what struck.
struct RunTables {
    Tasks& tasks;
    TaskContacts& contacts;
    Blows& blows;
};
struct RunsNow {
    const Tasks& tasks;
    const TaskContacts& contacts;
};
/// What the game allows, and what can do it.
struct DamageRules {
    const DamageSettings& settings;
    const DamageModels& models;
};
/// The same, and what was done.
struct DamageLedger {
    const DamageSettings& settings;
    const DamageModels& models;
    DamageCounts& counts;
};
struct ToldOfHits {
    Events<ImpactEvent>& impacts;
    Events<RefusedEvent>& refused;
};
struct OpenedTasks {
    Events<TaskOpened>& opened;
    Events<ImpactEvent>& impacts;
    Events<RefusedEvent>& refused;
};
struct PlannedBirths {
    Events<Break>& breaks;
    Events<Birth>& births;
    Events<DrawnChanged>& changed;
    Events<CrackStartedEvent>& cracks;
    Events<RefusedEvent>& refused;
    Events<FaultEvent>& faults;
};
/// What bodies come apart into.
struct Pieces {
    Fragments& fragments;
    Touches& touches;
};
/// Tasks that ended, and what came apart.
struct EndedTasks {
    const Events<TaskEnded>& ended;
    const Events<Break>& breaks;
    Fragments& fragments;
    Touches& touches;
};
struct DebrisTables {
    Debris& debris;
    DebrisAges& ages;
};
struct BirthAccounts {
    const DamageModels& models;
    DamageCounts& counts;
    Arena& arena;
};
/// What loads ask for, beside hits.
struct ToldOfLoads {
    Events<Crushed>& crushed;
    Events<RefusedEvent>& refused;
};
struct ToldOfGrinding {
    Events<ImpactEvent>& impacts;
    Events<DebrisEvent>& debris;
    Events<RefusedEvent>& refused;
};
struct ToldOfBirths {
    Events<DrawnChanged>& changed;
    Events<FragmentBornEvent>& born;
    Events<DebrisEvent>& debris;
};

/// What systems tell each other. A queue is a line here.
inline auto queues_between(const LimitSettings& limits, const State& state) {
    const uint32_t tasks = limits.open_hits, bodies = limits.bodies;
    return Queues(QueueOf<Impact>{1u << 16}, QueueOf<ForeseenHit>{kMostFlights}, QueueOf<TaskOpened>{tasks},
                  QueueOf<StiffnessWanted>{state.stiffness_packs.limit() / kRowsPerChunk<StiffnessPacks> + tasks},
                  QueueOf<RegionPart>{state.marked_packs.limit() / kRowsPerChunk<MarkedPacks>},
                  QueueOf<TaskEnded>{tasks}, QueueOf<Break>{bodies + tasks},
                  QueueOf<Birth>{2 * (bodies + tasks) + limits.debris}, QueueOf<HullWanted>{state.cells.limit()},
                  QueueOf<DrawnChanged>{2 * bodies + tasks}, QueueOf<Crushed>{bodies});
}
/// What the game reads after the step; emptied when the next one begins. Each has a `place`.
inline auto queues_told(const LimitSettings& limits, const State& state) {
    // An impact for each task, each blow that joins one, and each piece that is crushed.
    return Queues(QueueOf<ImpactEvent>{limits.open_hits + state.blows.limit() + limits.bodies},
                  QueueOf<CrackStartedEvent>{1u << 14}, QueueOf<FragmentBornEvent>{limits.bodies},
                  QueueOf<DebrisEvent>{1u << 16}, QueueOf<RefusedEvent>{1u << 12}, QueueOf<FaultEvent>{1u << 10},
                  QueueOf<AsleepEvent>{limits.bodies}, QueueOf<SqueezedEvent>{limits.bodies});
}

struct WorldData {
    using Between = decltype(queues_between(LimitSettings{}, std::declval<const State&>()));
    using Told = decltype(queues_told(LimitSettings{}, std::declval<const State&>()));

    explicit WorldData(const Settings& settings);
    ~WorldData();

    State state;
    Step step_info;
    DamageSettings damage_settings;
    DamageCounts counts;
    EnergyBalance energy;  // Checked and Debug builds
    std::unique_ptr<RigidWorld> rigid;
    std::shared_ptr<const DamageModels> damage_models;
    std::unique_ptr<RunLoops> run_loops;
    ViewBoxes view_boxes;
    std::unique_ptr<QueryIndex> query_index;
    Arena arena;
    Between between;
    Told told;

    /// Pages for a hit on a shell of this size, now and again after what broke has used them.
    void make_ready(const ShellRoom& shell);
    ShellRoom ready_for;  // the largest so far, table by table

    template <class T>
    T& table() {
        if constexpr (std::is_same_v<T, ViewBoxes>)
            return view_boxes;
        else
            return state.table<T>();
    }
    template <class Set>
    Set& set() {
        return state;
    }
    /// What is beside tables and queues: one is a word here.
    auto resources() {
        return std::tuple{&state,      &step_info,          &damage_settings, &counts,           &energy,
                          rigid.get(), damage_models.get(), run_loops.get(),  query_index.get(), &arena};
    }
    template <class T>
    auto& resource() {
        if constexpr (Between::has<typename HeldBy<T>::Type>())
            return between.of<typename HeldBy<T>::Type>();
        else if constexpr (Told::has<typename HeldBy<T>::Type>())
            return told.of<typename HeldBy<T>::Type>();
        else
            return resource_in<T>(resources());
    }

 private:
    /// Of a queue the event, of anything else nothing.
    template <class T>
    struct HeldBy {
        using Type = void;
    };
    template <class E>
    struct HeldBy<Events<E>> {
        using Type = E;
    };
    template <class T, class... R>
    static auto& resource_in(std::tuple<R*...> all) {
        if constexpr ((... || std::is_same_v<const T, R>))
            return *std::get<const T*>(all);
        else
            return *std::get<T*>(all);
    }
};

}  // namespace cullet
