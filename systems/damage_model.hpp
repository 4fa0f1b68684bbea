// A damage model as the rest of the program knows it: the slots that it fills with systems of its own, its inner loops,
// and calls.
//
// A call is a plain function over a set of tables. It is asked of bodies that the model breaks, and of tasks on them.
#pragma once
#include "systems/model_calls.hpp"
#include "systems/model_loops.hpp"
#include "systems/settings/setting_list.hpp"
#include "systems/slots.hpp"

namespace cullet {

class DamageModel {
 public:
    explicit DamageModel(std::string name) : slots_(std::move(name)) {}

    // ---- registration

    DamageModel& at(Slot slot) {
        slots_.at(slot);
        return *this;
    }
    template <auto System>
    DamageModel& then() {
        slots_.then<System>();
        return *this;
    }
    /// A loop that works off tasks, and what its runs cost.
    template <auto Cost, class World>
    DamageModel& loop(std::string title, InnerLoop<World> loop, const TaskCalls& calls) {
        task_loops_.push_back(TaskLoop::of<Cost>(std::move(title), std::move(loop), calls));
        return *this;
    }
    /// A loop that runs in each frame. Its time is shown under `zone`.
    template <class World>
    DamageModel& frame_loop(std::string title, InnerLoop<World> loop, const FrameCalls& calls) {
        frame_loops_.emplace_back(std::move(title), std::move(loop), calls);
        return *this;
    }
    /// Units of its frame loops: `Most(rows)` run in one frame at most; `Wanted(rows)` for all that they ask for;
    /// `Grant(rows, units, slow_frames)` gives them what the frame has, counts what runs slower than the world, and
    /// returns what that costs. `zone`: of the profiler.
    template <auto Most, auto Wanted, auto Grant>
    DamageModel& moves_each_frame(const char* zone) {
        frame_zone_ = zone;
        calls_.most_moving = [](const WorldRows& rows) { return Most(rows); };
        calls_.wanted = [](const WorldRows& rows) { return Wanted(rows); };
        calls_.grant = [](WorldRows& rows, uint64_t units, uint64_t& slow_frames) {
            return Grant(rows, units, slow_frames);
        };
        return *this;
    }
    /// `Cancel(rows, task)`: rows that the model holds for a task go back.
    template <auto Cancel>
    DamageModel& cancels() {
        calls_.cancel = [](WorldRows& rows, Row<Tasks> task) { Cancel(rows, task); };
        return *this;
    }
    /// `Energy(rows, body, gravity)` of a body that the model moves by itself; none of one that is rigid.
    template <auto Energy>
    DamageModel& has_energy() {
        calls_.energy = [](WorldRows& rows, Row<Bodies> body, Vec3 gravity) { return Energy(rows, body, gravity); };
        return *this;
    }
    /// Blows of the game on a body that the model can move by itself: `Push(rows, rigid, body, push)`, and
    /// `Explode(rows, rigid, body, explosion)`. False: it cannot, and nothing happened.
    template <auto Push, auto Explode>
    DamageModel& takes_blows() {
        calls_.push = [](WorldRows& rows, RigidWorld& rigid, Row<Bodies> body, const PointPush& push) {
            return Push(rows, rigid, body, push);
        };
        calls_.explode = [](WorldRows& rows, RigidWorld& rigid, Row<Bodies> body, const Explosion& explosion) {
            return Explode(rows, rigid, body, explosion);
        };
        return *this;
    }
    /// Who is driven into a body that the model can move by itself: `CallUp(rows, body)` lets it make way from the next
    /// step on, false where the model cannot. `IsDrivenInto(rows)`: somebody is driven into one now.
    template <auto CallUp, auto IsDrivenInto>
    DamageModel& makes_way() {
        calls_.call_up = [](WorldRows& rows, Row<Bodies> body) { return CallUp(rows, body); };
        calls_.is_driven_into = [](const WorldRows& rows) { return IsDrivenInto(rows); };
        return *this;
    }
    /// `Cook(cooking)` makes a shell of a clean mesh, in tables of its own. A sentence without the mesh's name refuses
    /// it.
    template <auto Cook>
    DamageModel& cooks() {
        calls_.cook = [](Cooking& cooking) { return Cook(cooking); };
        return *this;
    }
    /// `Share(settings)`: edges longer than this share of the box diagonal are split before, where the game does not
    /// say how long they may be.
    template <auto Share>
    DamageModel& splits_edges() {
        calls_.edge_share = [](const CookSettings& settings) { return Share(settings); };
        return *this;
    }
    /// Settings of its own, which stand in this member of CookSettings, or in that member of it. Their list is what the
    /// check, scripts, options and help go by. `name`: of their table in scripts; empty: there is none.
    template <auto... Member>
    DamageModel& cook_settings(const char* name = "") {
        cook_settings_.push_back(group_of<CookSettings, Member...>(name));
        return *this;
    }
    /// The same of SpawnSettings. Recordings hold them, in this order.
    template <auto... Member>
    DamageModel& spawn_settings(const char* name = "") {
        spawn_settings_.push_back(group_of<SpawnSettings, Member...>(name));
        return *this;
    }
    /// A body is spawned. `Body(rows, body, spawning)`, once its mass is known: fills what the model keeps for it, and
    /// returns the rows that the first hit on it takes.
    template <auto Body>
    DamageModel& spawns() {
        calls_.spawn_body = [](WorldRows& rows, Row<Bodies> body, const Spawning& spawning) {
            return Body(rows, body, spawning);
        };
        return *this;
    }
    /// `Why(rows, body)`: why a body that is not breakable cannot be cut, and which one can: "its material is rubber;
    /// cut glass". Null: the model has no other reason than the game has.
    template <auto Why>
    DamageModel& says_why_not_cut() {
        calls_.why_not_cut = [](const WorldRows& rows, Row<Bodies> body) -> const char* { return Why(rows, body); };
        return *this;
    }
    /// Before that. `Shell(rows, source, spawning)`: the cooked shell, which bodies share, or one of the body's own.
    template <auto Shell>
    DamageModel& spawns_own() {
        calls_.spawn_structure = [](WorldRows& rows, Row<Structures> source, const Spawning& spawning) {
            return Shell(rows, source, spawning);
        };
        return *this;
    }
    /// `Nothing(rows, knock, bounce)`: the blow leaves nothing behind, so that no task is opened for it. `bounce` is
    /// the restitution that its contacts have then at least.
    template <auto Nothing>
    DamageModel& passes_over() {
        calls_.leaves_nothing = [](WorldRows& rows, const Knock& knock, float& bounce) {
            return Nothing(rows, knock, bounce);
        };
        return *this;
    }
    /// What yields in its shape: `Note(rows, body, press)` takes note of what presses on the body. True: it wants a
    /// task for that, whose only contact says where. `Width(rows, body)`: m, to which it can be pressed flat.
    template <auto Note, auto Width>
    DamageModel& yields_to_presses() {
        calls_.is_pressed = [](WorldRows& rows, Row<Bodies> body, const Press& press) {
            return Note(rows, body, press);
        };
        calls_.least_width = [](const WorldRows& rows, Row<Bodies> body) { return double{Width(rows, body)}; };
        return *this;
    }
    /// Rows for a task that opens. `Shell(rows, body)` is a WorkingCopy; `Begin(rows, task)` fills
    /// what the model keeps for it.
    template <auto Shell, auto Begin>
    DamageModel& takes() {
        calls_.working_copy = [](WorldRows& rows, Row<Bodies> body) { return Shell(rows, body); };
        calls_.begin = [](WorldRows& rows, Row<Tasks> task) { Begin(rows, task); };
        return *this;
    }
    /// `GiveLate(rows, blows, task, full)` gives rows to one that waited for its contacts: false, there is no room.
    template <auto GiveLate>
    DamageModel& takes_late() {
        calls_.give_late = [](WorldRows& rows, const Blows& blows, Row<Tasks> task, const char** full) {
            return GiveLate(rows, blows, task, full);
        };
        return *this;
    }
    /// `Room(rows, body)`: rows that a hit on the body takes. `MayFind(rows, body)`: false where they have no room
    /// beside the body's even when nothing else is there, so that a hit need not wait for it.
    template <auto Room, auto MayFind>
    DamageModel& needs_room() {
        calls_.room = [](WorldRows& rows, Row<Bodies> body) { return Room(rows, body); };
        calls_.may_find_room = [](const WorldRows& rows, Row<Bodies> body) { return MayFind(rows, body); };
        return *this;
    }
    /// `IsFull(rows)`: as many of its tasks are open as may be at a time; others wait.
    template <auto IsFull>
    DamageModel& takes_turns() {
        calls_.is_full = [](const WorldRows& rows) { return IsFull(rows); };
        return *this;
    }
    /// The first crack's speed that it cooks is that of a few places, and weaker ones break below it. Its runs tell
    /// within a frame, so that any blow is worth a hold.
    DamageModel& breaks_at_any_speed() {
        calls_.breaks_at_any_speed = true;
        return *this;
    }
    /// `Length(rows, body)`: a RunLength, none where runs are over before anything presses on.
    template <auto Length>
    DamageModel& lasts() {
        calls_.length = [](const WorldRows& rows, Row<Bodies> body) { return Length(rows, body); };
        return *this;
    }
    /// `IsPart(rows, task)`: the task's shell is a part of its body's.
    template <auto IsPart>
    DamageModel& works_on_parts() {
        calls_.is_part = [](const WorldRows& rows, uint32_t task) { return IsPart(rows, task); };
        return *this;
    }
    /// `Motion(rows, task)`: how the rest of a body moves that was hit on a part of it, once that part is back in it.
    template <auto Motion>
    DamageModel& moves_rest() {
        calls_.motion_of_rest = [](const WorldRows& rows, Row<Tasks> task) { return Motion(rows, task); };
        return *this;
    }
    /// `Inherit(rows, parent, piece)`: what the model keeps of a body goes on to a new piece of it.
    template <auto Inherit>
    DamageModel& inherits() {
        calls_.inherit = [](WorldRows& rows, Row<Bodies> parent, Row<Bodies> piece) { Inherit(rows, parent, piece); };
        return *this;
    }
    /// `Keeps(rows, body)`: a run on a copy of the body leaves the cells that did not change under their names.
    template <auto Keeps>
    DamageModel& keeps_cell_names() {
        calls_.keeps_cell_names = [](const WorldRows& rows, Row<Bodies> body) { return Keeps(rows, body); };
        return *this;
    }
    /// Bodies that the model moves by itself may tear. `IsMoving(rows, body)` says whether it does; of such a body
    /// `LookForPieces(rows, body)` asks anew for pieces that found no room. `Take(rows)` is a body that tore and whose
    /// pieces nobody has looked for, each once; a row that does not exist: there is none left.
    template <auto IsMoving, auto LookForPieces, auto Take>
    DamageModel& may_tear() {
        calls_.is_moving = [](const WorldRows& rows, Row<Bodies> body) { return IsMoving(rows, body); };
        calls_.look_for_pieces = [](WorldRows& rows, Row<Bodies> body) { LookForPieces(rows, body); };
        calls_.take_torn = [](WorldRows& rows) { return Take(rows); };
        return *this;
    }
    /// Of a body that tore: `HandOff(rows, torn, fragments)` finds how the fragments move, `Give(rows, torn,
    /// fragments)` makes the new bodies move by themselves, `Keep(rows, rigid, body)` lets the rest go on.
    template <auto HandOff, auto Give, auto Keep>
    DamageModel& tears() {
        calls_.hand_off_torn = [](const WorldRows& rows, const Break& torn, Fragments& fragments) {
            HandOff(rows, torn, fragments);
        };
        calls_.give_torn = [](WorldRows& rows, const Break& torn, const Fragments& fragments) {
            Give(rows, torn, fragments);
        };
        calls_.keep_torn = [](WorldRows& rows, RigidWorld& rigid, Row<Bodies> body) { Keep(rows, rigid, body); };
        return *this;
    }
    /// `Follow(rows, body)`: the game has put a body elsewhere, or given it another motion. `Release(rows, body)`: what
    /// the model keeps for a body goes; the body is no concern of it any more.
    template <auto Follow, auto Release>
    DamageModel& keeps_for_bodies() {
        calls_.follow = [](WorldRows& rows, Row<Bodies> body) { Follow(rows, body); };
        calls_.release = [](WorldRows& rows, Row<Bodies> body) { Release(rows, body); };
        return *this;
    }
    /// After a load, what is not in the bytes because it follows from them: `Run(rows, task)` of a run that goes on,
    /// `Body(rows, body)` of each body with a shell.
    template <auto Run, auto Body>
    DamageModel& restores() {
        calls_.restore_run = [](WorldRows& rows, Row<Tasks> task) { Run(rows, task); };
        calls_.restore_body = [](WorldRows& rows, Row<Bodies> body) { Body(rows, body); };
        return *this;
    }
    /// Rows that came from a file. `Shell(rows, structure, wear, name, advice)` is a Result<void>, whose sentence
    /// begins with the name and ends with the advice. Ranges, users and shared tables have been looked at before.
    template <auto Shell>
    DamageModel& checks() {
        calls_.check_shell = [](MetalShellRows rows, Row<Structures> structure, Wear wear, const std::string& name,
                                const char* advice) { return Shell(rows, structure, wear, name, advice); };
        return *this;
    }
    /// The same of tasks and of rows of the model's own. `Task(rows, task)` is empty or what the task's shell is or
    /// lacks; `Rows(rows, own, name, advice)` is a Result<void>. `own`: the model's number. Rows that it keeps for
    /// tasks and bodies of another model may hold what they held.
    template <auto Task, auto Rows>
    DamageModel& checks_own() {
        calls_.trouble_of_task = [](const WorldRows& rows, uint32_t task) { return Task(rows, task); };
        calls_.check_rows = [](const WorldRows& rows, uint8_t own, const std::string& name, const char* advice) {
            return Rows(rows, own, name, advice);
        };
        return *this;
    }

