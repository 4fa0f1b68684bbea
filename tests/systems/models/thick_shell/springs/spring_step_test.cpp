// One step of springs against plain loops, conservation laws and formulas, at every SIMD level and number of threads.
#include <gtest/gtest.h>

#include <memory>

#include "components/state.hpp"
#include "engine/jobs.hpp"
#include "engine/random.hpp"
#include "engine/simd.hpp"
#include "sample_game/spring_bench.hpp"
#include "systems/models/thick_shell/springs/spring_lists.hpp"
#include "systems/models/thick_shell/springs/spring_loop.hpp"
#include "systems/models/thick_shell/springs/spring_packs.hpp"

namespace cullet::test {
namespace {

constexpr SpringLayout kLayouts[] = {SpringLayout::OneLayer, SpringLayout::Sandwich, SpringLayout::Crossed};
/// And with what shares of E h A areas and volumes are kept (B4).
constexpr std::pair<SpringLayout, float> kLayoutsAndEnergies[] = {
    {SpringLayout::OneLayer, 0.0f}, {SpringLayout::OneLayer, 0.5f}, {SpringLayout::Sandwich, 0.0f},
    {SpringLayout::Sandwich, 0.5f}, {SpringLayout::Crossed, 0.0f},  {SpringLayout::Crossed, 0.5f}};

SpringSettings settings_of(SpringLayout layout, float damping = 0.05f) {
    SpringSettings settings;
    settings.layout = layout;
    settings.damping_ratio = damping;
    return settings;
}

SpringBench make_ball(SpringLayout layout, float damping = 0.05f, int rounds = 2, float energy = 0) {
    SpringSettings settings = settings_of(layout, damping);
    settings.area_energy = settings.volume_energy = energy;
    return SpringBench(bench_sphere(0.1, rounds), 0.006, {}, settings);
}

/// Moves every point about its place by up to `size`, and gives it some speed.
void shake(SpringBench& bench, double size, double speed, uint64_t seed = 3) {
    const Random random{seed};
    const SpringView view = bench.view();
    for (uint32_t v = 0; v < bench.size(); ++v) {
        const auto r = [&](uint64_t k, double by) {
            const auto one = [&](uint64_t c) { return by * (2 * random.uniform(v, 3 * k + c) - 1); };
            return Vec3d(one(0), one(1), one(2)).to_float();
        };
        view.place(v, view.position(v) + r(0, size));
        bench.state().vertices.velocity.set(view.shell.vertex(v), r(1, speed));
        if (!view.has_layers()) continue;
        view.place_twin(v, view.twin_position(v) + r(2, size));
        bench.state().twins.velocity.set(view.twin(v), r(3, speed));
    }
}

/// Places of all points, outer then inner.
std::vector<Vec3d> points_of(SpringBench& bench) {
    std::vector<Vec3d> points;
    const SpringView view = bench.view();
    for (uint32_t v = 0; v < bench.size(); ++v) points.push_back(Vec3d(view.position(v)));
    for (uint32_t v = 0; v < bench.size() && view.has_layers(); ++v) points.push_back(Vec3d(view.twin_position(v)));
    return points;
}
std::vector<Vec3d> speeds_of(SpringBench& bench) {
    std::vector<Vec3d> speeds;
    const SpringView view = bench.view();
    for (uint32_t v = 0; v < bench.size(); ++v) speeds.push_back(Vec3d(bench.velocity(v)));
    for (uint32_t v = 0; v < bench.size() && view.has_layers(); ++v)
        speeds.push_back(Vec3d(bench.state().twins.velocity[view.twin(v)]));
    return speeds;
}

/// Energy of the springs with point p moved: what a force is the slope of.
double energy_with(SpringBench& bench, uint32_t p, Vec3d at) {
    const SpringView view = bench.view();
    const bool is_outer = p < bench.size();
    const uint32_t v = is_outer ? p : p - bench.size();
    const Vec3 before = is_outer ? view.position(v) : view.twin_position(v);
    const auto put = [&](Vec3 to) { is_outer ? view.place(v, to) : view.place_twin(v, to); };
    put(at.to_float());
    const double energy = spring_energy(view);
    put(before);
    return energy;
}

TEST(SpringStep, PushesAsTheSlopeOfTheEnergyDoes) {
    for (const SpringLayout layout : kLayouts) {
        SpringBench bench = make_ball(layout, 0);
        shake(bench, 2e-3, 0);
        const std::vector<Vec3d> points = points_of(bench);
        constexpr double kMove = 1e-4;
        std::vector<Vec3d> slope(points.size());
        double largest = 0;
        for (uint32_t p = 0; p < points.size(); ++p) {
            const auto along = [&](Vec3d axis) {
                return -(energy_with(bench, p, points[p] + kMove * axis) -
                         energy_with(bench, p, points[p] - kMove * axis)) /
                       (2 * kMove);
            };
            slope[p] = {along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})};
            largest = std::max(largest, length(slope[p]));
        }
        bench.step();
        const std::vector<Vec3d> speed = speeds_of(bench);
        for (uint32_t p = 0; p < points.size(); ++p) {
            const uint32_t v = p % bench.size();
            const double mass =
                bench.state().vertices.mass[bench.view().shell.vertex(v)] / (layout == SpringLayout::OneLayer ? 1 : 2);
            EXPECT_LT(length((mass / bench.time_step()) * speed[p] - slope[p]), 2e-3 * largest)
                << "layout " << static_cast<int>(layout) << ", point " << p;
        }
    }
}

