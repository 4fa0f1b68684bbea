#include "systems/models.hpp"

#include <algorithm>

#include "systems/models/lattice/model.hpp"
#include "systems/models/metal_shell/model.hpp"
#include "systems/models/thick_shell/model.hpp"
#include "systems/settings/check.hpp"

namespace cullet {

const ModelList& damage_models() {
    static const ModelList all =
        std::make_shared<const DamageModels>(std::vector{thick_shell_model(), metal_shell_model(), lattice_model()});
    return all;
}

DamageModels::DamageModels(std::vector<DamageModel> models) : models_(std::move(models)) {
    CULLET_ASSERT(!models_.empty() && models_.size() <= 255, "a world has 1 to 255 damage models, not %zu",
                  models_.size());
    for (size_t a = 0; a < models_.size(); ++a)
        for (size_t b = 0; b < a; ++b)
            CULLET_ASSERT(models_[a].name() != models_[b].name(), "two damage models are called %s",
                          models_[a].name().c_str());
}

std::optional<uint8_t> DamageModels::find(const std::string& name) const {
    for (size_t number = 0; number < models_.size(); ++number)
        if (models_[number].name() == name) return static_cast<uint8_t>(number);
    return {};
}

std::string DamageModels::names() const {
    std::string list;
    for (const DamageModel& model : models_) list += (list.empty() ? "" : ", ") + model.name();
    return list;
}

Result<void> DamageModels::check_spawn(const StructureRows& rows, Row<Structures> source,
                                       const SpawnSettings& settings) const {
    return check_settings(models_[rows.structures.damage_model[source]].spawn_settings(), settings);
}

Result<Row<Structures>> DamageModels::spawn_structure(WorldRows& rows, Row<Structures> source,
                                                      const Spawning& spawning) const {
    const auto call = call_of(rows, source, &ModelCalls::spawn_structure);
    return call ? call(rows, source, spawning) : source;
}

Result<ShellRoom> DamageModels::spawn_body(WorldRows& rows, Row<Bodies> body, const Spawning& spawning) const {
    const auto call = call_of(rows, body, &ModelCalls::spawn_body);
    return call ? call(rows, body, spawning) : ShellRoom{};
}

bool DamageModels::leaves_nothing(WorldRows& rows, const Knock& knock, float& bounce) const {
    const auto call = call_of(rows, knock.body, &ModelCalls::leaves_nothing);
    return call && call(rows, knock, bounce);
}

std::optional<double> DamageModels::least_width(const WorldRows& rows, Row<Bodies> body) const {
    const auto call = call_of(rows, body, &ModelCalls::least_width);
    return call ? std::optional<double>(call(rows, body)) : std::nullopt;
}

bool DamageModels::is_pressed(WorldRows& rows, Row<Bodies> body, const Press& press) const {
    const auto call = call_of(rows, body, &ModelCalls::is_pressed);
    return call && call(rows, body, press);
}

WorkingCopy DamageModels::working_copy(WorldRows& rows, Row<Bodies> body) const {
    const auto call = call_of(rows, body, &ModelCalls::working_copy);
    CULLET_ASSERT(call, "no damage model breaks body %u", body.index);
    return call(rows, body);
}

void DamageModels::begin_run(WorldRows& rows, Row<Tasks> task) const {
    if (const auto call = call_of(rows, task, &ModelCalls::begin)) call(rows, task);
}

bool DamageModels::give_late(WorldRows& rows, const Blows& blows, Row<Tasks> task, const char** full) const {
    const auto call = call_of(rows, task, &ModelCalls::give_late);
    return call && call(rows, blows, task, full);
}

bool DamageModels::may_find_room(const WorldRows& rows, Row<Bodies> body) const {
    const auto call = call_of(rows, body, &ModelCalls::may_find_room);
    return call && call(rows, body);
}

std::optional<RunLength> DamageModels::length(const WorldRows& rows, Row<Bodies> body) const {
    const auto call = call_of(rows, body, &ModelCalls::length);
    return call ? call(rows, body) : std::nullopt;
}

std::optional<ShellRoom> DamageModels::room(WorldRows& rows, Row<Bodies> body) const {
    const auto call = call_of(rows, body, &ModelCalls::room);
    return call ? std::optional(call(rows, body)) : std::nullopt;
}

bool DamageModels::is_part(const WorldRows& rows, uint32_t task) const {
    const auto call = call_of(rows, Row<Tasks>(task), &ModelCalls::is_part);
    return call && call(rows, task);
}

void DamageModels::cancel(WorldRows& rows, Row<Tasks> task) const {
    if (const auto call = call_of(rows, task, &ModelCalls::cancel)) call(rows, task);
}

const TaskLoop& DamageModels::loop_of(const WorldRows& rows, uint32_t task) const {
    const DamageModel& model = models_[rows.model_of(task)];
    const TaskLoop* found = nullptr;
    for (const TaskLoop& loop : model.task_loops())
        if (!found && loop.works_on(rows, task)) found = &loop;
    CULLET_ASSERT(found, "no loop of %s works on task %u", model.name().c_str(), task);
    return *found;
}

std::optional<RestMotion> DamageModels::motion_of_rest(const WorldRows& rows, Row<Tasks> task) const {
    const auto call = call_of(rows, task, &ModelCalls::motion_of_rest);
    return call ? std::optional(call(rows, task)) : std::nullopt;
}

void DamageModels::inherit(WorldRows& rows, Row<Bodies> parent, Row<Bodies> piece) const {
    if (const auto call = call_of(rows, parent, &ModelCalls::inherit)) call(rows, parent, piece);
}

bool DamageModels::keeps_cell_names(const WorldRows& rows, Row<Bodies> body) const {
    const auto call = call_of(rows, body, &ModelCalls::keeps_cell_names);
    return call && call(rows, body);
}

std::optional<MechanicalEnergy> DamageModels::energy(WorldRows& rows, Row<Bodies> body, Vec3 gravity) const {
    const auto call = call_of(rows, body, &ModelCalls::energy);
    return call ? call(rows, body, gravity) : std::nullopt;
}

bool DamageModels::push(WorldRows& rows, RigidWorld& rigid, Row<Bodies> body, const PointPush& push) const {
    const auto call = call_of(rows, body, &ModelCalls::push);
    return call && call(rows, rigid, body, push);
}

bool DamageModels::explode(WorldRows& rows, RigidWorld& rigid, Row<Bodies> body, const Explosion& explosion) const {
    const auto call = call_of(rows, body, &ModelCalls::explode);
    return call && call(rows, rigid, body, explosion);
}

bool DamageModels::is_moving(const WorldRows& rows, Row<Bodies> body) const {
    const auto call = call_of(rows, body, &ModelCalls::is_moving);
    return call && call(rows, body);
}

void DamageModels::look_for_pieces(WorldRows& rows, Row<Bodies> body) const {
    if (const auto call = call_of(rows, body, &ModelCalls::look_for_pieces)) call(rows, body);
}

void DamageModels::hand_off_torn(const WorldRows& rows, const Break& torn, Fragments& fragments) const {
    if (const auto call = call_of(rows, torn.body, &ModelCalls::hand_off_torn)) call(rows, torn, fragments);
}

void DamageModels::give_torn(WorldRows& rows, const Break& torn, const Fragments& fragments) const {
    if (const auto call = call_of(rows, torn.body, &ModelCalls::give_torn)) call(rows, torn, fragments);
}

void DamageModels::keep_torn(WorldRows& rows, RigidWorld& rigid, Row<Bodies> body) const {
    if (const auto call = call_of(rows, body, &ModelCalls::keep_torn)) call(rows, rigid, body);
}

void DamageModels::follow(WorldRows& rows, Row<Bodies> body) const {
    if (const auto call = call_of(rows, body, &ModelCalls::follow)) call(rows, body);
}

void DamageModels::release(WorldRows& rows, Row<Bodies> body) const {
    if (const auto call = call_of(rows, body, &ModelCalls::release)) call(rows, body);
}

void DamageModels::restore_run(WorldRows& rows, Row<Tasks> task) const {
    if (const auto call = call_of(rows, task, &ModelCalls::restore_run)) call(rows, task);
}

void DamageModels::restore_body(WorldRows& rows, Row<Bodies> body) const {
    if (const auto call = call_of(rows, body, &ModelCalls::restore_body)) call(rows, body);
}

Result<void> DamageModels::check_shell(MetalShellRows rows, Row<Structures> structure, Wear wear,
                                       const std::string& name, const char* advice) const {
    const auto call = call_of(rows.shell_rows, structure, &ModelCalls::check_shell);
    return call ? call(rows, structure, wear, name, advice) : Result<void>();
}

std::string DamageModels::trouble_of_task(const WorldRows& rows, uint32_t task) const {
    const auto call = call_of(rows, Row<Tasks>(task), &ModelCalls::trouble_of_task);
    return call ? call(rows, task) : std::string();
}

uint64_t DamageModels::units_wanted(const WorldRows& rows) const {
    uint64_t sum = 0;
    for (const DamageModel& model : models_)
        if (const auto wanted = model.calls().wanted) sum += wanted(rows);
    return sum;
}

bool DamageModels::is_full(const WorldRows& rows, Row<Bodies> body) const {
    const auto call = call_of(rows, body, &ModelCalls::is_full);
    return call && call(rows);
}

bool DamageModels::breaks_at_any_speed(const Structures& structures, Row<Structures> structure) const {
    return models_[structures.damage_model[structure]].calls().breaks_at_any_speed;
}

bool DamageModels::call_up(WorldRows& rows, Row<Bodies> body) const {
    const auto call = call_of(rows, body, &ModelCalls::call_up);
    return call && call(rows, body);
}

bool DamageModels::is_any_driven_into(const WorldRows& rows) const {
    return std::any_of(models_.begin(), models_.end(), [&](const DamageModel& model) {
        const auto is_driven_into = model.calls().is_driven_into;
        return is_driven_into && is_driven_into(rows);
    });
}

uint32_t DamageModels::most_moving(const WorldRows& rows) const {
    uint32_t sum = 0;
    for (const DamageModel& model : models_)
        if (const auto most = model.calls().most_moving) sum += most(rows);
    return sum;
}

const char* DamageModels::why_not_cut(const WorldRows& rows, Row<Bodies> body) const {
    const auto call = call_of(rows, body, &ModelCalls::why_not_cut);
    return call ? call(rows, body) : nullptr;
}

uint64_t DamageModels::grant_frame(WorldRows& rows, uint64_t units, uint64_t& slow_frames) const {
    uint64_t used = 0;
    for (const DamageModel& model : models_)
        if (const auto grant = model.calls().grant) used += grant(rows, units - std::min(used, units), slow_frames);
    return used;
}

Row<Bodies> DamageModels::take_torn(WorldRows& rows) const {
    Row<Bodies> torn;
    for (const DamageModel& model : models_)
        if (const auto take = model.calls().take_torn; take && !torn.exists()) torn = take(rows);
    return torn;
}

Result<void> DamageModels::check_rows(const WorldRows& rows, const std::string& name, const char* advice) const {
    for (size_t own = 0; own < models_.size(); ++own)
        if (const auto check = models_[own].calls().check_rows)
            if (const Result<void> sound = check(rows, static_cast<uint8_t>(own), name, advice); !sound) return sound;
    return {};
}

}  // namespace cullet
