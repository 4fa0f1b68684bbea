// Damage tasks: impact in, fragments out. A task works on a structure of its own, a copy of the body's with room to
// grow. The body itself does not change until the task ends.
#pragma once
#include "components/shells.hpp"
#include "engine/system.hpp"

namespace cullet {

struct Bodies;

enum class TaskState : uint8_t {
    Free = 0,
    Running,   // steps remain
    Whole,     // ended; no piece came free. Its cracks, if any, stay with the body
    Broke,     // ended; the shell has more than one component
    Dropped,   // ended by a fault (energy) or because the body was removed; nothing changes
    Reshaped,  // ended; no piece came free, and its shape is another
};

/// One row is one hit being worked off.
struct Tasks : Table<Tasks> {
    using Table::Table;
    CULLET_TABLE(tasks);
    Column<uint8_t> state{*this, "state"};  // TaskState
    Column<Row<Bodies>> body{*this, "body"};
    Column<Row<Structures>> source{*this, "source"};    // the body's when it was hit
    Column<Row<Structures>> working{*this, "working"};  // the copy that the run changes
    Column<uint64_t> opened_frame{*this, "opened_frame"};
    Column<uint32_t> first_contact{*this,
                                   "first_contact"};  // range in TaskContacts, kMostContacts of them reserved a task
    Column<uint32_t> contact_count{*this, "contact_count"};
    Column<float> approach_speed{*this, "approach_speed", "m/s"};  // of the fastest contact
    Column<Vec3> start_velocity{*this, "start_velocity", "m/s"};   // V of the centre of mass, body axes
    Column<Vec3> start_spin{*this, "start_spin", "rad/s"};         // w, body axes
    Column<float> strength_scale{*this, "strength_scale"};         // the game's; infinite strength never cracks
    Column<uint64_t> strength_seed{*this, "strength_seed"};  // of a working copy that knows only the model's; or 0
    Column<uint32_t> steps_done{*this, "steps_done"};        // since the last (re)start
    Column<uint32_t> steps_granted{*this, "steps_granted"};  // this frame
    Column<uint32_t> crack_count{*this, "crack_count"};      // cut edges in this run
    Column<uint32_t> start_count{*this, "start_count"};      // cracks started in this run
    Column<uint8_t> lacks_room{*this, "lacks_room"};         // its shell has none for a crack of this run
    Column<uint64_t> units_owed{*this, "units_owed"};        // by cuts, taken from the next grant
    Column<uint8_t> is_held{*this, "is_held"};               // body (and striker) stand still meanwhile
    Column<uint8_t> is_late{*this, "is_late"};               // the contact was solved as between rigid bodies meanwhile
    Column<float> load{*this, "load", "N"};  // the run stands for what presses on the body, not for a blow; 0: a blow
    Column<uint32_t> frames_held{*this, "frames_held"};
    Column<uint32_t> part_count{*this, "part_count"};  // components of its shell, once it ended
    // Of a task that was opened before its touch, which is foreseen: it runs, or waits with its result.
    Column<uint64_t> due_frame{*this, "due_frame"};  // of the touch; 0: the touch has come, or nobody foresaw it
};

/// Row t is the run that works off task t: its clock, its energy, and which part of the body it works on. Quick runs,
/// which are short hidden runs, have more beside it (QuickRuns).
struct HiddenRuns : Table<HiddenRuns> {
    using Table::Table;
    CULLET_TABLE(hidden_runs);
    Column<float> time_step{*this, "time_step", "s"};
    Column<float> damping_time{*this, "damping_time", "s"};        // beta = 0.15 dt
    Column<float> end_time{*this, "end_time", "s"};                // T
    Column<float> quiet_time{*this, "quiet_time", "s"};            // 0.4 T
    Column<float> last_event_time{*this, "last_event_time", "s"};  // of the last crack or touch
    Column<double> start_energy{*this, "start_energy", "J"};       // body's and strikers' kinetic energy at the touch
    Column<uint8_t> redo_count{*this, "redo_count"};               // 0 to 2
    /// First elements of the working copy that are the body's, when it is a cut-out (cut_out.hpp): Elements.part says
    /// which. 0: it is a copy of the whole.
    Column<uint32_t> cut_elements{*this, "cut_elements"};
    Column<uint32_t> pack_count{*this, "pack_count"};  // rows in MarkedPacks
};

inline constexpr uint32_t kMostMarkedPacks = 4096;  // of one run: 32,768 vertices

/// Rows [t kMostMarkedPacks, + pack_count) are packs of 8 vertices of the working copy of task t, rising. Of a quick
/// run they are its region, of a hidden one on a cut-out the vertices by its border. Bit k is vertex k.
struct MarkedPacks : Table<MarkedPacks> {
    using Table::Table;
    CULLET_TABLE(marked_packs);
    Column<uint32_t> pack{*this, "pack"};
    Column<uint8_t> awake{*this, "awake"};  // moves; by a border: and is not cut
    /// Stays where it is, or by a border where the rest of the body has it. Of a region: its velocity is the impulse
    /// that springs gave it, over its mass. The piece that it belongs to gets that in the end.
    Column<uint8_t> held{*this, "held"};
};
template <>
inline constexpr uint32_t kRowsPerChunk<MarkedPacks> = 32;

/// Opened before its touch, which has not come yet: the world knows nothing of it.
inline bool is_ahead(const Tasks& tasks, uint32_t task) {
    return tasks.due_frame[task] > 0;
}

/// Which repetition of an inner loop this is: step n reads side n & 1 of two-sided columns and writes the other.
struct Turn {
    uint32_t old_side, new_side;
};
template <>
struct Parameter<Turn> {
    static void describe(std::vector<Access>&) {}
    template <class W>
    static Turn bind(Call<W>& call) {
        return {static_cast<uint32_t>(call.side), static_cast<uint32_t>(1 - call.side)};
    }
};

inline constexpr uint32_t kMostContacts = 8;  // patches a task
inline constexpr uint32_t kMostPatchVertices =
    512;  // of all patches of a task; a wide patch keeps its heaviest weights

/// One row is one contact patch of a task. It has springs of its own on each of its vertices, against one striker.
struct TaskContacts : Table<TaskContacts> {
    using Table::Table;
    CULLET_TABLE(task_contacts);
    Column<uint32_t> vertex{*this, "vertex"};  // nearest to the contact point when the task opened
    Column<Vec3> point{*this, "point", "m"};   // body frame
    Column<Vec3> normal{*this, "normal"};      // unit, body axes: the way the striker pushes the body
    Column<Row<Bodies>> striker{*this, "striker"};
    Column<uint32_t> cell{*this, "cell"};                                       // of the body, that is touched
    Column<float> approach_speed{*this, "approach_speed", "m/s"};               // as the rigid world told it
    Column<float> striker_inverse_mass{*this, "striker_inverse_mass", "1/kg"};  // effective along the normal; 0: floor
    // What a push at one contact does to the striker's speed at another that it has with the body:
    // n . n'/m + turn . spin'. Body axes.
    Column<float> striker_own_inverse_mass{*this, "striker_own_inverse_mass", "1/kg"};  // 1/m; 0: does not yield
    Column<Vec3> striker_turn{*this, "striker_turn", "m"};                              // r x n about its centre
    Column<Vec3> striker_spin{*this, "striker_spin", "1/(kg m)"};                       // I^-1 (r x n)
    Column<uint8_t> sharers{*this, "sharers"};  // tasks of one frame among which the striker is shared; 0: it is not
    Column<float> striker_radius{*this, "striker_radius", "m"};  // 0: flat
    Column<float> start_speed{*this, "start_speed", "m/s"};      // the striker's along the normal, body frame
    Column<double> striker_travel{*this, "striker_travel", "m"};
    Column<double> striker_speed{*this, "striker_speed", "m/s"};
    Column<double> impulse{*this, "impulse", "N s"};    // passed to the body along the normal so far
    Column<uint8_t> is_answered{*this, "is_answered"};  // the striker broke here first and has taken its own impulse
    Column<Vec3d> answer{*this, "answer", "N s"};       // what it passed to the body then, world axes: waits
    Column<Vec3d> answer_turn{*this, "answer_turn", "N m s"};   // about the body's centre
    Column<double> answer_energy{*this, "answer_energy", "J"};  // what the body may gain by it
    Column<uint8_t> is_heir_striker{*this, "is_heir_striker"};  // and its largest piece, which is the larger one's
    Column<float> radius{*this, "radius", "m"};                 // r_c
    Column<uint32_t> first_patch{*this, "first_patch"};         // range in PatchVertices
    Column<uint32_t> patch_count{*this, "patch_count"};
};

/// One row is one further hit on a body whose task is open. It waits until the body can open a task, or the piece that
/// then owns the place. That task is late from its start: the rigid solver has dealt with the contact.
struct QueuedHits : Table<QueuedHits> {
    using Table::Table;
    CULLET_TABLE(queued_hits);
    Column<uint8_t> is_used{*this, "is_used"};
    Column<uint64_t> frame{*this, "frame"};  // of the hit
    Column<Row<Bodies>> body{*this, "body"};
    Column<Row<Bodies>> striker{*this, "striker"};  // kNone once it was removed
    Column<Vec3> point{*this, "point", "m"};        // body frame, which pieces share
    Column<Vec3> normal{*this, "normal"};           // unit, body axes: the way the body is pushed
    Column<float> approach_speed{*this, "approach_speed", "m/s"};
    Column<float> striker_inverse_mass{*this, "striker_inverse_mass", "1/kg"};  // effective along the normal
    Column<float> striker_radius{*this, "striker_radius", "m"};                 // 0: flat
    Column<float> load{*this, "load", "N"};                                     // as of its task
};

/// One row is one vertex that a striker may push.
struct PatchVertices : Table<PatchVertices> {
    using Table::Table;
    CULLET_TABLE(patch_vertices);
    Column<uint32_t> vertex{*this, "vertex"};
    Column<float> stiffness{*this, "stiffness", "N/m"};                  // k_c w_i
    Column<float> crushed_stiffness{*this, "crushed_stiffness", "N/m"};  // of what has been crushed, as it unloads
    Column<float> yield_force{*this, "yield_force", "N"};                // w_i H A: what is harder pressed is crushed
    Column<float> force{*this, "force", "N"};  // along the normal, from the displacements before the step
};

/// It runs, and has steps left of those granted.
inline bool task_goes_on(const Tasks& tasks, uint32_t t) {
    return static_cast<TaskState>(tasks.state[t]) == TaskState::Running && tasks.steps_granted[t] > 0;
}

}  // namespace cullet
