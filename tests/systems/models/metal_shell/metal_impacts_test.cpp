// What dents metal in a world, how much of it comes back, and what leaves it as it was.
#include <gtest/gtest.h>

#include <cmath>

#include "components/body_id.hpp"
#include "sample_game/meshes.hpp"
#include "systems/models/metal_shell/dent/limit_stretch.hpp"
#include "tests/systems/models/metal_shell/panels.hpp"

namespace cullet {
namespace {

template <class T>
T value_of(Result<T> result) {
    if (!result) ADD_FAILURE() << result.error(), std::abort();
    return std::move(result).value();
}

Settings settings_on(uint32_t threads, bool has_gravity = true) {
    Settings settings = test::small_settings();
    settings.gravity = {0, has_gravity ? -9.81f : 0.0f, 0};
    settings.threads = threads;
    return settings;
}

constexpr float kHalf = 0.5f;

/// A square metre, held along its border, that faces up.
BodyId spawn_panel(World& world) {
    static const Model model = test::cook_metal(metal_sheet(1, 1, 40, 40));
    constexpr float kRim = 0.01f, kOut = 1;
    const Box pins[] = {{{-kOut, -kOut, -kOut}, {-kHalf + kRim, kOut, kOut}},
                        {{kHalf - kRim, -kOut, -kOut}, {kOut, kOut, kOut}},
                        {{-kOut, -kOut, -kOut}, {kOut, -kHalf + kRim, kOut}},
                        {{-kOut, kHalf - kRim, -kOut}, {kOut, kOut, kOut}}};
    SpawnSettings settings;
    settings.pose.position = {0, 1, 0};
    settings.pose.orientation = {-0.70710678f, 0, 0, 0.70710678f};  // +z comes to +y
    settings.pins = pins, settings.pin_count = 4;
    return value_of(world.spawn(value_of(world.add_model(model)), settings));
}

constexpr Vec3 kMiddle{0.15f, 0.15f, 0.15f};  // of the box

/// Its middle there.
BodyId spawn_box(World& world, Vec3 place, Vec3 velocity) {
    static const Model model = test::cook_metal(test::box_mesh({0.3, 0.3, 0.3}, 12));
    SpawnSettings settings;
    settings.pose.position = place - kMiddle;
    settings.motion.velocity = velocity;
    return value_of(world.spawn(value_of(world.add_model(model)), settings));
}

/// A ball that falls onto the panel's middle as fast as that.
BodyId drop_ball(World& world, float mass, float speed, float radius = 0.1f) {
    SphereSettings ball;
    ball.radius = radius, ball.mass = mass;
    ball.pose.position = {0, 1.02f + radius, 0};
    ball.motion.velocity = {0, -speed, 0};
    return value_of(world.add_sphere(ball));
}

std::string model_of(const std::string& material, const std::string& model = "") {
    CookSettings settings;
    settings.material = material, settings.model = model;
    settings.thickness = 1e-3f;
    const Mesh sheet = metal_sheet(1, 1, 4, 4);
    return value_of(cook(test::view_of_mesh(sheet), settings)).contents->damage_model;
}

TEST(MetalImpacts, SteelAluminiumAndCopperAreMetalShellsUnlessToldOtherwise) {
    for (const char* metal : {"steel", "aluminium", "copper"}) EXPECT_EQ(model_of(metal), "metal_shell") << metal;
    for (const char* other : {"rubber", "cloth", "porcelain"}) EXPECT_EQ(model_of(other), "thick_shell") << other;
    EXPECT_EQ(model_of("steel", "thick_shell"), "thick_shell");
    MaterialTable table;
    MaterialSettings row = value_of(table.find("rubber"));
    row.name = "tin", row.kind = MaterialKind::Ductile, row.yield_strain = 1e-3f, row.model = "metal_shell";
    row.crush_pressure = 5e4f;
    ASSERT_TRUE(table.add(row).ok());
    CookSettings settings;
    settings.material = "tin", settings.materials = &table;
    settings.thickness = 1e-3f;
    const Mesh box = test::box_mesh({0.3, 0.3, 0.3}, 8);
    const Model model = value_of(cook(test::view_of_mesh(box), settings));
    EXPECT_EQ(model.contents->damage_model, "metal_shell");
    EXPECT_EQ(value_of(damage_model_of(settings)), "metal_shell");
    EXPECT_EQ(model.contents->state.metal_shells.crush_pressure[Row<MetalShells>(0)], 5e4f);
}

TEST(MetalImpacts, WhatDoesNotYieldIsNoMetal) {
    CookSettings settings;
    settings.material = "glass", settings.model = "metal_shell";
    const Mesh sheet = metal_sheet(1, 1, 4, 4);
    const Result<Model> made = cook(test::view_of_mesh(sheet), settings);
    ASSERT_FALSE(made.ok());
    EXPECT_NE(made.error().find("glass is brittle"), std::string::npos) << made.error();
}

TEST(MetalImpacts, SettingsOfTheModelDecideWhatIsCooked) {
    const Mesh box = test::box_mesh({0.3, 0.3, 0.3}, 12);
    CookSettings settings;
    settings.material = "steel", settings.thickness = 1e-3f, settings.longest_edge = 100;
    settings.metal_shell.sub_shells = 40;
    settings.metal_shell.crush_pressure = 2e5f;
    const Model model = value_of(cook(test::view_of_mesh(box), settings));
    const Workbench& rows = model.contents->state;
    EXPECT_EQ(rows.metal_shells.cells[Row<MetalShells>(0)].count, 40u);
    EXPECT_EQ(rows.metal_shells.crush_pressure[Row<MetalShells>(0)], 2e5f);
    settings.metal_shell.seeds = MetalChoice::Paper;
    const Model by_paper = value_of(cook(test::view_of_mesh(box), settings));
    bool differs = false;
    for (uint32_t e = 0; e < model.report().elements; ++e)
        differs = differs || rows.metal_elements.cell[e] != by_paper.contents->state.metal_elements.cell[e];
    EXPECT_TRUE(differs);
    settings.metal_shell.sub_shells = 5000;
    EXPECT_NE(cook(test::view_of_mesh(box), settings).error().find("sub_shells is 5000; use 0, or 2 to 512"),
              std::string::npos);
}

TEST(MetalImpacts, WhatEnclosesSomethingIsABodyHolesOrNot) {
    Mesh box = test::box_mesh({0.3, 0.3, 0.3}, 12);
    const auto pressure = [](const Mesh& mesh) {
        return test::cook_metal(mesh).contents->state.metal_shells.crush_pressure[Row<MetalShells>(0)];
    };
    EXPECT_GT(pressure(box), 0);
    std::erase_if(box.triangles, [&](const auto& t) {  // a window
        const Vec3 middle = (1.0f / 3) * (box.positions[t[0]] + box.positions[t[1]] + box.positions[t[2]]);
        return middle.z > 0.299f && std::fabs(middle.x - 0.15f) < 0.08f && std::fabs(middle.y - 0.15f) < 0.08f;
    });
    EXPECT_GT(pressure(box), 0);
    EXPECT_EQ(pressure(metal_sheet(1, 1, 10, 10)), 0);
}

TEST(MetalImpacts, ABodyMayLackItsFloorAndAChannelOrABowlIsNone) {
    const auto pressure = [](const Mesh& mesh) {
        return test::cook_metal(mesh).contents->state.metal_shells.crush_pressure[Row<MetalShells>(0)];
    };
    const auto without_floor = [](Vec3d size, int cells, double floor) {
        Mesh mesh = test::box_mesh(size, cells);
        std::erase_if(mesh.triangles, [&](const auto& t) {
            return std::ranges::all_of(t, [&](uint32_t v) { return double{mesh.positions[v].y} < floor; });
        });
        return mesh;
    };
    EXPECT_GT(pressure(without_floor({0.44, 0.12, 0.18}, 12, 1e-4)), 0) << "as long and as wide as a car";
    EXPECT_GT(pressure(without_floor({0.6, 0.25, 0.2}, 12, 1e-4)), 0) << "a van";
    Mesh pipe = metal_sheet(1, 1, 24, 24);
    for (Vec3& p : pipe.positions) {
        double sine, cosine;
        sine_cosine(3.14159265 * double{p.x}, sine, cosine);
        p = Vec3{static_cast<float>(0.3 * sine), p.y, static_cast<float>(0.3 * cosine)};
    }
    EXPECT_EQ(pressure(pipe), 0) << "half a pipe";
    Mesh bowl = make_ball(0.3f, 4);
    std::erase_if(bowl.triangles, [&](const auto& t) {
        return std::ranges::any_of(t, [&](uint32_t v) { return bowl.positions[v].y < -1e-4f; });
    });
    EXPECT_EQ(pressure(bowl), 0);
}

/// One impact in so many pushes, a frame each.
double depth_of_slices(uint32_t slices, bool is_box) {
    World world = test::make_world(settings_on(1, false));
    const BodyId body = is_box ? spawn_box(world, {0, 1, 0}, {}) : spawn_panel(world);
    PushSettings push;
    push.place = is_box ? Vec3{0, 1.15f, 0} : Vec3{0, 1, 0};
    push.normal = {0, -1, 0};
    push.mass = 100, push.radius = is_box ? 0.0f : 0.145f;
    push.approach_speed = (is_box ? 10 : 5) / std::sqrt(static_cast<float>(slices));
    for (uint32_t n = 0; n < slices; ++n) {
        if (is_box) {  // where it was: pushes fall on the same place, each with the same energy
            EXPECT_TRUE(world.set_pose(body, {Vec3{0, 1, 0} - kMiddle, {}}).ok());
            EXPECT_TRUE(world.set_motion(body, {}).ok());
        }
        EXPECT_TRUE(world.push_impact(body, push).ok());
        // Two that come in one step strike as one, and what is free takes less of such a one than of both.
        for (int step = 0; step < (is_box ? 4 : 1); ++step) world.step();
    }
    for (int n = 0; n < 12; ++n) world.step();
    return test::deepest(world, body);
}

TEST(MetalImpacts, AnImpactInSlicesDentsAsInOneGo) {
    for (const bool is_box : {false, true}) {
        const double whole = depth_of_slices(1, is_box);
        EXPECT_GT(whole, 0.005) << is_box;
        for (const uint32_t slices : {10u, 40u})
            EXPECT_NEAR(depth_of_slices(slices, is_box), whole, 0.05 * whole) << is_box << ", " << slices;
    }
}

TEST(MetalImpacts, HitsThatAreTooWeakToYieldOpenNoTask) {
    World world = test::make_world(settings_on(1));
    const BodyId sheet = spawn_panel(world);
    (void)drop_ball(world, 1, 2, 0.05f);  // 2 J; the panel yields from 9 J on
    for (int n = 0; n < 120; ++n) world.step();
    EXPECT_EQ(test::deepest(world, sheet), 0);
    EXPECT_EQ(world.contents().data.counts.opened, 0u);
}

TEST(MetalImpacts, ASheetGivesBackMuchOfAWeakHitAndLittleOfAHardOne) {
    const auto bounce = [](float speed) {
        World world = test::make_world(settings_on(1, false));
        spawn_panel(world);
        const BodyId ball = drop_ball(world, 100, speed, 0.145f);
        for (int n = 0; n < 20; ++n) world.step();
        return double{value_of(world.motion(ball)).velocity.y} / double{speed};
    };
    const double weak = bounce(0.6f), middle = bounce(2), hard = bounce(10);
    EXPECT_NEAR(weak, 0.7, 0.05) << "18 J";
    EXPECT_GT(middle, 0.3);
    EXPECT_LT(middle, weak);
    EXPECT_LT(hard, middle);
    EXPECT_NEAR(hard, 0.3, 0.05) << "4,800 J: sqrt(0.7 (1 - (1 - q)^2)) with q = 0.06";
}

TEST(MetalImpacts, ABallComesToRestInItsDent) {
    World world = test::make_world(settings_on(2));
    const BodyId sheet = spawn_panel(world);
    const BodyId ball = drop_ball(world, 100, 5, 0.145f);
    for (int n = 0; n < 600; ++n) world.step();
    const double deep = test::deepest(world, sheet);
    EXPECT_GT(deep, 0.03);
    EXPECT_TRUE(value_of(world.is_asleep(ball)));
    const Vec3 place = value_of(world.pose(ball)).position;
    EXPECT_NEAR(double{place.y}, 1.145 - deep, 0.012) << "on the dent's bottom, " << deep << " m deep";
    EXPECT_LT(std::fabs(place.x) + std::fabs(place.z), 0.05f);
}

/// Of the body's edges, as it is now, those outside of their limits; and triangles that look the other way.
StretchCount stretch_of(const World& world, BodyId body, uint32_t& turned) {
    auto& state = const_cast<State&>(world.contents().data.state);
    const MetalView metal(state, state.bodies.structure[body_row(state.bodies, body)]);
    MetalVertices& vertices = metal.vertices();
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        vertices.place.set(metal.vertex(v), state.vertices.rest[metal.shell.vertex(v)]);
    turned = 0;
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        const auto& c = metal.corners(e);
        const auto normal = [&](const Column<Vec3>& at) {
            const Vec3 p = at[metal.vertex(c[0])];
            return cross(at[metal.vertex(c[1])] - p, at[metal.vertex(c[2])] - p);
        };
        turned += dot(normal(vertices.original), normal(vertices.place)) < 0;
    }
    return count_stretch(metal, 0.25, 0.4);
}

TEST(MetalImpacts, ABallThatBouncesInItsDentsTearsAndTurnsNothing) {
    World world = test::make_world(settings_on(2));
    const BodyId sheet = spawn_panel(world);
    for (const float x : {-0.2f, 0.0f, 0.15f}) {
        SphereSettings ball;
        ball.radius = 0.145f, ball.mass = 100;
        ball.pose.position = {x, 1.2f, 0.1f};
        ball.motion.velocity = {0.3f, -5, 0};
        const BodyId id = value_of(world.add_sphere(ball));
        for (int n = 0; n < 240; ++n) world.step();
        ASSERT_TRUE(world.remove(id).ok());
    }
    uint32_t turned = 0;
    const StretchCount count = stretch_of(world, sheet, turned);
    EXPECT_EQ(turned, 0u);
    EXPECT_LE(count.outside, 3 * count.edges / 1000) << count.longest << " " << count.shortest;
}

TEST(MetalImpacts, APressCrushesABoxAndAWeightDoesNot) {
    World world = test::make_world(settings_on(2));
    test::add_floor(world);
    const BodyId pressed = spawn_box(world, {0, 0.151f, 0}, {}), laden = spawn_box(world, {2, 0.151f, 0}, {});
    KinematicSettings press;
    press.half_extents = {0.4f, 0.05f, 0.4f};
    press.pose.position = {0, 0.36f, 0};
    press.motion.velocity = {0, -0.1f, 0};
    const BodyId plate = value_of(world.add_kinematic_box(press));
    SphereSettings weight;
    weight.radius = 0.1f, weight.mass = 200;
    weight.pose.position = {2, 0.402f, 0};
    (void)world.add_sphere(weight);
    for (int n = 0; n < 240; ++n) {
        if (n == 180) {
            ASSERT_TRUE(world.set_motion(plate, {}).ok());
        }
        world.step();
    }
    EXPECT_EQ(test::deepest(world, laden), 0);
    const double low = double{value_of(world.pose(plate)).position.y} - 0.05;
    EXPECT_LT(low, 0.27) << "it is slow: the box gives way blow by blow";
    EXPECT_GT(test::deepest(world, pressed), 0.02);
    double top = 0;
    const BodyView view = value_of(world.view(pressed));
    for (size_t v = 0; v < view.vertex_count; ++v)
        top = std::max(top, double{to_world(value_of(world.pose(pressed)), view.vertices[v].position).y});
    EXPECT_LT(top, low + 0.012) << "it stands in the press";
    EXPECT_EQ(test::shells_of(world).size(), 2u);
    EXPECT_EQ(test::state_of(world).validate(), "");
}

TEST(MetalImpacts, ExplosionsDent) {
    World world = test::make_world(settings_on(2, false));
    const BodyId sheet = spawn_panel(world), box = spawn_box(world, {3, 1, 0}, {});
    ExplosionSettings explosion;
    explosion.centre = {0, 1.4f, 0}, explosion.radius = 2, explosion.impulse = 150;
    ASSERT_TRUE(world.explode(explosion).ok());
    explosion.centre = {3, 1.45f, 0};
    ASSERT_TRUE(world.explode(explosion).ok());
    for (int n = 0; n < 10; ++n) world.step();
    EXPECT_GT(test::deepest(world, sheet), 0.005);
    EXPECT_GT(test::deepest(world, box), 0.001);
    EXPECT_LT(value_of(world.motion(box)).velocity.y, 0) << "and it flies";
    EXPECT_EQ(test::state_of(world).validate(), "");
}

TEST(MetalImpacts, ACutOfMetalIsRefusedAndNotPassedOverInSilence) {
    World world = test::make_world(settings_on(1, false));
    const BodyId box = spawn_box(world, {0, 1, 0}, {});
    EXPECT_NE(world.cut(box, {.place = {0, 1, 0}, .normal = {0, 1, 0}}).error().find("it is of sheet metal"),
              std::string::npos);
    ASSERT_TRUE(world.cut({}, {.place = {0, 1, 0}, .normal = {0, 1, 0}}).ok());
    world.step();
    ASSERT_EQ(world.events().refused.count, 1u);
    EXPECT_NE(std::string(world.events().refused.data[0].setting).find("it is of sheet metal"), std::string::npos);
    ASSERT_TRUE(world.cut({}, {.place = {0, 3, 0}, .normal = {0, 1, 0}}).ok());
    world.step();
    EXPECT_EQ(world.events().refused.count, 0u) << "it passes by";
    EXPECT_EQ(test::shells_of(world).size(), 1u);
}

TEST(MetalImpacts, FiftyHitsOnOneSpotStaySane) {
    World world = test::make_world(settings_on(2, false));
    const BodyId sheet = spawn_panel(world);
    double last = 0;
    for (int hit = 0; hit < 50; ++hit) {
        const BodyId ball = drop_ball(world, 100, 5, 0.145f);
        for (int n = 0; n < 12; ++n) world.step();
        ASSERT_TRUE(world.remove(ball).ok());
        last = test::deepest(world, sheet);
    }
    EXPECT_GT(last, 0.08);
    EXPECT_LT(last, 0.2);
    EXPECT_EQ(test::state_of(world).validate(), "");
}

TEST(MetalImpacts, FiftyHitsFromOneSideOnOneSpotStaySane) {
    for (const bool is_box : {false, true})
        for (const float tilt : {0.7f, 1.2f}) {
            World world = test::make_world(settings_on(2, false));
            const BodyId body = is_box ? spawn_box(world, {0, 1, 0}, {}) : spawn_panel(world);
            double sine, cosine;
            sine_cosine(double{tilt}, sine, cosine);
            PushSettings push;
            push.place = is_box ? Vec3{0.05f, 1.15f, 0.03f} : Vec3{0.1f, 1, 0.05f};
            push.normal = {static_cast<float>(sine), -static_cast<float>(cosine), 0};
            push.approach_speed = 15, push.mass = 10, push.radius = 0.1f;
            for (int hit = 0; hit < 50; ++hit) {
                if (is_box) {
                    ASSERT_TRUE(world.set_pose(body, {Vec3{0, 1, 0} - kMiddle, {}}).ok());
                    ASSERT_TRUE(world.set_motion(body, {}).ok());
                }
                ASSERT_TRUE(world.push_impact(body, push).ok());
                for (int n = 0; n < 8; ++n) world.step();
            }
            EXPECT_GT(test::deepest(world, body), 0.01) << is_box << " " << tilt;
            EXPECT_LT(test::deepest(world, body), is_box ? 0.3 : 0.4) << is_box << " " << tilt;
            EXPECT_EQ(test::state_of(world).validate(), "");
        }
}

/// What a body's edges are of what they were, and triangles whose normal is past a right angle off.
struct Sanity {
    double longest = 0, shortest = 1e30;
    uint32_t turned = 0;
};
Sanity sanity_of(const World& world, BodyId body) {
    auto& state = const_cast<State&>(world.contents().data.state);
    const MetalView metal(state, state.bodies.structure[body_row(state.bodies, body)]);
    const auto now = [&](uint32_t v) { return state.vertices.rest[metal.shell.vertex(v)]; };
    const auto then = [&](uint32_t v) { return metal.vertices().original[metal.vertex(v)]; };
    const auto across = [&](const auto& at, uint32_t e) {
        const auto& c = metal.corners(e);
        return cross(at(c[1]) - at(c[0]), at(c[2]) - at(c[0]));
    };
    Sanity sanity;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        metal.for_each_spring(v, [&](uint32_t other, uint32_t spring) {
            if (metal.springs().is_tie[spring]) return;
            const double share = double{length(now(other) - now(v))} / double{metal.springs().length[spring]};
            sanity.longest = std::max(sanity.longest, share), sanity.shortest = std::min(sanity.shortest, share);
        });
    for (uint32_t e = 0; e < metal.element_count(); ++e) sanity.turned += dot(across(now, e), across(then, e)) < 0;
    return sanity;
}

// A push along a sheet would draw it out to nine times its length and leave teeth. It slides.
TEST(MetalImpacts, FiftySlantedPushesAllOverAPanelLeaveItWhole) {
    double straight = 0;
    for (const double tilt : {0.0, 0.5, 0.8, 1.05, 1.25, 1.5}) {
        World world = test::make_world(settings_on(2, false));
        const BodyId panel = spawn_panel(world);
        double sine, cosine;
        sine_cosine(tilt, sine, cosine);
        for (int hit = 0; hit < 50; ++hit) {
            double north, east;
            sine_cosine(2.4 * hit, north, east);
            const double x = std::fmod(hit * 0.618034, 1.0) - 0.5, z = std::fmod(hit * 0.754878, 1.0) - 0.5;
            PushSettings push;
            push.place = {static_cast<float>(0.9 * x), 1, static_cast<float>(0.9 * z)};
            push.normal = Vec3d(sine * east, -cosine, sine * north).to_float();
            push.approach_speed = 5, push.mass = 50, push.radius = 0.1f;
            ASSERT_TRUE(world.push_impact(panel, push).ok());
            for (int n = 0; n < 8; ++n) world.step();
        }
        const Sanity sanity = sanity_of(world, panel);
        EXPECT_EQ(sanity.turned, 0u) << tilt;
        EXPECT_LT(sanity.longest, 1.25) << tilt;
        EXPECT_GT(sanity.shortest, 0.6) << tilt;
        // What is across the sheet dents it: less, the more aslant.
        const double deep = test::deepest(world, panel);
        if (tilt == 0) straight = deep;
        EXPECT_GT(deep, 0.02 * straight) << tilt;
        EXPECT_LE(deep, 1.001 * straight) << tilt;
        EXPECT_EQ(test::state_of(world).validate(), "");
    }
}

}  // namespace
}  // namespace cullet
