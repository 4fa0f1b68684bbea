// 64 KiB of stack are enough for everything: a thread that has more is a luxury that a game may not have.
#include <gtest/gtest.h>

#include <filesystem>

#include "cullet/debug.hpp"
#include "cullet/query.hpp"
#include "cullet/recording.hpp"
#include "sample_game/meshes.hpp"
#include "systems/models/thick_shell/stiffness/pair_cells.hpp"
#include "tests/support/small_stack.hpp"
#include "tests/support/small_worlds.hpp"

// Designated initializers name what they set.
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"

namespace cullet::test {
namespace {

CookSettings cook_settings(const char* material, float thickness) {
    CookSettings settings;
    settings.material = material;
    settings.thickness = thickness;
    settings.longest_edge = 100;
    return settings;
}

Model cooked(const Mesh& mesh, const char* material, float thickness, const char* damage_model = "") {
    CookSettings settings = cook_settings(material, thickness);
    settings.model = damage_model;
    Result<Model> model = cook(view_of_mesh(mesh), settings);
    EXPECT_TRUE(model.ok()) << model.error();
    return std::move(model).value();
}

/// So much the promise leaves for a call: whoever runs it on exactly 64 KiB has none to spare for himself.
void expect_small(const char* what, const std::function<void()>& call) {
    const size_t used = run_on_stack(kPromisedStack, call);
    std::printf("  %-40s %5.1f KiB\n", what, static_cast<double>(used) / 1024);
    EXPECT_LT(used, kPromisedStack - 4096) << what;
}

void play(World& world, int frames) {
    for (int frame = 0; frame < frames; ++frame) world.step();
}

/// Hits, with a piece or more.
void play_until_born(World& world, const char* what) {
    EXPECT_GT(step_until_born(world, 120), 0u) << what;
    play(world, 30);
}

Settings story_settings() {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    settings.frames_ahead = 8;
    return settings;
}

SpawnSettings falling(FractureMode mode, float height = 0.8f) {
    SpawnSettings spawn;
    spawn.pose = {{0, height, 0}, {0.3f, 0, 0, 0.953939f}};
    spawn.motion.velocity = {0, -6, 0};
    spawn.thick_shell.fracture = mode;
    return spawn;
}

TEST(SmallStack, CooksEveryKindOfMaterial) {
    const Mesh vase = make_vase(0.3f, 0.025f), pane = make_pane(0.4f, 0.05f);
    for (const char* material : {"porcelain", "glass", "wood", "steel", "rubber", "cloth"})
        expect_small(material, [&] { cooked(vase, material, 0.005f); });
    expect_small("a report", [&] { EXPECT_TRUE(examine_mesh(view_of_mesh(pane)).ok()); });
}

TEST(SmallStack, CooksLargeMeshes) {
    const Mesh vase = make_vase(0.3f, 0.004f);
    CookSettings settings = cook_settings("porcelain", 0.005f);
    settings.thick_shell.measures_threshold = false;
    expect_small("12,000 vertices", [&] { EXPECT_TRUE(cook(view_of_mesh(vase), settings).ok()); });
}

TEST(SmallStack, WritesAndReadsModels) {
    const std::string path = testing::TempDir() + "small_stack.cmodel";
    const Model& model = small_vase();
    expect_small("a model file", [&] {
        EXPECT_TRUE(write_model(model, path).ok());
        EXPECT_TRUE(read_model(path).ok());
    });
    std::filesystem::remove(path);
}

TEST(SmallStack, HiddenAndQuickBreaksOnAFloor) {
    for (const FractureMode mode : {FractureMode::Hidden, FractureMode::Quick})
        for (const char* material : {"porcelain", "wood"}) {
            const Model model = cooked(make_vase(0.3f, 0.02f), material, 0.004f);
            expect_small(material, [&] {
                Settings settings = story_settings();
                settings.threads = mode == FractureMode::Quick ? 2 : 8;  // of oneTBB's where there are two cores
                World world = make_world(settings);
                add_floor(world);
                SpawnSettings spawn = falling(mode);
                spawn.strength_scale = 0.02f;
                EXPECT_TRUE(world.spawn(world.add_model(model).value(), spawn).ok());
                if (std::string(material) == "wood")  // its fibres mostly hold: cracks alone
                    play(world, 40);
                else
                    play_until_born(world, material);
            });
        }
}

TEST(SmallStack, LargeBodiesAndPairsStoredOnce) {
    Mesh mesh = make_vase(0.3f, 0.004f);
    CookSettings settings = cook_settings("porcelain", 0.005f);
    settings.fracture = FractureKind::Fine;
    settings.thick_shell.measures_threshold = false;
    for (const uint32_t bound : {kPairedCells, 4u}) {
        set_paired_cells(bound);
        const Model model = cook(view_of_mesh(mesh), settings).value();
        expect_small(bound == 4 ? "pairs stored once" : "a cut-out", [&] {
            Settings world_settings = story_settings();
            world_settings.limits = {256, 8, 1u << 18, 1u << 19, 8, 1u << 21, 512};
            world_settings.units_a_frame = 60'000'000;
            World world = make_world(world_settings);
            add_floor(world);
            EXPECT_TRUE(world.spawn(world.add_model(model).value(), falling(FractureMode::Hidden, 0.1f)).ok());
            play(world, 8);
        });
    }
    set_paired_cells(kPairedCells);
}

TEST(SmallStack, CutsExplosionsAndPushes) {
    for (const FractureMode mode : {FractureMode::Hidden, FractureMode::Quick})
        expect_small("blows", [&] {
            World world = make_world(story_settings());
            add_floor(world);
            const ModelId model = world.add_model(small_vase()).value();
            const Box foot{{-1, -1, -1}, {1, 0.01f, 1}};
            for (int k = 0; k < 3; ++k) {
                SpawnSettings spawn;
                spawn.pose.position = {0.5f * static_cast<float>(k), 0.01f, 0};
                spawn.thick_shell.fracture = mode;
                spawn.pins = &foot;
                spawn.pin_count = k == 0;
                EXPECT_TRUE(world.spawn(model, spawn).ok());
            }
            const Vec3 line[] = {{-1, 0.2f, 0}, {0.2f, 0.18f, 0}, {2, 0.22f, 0}};
            EXPECT_TRUE(world.cut({}, {.place = {0, 0.1f, 0}}).ok());
            EXPECT_TRUE(world.cut({}, {.points = line, .point_count = 3}).ok());
            play(world, 20);
            ExplosionSettings explosion;
            explosion.centre = {0.5f, 0.1f, 0.3f};
            explosion.impulse = 300;
            EXPECT_TRUE(world.explode(explosion).ok());
            explosion.centre = {0.5f, 0.1f, 0.01f};  // from within
            EXPECT_TRUE(world.explode(explosion).ok());
            EXPECT_TRUE(world.push_impact(shells_of(world).front(), {.place = {0, 0.2f, 0.1f}, .mass = 5}).ok());
            play_until_born(world, "blows");
        });
}

TEST(SmallStack, SoftBodiesDentTearAndAreBlownAway) {
    for (const char* material : {"steel", "rubber", "cloth"})
        for (const uint32_t layers : {1u, 2u}) {
            const Model model = cooked(make_pane(0.4f, 0.05f), material, 0.003f, "thick_shell");
            expect_small(material, [&] {
                Settings settings = story_settings();
                settings.units_a_frame = 8'000'000;
                World world = make_world(settings);
                add_floor(world);
                const Box border{{-1, 0.39f, -1}, {1, 0.41f, 1}};
                SpawnSettings spawn;
                spawn.pins = &border;
                spawn.pin_count = 1;
                spawn.strength_scale = 0.1f;
                spawn.thick_shell.springs.layout = layers > 1 ? LayerLayout::Crossed : LayerLayout::Sandwich;
                spawn.thick_shell.springs.area_energy = layers > 1 ? 100.0f : 0;
                EXPECT_TRUE(world.spawn(world.add_model(model).value(), spawn).ok());
                for (int k = 0; k < 3; ++k)
                    EXPECT_TRUE(
                        world.add_sphere(ball_at({0.1f * static_cast<float>(k) - 0.1f, 0.2f, 0}, 8, 40, 0.04f)).ok());
                play(world, 12);
                EXPECT_TRUE(world.explode({.centre = {0, 0.2f, 0.2f}, .impulse = 200}).ok());
                play(world, 6);
            });
        }
}

TEST(SmallStack, SavesLoadsRecordsReplaysAsksAndRetires) {
    const std::string path = testing::TempDir() + "small_stack.world", record = testing::TempDir() + "small_stack.crec";
    expect_small("a long life", [&] {
        World world = make_world(story_settings());
        EXPECT_TRUE(world.start_recording(record).ok());
        add_floor(world);
        const BodyId vase = world.spawn(world.add_model(small_vase()).value(), falling(FractureMode::Hidden)).value();
        EXPECT_TRUE(world.add_kinematic_box({.pose = {{2, 1, 0}, {}}, .motion = {{0, 0.1f, 0}, {}}}).ok());
        play_until_born(world, "a vase");
        EXPECT_TRUE(world.save(path).ok());
        play(world, 5);
        EXPECT_TRUE(world.load(path).ok());
        play(world, 5);
        (void)ray(world, {0, 2, 0}, {0, -1, 0}, 5);
        (void)closest(world, {0, 0.2f, 0}, 2);
        BodyId found[64];
        (void)overlap(world, {0, 0, 0}, 1, found, 64);
        (void)overlap(world, Box{{-1, -1, -1}, {1, 1, 1}}, found, 64);
        draw_debug(
            world, 0xffffffffu, [](void*, Vec3, Vec3, uint32_t) {}, nullptr);
        std::vector<uint32_t> indices(world.view(vase).value().index_count);
        (void)world.hairlines(vase, indices.data(), static_cast<uint32_t>(indices.size()));
        EXPECT_TRUE(world.shift_origin({1, 0, 1}).ok());
        EXPECT_TRUE(world.retire({.how = Retirement::Freeze, .count = 2}).ok());
        EXPECT_TRUE(world.retire({.how = Retirement::Merge, .count = 2}).ok());
        EXPECT_TRUE(world.retire({.count = 2}).ok());
        play(world, 5);
        (void)World::describe_frame();
        EXPECT_TRUE(world.stop_recording().ok());
    });
    expect_small("a replay", [&] {
        const Result<ReplayReport> report = replay(record);
        ASSERT_TRUE(report.ok()) << report.error();
        EXPECT_EQ(report->difference, "");
        EXPECT_GT(report->frames, 40u);
    });
    for (const std::string& file : {path, record}) std::filesystem::remove(file);
    std::filesystem::remove_all(record + ".models");
}

TEST(SmallStack, PilesOfPiecesThatPressAndRoll) {
    const Model model = cooked(make_vase(0.15f, 0.02f), "porcelain", 0.003f);
    expect_small("a pile", [&] {
        World world = make_world(story_settings());
        add_floor(world);
        const ModelId id = world.add_model(model).value();
        for (int k = 0; k < 12; ++k) {
            SpawnSettings spawn = falling(k % 2 ? FractureMode::Quick : FractureMode::Hidden);
            spawn.pose.position = {0.02f * static_cast<float>(k % 3), 0.2f + 0.15f * static_cast<float>(k), 0};
            EXPECT_TRUE(world.spawn(id, spawn).ok());
            EXPECT_TRUE(
                world.add_sphere({.pose = {{0.01f, 2.2f + 0.2f * static_cast<float>(k), 0}, {}}, .mass = 3}).ok());
        }
        play(world, 120);
    });
}

TEST(SmallStack, JobsOfAHostNeedNoMore) {
    SmallStackJobs jobs(kPromisedStack);
    Host host;
    host.jobs = jobs.jobs();
    expect_small("the caller of a host's jobs", [&] {
        CookSettings settings = cook_settings("porcelain", 0.005f);
        settings.host = &host;
        const Mesh vase = make_vase(0.3f, 0.02f);
        const Model model = cook(view_of_mesh(vase), settings).value();
        World world = make_world(story_settings(), host);
        add_floor(world);
        const ModelId id = world.add_model(model).value();
        for (int k = 0; k < 3; ++k) {
            SpawnSettings spawn = falling(k == 1 ? FractureMode::Quick : FractureMode::Hidden);
            spawn.pose.position.x = 0.4f * static_cast<float>(k);
            EXPECT_TRUE(world.spawn(id, spawn).ok());
        }
        const Box border{{-1, 0.29f, -1}, {1, 0.31f, 1}};
        SpawnSettings hung;
        hung.pose.position = {0, 0.1f, -0.5f};
        hung.pins = &border;
        hung.pin_count = 1;
        EXPECT_TRUE(world.spawn(world.add_model(cooked(make_pane(0.3f, 0.025f), "cloth", 0.001f)).value(), hung).ok());
        EXPECT_TRUE(world.cut({}, {.place = {0, 0.7f, 0}}).ok());
        EXPECT_TRUE(world.explode({.centre = {0, 0.5f, 0.3f}, .impulse = 100}).ok());
        play_until_born(world, "three vases");
    });
    std::printf("  %-40s %5.1f KiB\n", "jobs", static_cast<double>(jobs.most_used()) / 1024);
    EXPECT_LT(jobs.most_used(), kPromisedStack - 4096);
}

}  // namespace
}  // namespace cullet::test
