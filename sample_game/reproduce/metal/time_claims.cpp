// What it costs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/state.hpp"
#include "cullet/world.hpp"
#include "sample_game/metal/metal_car.hpp"
#include "sample_game/reproduce/metal/metal_claims.hpp"
#include "sample_game/reproduce/metal/metal_drawn.hpp"
#include "systems/world_contents.hpp"

namespace cullet::reproduce {
namespace {

/// So many balls meet a panel at once, in a world.
struct Shower {
    uint32_t balls = 0;
    uint64_t contacts = 0;              // in the frame that took longest
    double worst_ms = 0, plain_ms = 0;  // of a frame with contacts; of one without
};
Result<Shower> play_shower(Bench& bench, const Model& panel, uint32_t balls) {
    cullet::Settings settings;
    settings.threads = bench.threads();
    settings.gravity = {0, 0, 0};
    settings.units_a_frame = 2'000'000'000;
    Result<World> made = World::create(settings);
    if (!made.ok()) return Error{made.error()};
    World& world = *made;
    const Result<ModelId> model = world.add_model(panel);
    if (!model.ok()) return Error{model.error()};
    constexpr float kHalfX = 0.6f, kHalfY = 0.4f, kRim = 0.002f, kOut = 2;
    const Box pins[] = {{{-kOut, -kOut, -kOut}, {-kHalfX + kRim, kOut, kOut}},
                        {{kHalfX - kRim, -kOut, -kOut}, {kOut, kOut, kOut}},
                        {{-kOut, -kOut, -kOut}, {kOut, -kHalfY + kRim, kOut}},
                        {{-kOut, kHalfY - kRim, -kOut}, {kOut, kOut, kOut}}};
    SpawnSettings spawn;
    spawn.pins = pins, spawn.pin_count = 4;
    if (const Result<BodyId> sheet = world.spawn(*model, spawn); !sheet.ok()) return Error{sheet.error()};
    const auto columns = static_cast<uint32_t>(std::ceil(std::sqrt(1.5 * balls)));
    const uint32_t rows = (balls + columns - 1) / columns;
    for (uint32_t b = 0; b < balls; ++b) {
        SphereSettings ball;
        ball.radius = 0.03f, ball.mass = 2;
        ball.contact.friction = 0.4f;
        ball.pose.position = {1.0f * ((static_cast<float>(b % columns) + 0.5f) / static_cast<float>(columns) - 0.5f),
                              0.6f * ((static_cast<float>(b / columns) + 0.5f) / static_cast<float>(rows) - 0.5f),
                              0.25f};
        ball.motion.velocity = {0, 0, -8};
        if (const Result<BodyId> added = world.add_sphere(ball); !added.ok()) return Error{added.error()};
    }
    Shower shower;
    shower.balls = balls;
    for (int frame = 0; frame < 12; ++frame) {
        const double start = seconds_now();
        world.step();
        const double ms = 1e3 * (seconds_now() - start);
        const uint64_t contacts = world.contents().data.rigid->contacts().size();
        if (frame == 0) shower.plain_ms = ms;
        if (contacts == 0) shower.plain_ms = std::min(shower.plain_ms, ms);
        if (ms > shower.worst_ms) shower.worst_ms = ms, shower.contacts = contacts;
    }
    return shower;
}

}  // namespace

Result<Claim> metal_figure_8(Bench& bench) {
    Claim claim;
    claim.id = "figure_8";
    claim.where = "Figure 8, section 7";
    claim.title = "Run time grows steadily with the number of colliding points";
    claim.paper =
        "A curve without a table: time a frame grows slowly with the number of colliding points; the extra cost of "
        "moving sub-shells is small beside collision detection and springs.";
    const bool is_small = bench.settings().is_reduced;
    const Result<Model> panel =
        cook_metal_mesh(metal_sheet(1.2, 0.8, is_small ? 48 : 120, is_small ? 32 : 80), "steel", 1e-3);
    if (!panel.ok()) return Error{panel.error()};
    Table table{"Balls of 2 kg at 8 m/s that meet the panel of figure 7 at once; the longest of twelve frames",
                {{"balls", "contacts in it", "ms", "frame without contacts, ms"}}};
    PlotLine line{"longest frame", {}, {}, false}, plain{"without contacts", {}, {}, true};
    for (const uint32_t balls : {1u, 2u, 4u, 8u, 16u, 32u, 64u}) {
        if (is_small && balls > 8) break;
        Shower best;
        for (int repeat = 0; repeat < (is_small ? 1 : 3); ++repeat) {
            const Result<Shower> shower = play_shower(bench, *panel, balls);
            if (!shower.ok()) return Error{shower.error()};
            if (repeat == 0 || shower->worst_ms < best.worst_ms) best = *shower;
        }
        table.rows.push_back({fmt::format("{}", balls), fmt::format("{}", best.contacts),
                              fmt::format("{:.2f}", best.worst_ms), fmt::format("{:.3f}", best.plain_ms)});
        line.x.push_back(balls), line.y.push_back(best.worst_ms);
        plain.x.push_back(balls), plain.y.push_back(best.plain_ms);
    }
    if (auto added = add_plot(bench, claim, {"balls that touch at once", "ms a frame", {line, plain}}, "time",
                              "Frames of a world, collision and drawing included");
        !added.ok())
        return Error{added.error()};
    const double growth = line.y.back() / line.y.front();
    claim.numbers = {{fmt::format("{:.0f} points over one", line.x.back()), "", growth, {}},
                     {"longest frame with one point", "ms", line.y.front(), {}},
                     {fmt::format("longest frame with {:.0f} points", line.x.back()), "ms", line.y.back(), {}}};
    claim.tables.push_back(std::move(table));
    claim.ours = fmt::format("{:.0f} times the points cost {:.1f} times the frame. Met means at most as many times.",
                             line.x.back(), growth);
    claim.verdict = growth <= line.x.back() ? Verdict::Met : Verdict::FallsShort;
    return claim;
}

Result<Claim> metal_real_time(Bench& bench) {
    Claim claim;
    claim.id = "real_time";
    claim.where = "Section 7";
    claim.title = "24 frames a second while vertices do not exceed 26,500";
    claim.paper =
        "Real time (24 frames a second) as long as there are at most 26,500 vertices; the machine is not named.";
    Table table{"Displacement, creases, limits and the write-back of one impact, one thread",
                {{"shell", "triangles", "impact", "ms"}}};
    double slowest = 0;
    const auto time = [&](MetalBench& shell, const Striker& striker, double energy, const char* name,
                          const char* impact) {
        const double start = seconds_now();
        shell.hit(striker, energy);
        const double ms = 1e3 * (seconds_now() - start);
        slowest = std::max(slowest, ms);
        table.rows.push_back(
            {name, fmt::format("{}", shell.view().element_count()), impact, fmt::format("{:.1f}", ms)});
    };
    Result<MetalBench> panel = paper_panel(bench, 0);
    if (!panel.ok()) return Error{panel.error()};
    time(*panel, panel->ball_over(0, 0, 0.145), 1200, "panel", "ball, 1,200 J");
    for (const auto& [impact, shape] :
         {std::pair{"wall, 10 m/s", StrikerShape::Plane}, {"pole, 10 m/s", StrikerShape::Cylinder}}) {
        std::optional<MetalBench> car = paper_car(bench, 0);
        if (car) time(*car, coming(*car, shape, {0, 0, -1}, 0.15, {0, 0, 10}), 5e4, "car", impact);
    }
    claim.tables.push_back(std::move(table));
    claim.numbers = {{"slowest impact", "ms", slowest, 1000.0 / 24}};
    claim.ours =
        "A frame without an impact costs what a rigid body costs. Met means that the slowest impact is shorter than "
        "a frame of 24 a second.";
    claim.verdict = slowest < 1000.0 / 24 ? Verdict::Met : Verdict::FallsShort;
    return claim;
}

}  // namespace cullet::reproduce
