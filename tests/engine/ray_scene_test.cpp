#include "engine/ray_scene.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <time.h>
#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cullet {
namespace {

constexpr float kFar = 1e6f;

// SplitMix64 finaliser of a counter, to [0, 1).
float uniform(uint64_t& counter) {
    uint64_t z = (counter += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return static_cast<float>((z ^ (z >> 31)) >> 40) * 0x1p-24f;
}

Vec3 in_cube(uint64_t& counter) {
    const float x = uniform(counter), y = uniform(counter), z = uniform(counter);
    return {2 * x - 1, 2 * y - 1, 2 * z - 1};
}

struct Soup {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
};

Soup random_soup(uint32_t triangle_count, uint64_t seed) {
    Soup soup;
    for (uint32_t t = 0; t < triangle_count; ++t) {
        const Vec3 middle = in_cube(seed);
        for (int corner = 0; corner < 3; ++corner) soup.positions.push_back(middle + 0.3f * in_cube(seed));
        soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return soup;
}

struct ExactHit {
    double distance = std::numeric_limits<double>::infinity();
    double least_weight = 0;  // the smallest barycentric weight: near 0 the ray grazes an edge
    double u = 0, v = 0;
    bool is_hit() const { return least_weight >= 0 && distance > 0 && distance < static_cast<double>(kFar); }
    // Whether float and double may disagree about it.
    bool is_doubtful() const { return std::fabs(least_weight) < 1e-4; }
};

// The line meets the plane of a, b, c; weights by areas (Cramer).
ExactHit intersect(Vec3d o, Vec3d d, Vec3d a, Vec3d b, Vec3d c) {
    const Vec3d e = b - a, f = c - a, p = cross(d, f), s = o - a, q = cross(s, e);
    const double determinant = dot(e, p);
    ExactHit hit;
    if (determinant == 0) return {std::numeric_limits<double>::infinity(), -1, 0, 0};
    hit.u = dot(s, p) / determinant;
    hit.v = dot(d, q) / determinant;
    hit.distance = dot(f, q) / determinant;
    hit.least_weight = std::min({hit.u, hit.v, 1 - hit.u - hit.v});
    return hit;
}

ExactHit intersect(const Soup& soup, uint32_t triangle, Vec3 origin, Vec3 direction) {
    const Triangle& corner = soup.triangles[triangle];
    return intersect(Vec3d(origin), Vec3d(direction), Vec3d(soup.positions[corner[0]]),
                     Vec3d(soup.positions[corner[1]]), Vec3d(soup.positions[corner[2]]));
}

struct BruteForce {
    std::vector<ExactHit> hits;
    uint32_t first = 0;
    bool is_hit = false, is_doubtful = false;
};

bool ignore_every_third(uint32_t triangle, const void*) {
    return triangle % 3 == 0;
}

BruteForce brute_force(const Soup& soup, Vec3 origin, Vec3 direction, bool ignore_thirds) {
    BruteForce result;
    double least = std::numeric_limits<double>::infinity();
    for (uint32_t t = 0; t < soup.triangles.size(); ++t) {
        result.hits.push_back(intersect(soup, t, origin, direction));
        if (ignore_thirds && ignore_every_third(t, nullptr)) continue;
        const ExactHit& hit = result.hits.back();
        if (hit.is_doubtful()) result.is_doubtful = true;
        if (hit.is_hit() && hit.distance < least) least = hit.distance, result.first = t, result.is_hit = true;
    }
    return result;
}

TEST(RayScene, TheClosestHitIsTheOneThatBruteForceFinds) {
    const Soup soup = random_soup(500, 1);
    const RayScene scene(soup.positions, soup.triangles);
    uint64_t seed = 2;
    int compared = 0;
    for (int ray = 0; ray < 2000; ++ray) {
        const Vec3 origin = 2.0f * in_cube(seed), direction = normalised(in_cube(seed) - origin);
        const BruteForce expected = brute_force(soup, origin, direction, false);
        if (expected.is_doubtful) continue;
        ++compared;
        RayScene::Hit hit;
        ASSERT_EQ(scene.closest(origin, direction, 0, kFar, hit), expected.is_hit) << "ray " << ray;
        EXPECT_EQ(scene.any(origin, direction, 0, kFar), expected.is_hit);
        if (!expected.is_hit) continue;
        const ExactHit& exact = expected.hits[expected.first];
        EXPECT_EQ(hit.triangle, expected.first);
        EXPECT_NEAR(hit.distance, exact.distance, 1e-4);
        EXPECT_NEAR(hit.u, exact.u, 1e-3);
        EXPECT_NEAR(hit.v, exact.v, 1e-3);
        EXPECT_FALSE(scene.any(origin, direction, 0, hit.distance * 0.999f));
    }
    EXPECT_GT(compared, 1000);
}

TEST(RayScene, CollectFindsEveryTriangleUpToTheFirstPlusSlackAndNoIgnoredOne) {
    const Soup soup = random_soup(500, 3);
    const RayScene scene(soup.positions, soup.triangles);
    uint64_t seed = 4;
    size_t found_in_all = 0;
    for (int ray = 0; ray < 2000; ++ray) {
        const Vec3 origin = 2.0f * in_cube(seed), direction = normalised(in_cube(seed) - origin);
        const float slack = 0.5f * uniform(seed);
        const BruteForce expected = brute_force(soup, origin, direction, true);
        if (expected.is_doubtful) continue;
        std::array<uint32_t, 64> found{};
        const size_t count = scene.collect(origin, direction, kFar, slack, ignore_every_third, nullptr, found);
        if (!expected.is_hit) {
            EXPECT_EQ(count, 0u);
            continue;
        }
        const double limit = expected.hits[expected.first].distance * (1 + 1e-4) + static_cast<double>(slack);
        std::sort(found.begin(), found.begin() + count);
        for (uint32_t t = 0; t < soup.triangles.size(); ++t) {
            const ExactHit& hit = expected.hits[t];
            const bool is_found = std::binary_search(found.begin(), found.begin() + count, t);
            const bool is_ignored = ignore_every_third(t, nullptr);
            const bool is_surely_in = !is_ignored && hit.is_hit() && hit.distance < limit - 1e-4;
            const bool is_surely_out = is_ignored || !hit.is_hit() || hit.distance > limit + 1e-4;
            if (is_surely_in) {
                EXPECT_TRUE(is_found) << "ray " << ray;
            }
            if (is_surely_out && (is_ignored || !hit.is_doubtful())) {
                EXPECT_FALSE(is_found) << "ray " << ray;
            }
        }
        found_in_all += count;
    }
    EXPECT_GT(found_in_all, 1500u);
}

TEST(RayScene, CollectNamesBothOfTwoEqualTrianglesOnce) {
    const std::vector<Vec3> positions{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    const std::vector<Triangle> triangles{{0, 1, 2}, {0, 1, 2}};
    const RayScene scene(positions, triangles);
    std::array<uint32_t, 8> found{};
    ASSERT_EQ(scene.collect({0.2f, 0.2f, 0}, {0, 0, 1}, kFar, 0, nullptr, nullptr, found), 2u);
    EXPECT_EQ(found[0] + found[1], 1u);
    EXPECT_EQ(scene.collect({0.2f, 0.2f, 0}, {0, 0, 1}, kFar, 0, nullptr, nullptr, std::span(found).first(1)), 1u);
}

TEST(RayScene, ARayAlongASharedEdgeDoesNotSlipThrough) {
    const std::vector<Vec3> positions{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
    const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
    const RayScene scene(positions, triangles);
    for (int step = -99; step < 100; ++step) {
        const float s = static_cast<float>(step) * 0.01f;
        EXPECT_TRUE(scene.any({s, s, 0}, {0, 0, 1}, 0, kFar)) << s;
    }
}

TEST(RayScene, AnEmptySceneAndTrianglesOfNoAreaOrMissingCornersAreNeverHit) {
    RayScene::Hit hit;
    EXPECT_FALSE(RayScene({}, {}).closest({}, {0, 0, 1}, 0, kFar, hit));
    const std::vector<Vec3> positions{{0, 0, 1}, {1, 0, 1}};
    const std::vector<Triangle> triangles{{0, 1, 1}, {0, 1, 77}};
    const RayScene scene(positions, triangles);
    EXPECT_FALSE(scene.any({0.5f, 0, 0}, {0, 0, 1}, 0, kFar));
}

TEST(RayScene, TheCallersFloatingPointModeIsBackAfterEveryCall) {
    const unsigned before = _mm_getcsr() & ~0x3fu;  // without the sticky exception flags
    const Soup soup = random_soup(100, 5);
    const RayScene scene(soup.positions, soup.triangles);
    RayScene::Hit hit;
    std::array<uint32_t, 8> found{};
    scene.closest({0, 0, -3}, {0, 0, 1}, 0, kFar, hit);
    scene.any({0, 0, -3}, {0, 0, 1}, 0, kFar);
    scene.collect({0, 0, -3}, {0, 0, 1}, kFar, 0, ignore_every_third, nullptr, found);
    EXPECT_EQ(_mm_getcsr() & ~0x3fu, before);
    EXPECT_EQ(before & 0x8040u, 0u);
}

double seconds_of(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

TEST(RayScene, BuildingUsesTheCallingThreadAloneAndLeavesOtherUsersOfTbbTheirThreads) {
    using oneapi::tbb::global_control;
    const size_t allowed = global_control::active_value(global_control::max_allowed_parallelism);
    const Soup soup = random_soup(100000, 6);
    const double process = seconds_of(CLOCK_PROCESS_CPUTIME_ID), thread = seconds_of(CLOCK_THREAD_CPUTIME_ID);
    const RayScene scene(soup.positions, soup.triangles);
    const double elsewhere =
        (seconds_of(CLOCK_PROCESS_CPUTIME_ID) - process) - (seconds_of(CLOCK_THREAD_CPUTIME_ID) - thread);
    EXPECT_LT(elsewhere, 0.2 * (seconds_of(CLOCK_THREAD_CPUTIME_ID) - thread));
    EXPECT_EQ(global_control::active_value(global_control::max_allowed_parallelism), allowed);
}

}  // namespace
}  // namespace cullet
