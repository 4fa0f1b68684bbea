// Case 7: what is conserved.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sample_game/spring_truth.hpp"
#include "sample_game/truth_cases.hpp"

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

}  // namespace

std::vector<Verdict> spinning_shell() {
    std::vector<Verdict> verdicts;
    spin(SpringLayout::OneLayer, "one layer", verdicts);
    spin(SpringLayout::Sandwich, "sandwich", verdicts);
    spin(SpringLayout::Crossed, "the paper's layout", verdicts);
    return verdicts;
}

}  // namespace cullet