TEST(SpringStep, MovesAPairByHandAsTheFormulaSays) {
    // k = 100, L = 1, masses 1 and 3, c = 2 zeta sqrt(k mu); one step from length 1.1, which was 1.05 before.
    const std::vector<GivenSpring> one{{0, 1, 1, 100}};
    SpringSettings settings;
    settings.damping_ratio = 0.1f;
    settings.time_step = 0.01f;
    SpringBench bench({{0, 0, 0}, {1.1, 0, 0}}, {1, 3}, one, settings);
    State& state = bench.state();
    for (const uint32_t v : {0u, 1u}) state.spring_slots.slot[bench.view().slot(0)].length[v] = 1.05f;
    state.shell_springs.gravity.set(bench.springs(), {0, -10, 0});
    bench.step();
    const double c = 2 * 0.1 * std::sqrt(100 * 0.75), pull = 100 * 0.1 + c * 0.05 / 0.01;
    EXPECT_NEAR(bench.velocity(0).x, 0.01 * pull, 2e-6);
    EXPECT_NEAR(bench.velocity(1).x, -0.01 * pull / 3, 1e-6);
    EXPECT_NEAR(bench.velocity(0).y, -0.1, 1e-7);
    EXPECT_NEAR(bench.view().position(0).x, 0.01 * 0.01 * pull, 1e-7);
    EXPECT_NEAR(bench.view().largest_strain(0), 0.1, 1e-6);
    EXPECT_NEAR(bench.view().largest_strain(1), 0.1, 1e-6);
}

TEST(SpringStep, KeepsMomentumAndAngularMomentum) {
    for (const auto& [layout, energy] : kLayoutsAndEnergies) {
        SpringBench bench = make_ball(layout, 0.05f, 2, energy);
        shake(bench, 2e-3, 1);
        const SpringMotion before = motion_of(bench.view());
        const double scale = before.mass * 1;
        for (int i = 0; i < 100; ++i) bench.step();
        const SpringMotion after = motion_of(bench.view());
        EXPECT_LT(length(after.momentum - before.momentum), 1e-6 * scale);
        EXPECT_LT(length(after.angular - before.angular), 1e-6 * scale * 0.1);
    }
}

TEST(SpringStep, RigidTravelIsFreeOfForce) {
    for (const SpringLayout layout : kLayouts) {
        SpringBench bench = make_ball(layout);
        RigidMotion motion;
        motion.velocity = {1, 2, 3};
        start_springs(bench.view(), motion);
        for (int i = 0; i < 50; ++i) bench.step();
        for (const Vec3d speed : speeds_of(bench)) EXPECT_LT(length(speed - Vec3d(1, 2, 3)), 2e-3);
    }
}

TEST(SpringStep, DampingOnlyTakesEnergy) {
    for (const SpringLayout layout : kLayouts) {
        SpringBench bench = make_ball(layout, 0.1f);
        // Semi-implicit Euler keeps an energy that is off by up to omega dt / 2 of it: 1 % of the stiffest mode here.
        set_spring_step(bench.view(), 0.02f * stable_spring_step(bench.view()));
        shake(bench, 1e-3, 0.5);
        measure_lengths(bench.view());
        double before = motion_of(bench.view()).kinetic + spring_energy(bench.view());
        const double start = before;
        for (int i = 0; i < 20; ++i) {
            for (int k = 0; k < 500; ++k) bench.step();
            const double now = motion_of(bench.view()).kinetic + spring_energy(bench.view());
            EXPECT_LT(now, before * 1.001);
            before = now;
        }
        EXPECT_LT(before, 0.9 * start);
    }
}

