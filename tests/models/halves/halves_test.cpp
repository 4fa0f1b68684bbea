// A second damage model beside the thick shell, in one world and in one frame. It is given to the world from outside:
// nothing but this folder knows of it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "sample_game/allocations.hpp"
#include "systems/api/with_models.hpp"
#include "systems/models/thick_shell/model.hpp"
#include "tests/models/halves/model.hpp"
#include "tests/support/closed_view.hpp"
#include "tests/support/same_bytes.hpp"
#include "tests/support/simple_meshes.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::halves {
namespace {

namespace fs = std::filesystem;

/// Its number is 0 in the first list, and 1 in the second.
const ModelList& halves_first() {
    static const ModelList list =
        std::make_shared<const DamageModels>(std::vector{halves_model(), thick_shell_model()});
    return list;
}
const ModelList& thick_shell_first() {
    static const ModelList list =
        std::make_shared<const DamageModels>(std::vector{thick_shell_model(), halves_model()});
    return list;
}

template <class T>
T value_of(Result<T> result) {
    if (!result) ADD_FAILURE() << result.error(), std::abort();
    return std::move(result).value();
}

Model cook_globe(const ModelList& list, const std::string& model) {
    Mesh mesh = test::sphere_mesh(0.1, 3);
    mesh.name = model + " globe";
    CookSettings settings;
    settings.model = model;
    settings.material = "glass";
    settings.thickness = 0.004f;
    settings.longest_edge = 1;
    return value_of(cook_with(list, test::view_of_mesh(mesh), settings));
}
const Model& globe_of_halves() {
    static const Model model = cook_globe(halves_first(), "halves");
    return model;
}
const Model& globe_of_glass() {
    static const Model model = cook_globe(halves_first(), "thick_shell");
    return model;
}

Settings settings_on(uint32_t threads, uint64_t units_a_frame = 8'000'000) {
    Settings settings = test::small_settings();
    settings.gravity = {0, -9.81f, 0};
    settings.threads = threads;
    settings.units_a_frame = units_a_frame;
    return settings;
}

BodyId spawn(World& world, const Model& model, Vec3 place, Vec3 velocity) {
    SpawnSettings settings;
    settings.pose.position = place;
    settings.motion.velocity = velocity;
    return value_of(world.spawn(value_of(world.add_model(model)), settings));
}

/// A globe of each model, and one of each more that a ball hits in mid-air: they break in the same frames.
World both_models(const ModelList& list, const Settings& settings) {
    World world = value_of(create_with(list, settings));
    test::add_floor(world);
    spawn(world, globe_of_halves(), {0, 0.12f, 0}, {0, -3, 0});
    spawn(world, globe_of_glass(), {1, 0.12f, 0}, {0, -6, 0});
    spawn(world, globe_of_halves(), {0, 1, 0}, {});
    spawn(world, globe_of_glass(), {1, 1, 0}, {});
    EXPECT_TRUE(world.add_sphere(test::ball_at({0.01f, 1, 0}, 0.1f, 8)).ok());
    EXPECT_TRUE(world.add_sphere(test::ball_at({1.01f, 1, 0}, 0.1f, 8)).ok());
    return world;
}

uint32_t bodies_of(const World& world, const std::string& model) {
    const WorldData& d = world.contents().data;
    const State& state = d.state;
    uint32_t count = 0;
    for (uint32_t b = 0; b < state.bodies.size(); ++b)
        if (state.bodies.kind[b] != 0 && state.bodies.structure[b].exists())
            count += state.structures.damage_model[state.bodies.structure[b]] == d.damage_models->find(model);
    return count;
}

std::string file_of(const std::string& name) {
    const fs::path folder = fs::temp_directory_path() / ("cullet_halves_test." + std::to_string(getpid()));
    fs::create_directories(folder);
    return (folder / name).string();
}
void remove_files() {
    fs::remove_all(fs::path(file_of("x")).parent_path());
}

TEST(Halves, AModelIsCookedByItsNameAndAnUnknownOneIsRefusedByAListOfNames) {
    EXPECT_GT(globe_of_halves().report().vertices, 100u);
    EXPECT_GT(globe_of_halves().report().mass, 0.1);
    CookSettings settings;
    settings.model = "quarters";
    const Mesh mesh = test::sphere_mesh(0.1, 1);
    const Result<Model> cooked = cook_with(thick_shell_first(), test::view_of_mesh(mesh), settings);
    ASSERT_FALSE(cooked.ok());
    EXPECT_NE(cooked.error().find("model is \"quarters\"; use one of thick_shell, halves."), std::string::npos)
        << cooked.error();
    settings.model = "halves";
    const Result<Model> by_default = cook(test::view_of_mesh(mesh), settings);
    ASSERT_FALSE(by_default.ok()) << "it lives in tests alone";
    EXPECT_NE(by_default.error().find("use one of thick_shell, metal_shell, lattice."), std::string::npos)
        << by_default.error();
}

TEST(Halves, AWorldWithoutTheModelRefusesWhatWasCookedForIt) {
    World world = test::make_world(settings_on(1));
    const Result<ModelId> added = world.add_model(globe_of_halves());
    ASSERT_FALSE(added.ok());
    EXPECT_EQ(added.error(),
              "halves globe: is cooked for the damage model halves; this world has thick_shell, metal_shell, lattice.");
}

TEST(Halves, AGlobeFallsInTwoWhereItIsHitAndItsMomentumStays) {
    World world = value_of(create_with(halves_first(), test::small_settings()));
    const BodyId globe = spawn(world, globe_of_halves(), {}, {});
    ASSERT_TRUE(world.add_sphere(test::ball_at({}, 0.05f, 8)).ok());
    const auto before = test::matter_of(world).momentum;
    ASSERT_GT(test::step_until_born(world, 60), 0u);
    EXPECT_EQ(bodies_of(world, "halves"), 2u);
    EXPECT_NEAR(value_of(world.mass(globe)), 0.5 * globe_of_halves().report().mass, 0.1);
    for (int frame = 0; frame < 30; ++frame) world.step();
    EXPECT_EQ(bodies_of(world, "halves"), 2u);
    const auto after = test::matter_of(world).momentum;
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(after[k], before[k], 1e-4) << k;
}

TEST(Halves, WhatIsSlowerLeavesItWhole) {
    World world = value_of(create_with(halves_first(), test::small_settings()));
    spawn(world, globe_of_halves(), {}, {});
    ASSERT_TRUE(world.add_sphere(test::ball_at({}, 0.05f, 0.2f)).ok());
    for (int frame = 0; frame < 120; ++frame) world.step();
    EXPECT_EQ(bodies_of(world, "halves"), 1u);
}

TEST(Halves, BothModelsBreakInOneWorldAreDrawnClosedAndLieOnTheFloor) {
    World world = both_models(halves_first(), settings_on(2));
    uint32_t together = 0;  // frames with tasks of both
    test::after_each_system(world, [&](const std::string& system) {
        if (system != "settle_tasks") return;
        uint32_t open[2] = {};
        const State& state = test::state_of(world);
        for (uint32_t t = 0; t < state.tasks.size(); ++t)
            if (static_cast<TaskState>(state.tasks.state[t]) != TaskState::Free) ++open[state.model_of(t)];
        together += open[0] > 0 && open[1] > 0;
    });
    for (int frame = 0; frame < 150; ++frame) world.step();
    EXPECT_GT(together, 0u);
    EXPECT_GE(bodies_of(world, "halves"), 4u);
    EXPECT_GT(bodies_of(world, "thick_shell"), 4u);
    EXPECT_EQ(test::state_of(world).validate(), "");
    for (const BodyId id : test::shells_of(world)) {
        const BodyView view = value_of(world.view(id));
        EXPECT_GT(view.index_count, 0u);
        EXPECT_EQ(test::find_open_edge(view), "");
        EXPECT_GT(view.pose.position.y, -0.15f) << "the frame of a globe that lies on the floor";
    }
}

TEST(Halves, TheGameCutsItAsAnyShell) {
    World world = value_of(create_with(halves_first(), test::small_settings()));
    const BodyId globe = spawn(world, globe_of_halves(), {}, {});
    CutSettings settings;
    settings.place = {0, 0.05f, 0};
    ASSERT_TRUE(world.cut(globe, settings).ok());
    ASSERT_GT(test::step_until_born(world, 10), 0u);
    EXPECT_EQ(bodies_of(world, "halves"), 2u);
    EXPECT_NEAR(value_of(world.mass(globe)) / globe_of_halves().report().mass, 0.75, 0.01);
}

TEST(Halves, AnyNumberOfThreadsGivesTheSameBytes) {
    World one = both_models(halves_first(), settings_on(1, 400'000));
    (void)test::hashes_of(one, 60);
    EXPECT_GE(bodies_of(one, "halves"), 4u);
    test::expect_same_on_threads(
        [](uint32_t threads) { return both_models(halves_first(), settings_on(threads, 400'000)); }, 60);
}

TEST(Halves, TheThickShellDoesAllThatItDidWithoutIt) {
    const auto play = [](World world) {
        spawn(world, globe_of_glass(), {1, 0.12f, 0}, {0, -6, 0});
        test::add_floor(world);
        return test::hashes_of(world, 60);
    };
    const std::vector<uint64_t> alone = play(test::make_world(settings_on(1)));
    EXPECT_EQ(play(value_of(create_with(thick_shell_first(), settings_on(1)))), alone);
}

TEST(Halves, AWorldThatIsLoadedInMidHitGoesOnWithTheSameBytes) {
    World world = both_models(thick_shell_first(), settings_on(1, 4'000));
    const uint32_t loads = test::expect_loads(
        world, [] { return value_of(create_with(thick_shell_first(), settings_on(2))); }, 40,
        [&](int frame) {
            const State& state = test::state_of(world);
            bool has_halves = false;
            for (uint32_t t = 0; t < state.tasks.size(); ++t)
                has_halves = has_halves || (static_cast<TaskState>(state.tasks.state[t]) != TaskState::Free &&
                                            state.model_of(t) == 1);
            return has_halves || frame == 0 || frame == 39;
        });
    EXPECT_GT(loads, 2u);
}

TEST(Halves, ASnapshotOfOneListIsRefusedByAWorldOfAnother) {
    World world = both_models(halves_first(), settings_on(1));
    const std::vector<uint8_t> bytes = value_of(world.snapshot());
    const auto refused_by = [&](World other) {
        const Result<void> restored = other.restore(bytes.data(), bytes.size());
        EXPECT_FALSE(restored.ok());
        return restored.error();
    };
    EXPECT_EQ(refused_by(test::make_world(settings_on(1))),
              "snapshot: is of a world that has the damage models halves, thick_shell, and this one has thick_shell, "
              "metal_shell, lattice. Load it into a world that has the same.");
    EXPECT_NE(refused_by(value_of(create_with(thick_shell_first(), settings_on(1)))), "");
}

TEST(Halves, ItsModelFileIsReadByWhoHasItAndRefusedByWhoHasNot) {
    const std::string path = file_of("globe.cmodel");
    ASSERT_TRUE(write_model(globe_of_halves(), path).ok());
    const Model read = value_of(read_model_with(thick_shell_first(), path));
    EXPECT_EQ(read.report().mass, globe_of_halves().report().mass);
    World cooked = value_of(create_with(halves_first(), settings_on(1))),
          from_file = value_of(create_with(halves_first(), settings_on(1)));
    spawn(cooked, globe_of_halves(), {}, {});
    spawn(from_file, read, {}, {});
    EXPECT_EQ(from_file.hash(), cooked.hash());
    const Result<Model> by_default = read_model(path);
    ASSERT_FALSE(by_default.ok());
    EXPECT_NE(by_default.error().find(
                  "is cooked for the damage model \"halves\"; this version has thick_shell, metal_shell, lattice."),
              std::string::npos)
        << by_default.error();
    remove_files();
}

TEST(Halves, ARecordingReplaysOnAnyNumberOfThreadsByWhoHasTheModel) {
    const std::string path = file_of("both.crec");
    {
        World world = value_of(create_with(halves_first(), settings_on(1, 400'000)));
        ASSERT_TRUE(world.start_recording(path).ok());
        test::add_floor(world);
        spawn(world, globe_of_halves(), {0, 0.12f, 0}, {0, -3, 0});
        spawn(world, globe_of_glass(), {1, 0.12f, 0}, {0, -6, 0});
        for (int frame = 0; frame < 40; ++frame) world.step();
        EXPECT_GE(bodies_of(world, "halves"), 2u);
        ASSERT_TRUE(world.stop_recording().ok());
    }
    ReplaySettings on;
    on.threads = {1, 2, 3, 8};
    const ReplayReport report = value_of(replay_with(halves_first(), path, on));
    EXPECT_EQ(report.frames, 40u);
    EXPECT_EQ(report.difference, "");
    EXPECT_EQ(report.damage, "");
    const Result<ReplayReport> by_default = replay(path, on);
    ASSERT_FALSE(by_default.ok());
    EXPECT_NE(by_default.error().find("has the damage models halves, thick_shell"), std::string::npos)
        << by_default.error();
    remove_files();
}

TEST(Halves, FramesDoNotAllocate) {
    World world = both_models(halves_first(), settings_on(1));
    start_counting_allocations();
    for (int frame = 0; frame < 40; ++frame) world.step();
    EXPECT_EQ(stop_counting_allocations().ours, 0u);
    EXPECT_GE(bodies_of(world, "halves"), 4u);
}

TEST(Halves, ItsSystemsStandInTheirSlotsBesideThoseOfTheThickShell) {
    World world = value_of(create_with(halves_first(), settings_on(1)));
    std::vector<std::string> names;
    std::vector<uint32_t> owners;
    for (const PlannedSystem<WorldData>& system : world.contents().plan.systems()) {
        names.push_back(system.name);
        owners.push_back(system.owner);
    }
    const auto place = [&](const std::string& name) {
        const auto found = std::find(names.begin(), names.end(), name);
        EXPECT_NE(found, names.end()) << name;
        return found - names.begin();
    };
    EXPECT_LT(place("open_tasks"), place("halves::copy_wholes"));
    EXPECT_LT(place("halves::push_wholes"), place("fill_tasks"));
    EXPECT_LT(place("start_tasks"), place("grant_units"));
    EXPECT_LT(place("settle_tasks"), place("halves::find_halves"));
    EXPECT_LT(place("halves::find_halves"), place("find_parts"));
    EXPECT_LT(place("find_parts"), place("plan_births"));
    EXPECT_EQ(owners[static_cast<size_t>(place("halves::find_halves"))], 0u);
    EXPECT_EQ(owners[static_cast<size_t>(place("find_parts"))], 1u);
}

}  // namespace
}  // namespace cullet::halves
