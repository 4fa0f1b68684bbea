// Metal shells: cutting into sub-shells, in Embree builds of the mesh; one impact, in passes of the plain spring loop
// over the region that it reaches; and a frame without impacts, beside the same body that cannot be dented.
#include <algorithm>
#include <cstdio>

#include "cullet/world.hpp"
#include "perf/perf.hpp"
#include "perf/springs.hpp"
#include "sample_game/generation_figures.hpp"
#include "sample_game/metal/metal_bench.hpp"
#include "sample_game/metal/metal_car.hpp"
#include "sample_game/run_scene.hpp"

namespace cullet::perf {
namespace {

constexpr uint32_t kCells = 128;

template <class Call>
double least_seconds(uint32_t rounds, Call call) {
    double least = 1e30;
    for (uint32_t round = 0; round < rounds; ++round) least = std::min(least, call());
    return least;
}

Mesh mesh_of(const MetalBench& metal) {
    Mesh mesh;
    mesh.name = "metal";
    for (uint32_t v = 0; v < metal.view().vertex_count(); ++v) mesh.positions.push_back(metal.original(v));
    for (uint32_t e = 0; e < metal.view().element_count(); ++e) mesh.triangles.push_back(metal.view().corners(e));
    return mesh;
}

bool measure_cells(const MetalBench& car, uint32_t rounds, Figures& figures) {
    const Mesh mesh = mesh_of(car);
    const Result<Surface> surface = prepare_surface(mesh);
    if (!surface.ok()) return std::printf("%s\n", surface.error().c_str()), false;
    const double build = embree_build(mesh, 20 * rounds);
    Segmentation cells;
    SubShellSettings settings;
    settings.count = kCells;
    const double cut = least_seconds(rounds, [&] {
        return seconds([&] { cells = find_sub_shells(*surface, build_dual_graph(*surface), settings); });
    });
    figures.add("car: triangles", static_cast<double>(mesh.triangles.size()), "");
    figures.add_ratio("car: 128 sub-shells, in Embree builds", 1e3 * cut, 1e3 * build, "ms", 300);
    double rise = 0;
    for (size_t k = 1; k < cells.sums.size(); ++k) rise = std::max(rise, cells.sums[k] / cells.sums[k - 1] - 1);
    return rise <= 1e-12;
}

/// Vertices that the last impact moved, and the edges between them.
SpringNet region_of(const MetalBench& metal) {
    const MetalView view = metal.view();
    std::vector<uint32_t> number(view.vertex_count(), 0xffffffffu);
    SpringNet net;
    for (uint32_t v = 0; v < view.vertex_count(); ++v) {
        if (!(view.vertices().field[view.vertex(v)] > 0)) continue;
        number[v] = static_cast<uint32_t>(net.points.size());
        net.points.push_back(metal.original(v));
    }
    for (uint32_t v = 0; v < view.vertex_count(); ++v)
        view.for_each_spring(v, [&](uint32_t other, uint32_t spring) {
            if (other < v || number[v] == 0xffffffffu || number[other] == 0xffffffffu) return;
            if (!view.springs().is_tie[spring]) net.springs.push_back({number[v], number[other]});
        });
    net.stiffness = 1e3f, net.damping = 1, net.mass = 0.01f, net.dt = 1e-5f;
    return net;
}

struct Blow {
    const char* name;
    const Model* model;
    bool is_clamped;
    double crush_pressure;
    StrikerShape shape;
    Vec3d push;
    double energy;
};
/// ms of one impact. `net`: the region that it reached.
double impact_ms(const Blow& blow, uint32_t rounds, SpringNet& net) {
    return 1e3 * least_seconds(rounds, [&] {
               MetalBench metal(*blow.model);
               if (blow.is_clamped) metal.clamp();
               if (blow.crush_pressure > 0) metal.set_crush_pressure(blow.crush_pressure);
               Striker striker;
               striker.shape = blow.shape, striker.push = blow.push, striker.axis = {0, 1, 0}, striker.radius = 0.145;
               Vec3d middle;
               for (uint32_t v = 0; v < metal.view().vertex_count(); ++v)
                   middle += (1.0 / metal.view().vertex_count()) * Vec3d(metal.original(v));
               striker.point = middle - 10.0 * blow.push;
               double least = 1e30;
               for (uint32_t v = 0; v < metal.view().vertex_count(); ++v)
                   least = std::min(least, striker.gap(Vec3d(metal.place(v))));
               striker.point += least * blow.push;
               const double spent = seconds([&] { metal.hit(striker, blow.energy); });
               net = region_of(metal);
               return spent;
           });
}

/// Seconds of a step of a world in which a car drifts, which nothing meets.
double quiet_frame(bool is_breakable) {
    Settings settings;
    settings.gravity = {};
    settings.threads = 1;
    Result<World> world = World::create(settings);
    if (!world.ok()) return 0;
    const Result<ModelId> model = world->add_model(even_car());
    SpawnSettings spawn;
    spawn.is_breakable = is_breakable;
    spawn.motion = {{1, 0, 0}, {0, 0.5f, 0}};
    if (!model.ok() || !world->spawn(*model, spawn).ok()) return 0;
    for (int frame = 0; frame < 20; ++frame) world->step();
    constexpr int kFrames = 200;
    return seconds([&] {
               for (int frame = 0; frame < kFrames; ++frame) world->step();
           }) /
           kFrames;
}

/// Cars of scene `car` that crash, each frame the least of its runs.
bool measure_crash(uint32_t rounds, Figures& figures) {
    RunOptions options;
    options.scene = "car";
    options.threads = 2;
    options.repeat = rounds;
    options.frames = 60;
    options.hash = HashWhen::Last;
    const Result<Report> played = play(plan_scene(*find_scene("car"), options), options);
    if (!played.ok()) return std::printf("%s\n", played.error().c_str()), false;
    figures.add("crash of four cars, 2 threads: frame, worst", static_cast<double>(played->frame_ms.max), "ms");
    figures.add("crash of four cars, 2 threads: hitch", played->hitch, "x", 2);
    return played->repeats_agree;
}

}  // namespace

bool measure_metal(const Options& options, Figures& figures) {
    const uint32_t rounds = options.rounds_of_a_pass(6);
    MetalBench car(even_car());
    const bool is_good = measure_cells(car, std::min(rounds, 2u), figures);
    const Model panel = cook_metal_mesh(metal_sheet(1.2, 0.8, 120, 80), "steel", 1e-3).value(),
                fine = cook_metal_mesh(metal_sheet(1.2, 0.8, 240, 160), "steel", 1e-3).value();
    const Blow blows[] = {
        {"panel, ball of 1,200 J", &panel, true, 0, StrikerShape::Sphere, {0, 0, -1}, 1200},
        {"panel of four times the triangles", &fine, true, 0, StrikerShape::Sphere, {0, 0, -1}, 1200},
        {"car, wall at 10 m/s", &even_car(), false, kCarPressure, StrikerShape::Plane, {-1, 0, 0}, 5e4},
        {"car, pole at 10 m/s", &even_car(), false, kCarPressure, StrikerShape::Cylinder, {-1, 0, 0}, 5e4}};
    double first = 0;
    for (const Blow& blow : blows) {
        SpringNet net;
        const double ms = impact_ms(blow, rounds, net);
        PlainSprings plain(net, net.points);
        constexpr int kPasses = 50;
        const double pass = least_seconds(rounds,
                                          [&] {
                                              return seconds([&] {
                                                  for (int step = 0; step < kPasses; ++step) plain.step();
                                              });
                                          }) /
                            kPasses;
        figures.add(std::string(blow.name) + ": vertices reached", static_cast<double>(net.points.size()), "");
        figures.add_ratio(std::string(blow.name) + ": in passes of the plain spring loop", ms, 1e3 * pass, "ms", 60);
        if (blow.model == &panel) first = ms;
        if (blow.model == &fine)
            figures.add_ratio("panel: a triangle, four times as many over as many", ms / 4, first, "ms", 1.5);
    }
    double ours = 1e30, theirs = 1e30;  // by turns: both meet the same noise
    for (uint32_t round = 0; round < rounds; ++round) {
        ours = std::min(ours, quiet_frame(true));
        theirs = std::min(theirs, quiet_frame(false));
    }
    figures.add_ratio("a frame without impacts beside a rigid body", 1e3 * ours, 1e3 * theirs, "ms", 1.1);
    return measure_crash(rounds, figures) && is_good;
}

}  // namespace cullet::perf
