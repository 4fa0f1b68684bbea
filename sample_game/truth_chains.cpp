// Cases 3, 4 and 5: chains whose answer is a formula.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sample_game/spring_bench.hpp"
#include "sample_game/truth_cases.hpp"

namespace cullet {
namespace {

constexpr double kPi = 3.14159265358979323846, kGravity = 9.81;

struct Chain {
    std::vector<Vec3d> points;
    std::vector<double> masses;
    std::vector<GivenSpring> springs;

    /// Joins each point to the next; a length of 0 at rest is that of the points.
    void join(double stiffness, double rest = 0) {
        for (uint32_t v = 0; v + 1 < points.size(); ++v) {
            const double l = rest > 0 ? rest : length(points[v + 1] - points[v]);
            springs.push_back({v, v + 1, static_cast<float>(l), static_cast<float>(stiffness)});
        }
    }
};

}  // namespace

// N masses under a fixed point: m g N (N + 1) / (2 k), which is (1 + 1 / N) rho g L^2 / (2 E).
std::vector<Verdict> hanging_chain() {
    constexpr uint32_t kMasses = 20;
    constexpr double kLink = 0.05, kMass = 0.01, kStiffness = 2000;
    Chain chain;
    for (uint32_t v = 0; v <= kMasses; ++v) chain.points.push_back({0, -kLink * v, 0}), chain.masses.push_back(kMass);
    chain.join(kStiffness);
    SpringBench bench(chain.points, chain.masses, chain.springs, {}, [](uint32_t v) { return v == 0; });
    bench.state().shell_springs.gravity.set(bench.springs(), {0, -static_cast<float>(kGravity), 0});
    const double omega = kPi / 2 * std::sqrt(kStiffness / kMass) / kMasses;
    bench.settle(omega, 20 / omega);
    const double elongation = -bench.middle(kMasses).y - kLink * kMasses;
    const double theory = kMass * kGravity * kMasses * (kMasses + 1) / (2 * kStiffness);
    return {{"elongation over m g N (N + 1) / (2 k)", elongation / theory, 0.999, 1.001}};
}

// Span 1, length 1.2; links that stretch by 2e-5 or so. The sags of N links are those of the discrete chain.
std::vector<Verdict> catenary() {
    std::vector<Verdict> verdicts;
    const std::pair<uint32_t, double> known[] = {{10, 0.293864}, {20, 0.292721}, {40, 0.292438}, {80, 0.292367}};
    for (const auto& [links, sag] : known) {
        Chain chain;
        const double depth = std::sqrt(0.6 * 0.6 - 0.5 * 0.5), mass = 0.1 / links;
        for (uint32_t v = 0; v <= links; ++v) {
            const double t = 2.0 * v / links;
            chain.points.push_back({t / 2, t <= 1 ? -depth * t : -depth * (2 - t), 0});
            chain.masses.push_back(mass);
        }
        const double weight = 0.1 * kGravity, stiffness = weight / 2e-5 / (1.2 / links);
        chain.join(stiffness, 1.2 / links);
        const uint32_t last = links;
        SpringBench bench(chain.points, chain.masses, chain.springs, {},
                          [last](uint32_t v) { return v == 0 || v == last; });
        bench.state().shell_springs.gravity.set(bench.springs(), {0, -static_cast<float>(kGravity), 0});
        bench.settle(std::sqrt(kGravity / sag), 2.5);
        double lowest = 0;
        for (uint32_t v = 0; v <= links; ++v) lowest = std::min(lowest, bench.middle(v).y);
        verdicts.push_back({fmt::format("{} links: sag over {}", links, sag), -lowest / sag, 0.999, 1.001});
    }
    return verdicts;
}

namespace {

/// Links a time sqrt(m / k) that the place where the strain is half of that behind it has moved.
double front_speed() {
    constexpr uint32_t kLinks = 400, kFar = 300;
    constexpr double kLink = 0.01, kMass = 0.001, kStiffness = 1000;
    Chain chain;
    for (uint32_t v = 0; v <= kLinks; ++v) chain.points.push_back({kLink * v, 0, 0}), chain.masses.push_back(kMass);
    chain.join(kStiffness);
    SpringSettings settings;
    settings.damping_ratio = 0;
    settings.time_step = static_cast<float>(0.2 * std::sqrt(kMass / kStiffness));
    SpringBench bench(chain.points, chain.masses, chain.springs, settings, [](uint32_t v) { return v == 0; });
    const double unit = std::sqrt(kMass / kStiffness), strain = 0.05, push = strain * kLink / unit;
    bench.set_velocity(0, {static_cast<float>(push), 0, 0});  // what is pinned goes on at its speed
    double before = 0;
    for (double t = 0; t < 2 * kLinks * unit; t += bench.time_step()) {
        bench.step();
        const double now = 1 - (bench.middle(kFar + 1).x - bench.middle(kFar).x) / kLink;
        if (now >= strain / 2) {
            const double part = (strain / 2 - before) / (now - before);
            return (kFar + 0.5) / ((t + part * bench.time_step()) / unit);
        }
        before = now;
    }
    return 0;
}

/// Frequency of a standing wave with `half_waves` on a chain held at both ends, over 2 sqrt(k / m) sin(q l / 2).
double standing_wave(uint32_t half_waves) {
    constexpr uint32_t kLinks = 40;
    constexpr double kLink = 0.01, kMass = 0.001, kStiffness = 1000;
    Chain chain;
    for (uint32_t v = 0; v <= kLinks; ++v) chain.points.push_back({kLink * v, 0, 0}), chain.masses.push_back(kMass);
    chain.join(kStiffness);
    SpringSettings settings;
    settings.damping_ratio = 0;
    const double theory = 2 * std::sqrt(kStiffness / kMass) * std::sin(kPi * half_waves / (2.0 * kLinks));
    settings.time_step = static_cast<float>(0.02 / theory);
    SpringBench bench(chain.points, chain.masses, chain.springs, settings,
                      [](uint32_t v) { return v == 0 || v == kLinks; });
    const auto shape = [&](uint32_t v) { return std::sin(kPi * half_waves * v / kLinks); };
    for (uint32_t v = 1; v < kLinks; ++v)
        bench.set_velocity(v, {static_cast<float>(0.02 * kLink * theory * shape(v)), 0, 0});
    // Sine of the mode's amplitude: crossings downward at half a period and each whole one later.
    const auto amplitude = [&] {
        double sum = 0;
        for (uint32_t v = 1; v < kLinks; ++v) sum += shape(v) * (bench.middle(v).x - kLink * v);
        return sum;
    };
    double before = 0, first = 0;
    int crossings = 0;
    for (double t = 0; crossings < 11; t += bench.time_step()) {
        bench.step();
        const double now = amplitude();
        if (before > 0 && now <= 0) {
            const double at = t + bench.time_step() * before / (before - now);
            if (crossings++ == 0) first = at;
            if (crossings == 11) return 10 * 2 * kPi / (at - first) / theory;
        }
        before = now;
    }
    return 0;
}

}  // namespace

std::vector<Verdict> wave_on_a_chain() {
    std::vector<Verdict> verdicts{{"half-level front speed over l sqrt(k / m), 300 links", front_speed(), 0.99, 1.01}};
    for (const uint32_t half_waves : {10u, 20u, 36u})
        verdicts.push_back({fmt::format("q l = {:.2f} pi: omega over 2 sqrt(k / m) sin(q l / 2)", half_waves / 40.0),
                            standing_wave(half_waves), 0.999, 1.001});
    return verdicts;
}

}  // namespace cullet
