// Static triangles bear from both sides, for a game that knows nothing of winding: whole worlds.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "cullet/world.hpp"
#include "tests/support/effort.hpp"

namespace cullet {
namespace {

constexpr Vec3 kCorners[] = {{-20, 0, -20}, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20}};
constexpr uint32_t kUpward[] = {0, 1, 2, 0, 2, 3}, kDownward[] = {0, 2, 1, 0, 3, 2}, kMixed[] = {0, 1, 2, 0, 3, 2};

BodyId add_ball(World& world, Vec3 at) {
    SphereSettings ball;
    ball.pose.position = at;
    return world.add_sphere(ball).value();
}

float height_of_ball(World& world, BodyId ball, int frames) {
    for (int frame = 0; frame < frames; ++frame) world.step();
    return world.pose(ball).value().position.y;
}

TEST(StaticSides, ABallStaysOnAFloorHoweverItIsWound) {
    for (const auto* indices : {&kUpward, &kDownward, &kMixed}) {
        World world = std::move(*World::create({}));
        ASSERT_TRUE(world.add_static({kCorners, 4, *indices, 2}).ok());
        const BodyId ball = add_ball(world, {5, 1, -5});
        EXPECT_GT(height_of_ball(world, ball, 180), 0);
    }
}

TEST(StaticSides, OneSideIsKeptBySavedWorlds) {
    World world = std::move(*World::create({}));
    ASSERT_TRUE(world.add_static({kCorners, 4, kDownward, 2}, {}, 0, true).ok());
    const BodyId ball = add_ball(world, {0, 1, 0});
    world.step();
    const std::string path = ::testing::TempDir() + "one_side.csnap";
    ASSERT_TRUE(world.save(path).ok());
    World twin = std::move(*World::create({}));
    const Result<void> loaded = twin.load(path);
    ASSERT_TRUE(loaded.ok()) << loaded.error();
    EXPECT_LT(height_of_ball(twin, ball, 120), -1);
    EXPECT_LT(height_of_ball(world, ball, 120), -1);
}

TEST(StaticSides, WhatIsLeftOutOfAStaticMeshIsToldOnceWithANumber) {
    std::vector<std::string> told;
    Host host;
    host.user = &told;
    host.log = [](void* user, LogLevel, const char* sentence) {
        static_cast<std::vector<std::string>*>(user)->emplace_back(sentence);
    };
    World world = std::move(*World::create({}, host));
    const uint32_t with_needles[] = {0, 1, 2, 1, 1, 2, 0, 2, 3, 2, 1, 0};
    ASSERT_TRUE(world.add_static({kCorners, 4, with_needles, 4}).ok());
    ASSERT_EQ(told.size(), 1u);
    EXPECT_NE(told[0].find("2 of 4 triangles"), std::string::npos) << told[0];
    EXPECT_NE(told[0].find("the first: 1"), std::string::npos) << told[0];
}

Model vase(float size) {
    std::vector<Vec3> points{{0, 0, 0}};
    std::vector<std::array<uint32_t, 3>> faces;
    for (uint32_t i = 0; i < 24 * 32; ++i) {
        const float ring = static_cast<float>(i / 32), angle = 6.2831853f / 32 * static_cast<float>(i % 32);
        const float radius = ring < 3 ? 0.02f + 0.015f * ring : 0.06f + 0.025f * std::sin(0.28f * ring - 0.9f);
        const float up = ring < 3 ? 0 : 0.0125f * (ring - 2);
        points.push_back({size * radius * std::cos(angle), size * up, size * radius * std::sin(angle)});
        const uint32_t a = i + 1, b = i % 32 == 31 ? a - 31 : a + 1;
        if (i < 32) faces.push_back({0, a, b});
        if (i >= 32) faces.insert(faces.end(), {{a - 32, a, b - 32}, {b - 32, a, b}});
    }
    CookSettings settings;
    settings.thick_shell.measures_threshold = false;
    if (size < 1) settings.thickness = 0.006f * size;
    return cook({points.data(), points.size(), faces[0].data(), faces.size()}, settings).value();
}

/// What the world tells of a body is one place, from which a step moves it only as far as contacts push out the half of
/// a cell that still reaches through.
void expect_told_where_it_is(World& world, BodyId body, const char* what) {
    const Pose pose = world.pose(body).value();
    const BodyView view = world.view(body).value();
    EXPECT_EQ(length(view.pose.position - pose.position), 0) << what;
    EXPECT_EQ(length(view.pose_before.position - pose.position), 0) << what;
    world.step();
    EXPECT_LT(length(world.pose(body).value().position - pose.position), 0.01f) << what;
}

TEST(StaticSides, WhatIsPutIntoASheetIsToldWhereItCameOut) {
    const Model model = vase(1);
    for (const float sunk : {0.04f, 0.08f, 0.1f})
        for (const FractureMode mode : {FractureMode::Hidden, FractureMode::Quick}) {
            World world = std::move(*World::create({}));
            ASSERT_TRUE(world.add_static({kCorners, 4, kMixed, 2}).ok());
            SpawnSettings spawn;
            spawn.thick_shell.fracture = mode;
            spawn.pose.position = {1, -sunk, 2};
            const BodyId body = world.spawn(world.add_model(model).value(), spawn).value();
            EXPECT_GT(world.pose(body).value().position.y, 0.1f * sunk - sunk);
            expect_told_where_it_is(world, body, "spawned");
            ASSERT_TRUE(world.set_pose(body, {{-3, -sunk, 1}, {}}).ok());
            EXPECT_GT(world.pose(body).value().position.y, 0.1f * sunk - sunk);
            expect_told_where_it_is(world, body, "put");
        }
}

TEST(StaticSides, WhatIsPutWhereNothingCutsItIsThereToTheLastBit) {
    const Model model = vase(1);
    World world = std::move(*World::create({}));
    ASSERT_TRUE(world.add_static({kCorners, 4, kMixed, 2}).ok());
    const Pose asked{{1.1f, 3.3f, -2.7f}, {0.5f, 0.5f, 0.5f, 0.5f}};
    SpawnSettings spawn;
    spawn.pose = asked;
    const BodyId body = world.spawn(world.add_model(model).value(), spawn).value();
    EXPECT_TRUE(world.pose(body).value().position == asked.position);
    const Vec3 elsewhere{1000.3f, 17.77f, -431.9f};
    ASSERT_TRUE(world.set_pose(body, {elsewhere, asked.orientation}).ok());
    EXPECT_TRUE(world.pose(body).value().position == elsewhere);
}

/// How many bodies fall below a floor on which three vases shatter.
size_t gone_through(const Model& model, float size, float steps_a_second, FractureMode mode, uint64_t seed) {
    Settings settings;
    settings.step_seconds = 1 / steps_a_second;
    settings.units_a_frame = 1'000'000'000;
    World world = std::move(*World::create(settings));
    EXPECT_TRUE(world.add_static({kCorners, 4, kMixed, 2}).ok());
    const ModelId id = world.add_model(model).value();
    for (int k = 0; k < 3; ++k) {
        const float half = 0.3f + 0.37f * static_cast<float>(k + 3 * static_cast<int>(seed));
        SpawnSettings spawn;
        spawn.thick_shell.fracture = mode;
        spawn.pose = {{0.4f * static_cast<float>(k) - 1, 0.8f * size, 0.3f}, {std::sin(half), 0, 0, std::cos(half)}};
        spawn.motion.velocity = {0, -8, 0};
        EXPECT_TRUE(world.spawn(id, spawn).ok());
    }
    std::set<std::pair<uint32_t, uint32_t>> gone;
    std::vector<BodyId> ids(4096);
    for (int frame = 0; frame < static_cast<int>(steps_a_second); ++frame) {
        world.step();
        const uint32_t count = world.bodies(ids.data(), 4096);
        for (uint32_t i = 0; i < count; ++i) {
            const Vec3 p = world.pose(ids[i]).value().position;
            if (world.mass(ids[i]).value() > 0 && p.y < -0.4f && std::fabs(p.x) < 18 && std::fabs(p.z) < 18)
                gone.insert({ids[i].index, ids[i].generation});
        }
    }
    return gone.size();
}

TEST(StaticSides, ShardsStayAboveASheetAtTwentyToSixtyStepsASecond) {
    // sheets_test throws pieces of all sizes; here they are born beside the sheet.
    struct Case {
        float size, rate;
        FractureMode mode;
    };
    constexpr Case kCases[] = {{1, 20, FractureMode::Hidden},
                               {0.15f, 20, FractureMode::Quick},
                               {1, 60, FractureMode::Quick},
                               {0.15f, 30, FractureMode::Hidden}};
    for (const Case& c : std::span(kCases).first(test::few_or_all(2u, 4u)))
        EXPECT_EQ(gone_through(vase(c.size), c.size, c.rate, c.mode, 1), 0u)
            << c.rate << " steps a second, size " << c.size << ", mode " << static_cast<int>(c.mode);
}

}  // namespace
}  // namespace cullet
