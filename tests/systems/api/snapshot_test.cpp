// A world that is saved and one that loads what was saved go on as one and the same.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "components/state.hpp"
#include "engine/mesh_file.hpp"
#include "systems/api/snapshot.hpp"
#include "systems/models/thick_shell/shared/working_room.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet {
namespace {

std::vector<uint8_t> taken(World& world) {
    Result<std::vector<uint8_t>> bytes = world.snapshot();
    EXPECT_TRUE(bytes.ok()) << bytes.error();
    return bytes.value_or({});
}

/// A hit takes a dozen frames.
Settings sliced_settings() {
    Settings settings = test::small_settings();
    settings.units_a_frame = 600'000;
    return settings;
}

test::Breakage vase_hit_over_a_floor() {
    test::Breakage hit = test::vase_and_ball(sliced_settings());
    EXPECT_TRUE(test::add_floor(hit.world));
    EXPECT_TRUE(hit.world.set_gravity({0, -9.81f, 0}).ok());
    return hit;
}

/// Steps until a hit is being worked off, and on for some frames.
void step_into_hit(World& world) {
    for (int frame = 0; frame < 60 && test::open_tasks(world) == 0; ++frame) world.step();
    for (int frame = 0; frame < 3; ++frame) world.step();
    EXPECT_GT(test::open_tasks(world), 0u);
}

/// A world of its own that goes on from these bytes.
World restored(const std::vector<uint8_t>& bytes, uint32_t threads = 1) {
    Settings settings = sliced_settings();
    settings.threads = threads;
    World world = test::make_world(settings);
    const Result<void> loaded = world.restore(bytes.data(), bytes.size());
    EXPECT_TRUE(loaded.ok()) << loaded.error();
    return world;
}

/// Both take the same steps, compared after each one.
void expect_same_steps(World& a, World& b, uint32_t frames) {
    ASSERT_EQ(a.hash(), b.hash()) << test::state_of(a).first_difference(test::state_of(b));
    for (uint32_t frame = 0; frame < frames; ++frame) {
        a.step(), b.step();
        ASSERT_EQ(a.hash(), b.hash()) << frame
                                      << " steps later: " << test::state_of(a).first_difference(test::state_of(b));
    }
}

TEST(Snapshot, AnyFrameOfABreakGoesOnFromItsBytes) {
    test::Breakage hit = vase_hit_over_a_floor();
    uint32_t mid_fracture = 0;
    const uint32_t each = test::few_or_all(2u, 1u);
    for (uint32_t frame = 0; frame < 60; ++frame) {
        hit.world.step();
        if (frame % each != 0 || (test::open_tasks(hit.world) == 0 && frame % 7 != 0)) continue;
        mid_fracture += test::open_tasks(hit.world);
        const std::vector<uint8_t> bytes = taken(hit.world);
        World twin = restored(bytes);
        // The one that was saved goes on in a copy of its own, so that the next frame starts from an unbroken run.
        World self = restored(bytes, 2);
        expect_same_steps(self, twin, 12);
    }
    EXPECT_GT(mid_fracture, 3u);
}

TEST(Snapshot, TheWorldThatWasSavedGoesOnAsTheOneThatLoads) {
    test::Breakage hit = vase_hit_over_a_floor();
    step_into_hit(hit.world);
    World twin = restored(taken(hit.world));
    expect_same_steps(hit.world, twin, 150);
    EXPECT_GT(test::shells_of(twin).size(), 3u);
    twin = restored(taken(hit.world));  // a heap that is coming to rest
    expect_same_steps(hit.world, twin, 60);
}

TEST(Snapshot, TakenTwiceItIsTheSameBytes) {
    test::Breakage hit = test::vase_and_ball(test::small_settings());
    for (int frame = 0; frame < 30; ++frame) hit.world.step();
    const std::vector<uint8_t> first = taken(hit.world);
    EXPECT_EQ(taken(hit.world), first);
    World twin = restored(first);
    EXPECT_EQ(taken(twin), first);
}

TEST(Snapshot, ARestingPileThatIsSavedEveryFrameStaysAsleep) {
    test::Breakage hit = vase_hit_over_a_floor();
    for (int frame = 0; frame < 600; ++frame) hit.world.step();
    World unsaved = restored(taken(hit.world));
    const auto asleep = [](World& world) {
        uint32_t count = 0;
        for (const BodyId body : test::all_bodies(world)) count += world.is_asleep(body).value();
        return count;
    };
    const uint32_t asleep_before = asleep(unsaved);
    EXPECT_GE(asleep_before, 2u);
    double most_saved = 0, most_unsaved = 0;
    for (int frame = 0; frame < 60; ++frame) {
        ASSERT_FALSE(taken(hit.world).empty());
        hit.world.step(), unsaved.step();
        most_saved = std::max(most_saved, test::matter_of(hit.world).kinetic_energy);
        most_unsaved = std::max(most_unsaved, test::matter_of(unsaved).kinetic_energy);
    }
    EXPECT_GE(asleep(hit.world), asleep_before);
    EXPECT_LE(most_saved, 1.1 * most_unsaved + 1e-12);
}

TEST(Snapshot, ASettlingHeapThatIsSavedEveryFrameComesToRestAsOneThatIsNot) {
    test::Breakage hit = vase_hit_over_a_floor();
    for (int frame = 0; frame < 90; ++frame) hit.world.step();
    World unsaved = restored(taken(hit.world));
    double saved_energy = 0, unsaved_energy = 0;  // J s
    for (int frame = 0; frame < 240; ++frame) {
        ASSERT_FALSE(taken(hit.world).empty());
        hit.world.step(), unsaved.step();
        saved_energy += test::matter_of(hit.world).kinetic_energy / 60;
        unsaved_energy += test::matter_of(unsaved).kinetic_energy / 60;
    }
    EXPECT_LE(saved_energy, 1.1 * unsaved_energy);
}

TEST(Snapshot, HandlesMotionAndViewsAreThoseOfTheWorldThatWasSaved) {
    test::Breakage hit = test::vase_and_ball(test::small_settings());
    ASSERT_GT(test::step_until_born(hit.world, 60), 0u);
    World twin = restored(taken(hit.world));
    for (const BodyId body : test::all_bodies(hit.world)) {
        ASSERT_TRUE(twin.is_alive(body));
        EXPECT_EQ(twin.mass(body).value(), hit.world.mass(body).value());
        EXPECT_EQ(twin.motion(body).value().velocity.z, hit.world.motion(body).value().velocity.z);
        EXPECT_EQ(twin.view(body).value().index_count, hit.world.view(body).value().index_count);
    }
    EXPECT_FALSE(twin.is_alive(BodyId{4000, 1}));
}

TEST(Snapshot, AFileGoesOnWhereItWasSaved) {
    const std::string path = (std::filesystem::temp_directory_path() / "cullet_snapshot_test.csnap").string();
    test::Breakage hit = test::vase_and_ball(test::small_settings());
    for (int frame = 0; frame < 20; ++frame) hit.world.step();
    ASSERT_TRUE(hit.world.save(path).ok());
    World twin = test::make_world(test::small_settings());
    const Result<void> loaded = twin.load(path);
    ASSERT_TRUE(loaded.ok()) << loaded.error();
    expect_same_steps(hit.world, twin, 20);
    std::remove(path.c_str());
    const Result<void> gone = twin.load(path);
    EXPECT_FALSE(gone.ok());
    EXPECT_NE(gone.error().find(path), std::string::npos) << gone.error();
}

TEST(Snapshot, RoomIsMadeReadyForTheLargestBodyAndNotForWhatASnapshotClaims) {
    test::Breakage hit = test::vase_and_ball(test::small_settings());
    const State& state = test::state_of(hit.world);
    const ShellRoom vase = working_room(ShellView(test::state_of(hit.world), state.bodies.structure[hit.body.index]));
    hit.world.contents().data.ready_for = {1u << 28, 1u << 28, 1u << 28, 1u << 28, 1u << 28, 1u << 28, 1u << 28};
    World twin = restored(taken(hit.world));
    const ShellRoom& found = twin.contents().data.ready_for;
    for (const auto rows : {&ShellRoom::vertices, &ShellRoom::elements, &ShellRoom::hinges, &ShellRoom::blocks,
                            &ShellRoom::links, &ShellRoom::cells})
        EXPECT_EQ(found.*rows, vase.*rows);
}

/// A refusal must leave the world as it was, a success must give the saved one.
void expect_refused_or_same(World& world, const std::vector<uint8_t>& damaged, uint64_t good_hash, size_t at) {
    const uint64_t before = world.hash();
    const Result<void> loaded = world.restore(damaged.data(), damaged.size());
    if (loaded.ok()) {
        ASSERT_EQ(world.hash(), good_hash) << "byte " << at;
    } else {
        ASSERT_EQ(world.hash(), before) << "byte " << at;
        ASSERT_NE(loaded.error().find("snapshot"), std::string::npos) << loaded.error();
    }
}

TEST(Snapshot, TwoThousandFlippedBytesAreRefusedOrGiveTheSameWorld) {
    test::Breakage hit = vase_hit_over_a_floor();
    step_into_hit(hit.world);
    const std::vector<uint8_t> good = taken(hit.world);
    const uint64_t hash = hit.world.hash();
    World world = test::make_world(test::small_settings());
    for (size_t k = 0; k < 2000; ++k) {
        std::vector<uint8_t> damaged = good;
        const size_t at = k < 128 ? k : k * good.size() / 2000;
        damaged[at] ^= static_cast<uint8_t>(1u << (k % 8));
        expect_refused_or_same(world, damaged, hash, at);
    }
}

TEST(Snapshot, EveryCutIsRefused) {
    test::Breakage hit = test::vase_and_ball(test::small_settings());
    hit.world.step();
    const std::vector<uint8_t> good = taken(hit.world);
    World world = test::make_world(test::small_settings());
    for (size_t k = 0; k < 200; ++k) {
        const std::vector<uint8_t> cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(k * good.size() / 200));
        EXPECT_FALSE(world.restore(cut.data(), cut.size()).ok());
    }
}

}  // namespace
}  // namespace cullet
