// Cases 5, 6 and 9: how deep dents are, what shape they have, and fifty of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sample_game/metal/metal_bench.hpp"
#include "sample_game/metal/truth_metal.hpp"
#include "systems/models/metal_shell/dent/raise_body.hpp"
#include "systems/models/metal_shell/dent/raise_sheet.hpp"

namespace cullet {
namespace {

constexpr double kWidth = 1.2, kHeight = 0.8, kBall = 0.145, kSupport = 0.4, kBallMass = 100;  // m, kg
constexpr double kSheetMass = 7850 * kWidth * kHeight * 1e-3;
constexpr double kMostStretch = 0.25, kMostShortening = 0.4;  // of steel

const Model& panel() {
    static const Model kModel = cook_metal_mesh(metal_sheet(kWidth, kHeight, 120, 80), "steel", 1e-3).value();
    return kModel;
}

class Random {
 public:
    explicit Random(uint64_t seed) : state_(seed) {}
    double operator()() {
        state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<double>(state_ >> 11) / 9007199254740992.0;
    }

 private:
    uint64_t state_;
};

struct Hits {
    StretchCount stretch;
    uint32_t turned = 0;
    double depth = 0;
    bool is_finite = true;
};
Hits fifty_hits(uint8_t published, uint64_t seed) {
    MetalCookSettings settings;
    settings.cells.count = 128, settings.published = published;
    MetalBench bench(panel(), &settings);
    bench.clamp();
    Random random(seed);
    for (int hit = 0; hit < 50; ++hit) {
        const double x = (random() - 0.5) * (kWidth - 0.3), y = (random() - 0.5) * (kHeight - 0.3);
        bench.hit(bench.ball_over(x, y, kBall), 1200);
    }
    return {bench.stretch(kMostStretch, kMostShortening), bench.turned_triangles(), -bench.lowest(), bench.is_finite()};
}

double share_out(const StretchCount& count) {
    return static_cast<double>(count.outside) / std::max(1u, count.edges);
}

}  // namespace

std::vector<Verdict> metal_depth() {
    struct Row {
        bool is_clamped;
        double speed, depth;
    };
    std::vector<Verdict> verdicts;
    for (const Row& row : {Row{true, 1, 8.8e-3}, Row{true, 2, 21.0e-3}, Row{true, 5, 55.9e-3}, Row{true, 10, 110e-3},
                           Row{false, 5, 13.0e-3}, Row{false, 10, 30.5e-3}}) {
        MetalBench bench(panel());
        bench.set_yield(250e6);
        if (row.is_clamped) bench.clamp();
        // The note's depths are of what the restitution of 0.2 takes.
        const double mass = row.is_clamped ? kBallMass : kBallMass * kSheetMass / (kBallMass + kSheetMass);
        const double energy = 0.96 * 0.5 * mass * row.speed * row.speed;
        const Striker ball = bench.ball_over(0, 0, kBall);
        bench.hit(ball, 1e-9);
        const SheetPlace place = find_sheet_place(bench.view(), ball);
        const SheetPlan plan = plan_sheet(sheet_metal(bench.view()), {kBall, place.support, energy, 0});
        bench.hit(ball, energy);
        const std::string name = fmt::format("{}, {} m/s", row.is_clamped ? "clamped" : "free", row.speed);
        verdicts.push_back({name + ": planned depth over the note's", plan.depth / row.depth, 0.99, 1.01});
        verdicts.push_back({name + ": depth on the mesh over the planned", -bench.lowest() / plan.depth, 0.97, 1.03});
    }
    return verdicts;
}

std::vector<Verdict> metal_obstacle() {
    MetalBench bench(panel());
    bench.clamp();
    const Striker ball = bench.ball_over(0, 0, kBall);
    bench.hit(ball, 1e-9);
    const MetalView metal = bench.view();
    const SheetPlan plan = plan_sheet(sheet_metal(metal), {kBall, kSupport, 1200, 0});
    raise_body(metal, ball, plan.depth, kSupport);
    // The distance at which a field has fallen to a half, by the vertices along x.
    double most = 0, ours = 0, far = 1e30;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        most = std::max(most, double{metal.vertices().field[metal.vertex(v)]});
    double last = 0, last_field = most;
    for (int k = 1; k < 60; ++k) {
        const double x = k * kWidth / 120;
        double field = 0, nearest = 1e30;
        for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
            const Vec3d p(bench.original(v));
            const double away = std::hypot(p.x - x, p.y);
            if (away < nearest) nearest = away, field = double{metal.vertices().field[metal.vertex(v)]};
        }
        if (field < 0.5 * most && far > 1) {
            far = x;
            ours = last + (x - last) * (last_field - 0.5 * most) / (last_field - field);
        }
        last = x, last_field = field;
    }
    double half = 0;
    while (profile(plan, kBall, half) > 0.5 * plan.depth) half += 1e-4;
    return {{"peak of the obstacle's field over that of the profile", most / plan.depth, 0.97, 1.03},
            {"radius at half of the depth, obstacle over profile", ours / half, 0.97, 1.03}};
}

// What hits lie beside each other decides how deep they dig: so the middle of five times fifty places counts.
std::vector<Verdict> metal_fifty_hits() {
    std::vector<double> longest, depth;
    uint32_t turned = 0, bad = 0;
    double out = 0;
    for (uint64_t seed = 1; seed <= 5; ++seed) {
        const Hits hits = fifty_hits(0, seed);
        longest.push_back(hits.stretch.longest), depth.push_back(hits.depth);
        turned += hits.turned, bad += !hits.is_finite;
        out = std::max(out, share_out(hits.stretch));
    }
    std::sort(longest.begin(), longest.end()), std::sort(depth.begin(), depth.end());
    const Hits published = fifty_hits(kAllPublished, 1);
    return {{"ours: numbers that are none", static_cast<double>(bad), 0, 0},
            {"ours: triangles turned over, five runs", static_cast<double>(turned), 0, 0},
            {"ours: longest edge over what it was, middle of five", longest[2], 1, 1.18},
            {"ours: deepest place, m, middle of five", depth[2], 0.082, 0.102},
            {"ours: share of edges out of limits, worst of five", out, 0, 0.003},
            {"as published: share of edges out of limits", share_out(published.stretch), 0.1, 1},
            {"as published: triangles turned over", static_cast<double>(published.turned), 100, 1e9}};
}

}  // namespace cullet
