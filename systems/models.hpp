// The damage models of a world, in one list. Each body has one of them: the structure that it is made of says which.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "systems/damage_model.hpp"

namespace cullet {

/// In the order in which they run within a slot. Nothing of it changes while a world has it. A model's number is its
/// place: Structures::damage_model, and the owner of its systems.
class DamageModels {
 public:
    /// 1 to 255 models, whose names differ.
    explicit DamageModels(std::vector<DamageModel> models);
    auto begin() const { return models_.begin(); }
    auto end() const { return models_.end(); }
    uint32_t size() const { return static_cast<uint32_t>(models_.size()); }
    const DamageModel& operator[](uint8_t number) const { return models_[number]; }
    /// The number of the model of that name, or none.
    std::optional<uint8_t> find(const std::string& name) const;
    /// "thick_shell, lattice"
    std::string names() const;

    // ---- each asks the model of the body, of the task's body, or of the structure

    Result<void> check_spawn(const StructureRows& rows, Row<Structures> source, const SpawnSettings& settings) const;
    Result<Row<Structures>> spawn_structure(WorldRows& rows, Row<Structures> source, const Spawning& spawning) const;
    /// Rows that the first hit on the body takes; none: it does not break.
    Result<ShellRoom> spawn_body(WorldRows& rows, Row<Bodies> body, const Spawning& spawning) const;

    bool leaves_nothing(WorldRows& rows, const Knock& knock, float& bounce) const;
    /// m, to which what yields in its shape can be pressed flat. None: it does not yield so, it comes apart.
    std::optional<double> least_width(const WorldRows& rows, Row<Bodies> body) const;
    bool is_pressed(WorldRows& rows, Row<Bodies> body, const Press& press) const;
    WorkingCopy working_copy(WorldRows& rows, Row<Bodies> body) const;
    void begin_run(WorldRows& rows, Row<Tasks> task) const;
    bool give_late(WorldRows& rows, const Blows& blows, Row<Tasks> task, const char** full) const;
    bool may_find_room(const WorldRows& rows, Row<Bodies> body) const;
    /// As many tasks of its model are open as may be at a time. A load, which goes on, waits for that and tells nobody.
    bool is_full(const WorldRows& rows, Row<Bodies> body) const;
    /// Blows slower than Structures::first_crack_speed break it, too.
    bool breaks_at_any_speed(const Structures& structures, Row<Structures> structure) const;
    std::optional<RunLength> length(const WorldRows& rows, Row<Bodies> body) const;
    std::optional<ShellRoom> room(WorldRows& rows, Row<Bodies> body) const;
    bool is_part(const WorldRows& rows, uint32_t task) const;
    void cancel(WorldRows& rows, Row<Tasks> task) const;
    /// The loop that works off an open task: the first one of its model that does.
    const TaskLoop& loop_of(const WorldRows& rows, uint32_t task) const;

    std::optional<RestMotion> motion_of_rest(const WorldRows& rows, Row<Tasks> task) const;
    void inherit(WorldRows& rows, Row<Bodies> parent, Row<Bodies> piece) const;
    bool keeps_cell_names(const WorldRows& rows, Row<Bodies> body) const;

    std::optional<MechanicalEnergy> energy(WorldRows& rows, Row<Bodies> body, Vec3 gravity) const;
    bool push(WorldRows& rows, RigidWorld& rigid, Row<Bodies> body, const PointPush& push) const;
    bool explode(WorldRows& rows, RigidWorld& rigid, Row<Bodies> body, const Explosion& explosion) const;
    /// What the model moves by itself gives way like that to who is driven into it, whatever touches it: from the next
    /// step on. False: it does not move it.
    bool call_up(WorldRows& rows, Row<Bodies> body) const;
    bool is_moving(const WorldRows& rows, Row<Bodies> body) const;
    void look_for_pieces(WorldRows& rows, Row<Bodies> body) const;
    void hand_off_torn(const WorldRows& rows, const Break& torn, Fragments& fragments) const;
    void give_torn(WorldRows& rows, const Break& torn, const Fragments& fragments) const;
    void keep_torn(WorldRows& rows, RigidWorld& rigid, Row<Bodies> body) const;
    void follow(WorldRows& rows, Row<Bodies> body) const;
    void release(WorldRows& rows, Row<Bodies> body) const;

    const char* why_not_cut(const WorldRows& rows, Row<Bodies> body) const;
    void restore_run(WorldRows& rows, Row<Tasks> task) const;
    void restore_body(WorldRows& rows, Row<Bodies> body) const;
    Result<void> check_shell(MetalShellRows rows, Row<Structures> structure, Wear wear, const std::string& name,
                             const char* advice) const;
    std::string trouble_of_task(const WorldRows& rows, uint32_t task) const;

    // ---- these ask all of them, one after the other

    /// Units that all frame loops ask for.
    uint64_t units_wanted(const WorldRows& rows) const;
    /// Rows of their frame loops that run in one frame, at most.
    uint32_t most_moving(const WorldRows& rows) const;
    /// Gives them what there is, the first models first; returns what they use.
    uint64_t grant_frame(WorldRows& rows, uint64_t units, uint64_t& slow_frames) const;
    /// Somebody who yields to nothing is driven into what a model moves by itself.
    bool is_any_driven_into(const WorldRows& rows) const;
    /// A body that tore, each once; a row that does not exist: there is none left.
    Row<Bodies> take_torn(WorldRows& rows) const;
    Result<void> check_rows(const WorldRows& rows, const std::string& name, const char* advice) const;

 private:
    /// Null where the model has no such call. What has no structure has no model.
    template <class Call>
    Call call_of(const StructureRows& rows, Row<Structures> structure, Call ModelCalls::*call) const {
        return structure.exists() ? models_[rows.structures.damage_model[structure]].calls().*call : nullptr;
    }
    template <class Call>
    Call call_of(const WorldRows& rows, Row<Tasks> task, Call ModelCalls::*call) const {
        return call_of(rows, rows.tasks.source[task], call);
    }
    template <class Call>
    Call call_of(const WorldRows& rows, Row<Bodies> body, Call ModelCalls::*call) const {
        return call_of(rows, rows.bodies.structure[body], call);
    }
    std::vector<DamageModel> models_;
};

/// Shared by all that cook for it or play with it.
using ModelList = std::shared_ptr<const DamageModels>;

/// The one list of models, and that of structures.
const ModelList& damage_models();
std::vector<SlotList> structures();

}  // namespace cullet
