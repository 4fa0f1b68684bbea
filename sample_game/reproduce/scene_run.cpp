#include "sample_game/reproduce/scene_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "components/state.hpp"
#include "sample_game/draw_world.hpp"
#include "sample_game/game_world.hpp"
#include "sample_game/progress.hpp"
#include "systems/world_contents.hpp"

namespace cullet::reproduce {
namespace {

void take_times(const Profiler& profiler, const std::vector<uint8_t>& is_breaking, SceneRun& run) {
    for (uint32_t n = 0; n < profiler.frame_count(); ++n) {
        run.frame_ms.push_back(profiler.frame_ms(n));
        float rigid = 0;
        for (uint32_t zone = 0; zone < profiler.zone_count(); ++zone) {
            const std::string name = profiler.zone_name(zone);
            if (name == "detect_contacts" || name == "solve_rigid") rigid += profiler.zone_ms(n, zone);
        }
        run.rigid_ms.push_back(rigid);
        if (n < is_breaking.size() && is_breaking[n]) run.breaking_ms.push_back(run.frame_ms.back());
    }
}

void count_pieces(GameWorld& game, SceneRun& run) {
    const State& state = game.world().contents().data.state;
    double all = 0, largest = 0, debris = 0;
    for (uint32_t b = 0; b < state.bodies.size(); ++b) {
        if (state.bodies.kind[b] == static_cast<uint8_t>(BodyKind::Free) || !state.bodies.structure[b].exists())
            continue;
        ++run.pieces;
        all += state.bodies.mass[b];
        largest = std::max(largest, static_cast<double>(state.bodies.mass[b]));
    }
    for (uint32_t d = 0; d < state.debris.size(); ++d)
        if (state.debris.is_used[d]) debris += state.debris.mass[d], ++run.debris;
    all += debris;
    run.largest = all > 0 ? largest / all : 0;
    run.debris_share = all > 0 ? debris / all : 0;
    run.mass_put_in = game.mass_put_in();
    run.mass_at_end = measure_matter(game.world()).mass;
    for (uint32_t s = 0; s < state.soft_bodies.size(); ++s)
        if (state.soft_bodies.is_used[s]) run.tears += state.soft_bodies.tear_count[s];
    run.late = game.world().contents().data.counts.late;
    run.dropped = game.world().contents().data.counts.dropped;
}

}  // namespace

Result<SceneRun> run_scene(Bench& bench, const ScenePlay& play) {
    ScenePlan plan;
    plan.scene = {play.name, play.name + ".lua", play.lua};
    plan.set = play.set;
    plan.threads = bench.threads();
    plan.shelf = bench.shelf();
    Result<GameWorld> made = GameWorld::create(plan);
    if (!made.ok()) return Error{made.error()};
    GameWorld& game = made.value();
    SceneRun run;
    if (!game.stage().models.empty()) {
        run.vertices = game.stage().models[0].model.report().vertices;
        run.triangles = game.stage().models[0].model.report().elements;
    }
    std::vector<uint8_t> is_breaking;
    Progress progress(play.name);
    for (uint32_t frame = 0; frame <= play.frames; ++frame) {
        if (std::find(play.drawn.begin(), play.drawn.end(), frame) != play.drawn.end())
            run.pictures.push_back(
                draw_world(game, game.stage().camera, PictureLook::Pieces, bench.threads(), bench.picture_width()));
        if (frame == play.frames) break;
        game.before_step();
        game.step();
        game.after_step();
        if (!game.failure().empty()) return Error{game.failure()};
        is_breaking.push_back(game.broke() || game.world().report().units_used > 0);
        progress.show(static_cast<double>(frame + 1) / play.frames);
    }
    take_times(game.world().contents().profiler, is_breaking, run);
    count_pieces(game, run);
    run.notes = game.stage().notes;
    return run;
}

double mean_piece(const SceneRun& run) {
    if (run.pieces < 2) return 0;
    return (1 - run.largest - run.debris_share) / static_cast<double>(run.pieces - 1);
}

double frame_rate(const SceneRun& run) {
    if (run.breaking_ms.empty()) return 0;
    const double sum = std::accumulate(run.breaking_ms.begin(), run.breaking_ms.end(), 0.0);
    return sum > 0 ? 1000 * static_cast<double>(run.breaking_ms.size()) / sum : 0;
}

double percentile_of(std::vector<float> values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const auto rank = static_cast<size_t>(std::ceil(share * static_cast<double>(values.size())));
    return static_cast<double>(values[std::clamp<size_t>(rank, 1, values.size()) - 1]);
}

std::string filled(std::string text, const std::string& name, const std::string& value) {
    const std::string place = "@" + name + "@";
    for (size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + value.size()))
        text.replace(at, place.size(), value);
    return text;
}

}  // namespace cullet::reproduce
