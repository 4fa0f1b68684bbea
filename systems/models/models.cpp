#include "systems/models.hpp"

#include "systems/models/thick_shell/model.hpp"
#include "systems/structures/shell/structure.hpp"

namespace cullet {

DamageModels damage_models() {
    return DamageModels({thick_shell_model()});
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

}  // namespace cullet
