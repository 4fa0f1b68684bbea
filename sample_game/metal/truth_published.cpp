// Cases 1, 2 and 8: what formulas say of the published method.
#include <fmt/format.h>

#include <cmath>

#include "sample_game/metal/metal_bench.hpp"
#include "sample_game/metal/truth_metal.hpp"
#include "systems/models/metal_shell/published/hit_cells.hpp"
#include "systems/models/metal_shell/published/penalty.hpp"
#include "systems/models/metal_shell/published/pull_edges.hpp"

namespace cullet {

// A ball of 1 kg from 0.5 m on a plate that stands fast: it comes back to e^2 of that.
std::vector<Verdict> metal_bounce() {
    constexpr double kGravity = 9.81, kHeight = 0.5;
    const auto height_over = [](double e, uint32_t steps, bool splits) {
        PenaltyContact contact;
        contact.speed = std::sqrt(2 * kGravity * kHeight);
        contact.recede = e * e;
        contact.steps = steps, contact.splits_turn = splits;
        const double back = press(contact).rebound;
        return back * back / (2 * kGravity) / (e * e * kHeight);
    };
    std::vector<Verdict> verdicts;
    for (const auto& [name, e] : {std::pair{"steel", 0.2}, {"aluminium", 0.15}, {"copper", 0.1}}) {
        verdicts.push_back({fmt::format("{}: height over {:.4g} H, 40 steps, the turn in two", name, e * e),
                            height_over(e, 40, true), 0.95, 1.05});
        verdicts.push_back({fmt::format("{}: height over {:.4g} H, 200 plain steps", name, e * e),
                            height_over(e, 200, false), 0.95, 1.05});
    }
    return verdicts;
}

// A plate of one sub-shell: centre and moment are those of a box.
std::vector<Verdict> metal_single_cell() {
    constexpr double kA = 0.3, kB = 0.2, kThick = 0.002, kImpulse = 0.7, kTime = 1e-3, kAside = 0.05;
    const Result<Model> model = cook_metal_mesh(metal_sheet(kA, kB, 12, 8), "steel", kThick);
    if (!model.ok()) return {{model.error(), 1, 0, 0}};
    MetalCookSettings settings;
    settings.cells.count = 1;
    MetalBench bench(*model, &settings);
    bench.hit(bench.ball_over(0, 0, 0.1), 1e-9);  // fills the shape at the start, and moves nothing
    const CellMass of = mass_of_cell(bench.view(), 0);
    const double mass = 7850 * kA * kB * kThick;
    const Vec3d impulse(0, 0, -kImpulse);
    const CellMove middle = move_of_cell(of.mass, of.inertia, impulse, {}, kTime);
    const Vec3d arm(kAside, 0, 0);
    const CellMove beside = move_of_cell(of.mass, of.inertia, impulse, cross(arm, impulse), kTime);
    const double turn = kTime * 12 * kImpulse * kAside / (mass * (kA * kA + kThick * kThick));
    return {
        {"sub-shells", static_cast<double>(bench.view().cell_count()), 1, 1},
        {"mass over that of the plate", of.mass / mass, 0.999999, 1.000001},
        {"hit at the middle: way over tau J / m", length(middle.way) / (kTime * kImpulse / mass), 0.999999, 1.000001},
        {"hit at the middle: rotation, rad", length(middle.turn), 0, 1e-12},
        {"hit beside it: rotation over tau 12 J s / (m (a^2 + h^2))", length(beside.turn) / turn, 0.9999, 1.0001}};
}

// An edge from (0, 0) to (1, 0) whose end was pushed to (1, -0.8), at most a tenth longer. The third corner of its
// triangle is held where neither way to the end asks for anything.
std::vector<Verdict> metal_strain_limit() {
    Mesh mesh;
    mesh.name = "edge";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {3.87f, -0.947f, 0}};
    mesh.triangles = {{0, 2, 1}};
    const Result<Model> model = cook_metal_mesh(mesh, "steel", 1e-3);
    if (!model.ok()) return {{model.error(), 1, 0, 0}};
    const auto limited = [&](bool is_published) {
        MetalBench bench(*model);
        bench.hold([](Vec3 p) { return !(std::fabs(p.x - 1) < 1e-5f); });
        const MetalView metal = bench.view();
        Vec3 end;
        bench.hit(bench.ball_over(1, 0, 0.1), 1e-9);
        for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
            if (metal.is_pinned(v)) continue;
            metal.vertices().place.set(metal.vertex(v), {1, -0.8f, 0});
            metal.vertices().field[metal.vertex(v)] = 0.8f;
            for (int round = 0; round < 60; ++round)
                is_published ? cut_long_edges(metal, 0.1) : relax_once(metal, 0.1f);
            end = metal.vertices().place[metal.vertex(v)];
        }
        return end;
    };
    const Vec3 ours = limited(false), published = limited(true);
    return {{"ours: x of the end", double{ours.x}, 0.858, 0.860},
            {"ours: y of the end", double{ours.y}, -0.688, -0.686},
            {"as published: x of the end", double{published.x}, 1.0999, 1.1001},
            {"as published: y of the end, so that the push is gone", double{published.y}, -1e-6, 1e-6}};
}

}  // namespace cullet
