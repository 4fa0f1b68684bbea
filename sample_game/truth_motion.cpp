// Cases 7 and 8: what is conserved, and where a strip tears.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sample_game/spring_truth.hpp"
#include "sample_game/truth_cases.hpp"
#include "systems/springs/spring_lists.hpp"

namespace cullet {
namespace {

/// A sphere that spins and breathes, 10,000 steps without damping.
void spin(SpringLayout layout, const char* name, std::vector<Verdict>& verdicts) {
    SpringSettings settings;
    settings.layout = layout;
    settings.damping_ratio = 0;
    SpringBench bench(bench_sphere(0.1, 3), 0.004, {}, settings);
    const Vec3 velocity{3, -1, 2}, turn{40, 90, -20};
    RigidMotion motion;
    motion.velocity = velocity, motion.spin = turn;
    start_springs(bench.view(), motion);
    const SpringMotion start = motion_of(bench.view());
    const double start_energy = start.kinetic + spring_energy(bench.view());
    double early = 0, late = 0, most = 0;
    constexpr int kSteps = 10000, kSamples = 200;
    for (int s = 0; s < kSamples; ++s) {
        for (int i = 0; i < kSteps / kSamples; ++i) bench.step();
        const double energy = (motion_of(bench.view()).kinetic + spring_energy(bench.view())) / start_energy;
        if (s < kSamples / 4) early += energy / (kSamples / 4);
        if (s >= 3 * kSamples / 4) late += energy / (kSamples / 4);
        most = std::max(most, std::fabs(energy - 1));
    }
    const SpringMotion end = motion_of(bench.view());
    const auto drift = [](Vec3d a, Vec3d b) { return length(b - a) / length(a); };
    verdicts.push_back(
        {fmt::format("{}: drift of momentum, of it", name), drift(start.momentum, end.momentum), 0, 1e-6});
    verdicts.push_back(
        {fmt::format("{}: drift of angular momentum, of it", name), drift(start.angular, end.angular), 0, 1e-5});
    verdicts.push_back({fmt::format("{}: energy, last quarter over first", name), late / early, 0.999, 1.001});
    verdicts.push_back({fmt::format("{}: energy off the start's at most, of it", name), most, 0, 0.02});
}

/// Cuts every spring longer than the limit allows; how many.
uint32_t tear(SpringBench& bench, float limit, std::vector<uint32_t>& torn) {
    const SpringView view = bench.view();
    Springs& springs = bench.state().springs;
    uint32_t count = 0;
    for (uint32_t s = 0; s < view.spring_count(); ++s) {
        const uint32_t row = view.spring(s), a = springs.a[row], b = springs.b[row];
        if (!(springs.stiffness[row] > 0)) continue;
        // The kernel's own figure says whether any spring of the vertex may have passed.
        if (view.largest_strain(a) <= limit && view.largest_strain(b) <= limit) continue;
        const float now = length(view.position(b) - view.position(a));
        if (now / springs.rest_length[row] - 1 <= limit) continue;
        springs.stiffness[row] = springs.damping[row] = 0;
        write_spring(view, s);
        torn.push_back(s);
        ++count;
    }
    return count;
}

struct Tear {
    double strain_over_limit = 0;  // nominal, when the first spring went
    double step_strain = 0;        // nominal strain that a step adds, over the limit
    bool is_at_notch = false;      // all of the first springs
};

/// Both ends drawn apart, slow beside sound; `has_notch`: springs across the middle near both borders are missing.
Tear pull_apart(bool has_notch) {
    const StripSize strip{10, 8, 0.01, 0.002};
    const double half = strip.half_edges * strip.edge, limit = 0.004;
    const auto is_end = [&](Vec3d p) { return std::fabs(p.x) > half - 0.6 * strip.edge; };
    SpringSettings settings;
    settings.damping_ratio = 0.3f;
    SpringBench bench(bench_strip(strip.half_edges, strip.rows, strip.edge), strip.thickness, {}, settings, is_end);
    const SpringView view = bench.view();
    const auto rest = [&](uint32_t v) { return Vec3d(bench.state().vertices.rest[view.shell.vertex(v)]); };
    const auto middle_of = [&](uint32_t s) {
        return 0.5 * (rest(bench.state().springs.a[view.spring(s)]) + rest(bench.state().springs.b[view.spring(s)]));
    };
    if (has_notch)
        for (uint32_t s = 0; s < view.spring_count(); ++s) {
            const Vec3d m = middle_of(s);
            const bool is_near_border = std::min(m.y, strip.width() - m.y) < 1.2 * strip.row_height();
            if (std::fabs(m.x) > 0.3 * strip.edge || !is_near_border) continue;
            bench.state().springs.stiffness[view.spring(s)] = bench.state().springs.damping[view.spring(s)] = 0;
            write_spring(view, s);
        }
    // A twentieth of the limit in a wave's time over the length; sideways the ends contract as the middle does.
    const double sound = std::sqrt(1e7 / 1000), rate = limit / 20 * sound / (2 * half);
    const double axis = strip.width() / 2;
    // Places, not speeds, lead the ends: a step's way rounds to a hundredth of itself.
    const auto drawn = [&](Vec3d p, double strain) {
        return Vec3d((1 + strain) * p.x, p.y - strain / 3 * (p.y - axis), 0).to_float();
    };
    std::vector<uint32_t> ends;
    for (uint32_t v = 0; v < bench.size(); ++v) {
        const Vec3d p = rest(v);
        if (is_end(p)) ends.push_back(v);
        if (!is_end(p)) bench.set_velocity(v, (rate * Vec3d(p.x, (axis - p.y) / 3, 0)).to_float());
    }
    Tear result;
    std::vector<uint32_t> torn;
    result.step_strain = rate * bench.time_step() / limit;
    for (double strain = 0; strain < 2 * limit;) {
        bench.step();
        strain += rate * bench.time_step();
        for (const uint32_t v : ends) view.place(v, drawn(rest(v), strain));
        if (tear(bench, static_cast<float>(limit), torn) == 0) continue;
        result.strain_over_limit = strain / limit;
        break;
    }
    result.is_at_notch = !torn.empty();
    for (const uint32_t s : torn) result.is_at_notch &= std::fabs(middle_of(s).x) <= 1.6 * strip.edge;
    return result;
}

}  // namespace

std::vector<Verdict> spinning_shell() {
    std::vector<Verdict> verdicts;
    spin(SpringLayout::OneLayer, "one layer", verdicts);
    spin(SpringLayout::Sandwich, "sandwich", verdicts);
    spin(SpringLayout::Crossed, "the paper's layout", verdicts);
    return verdicts;
}

std::vector<Verdict> tearing_strip() {
    const Tear whole = pull_apart(false), notched = pull_apart(true);
    // The largest strain is that before the step: the first spring goes one step late, or two.
    return {{"the bench cuts what passes the limit: strain at the first break over it", whole.strain_over_limit,
             1 - whole.step_strain, 1 + 2 * whole.step_strain},
            {"notched: strain at the first break over the limit", notched.strain_over_limit, 0.1, 0.9},
            {"notched: all of the first springs lie at the notch", notched.is_at_notch ? 1.0 : 0.0, 1, 1}};
}

}  // namespace cullet
