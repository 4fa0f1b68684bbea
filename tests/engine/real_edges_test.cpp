// Steps, kerbs and ridges of many parts stop and throw what comes to them as those of one box or of few triangles do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "tests/engine/rigid_scenes.hpp"
#include "tests/support/random_sliders.hpp"

namespace cullet {
namespace {

constexpr float kEdge = 3;  // m along x, where the step or kerb begins
constexpr uint32_t kFirst = 6000, kLimit = 6100, kAbreast = 4;

struct Corner {
    float x, y;
};
using Profile = std::vector<Corner>;  // of the ground, along x

Profile step_of(float height) {
    return {{kFloorLow, 0}, {kEdge, 0}, {kEdge, height}, {kFloorHigh, height}};
}
Profile kerb_of(float height, float wide) {
    return {{kFloorLow, 0}, {kEdge, 0}, {kEdge, height}, {kEdge + wide, height}, {kEdge + wide, 0}, {kFloorHigh, 0}};
}
Profile ridge_of(float height, float half) {
    return {{kFloorLow, 0}, {kEdge, 0}, {kEdge + half, height}, {kEdge + 2 * half, 0}, {kFloorHigh, 0}};
}

void add_quad(FloorPart& part, Vec3 a, Vec3 b, Vec3 c, Vec3 d, bool is_other_way) {
    const auto first = static_cast<uint32_t>(part.points.size());
    part.points.insert(part.points.end(), {a, b, c, d});
    if (is_other_way)
        part.triangles.insert(part.triangles.end(), {{first, first + 3, first + 1}, {first + 1, first + 3, first + 2}});
    else
        part.triangles.insert(part.triangles.end(), {{first, first + 2, first + 1}, {first, first + 3, first + 2}});
}

std::vector<float> shares(Chance& chance, float length, float most) {
    std::vector<float> at{0};
    if (most > 0)
        for (float next = chance.between(0.2f, 1) * most; next < length; next += chance.between(0.2f, 1) * most)
            at.push_back(next / length);
    at.push_back(1);
    return at;
}

/// Each part of the profile cut unevenly into cells of at most `cell` m; 0: into two triangles.
Floor sheet(const Profile& profile, Chance& chance, float cell) {
    Floor floor{"sheet", {FloorPart{}}};
    for (size_t k = 0; k + 1 < profile.size(); ++k) {
        const Vec3 from{profile[k].x, profile[k].y, 0}, way = Vec3{profile[k + 1].x, profile[k + 1].y, 0} - from;
        const auto along = shares(chance, length(way), cell), across = shares(chance, 2 * kFloorSide, cell);
        for (size_t i = 0; i + 1 < along.size(); ++i)
            for (size_t j = 0; j + 1 < across.size(); ++j) {
                const auto at = [&](size_t a, size_t b) {
                    return from + along[a] * way + Vec3{0, 0, kFloorSide * (2 * across[b] - 1)};
                };
                add_quad(floor.parts[0], at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), chance.below(2) > 0);
            }
    }
    return floor;
}

/// Boxes side by side under the level parts of a profile: bodies of their own, or pieces of one.
Floor boxes(const Profile& profile, Chance& chance, float cell, bool is_one_body) {
    Floor floor{is_one_body ? "pieces of one body" : "tiles", {}};
    constexpr float kMargin = 0.001f, kDeep = 0.2f;
    if (is_one_body) floor.parts.emplace_back();
    for (size_t k = 0; k + 1 < profile.size(); ++k) {
        const float from = profile[k].x, way = profile[k + 1].x - from, top = profile[k].y;
        if (!(way > 0)) continue;
        const auto along = shares(chance, way, cell);
        for (size_t i = 0; i + 1 < along.size(); ++i) {
            const auto across = shares(chance, 2 * kFloorSide, 2 * cell);
            for (size_t j = 0; j + 1 < across.size(); ++j) {
                const Vec3 low{from + along[i] * way, -kDeep, kFloorSide * (2 * across[j] - 1)},
                    high{from + along[i + 1] * way, top, kFloorSide * (2 * across[j + 1] - 1)};
                const Vec3 half = 0.5f * (high - low) - Vec3{kMargin, kMargin, kMargin};
                if (!(std::min(half.x, half.z) > kMargin)) continue;
                if (!is_one_body) floor.parts.emplace_back();
                floor.parts.back().margin = kMargin;
                floor.parts.back().pieces.push_back(box_points(half, 0.5f * (low + high)));
            }
        }
    }
    return floor;
}

/// The floor in two triangles, and what stands on it as one box.
Floor one_box(float height, float from, float to) {
    Floor floor = two_triangles();
    FloorPart box;
    box.margin = 0.001f;
    const Vec3 half{0.5f * (to - from) - 0.001f, 0.5f * height + 0.099f, kFloorSide - 0.001f};
    box.pieces.push_back(box_points(half, {0.5f * (from + to), 0.5f * height - 0.1f, 0}));
    floor.parts.push_back(box);
    return floor;
}

struct Outcome {
    float farthest = 0, top = 0;  // m, of the middle
    float slowest = 1e9f;         // m/s along x, in the first tenth of a second after the hit
    float struck = 0;             // m/s, the hardest touch
};

std::vector<Outcome> meet(const Floor& floor, const std::vector<Slider>& sliders, float dt) {
    const auto world = make_bullet_world(kLimit);
    world->set_gravity({0, -9.81f, 0});
    add_floor(*world, floor);
    const Height flat = [](float, float) { return 0.0f; };
    for (uint32_t k = 0; k < sliders.size(); ++k) {
        const float start = kEdge - 0.35f - std::min(0.1f * sliders[k].speed, 0.5f);
        add_slider(*world, kFirst + k, sliders[k], laid_level(flat, sliders[k], start), {sliders[k].speed, 0, 0});
    }
    std::vector<Outcome> out(sliders.size());
    std::vector<int> steps_since(sliders.size(), -1);
    for (int n = 0; real(n) * dt < 0.6f; ++n) {
        world->detect(dt);
        for (const RigidContact& c : world->contacts()) {
            const uint32_t k = std::max(c.a, c.b) - kFirst;
            out[k].struck = std::max(out[k].struck, c.approach_speed);
            if (c.distance > 0.001f) continue;
            if (std::fabs(c.normal.x) > 0.1f && steps_since[k] < 0) steps_since[k] = 0;
        }
        world->solve(dt);
        for (uint32_t k = 0; k < sliders.size(); ++k) {
            const Vec3 p = world->pose(kFirst + k).position;
            out[k].farthest = std::max(out[k].farthest, p.x), out[k].top = std::max(out[k].top, p.y);
            if (steps_since[k] < 0 || real(steps_since[k]++) * dt > 0.1f) continue;
            out[k].slowest = std::min(out[k].slowest, world->motion(kFirst + k).velocity.x);
        }
    }
    return out;
}

std::vector<Slider> any_sliders(Chance& chance) {
    std::vector<Slider> sliders;
    while (sliders.size() < kAbreast) {
        const Slider slider = random_slider(chance);
        if (slider.speed < 2) continue;  // friction stops it before the edge
        sliders.push_back(slider);
        sliders.back().side = -0.9f + 0.6f * real(sliders.size() - 1);
    }
    return sliders;
}

/// CULLET_REAL_EDGES in the environment asks for another number.
uint32_t grounds(uint32_t usual) {
    const char* wanted = std::getenv("CULLET_REAL_EDGES");
    return wanted ? static_cast<uint32_t>(std::atoi(wanted)) : usual;
}

TEST(RealEdges, AStepOrKerbOfManyPartsStopsWhatOneBoxStops) {
    uint32_t cases = 0, stopped = 0, passed = 0, faster = 0, softer = 0;
    for (uint32_t seed = 0; seed < grounds(40); ++seed) {
        Chance chance{std::mt19937(seed)};
        const float height = chance.between(0.02f, 0.2f), wide = chance.between(0.15f, 0.5f),
                    cell = chance.between(0.15f, 0.5f);
        const bool is_kerb = chance.below(2) > 0;
        const Profile profile = is_kerb ? kerb_of(height, wide) : step_of(height);
        const uint32_t kind = chance.below(3);
        const Floor floor = kind == 0 ? sheet(profile, chance, cell) : boxes(profile, chance, cell, kind == 1);
        const float dt = chance.below(2) ? 1.0f / 60 : 1.0f / 120;
        const auto sliders = any_sliders(chance);
        const auto got = meet(floor, sliders, dt),
                   box = meet(one_box(height, kEdge, is_kerb ? kEdge + wide : kFloorHigh), sliders, dt);
        for (uint32_t k = 0; k < kAbreast; ++k) {
            ++cases;
            const bool is_stopped = box[k].farthest < kEdge;
            stopped += is_stopped;
            const bool passes = is_stopped && got[k].farthest > kEdge;
            const bool is_faster = is_stopped && got[k].slowest > box[k].slowest + 0.15f * sliders[k].speed + 0.3f;
            const bool is_softer = got[k].struck < 0.8f * box[k].struck - 0.3f;
            passed += passes, faster += is_faster, softer += is_softer;
            if (!passes && !is_faster && !is_softer) continue;
            std::printf(
                "seed %u lane %u: %s at %.1f m/s against a %s of %s, %.0f mm: comes to %.3f (%.3f) m, slowest %.2f "
                "(%.2f), struck %.2f (%.2f)\n",
                seed, k, sliders[k].name, sliders[k].speed, is_kerb ? "kerb" : "step", floor.name, 1000 * height,
                got[k].farthest, box[k].farthest, got[k].slowest, box[k].slowest, got[k].struck, box[k].struck);
        }
    }
    std::printf("%u cases, %u stopped by one box: %u pass, %u are not slowed as much, %u are struck less\n", cases,
                stopped, passed, faster, softer);
    EXPECT_GT(stopped, cases / 2);
    EXPECT_EQ(passed, 0u);
    EXPECT_LE(50 * faster, cases);
    EXPECT_LE(50 * softer, cases);
}

// Over its top they fly: as high, to a tenth.
TEST(RealEdges, ARidgeOfManyTrianglesThrowsAsOneOfSix) {
    uint32_t cases = 0, thrown = 0, others = 0;
    for (uint32_t seed = 0; seed < grounds(30); ++seed) {
        Chance chance{std::mt19937(seed)};
        const float height = chance.between(0.02f, 0.2f), half = height * chance.between(1.5f, 6),
                    cell = chance.between(0.08f, 0.5f);
        const Profile profile = ridge_of(height, half);
        const Floor floor = sheet(profile, chance, cell);
        const auto sliders = any_sliders(chance);
        const auto got = meet(floor, sliders, 1.0f / 120), few = meet(sheet(profile, chance, 0), sliders, 1.0f / 120);
        for (uint32_t k = 0; k < kAbreast; ++k) {
            ++cases, thrown += few[k].top > 0.5f * height + sliders[k].lift;
            const bool is_other = std::fabs(got[k].top - few[k].top) > 0.1f * few[k].top + 0.02f;
            others += is_other;
            if (is_other)
                std::printf(
                    "seed %u lane %u: %s at %.1f m/s over a ridge of %.0f mm, %.2f steep: top %.3f (%.3f), way %.3f "
                    "(%.3f)\n",
                    seed, k, sliders[k].name, sliders[k].speed, 1000 * height, height / half, got[k].top, few[k].top,
                    got[k].farthest, few[k].farthest);
        }
    }
    std::printf("%u cases, %u thrown: %u otherwise\n", cases, thrown, others);
    EXPECT_GT(thrown, cases / 2);
    EXPECT_LE(10 * others, cases) << "wanted: none; 59 of 1,200 do, boxes and panes, and why is not known";
}

}  // namespace
}  // namespace cullet
