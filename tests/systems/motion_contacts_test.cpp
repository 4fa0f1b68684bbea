// T6: the guarded front, whose tests look at the end of each step, and continuous collision detection, which looks at
// the whole step, agree on what is valid.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "systems/structures/shell/cook/extrude.hpp"
#include "tests/support/expect_always.hpp"
#include "tests/support/motion_contacts.hpp"
#include "tests/support/plain_reader.hpp"
#include "tests/support/random_meshes.hpp"
#include "tests/support/shell_checks.hpp"
#include "tests/support/simple_meshes.hpp"
#include "tests/support/test_data.hpp"

namespace cullet {
namespace {

using test::MovingPoint;

MovingPoint still(Vec3d p) {
    return {p, p};
}

TEST(MotionContacts, APointThatFallsThroughATriangleTouchesItAndOneBesideItDoesNot) {
    const std::array<MovingPoint, 3> triangle{still({0, 0, 0}), still({1, 0, 0}), still({0, 1, 0})};
    EXPECT_TRUE(test::point_touches({{0.2, 0.2, 1}, {0.3, 0.3, -1}}, triangle));
    EXPECT_FALSE(test::point_touches({{0.7, 0.7, 1}, {0.7, 0.7, -1}}, triangle));
    EXPECT_FALSE(test::point_touches({{0.2, 0.2, 1}, {0.2, 0.2, 0.1}}, triangle));
    const std::vector<double> times =
        test::coplanar_times({triangle[0], triangle[1], triangle[2], MovingPoint{{0.2, 0.2, 1}, {0.2, 0.2, -3}}});
    ASSERT_EQ(times.size(), 1u);
    EXPECT_NEAR(times[0], 0.25, 1e-12);
}

TEST(MotionContacts, EdgesThatPassThroughEachOtherTouchThoughTheyAreApartBeforeAndAfter) {
    const MovingPoint a = still({-1, 0, 0}), b = still({1, 0, 0});
    EXPECT_TRUE(test::edges_touch(a, b, {{0, -1, 1}, {0, -1, -1}}, {{0, 1, 1}, {0, 1, -1}}));
    EXPECT_FALSE(test::edges_touch(a, b, {{2, -1, 1}, {2, -1, -1}}, {{2, 1, 1}, {2, 1, -1}}));
}

TEST(MotionContacts, ACubicMotionHasAllOfItsThreeRoots) {
    // det = (t - 0.2)(t - 0.5)(t - 0.9) by moving three corners along the axes.
    const std::vector<double> times =
        test::coplanar_times({still({0, 0, 0}), MovingPoint{{-0.2, 0, 0}, {0.8, 0, 0}},
                              MovingPoint{{0, -0.5, 0}, {0, 0.5, 0}}, MovingPoint{{0, 0, -0.9}, {0, 0, 0.1}}});
    ASSERT_EQ(times.size(), 3u);
    EXPECT_NEAR(times[0], 0.2, 1e-9);
    EXPECT_NEAR(times[1], 0.5, 1e-9);
    EXPECT_NEAR(times[2], 0.9, 1e-9);
}

struct Path {
    Surface surface;
    Extrusion shell;
    double thickness;
};

Path path_of(const Mesh& mesh, double share, Propagation way) {
    Result<Surface> surface = prepare_surface(mesh);
    EXPECT_TRUE(surface) << surface.error();
    ExtrusionSettings settings;
    settings.propagation = way;
    settings.keeps_path = true;
    const double thickness = share * surface->diagonal;
    Result<Extrusion> shell = extrude(*surface, thickness, settings);
    EXPECT_TRUE(shell) << shell.error();
    EXPECT_EQ(shell->path.back(), shell->depth);
    return {*surface, *shell, thickness};
}

/// Pairs that touch on the way, from `first` to the end, each once.
test::FacePairs contacts_on_the_way(const Path& p, const std::vector<double>& first) {
    test::FacePairs all;
    const std::vector<double>* before = &first;
    for (const std::vector<double>& state : p.shell.path) {
        const test::FacePairs some = test::contacts_of_motion(p.surface, p.shell.direction, *before, state);
        all.insert(all.end(), some.begin(), some.end());
        before = &state;
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

/// Pairs that meet in the end and did not from the first, and how many of them were not seen to touch on the way.
struct Missed {
    size_t meeting = 0, missed = 0;
};
Missed missed_on_the_way(const Path& p) {
    std::vector<double> first = p.shell.path.front();
    for (double& d : first) d *= 1e-3;  // at 0 both surfaces are one
    const test::FacePairs at_first = test::meetings_at(p.surface, p.shell.direction, first);
    const test::FacePairs seen = contacts_on_the_way(p, first);
    Missed result;
    for (const auto& pair : test::meetings_at(p.surface, p.shell.direction, p.shell.depth)) {
        if (std::binary_search(at_first.begin(), at_first.end(), pair)) continue;
        ++result.meeting;
        result.missed += !std::binary_search(seen.begin(), seen.end(), pair);
    }
    return result;
}

TEST(MotionContacts, WhateverTheFrontLeavesCrossingWasSeenToTouchOnTheWay) {
    const Mesh pleats = test::sheet_mesh(1, 1, 80, 8, [](double x, double) { return 0.1 * std::sin(30 * x); });
    const Missed of_pleats = missed_on_the_way(path_of(pleats, 0.1, Propagation::Front));
    EXPECT_GT(of_pleats.meeting, 0u);
    EXPECT_EQ(of_pleats.missed, 0u) << "of " << of_pleats.meeting;
    test::expect_always(10, [](uint64_t seed) {
        RC_ASSERT(missed_on_the_way(path_of(test::random_mesh(seed), 0.02 + 0.1 * static_cast<double>(seed % 100) / 100,
                                            Propagation::Front))
                      .missed == 0u);
    });
}

TEST(MotionContacts, OnTheWayOfTheGuardedFrontNothingTouchesAndNothingMeetsInTheEnd) {
    test::expect_always(10, [](uint64_t seed) {
        const Path p = path_of(test::random_mesh(seed), 0.02 + 0.1 * static_cast<double>(seed % 100) / 100,
                               Propagation::GuardedFront);
        const test::FacePairs seen = contacts_on_the_way(p, p.shell.path.front());
        RC_LOG() << seen.size() << " pairs touch on the way\n";
        RC_ASSERT(test::meetings_at(p.surface, p.shell.direction, p.shell.depth).empty());
        RC_ASSERT(seen.empty());
    });
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}

TEST(MotionContacts, AFrontThatSetsBackByMotionIsValidTooAndAboutAsDeep) {
    for (const uint64_t seed : {1ull, 2ull, 3ull, 4ull, 5ull, 6ull}) {
        const Path guarded = path_of(test::random_mesh(seed), 0.05, Propagation::GuardedFront);
        Extrusion shell = guarded.shell;
        shell.depth = test::push_by_motion(guarded.surface, shell.direction, guarded.shell.path.front(), shell.cap, 5);
        const test::ShellReport report = test::check_shell(guarded.surface, shell, guarded.thickness);
        EXPECT_TRUE(report.is_sound()) << "seed " << seed << ": " << report;
        EXPECT_TRUE(test::check_shell(guarded.surface, guarded.shell, guarded.thickness).is_sound());
        EXPECT_NEAR(mean(shell.depth) / mean(guarded.shell.depth), 1, 0.05) << "seed " << seed;
    }
}

TEST(MotionContacts, OnARealPleatedCurtainTooTheGuardedFrontTouchesNothingOnItsWay) {
    CULLET_SKIP_WITHOUT_DATA();
    const Mesh mesh = test::read_plain(test::test_data() / "thick_shell" / "curtain.ply");
    const Path p = path_of(mesh, 0.03, Propagation::GuardedFront);
    EXPECT_TRUE(test::meetings_at(p.surface, p.shell.direction, p.shell.depth).empty());
    EXPECT_EQ(contacts_on_the_way(p, p.shell.path.front()).size(), 0u);
}

}  // namespace
}  // namespace cullet