TEST(SpringStep, PinnedPointsStandStillAndTheirSpringsHold) {
    for (const SpringLayout layout : kLayouts) {
        SpringBench bench(bench_strip(4, 4, 0.01), 0.004, {}, settings_of(layout),
                          [](Vec3d p) { return p.x < -0.035; });
        bench.state().shell_springs.gravity.set(bench.springs(), {9.81f, 0, 0});
        uint32_t pinned = 0;
        for (int i = 0; i < 200; ++i) bench.step();
        for (uint32_t v = 0; v < bench.size(); ++v) {
            const uint32_t row = bench.view().shell.vertex(v);
            if (!bench.state().vertices.is_pinned[row]) continue;
            ++pinned;
            EXPECT_EQ(bench.view().position(v), bench.state().vertices.rest[row]);
        }
        EXPECT_GT(pinned, 2u);
        EXPECT_LT(bench.middle(bench.size() - 1).x, 0.06);
    }
}

TEST(SpringStep, SpringsOfLengthZeroAreSkippedAndCounted) {
    // Two points in one place, a third to the side; the pair's spring pushes nowhere.
    const std::vector<GivenSpring> springs{{0, 1, 0.5f, 100}, {1, 2, 1, 100}};
    SpringSettings settings;
    settings.time_step = 1e-3f;
    SpringBench bench({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}, {1, 1, 1}, springs, settings);
    for (int i = 0; i < 3; ++i) bench.step();
    EXPECT_EQ(bench.view().position(0), (Vec3{0, 0, 0}));
    EXPECT_EQ(bench.view().position(1), (Vec3{0, 0, 0}));
    EXPECT_EQ(bench.state().spring_packs.zero_lengths[bench.view().pack(0)], 6u) << "both ends, three steps";
    EXPECT_EQ(bench.state().shell_springs.no_lengths[bench.springs()], 0u);
    EXPECT_EQ(bench.state().validate(), "");
}

TEST(SpringStep, TheStiffestAndLongestThatIsAcceptedLeavesPointsInOnePlaceWhereTheyAre) {
    // k L is 1e18 N there, and its 1e36 N/m over no length are still finite: times x = 0 they are no force.
    const std::vector<GivenSpring> springs{{0, 1, 1e6f, 1e12f}};
    SpringSettings settings;
    settings.time_step = 1e-6f;
    SpringBench bench({{1, 2, 3}, {1, 2, 3}}, {1e6, 1e6}, springs, settings);
    for (int i = 0; i < 3; ++i) bench.step();
    for (const uint32_t v : {0u, 1u}) EXPECT_EQ(bench.view().position(v), (Vec3{1, 2, 3}));
    EXPECT_EQ(bench.state().validate(), "");
}

TEST(SpringStep, ASpringWithoutRestLengthHasNoForce) {
    const std::vector<GivenSpring> springs{{0, 1, 0, 100}};
    SpringBench bench({{0, 0, 0}, {1, 0, 0}}, {1, 1}, springs, {});
    EXPECT_EQ(bench.state().shell_springs.no_lengths[bench.springs()], 1u);
    for (int i = 0; i < 3; ++i) bench.step();
    EXPECT_EQ(bench.view().position(1), (Vec3{1, 0, 0}));
}

TEST(SpringStep, HasTheSameBitsAtEverySimdLevel) {
    for (const auto& [layout, energy] : kLayoutsAndEnergies) {
        uint64_t scalar = 0;
        for (const SimdLevel level : {SimdLevel::Scalar, SimdLevel::Sse4, SimdLevel::Avx2, SimdLevel::Avx512}) {
            if (!set_simd_level(level)) continue;
            SpringBench bench = make_ball(layout, 0.05f, 2, energy);
            shake(bench, 2e-3, 1);
            for (int i = 0; i < 60; ++i) bench.step();
            const uint64_t hash = bench.state().hash();
            if (level == SimdLevel::Scalar) scalar = hash;
            EXPECT_EQ(hash, scalar) << "level " << static_cast<int>(level);
        }
        set_simd_level(SimdLevel::Best);
    }
}

TEST(SpringStep, HasTheSameBitsOnAnyNumberOfThreads) {
    for (const SpringLayout layout : kLayouts) {
        SpringSettings settings = settings_of(layout);
        settings.area_energy = settings.volume_energy = 0.5f;
        uint64_t alone = 0;
        for (const uint32_t threads : {0u, 1u, 2u, 3u, 8u}) {  // 0: without a team
            SpringBench bench(bench_sphere(0.1, 4), 0.004, {}, settings);
            shake(bench, 1e-3, 1);
            if (threads == 0) {
                run_springs(bench.state(), bench.springs(), 20);
                alone = bench.state().hash();
                continue;
            }
            const auto jobs = make_jobs(JobBackend::Threads, threads);
            const SpringLoop loop = make_spring_loop(layout);
            SpringWorld world{bench.state()};
            SpringLoop::Team team(loop, world, {bench.springs(), 0, 20, nullptr}, threads);
            parallel_for(*jobs, threads, [&](uint32_t worker) { team.work(worker); });
            EXPECT_EQ(bench.state().hash(), alone) << threads << " threads";
            EXPECT_EQ(bench.state().shell_springs.steps[bench.springs()], 20u);
        }
    }
}

