#include "systems/models.hpp"

#include "systems/models/thick_shell/model.hpp"
#include "systems/structures/shell/structure.hpp"

namespace cullet {

const ModelList& damage_models() {
    static const ModelList all = std::make_shared<const DamageModels>(std::vector{thick_shell_model()});
    return all;
}

std::vector<SlotList> structures() {
    return {shell_structure()};
}

const TaskLoop& DamageModels::loop_of(const RunRows& rows, uint32_t task) const {
    const TaskLoop* found = nullptr;
    for (const DamageModel& model : models_)
        for (const TaskLoop& loop : model.task_loops())
            if (!found && loop.works_on(rows, task)) found = &loop;
    CULLET_ASSERT(found, "no loop of any damage model works on task %u", task);
    return *found;
}

uint64_t DamageModels::units_wanted(const SoftRows& rows) const {
    uint64_t sum = 0;
    for (const DamageModel& model : models_)
        if (const auto wanted = model.calls().wanted) sum += wanted(rows);
    return sum;
}

uint64_t DamageModels::grant_frame(SoftRows& rows, uint64_t units, uint64_t& slow_frames) const {
    uint64_t used = 0;
    for (const DamageModel& model : models_)
        if (const auto grant = model.calls().grant) used += grant(rows, units - std::min(used, units), slow_frames);
    return used;
}

void DamageModels::cancel(RunRows& rows, Row<Tasks> task) const {
    for (const DamageModel& model : models_)
        if (const auto cancel_run = model.calls().cancel) cancel_run(rows, task);
}

std::optional<MechanicalEnergy> DamageModels::energy(SoftRows& rows, Row<Bodies> body, Vec3 gravity) const {
    for (const DamageModel& model : models_)
        if (const auto energy_of = model.calls().energy)
            if (const auto found = energy_of(rows, body, gravity)) return found;
    return {};
}

bool DamageModels::push(SoftRows& rows, RigidWorld& rigid, Row<Bodies> body, const PointPush& push) const {
    for (const DamageModel& model : models_)
        if (const auto take = model.calls().push; take && take(rows, rigid, body, push)) return true;
    return false;
}

bool DamageModels::explode(SoftRows& rows, RigidWorld& rigid, Row<Bodies> body, const Explosion& explosion) const {
    for (const DamageModel& model : models_)
        if (const auto take = model.calls().explode; take && take(rows, rigid, body, explosion)) return true;
    return false;
}

Result<void> DamageModels::check_spawn(const SpawnSettings& settings) const {
    for (const DamageModel& model : models_)
        if (const auto check = model.calls().check_spawn)
            if (const Result<void> sound = check(settings); !sound) return sound;
    return {};
}

Result<Row<Shells>> DamageModels::spawn_shell(SoftRows& rows, Row<Shells> source, const Spawning& spawning) const {
    for (const DamageModel& model : models_)
        if (const auto spawn = model.calls().spawn_shell) {
            const Result<Row<Shells>> own = spawn(rows, source, spawning);
            if (!own || own.value() != source) return own;
        }
    return source;
}

Result<ShellRoom> DamageModels::spawn_body(SoftRows& rows, Row<Bodies> body, const Spawning& spawning) const {
    ShellRoom room;
    for (const DamageModel& model : models_)
        if (const auto spawn = model.calls().spawn_body) {
            const Result<ShellRoom> own = spawn(rows, body, spawning);
            if (!own) return own;
            if (own->vertices > room.vertices) room = own.value();
        }
    return room;
}

WorkingShell DamageModels::working_shell(BodyRows& rows, Row<Bodies> body) const {
    for (const DamageModel& model : models_)
        if (const auto make = model.calls().working_shell)
            if (const auto made = make(rows, body)) return *made;
    CULLET_ASSERT(false, "no damage model breaks body %u", body.index);
    return {};
}

void DamageModels::begin_run(BodyRows& rows, Row<Tasks> task, Events<StiffnessWanted>& wanted) const {
    for (const DamageModel& model : models_)
        if (const auto begin = model.calls().begin) begin(rows, task, wanted);
}

bool DamageModels::give_late(BodyRows& rows, const Blows& blows, Row<Tasks> task, Events<StiffnessWanted>& wanted,
                             const char** full) const {
    for (const DamageModel& model : models_)
        if (const auto give = model.calls().give_late; give && give(rows, blows, task, wanted, full)) return true;
    return false;
}

bool DamageModels::may_find_room(const BodyRows& rows, Row<Bodies> body) const {
    for (const DamageModel& model : models_)
        if (const auto may_find = model.calls().may_find_room; may_find && may_find(rows, body)) return true;
    return false;
}

std::optional<RunLength> DamageModels::length(const BodyRows& rows, Row<Bodies> body) const {
    for (const DamageModel& model : models_)
        if (const auto length_of = model.calls().length)
            if (const auto found = length_of(rows, body)) return found;
    return {};
}

std::optional<RestMotion> DamageModels::motion_of_rest(const RunRows& rows, Row<Tasks> task) const {
    for (const DamageModel& model : models_)
        if (const auto motion_of = model.calls().motion_of_rest)
            if (const auto found = motion_of(rows, task)) return found;
    return {};
}

void DamageModels::inherit(BodyRows& rows, Row<Bodies> parent, Row<Bodies> piece) const {
    for (const DamageModel& model : models_)
        if (const auto inherit_from = model.calls().inherit) inherit_from(rows, parent, piece);
}

bool DamageModels::keeps_cell_names(const BodyRows& rows, Row<Bodies> body) const {
    for (const DamageModel& model : models_)
        if (const auto keeps = model.calls().keeps_cell_names; keeps && keeps(rows, body)) return true;
    return false;
}

void DamageModels::hand_off_torn(const SoftRows& rows, const TornPieces& torn, std::span<PartMotion> motions) const {
    for (const DamageModel& model : models_)
        if (const auto hand_off = model.calls().hand_off_torn) hand_off(rows, torn, motions);
}

void DamageModels::give_torn(SoftRows& rows, const TornPieces& torn) const {
    for (const DamageModel& model : models_)
        if (const auto give = model.calls().give_torn) give(rows, torn);
}

void DamageModels::keep_torn(SoftRows& rows, RigidWorld& rigid, Row<Bodies> body) const {
    for (const DamageModel& model : models_)
        if (const auto keep = model.calls().keep_torn) keep(rows, rigid, body);
}

void DamageModels::follow(SoftRows& rows, Row<Bodies> body) const {
    for (const DamageModel& model : models_)
        if (const auto follow_body = model.calls().follow) follow_body(rows, body);
}

void DamageModels::release(SoftRows& rows, Row<Bodies> body) const {
    for (const DamageModel& model : models_)
        if (const auto release_rows = model.calls().release) release_rows(rows, body);
}

void DamageModels::restore_run(RunRows& rows, Row<Tasks> task) const {
    for (const DamageModel& model : models_)
        if (const auto restore = model.calls().restore_run) restore(rows, task);
}

void DamageModels::restore_body(BodyRows& rows, Row<Bodies> body) const {
    for (const DamageModel& model : models_)
        if (const auto restore = model.calls().restore_body) restore(rows, body);
}

bool DamageModels::is_part(const RunRows& rows, uint32_t task) const {
    for (const DamageModel& model : models_)
        if (const auto is_part_of = model.calls().is_part; is_part_of && is_part_of(rows, task)) return true;
    return false;
}

Result<void> DamageModels::check_shell(const ShellView& shell, bool is_part, const std::string& name,
                                       const char* advice) const {
    for (const DamageModel& model : models_)
        if (const auto check = model.calls().check_shell)
            if (const Result<void> sound = check(shell, is_part, name, advice); !sound) return sound;
    return {};
}

std::string DamageModels::trouble_of_task(const RunRows& rows, uint32_t task) const {
    for (const DamageModel& model : models_)
        if (const auto trouble_of = model.calls().trouble_of_task)
            if (std::string trouble = trouble_of(rows, task); !trouble.empty()) return trouble;
    return {};
}

Result<void> DamageModels::check_rows(const SoftRows& rows, const std::string& name, const char* advice) const {
    for (const DamageModel& model : models_)
        if (const auto check = model.calls().check_rows)
            if (const Result<void> sound = check(rows, name, advice); !sound) return sound;
    return {};
}

}  // namespace cullet
