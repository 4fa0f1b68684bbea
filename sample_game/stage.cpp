#include "sample_game/stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sample_game/cache.hpp"
#include "sample_game/event_list.hpp"
#include "sample_game/model_shelf.hpp"
#include "sample_game/progress.hpp"
#include "sample_game/read_materials.hpp"
#include "systems/tasks/hold_units.hpp"

namespace cullet {
namespace {

constexpr size_t kMostFaults = 20;  // sentences; all are counted

Look look_of(const std::string& material) {
    Look look;
    look.finish = finish_of(material);
    if (material == "glass") look.opacity = 0.4f, look.gloss = 1;
    if (material == "brick" || material == "concrete" || material == "wood") look.gloss = 0;
    return look;
}

/// Bricks of a thing that is too small for them are those of a model of it: halves, quarters and so on.
float pattern_size_of(const std::string& material, float largest_side) {
    constexpr float kLeastSide = 1.2f;  // m, for bricks of 24 cm
    float size = 1;
    if (material == "brick" || material == "concrete" || material == "wood")
        while (size > 0.01f && largest_side < size * kLeastSide) size *= 0.5f;
    return size;
}

}  // namespace

Keys world_keys() {
    const Settings defaults;
    Keys keys;
    keys.number("scene.seed", "1", 1, 0, 1e9, "seed of places, turns and strengths")
        .number("units_a_frame", "units", static_cast<double>(defaults.units_a_frame), 1e3, 1e15,
                "damage work a frame, 2 ns each")
        .number("hold_s", "s", static_cast<double>(defaults.hold_seconds), 0, 1,
                "longest hold of a blow that is being worked off")
        .number("frames_ahead", "frames", defaults.frames_ahead, 0, 60,
                "that the touch of a body in flight is foreseen, and its hit worked off")
        .number("generations", "1", defaults.generations, 0, 100, "fragments break again down to this one")
        .number("debris_share", "1", static_cast<double>(defaults.debris_share), 0, 1,
                "pieces lighter than this share of the whole are debris")
        .number("break_share", "1", static_cast<double>(defaults.break_share), 0, 1,
                "pieces lighter than this share do not break again by blows and weights")
        .number("break_elements", "1", defaults.break_elements, 0, 1e6, "pieces of fewer elements do not either")
        .number("debris_elements", "1", defaults.debris_elements, 0, 1e6, "pieces of fewer elements are debris")
        .number("debris_s", "s", static_cast<double>(defaults.debris_seconds), 0, 1e6,
                "debris is gone after so long; 0: it stays")
        .number("gravity_mps2", "m/s2", 9.81, 0, 100, "downward")
        .number("threads", "1", 1, 1, 64, "threads that step the world; the same as --threads")
        .word("simd", "best", "best, scalar, sse4, avx2, avx512", "kernels of the whole program run at this level");
    return keys;
}

Settings Stage::settings() const {
    const Keys& keys = story.keys;
    Settings s;
    s.gravity = {0, -static_cast<float>(keys["gravity_mps2"]), 0};
    s.step_seconds = static_cast<float>(0.001 * plan.step_ms);
    s.threads = static_cast<uint32_t>(keys["threads"]);
    s.units_a_frame = static_cast<uint64_t>(keys["units_a_frame"]);
    s.hold_seconds = static_cast<float>(keys["hold_s"]);
    s.frames_ahead = static_cast<uint32_t>(keys["frames_ahead"]);
    s.generations = static_cast<uint32_t>(keys["generations"]);
    s.debris_share = static_cast<float>(keys["debris_share"]);
    s.break_share = static_cast<float>(keys["break_share"]);
    s.break_elements = static_cast<uint32_t>(keys["break_elements"]);
    s.debris_elements = static_cast<uint32_t>(keys["debris_elements"]);
    s.debris_seconds = static_cast<float>(keys["debris_s"]);
    s.limits = limits;
    return s;
}

uint64_t Stage::steps_in(double seconds) const {
    return static_cast<uint64_t>(std::llround(std::max(0.0, 1000 * seconds / plan.step_ms)));
}

bool Stage::has_ground() const {
    return std::any_of(props.begin(), props.end(), [](const Prop& prop) { return prop.is_ground; });
}

float Stage::ground_height() const {
    for (const Prop& prop : props)
        if (prop.is_ground) return extent_of(prop.mesh).high.y;
    return 0;
}

Result<void> Stage::read_materials(const std::string& path) {
    if (Result<void> read = cullet::read_materials(path, materials); !read.ok() || plan.materials_path.empty())
        return read;
    return cullet::read_materials(plan.materials_path, materials);
}

Result<World*> Stage::stand() {
    if (world) return &*world;
    Result<World> made = World::create(settings(), host);
    if (!made.ok()) return Error{made.error()};
    world.emplace(std::move(made).value());
    if (!plan.record.empty())
        if (const Result<void> started = world->start_recording(plan.record); !started) return Error{started.error()};
    for (CookedModel& cooked : models) {
        const Result<ModelId> id = world->add_model(cooked.model);
        if (!id.ok()) return Error{id.error()};
        cooked.id = *id;
    }
    return &*world;
}

Result<uint32_t> Stage::cook(const Mesh& mesh, const CookSettings& settings, bool is_strangers) {
    CookedModel cooked;
    {
        Progress progress(fmt::format("{}: cooking", plan.scene.name));
        CookSettings watched = settings;
        watched.materials = &materials;
        watched.progress = &Progress::cooked;
        watched.progress_user = &progress;
        // What the project makes by itself is cooked anew by each program: it changes with the project.
        Result<CachedModel> model = plan.shelf->cook(mesh, watched, is_strangers ? cache_folder() : "");
        if (!model.ok()) return Error{model.error()};
        if (model->is_from_cache) notes.push_back("The cooked model was taken from the cache.");
        if (!model->trouble.empty()) notes.push_back(model->trouble);
        cooked.model = std::move(model->model);
    }
    const float pattern_size = pattern_size_of(settings.material, largest_side(mesh));
    const auto [look, is_new] =
        look_of_material.try_emplace({settings.material, pattern_size}, static_cast<uint32_t>(looks.size()));
    if (is_new) looks.push_back(look_of(settings.material)), looks.back().pattern_size = pattern_size;
    cooked.look = look->second;
    const ModelReport& report = cooked.model.report();
    if (!report.repairs.empty()) notes.push_back(report.repairs);
    if (!report.walls.empty()) notes.push_back(report.walls);
    if (report.inverted_elements + report.crossings > 0)
        notes.push_back(fmt::format("The published way of generation left {} inverted elements and {} crossings.",
                                    report.inverted_elements, report.crossings));
    if (world) {
        const Result<ModelId> id = world->add_model(cooked.model);
        if (!id.ok()) return Error{id.error()};
        cooked.id = *id;
    }
    models.push_back(std::move(cooked));
    return static_cast<uint32_t>(models.size() - 1);
}

void Stage::advise(uint32_t model) {
    CookedModel& cooked = models[model];
    const ModelReport& report = cooked.model.report();
    const Settings own = settings();
    if (cooked.is_advised || report.advice.empty() ||
        report.units_of_a_hit <= hold_units(own.units_a_frame, own.hold_seconds, own.step_seconds))
        return;
    cooked.is_advised = true;
    notes.push_back(report.advice);
}

Result<BodyId> Stage::add_prop(Prop prop) {
    Result<World*> stands = stand();
    if (!stands.ok()) return Error{stands.error()};
    Result<BodyId> id = (*stands)->add_static(view_of(prop.mesh), prop.contact, 0, prop.one_sided);
    if (id.ok()) props.push_back(std::move(prop));
    return id;
}

void Stage::after_step() {
    ++frame;
    const StepEvents step = world->events();
    each_event(step, [&](const char* name, const auto& events) { sums.events[name] += events.count; });
    for (const ImpactEvent& event : step.impacts) sums.events["load"] += event.load > 0;
    for (const RefusedEvent& event : step.refused) ++sums.refused[event.setting];
    for (const FaultEvent& event : step.faults)
        if (sums.faults.size() < kMostFaults)
            sums.faults.push_back(fmt::format("Frame {}, body {}: {}", frame, event.body.index, event.reason));
    for (const SqueezedEvent& event : step.squeezed)
        if (sums.squeezed.empty())
            sums.squeezed =
                fmt::format("Body {} is squeezed by body {} and cannot give way", event.body.index, event.by.index);
    sums.born += step.fragments_born.count;
    broke = step.fragments_born.count + step.debris.count + step.cracks_started.count > 0;
    const uint64_t used = world->report().units_used;
    sums.units_used += used;
    sums.most_units = used > sums.most_units ? used : sums.most_units;
}

}  // namespace cullet