    // ---- what was registered

    const std::string& name() const { return slots_.name(); }
    const SlotList& slots() const { return slots_; }
    const std::vector<TaskLoop>& task_loops() const { return task_loops_; }
    const std::vector<FrameLoop>& frame_loops() const { return frame_loops_; }
    const char* frame_zone() const { return frame_zone_; }
    const ModelCalls& calls() const { return calls_; }
    const std::vector<SettingGroup<CookSettings>>& cook_settings() const { return cook_settings_; }
    const std::vector<SettingGroup<SpawnSettings>>& spawn_settings() const { return spawn_settings_; }

 private:
    template <class Settings, auto... Member>
    static SettingGroup<Settings> group_of(const char* name) {
        using Own = std::remove_cvref_t<decltype((std::declval<Settings&>().*....*Member))>;
        return {name, setting_list<Own>(), [](Settings& settings) -> void* { return &(settings.*....*Member); }};
    }

    SlotList slots_;
    std::vector<TaskLoop> task_loops_;
    std::vector<FrameLoop> frame_loops_;
    const char* frame_zone_ = "";
    ModelCalls calls_;
    std::vector<SettingGroup<CookSettings>> cook_settings_;
    std::vector<SettingGroup<SpawnSettings>> spawn_settings_;
};

}  // namespace cullet