TEST(SpringStep, AStepThatIsStableStaysSoAndTwiceGershgorinsDoesNot) {
    for (const SpringLayout layout : kLayouts)
        for (const float share : {1.0f, 4.5f}) {
            SpringBench bench = make_ball(layout, 0);
            set_spring_step(bench.view(), share * stable_spring_step(bench.view()));
            shake(bench, 1e-6, 0);
            const double start = spring_energy(bench.view());
            for (int i = 0; i < 300; ++i) bench.step();
            const double end = motion_of(bench.view()).kinetic + spring_energy(bench.view());
            if (share > 1)
                EXPECT_FALSE(end < 10 * start);
            else
                EXPECT_LT(end, 1.5 * start);
        }
}

/// Energy of what was shaken by `size`, a hundredth of a spring at most, after 3,000 of its own steps, over that at the
/// start.
double energy_left(SpringBench bench, double size) {
    shake(bench, size, 0);
    measure_lengths(bench.view());
    const auto energy = [&] { return motion_of(bench.view()).kinetic + spring_energy(bench.view()); };
    const double start = energy();
    for (int i = 0; i < 3000; ++i) bench.step();
    return energy() / start;
}

/// A light point between `arms` heavy ones to each side: its mode is damped sqrt(2 arms) times as much as a spring.
SpringBench make_hub(uint32_t arms, float damping) {
    std::vector<Vec3d> points{{0, 0, 0}};
    std::vector<double> masses{1e-3};
    std::vector<GivenSpring> springs;
    for (uint32_t i = 0; i < 2 * arms; ++i) {
        points.push_back({i % 2 ? 1.0 : -1.0, 0, 0});
        masses.push_back(1);
        springs.push_back({0, i + 1, 1, 1000});
    }
    return SpringBench(points, masses, springs, settings_of(SpringLayout::OneLayer, damping));
}

SpringBench make_chain(float damping) {
    std::vector<Vec3d> points;
    std::vector<GivenSpring> springs;
    for (uint32_t v = 0; v < 30; ++v) {
        points.push_back({0.1 * v, 0, 0});
        if (v > 0) springs.push_back({v - 1, v, 0.1f, 1000});
    }
    return SpringBench(points, std::vector<double>(points.size(), 0.01), springs,
                       settings_of(SpringLayout::OneLayer, damping));
}

TEST(SpringStep, IsStableWithAnyDampingThatIsAccepted) {
    for (const float damping : {0.05f, 0.3f}) {
        EXPECT_LT(energy_left(make_chain(damping), 1e-3), 1) << damping;
        for (const uint32_t arms : {3u, 32u}) EXPECT_LT(energy_left(make_hub(arms, damping), 1e-2), 1) << damping;
        for (const SpringLayout layout : kLayouts)
            EXPECT_LT(energy_left(make_ball(layout, damping), 1e-5), 1) << damping;
    }
}

TEST(SpringStep, IsThatOfTheRowSumsOfStiffnessAndDamping) {
    // The light point decides: K = 2 sum k / m, C = 2 sum c / m, dt^2 K + 2 dt C = 4.
    for (const float damping : {0.0f, 0.3f}) {
        SpringBench bench = make_hub(32, damping);
        const double k = 64 * 1000, m = 1e-3, c = 64 * 2 * double{damping} * std::sqrt(1000 * (1e-3 / 1.001));
        const double bound = 4 / (2 * c / m + std::sqrt(4 * c * c / (m * m) + 8 * k / m));
        const double wanted = std::min(0.6 * 2 / std::sqrt(2 * k / m), 0.9 * bound);
        EXPECT_NEAR(stable_spring_step(bench.view()), wanted, 1e-5 * wanted);
        EXPECT_EQ(damping > 0, 0.9 * bound < 0.6 * 2 / std::sqrt(2 * k / m));
    }
}

TEST(SpringStep, OfAnEquilateralSheetIsTheNotesShareOfItsWave) {
    const double edge = 0.01;
    SpringBench bench(bench_strip(20, 20, edge), 0.002, {}, {});
    const double speed = std::sqrt(1e7 / 1000);
    EXPECT_NEAR(stable_spring_step(bench.view()) * speed / edge, 0.6 * 0.577, 0.6 * 0.002);
}

}  // namespace
}  // namespace cullet::test
