// What was asked of a world is asked again of another, which gives the same bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "cullet/recording.hpp"
#include "engine/mesh_file.hpp"
#include "systems/api/recorder.hpp"
#include "systems/api/replay.hpp"
#include "systems/api/with_models.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet {
namespace {

namespace fs = std::filesystem;

std::string file_of(const std::string& name) {
    const fs::path folder = fs::temp_directory_path() / ("cullet_recording_test." + std::to_string(getpid()));
    fs::create_directories(folder);
    return (folder / name).string();
}

void remove_files() {
    fs::remove_all(fs::path(file_of("x")).parent_path());
}

template <class T>
void expect_done(const Result<T>& result) {
    EXPECT_TRUE(result.ok()) << result.error();
}

ReplaySettings on(std::vector<uint32_t> threads) {
    ReplaySettings settings;
    settings.threads = std::move(threads);
    return settings;
}

/// All calls that there are, and a hit that takes several frames. Hashes of the steps.
std::vector<uint64_t> play_and_record(const std::string& path, uint32_t frames = 60) {
    Settings settings = test::small_settings();
    settings.units_a_frame = 1'500'000;
    World world = test::make_world(settings);
    EXPECT_TRUE(world.start_recording(path).ok());
    EXPECT_TRUE(world.set_gravity({0, -9.81f, 0}).ok());
    const ModelId model = world.add_model(test::small_vase()).value();
    const BodyId floor = test::add_floor(world);
    EXPECT_TRUE(floor);
    static int vetoes = 0;
    vetoes = 0;
    world.set_veto([](void*, const ImpactEvent&) { return ++vetoes > 2; }, nullptr);
    SpawnSettings place;
    place.pose.position = {0, 0.2f, 0};
    place.user_data = 7;
    const BodyId vase = world.spawn(model, place).value();
    place.pose.position = {1, 0.4f, 0};
    const BodyId other = world.spawn(model, place).value();
    const BodyId ball = world.add_sphere(test::ball_at({0, 0.35f, 0}, 0.3f, 8)).value();
    KinematicSettings box;
    box.pose.position = {2, 0, 0};
    box.half_extents = {0.2f, 0.1f, 0.2f};
    const BodyId lift = world.add_kinematic_box(box).value();
    EXPECT_TRUE(world.remove_model(model).ok());
    EXPECT_FALSE(world.remove_model(model).ok());
    std::vector<uint64_t> hashes;
    for (uint32_t frame = 0; frame < frames; ++frame) {
        if (frame == 5) expect_done(world.set_motion(lift, {{0, 0.5f, 0}, {}}));
        if (frame == 8) expect_done(world.apply_impulse(other, {0.1f, 0, 0.02f}, {1, 0.5f, 0}));
        if (frame == 20) expect_done(world.set_pose(ball, {{0.5f, 1, 0}, {}}));
        if (frame == 25) expect_done(world.snapshot());
        if (frame == 30) expect_done(world.remove(ball));
        if (frame == 40) expect_done(world.wake(vase));
        if (frame == 45) expect_done(world.shift_origin({8, 0, -4}));
        world.step();
        hashes.push_back(world.hash());
    }
    if (frames >= 60) {
        EXPECT_GT(test::shells_of(world).size(), 2u) << "nothing broke";
    }
    const Result<void> stopped = world.stop_recording();
    EXPECT_TRUE(stopped.ok()) << stopped.error();
    return hashes;
}

TEST(Recording, AReplayGivesEveryHashOnAnyNumberOfThreads) {
    const std::string path = file_of("all.crec");
    (void)play_and_record(path);
    const Result<ReplayReport> report = replay(path, on({1, 2, 3}));
    ASSERT_TRUE(report.ok()) << report.error();
    EXPECT_EQ(report->frames, 60u);
    EXPECT_EQ(report->first_frame, 0u);
    EXPECT_EQ(report->difference, "");
    EXPECT_EQ(report->damage, "");
    EXPECT_NE(report->recorded_with.find("cullet"), std::string::npos);
    remove_files();
}

TEST(Recording, ARecordingMayBeginInMidFracture) {
    const std::string path = file_of("late.crec");
    Settings settings = test::small_settings();
    settings.units_a_frame = 600'000;
    test::Breakage hit = test::vase_and_ball(settings);
    for (int frame = 0; frame < 60 && test::open_tasks(hit.world) == 0; ++frame) hit.world.step();
    ASSERT_GT(test::open_tasks(hit.world), 0u);
    const Result<void> started = hit.world.start_recording(path);
    ASSERT_TRUE(started.ok()) << started.error();
    EXPECT_FALSE(hit.world.start_recording(path).ok());
    for (int frame = 0; frame < 20; ++frame) hit.world.step();
    ASSERT_TRUE(hit.world.stop_recording().ok());
    const Result<ReplayReport> report = replay(path, on({1, 2}));
    ASSERT_TRUE(report.ok()) << report.error();
    EXPECT_EQ(report->frames, 20u);
    EXPECT_EQ(report->difference, "");
    remove_files();
}

/// Behind a chunk of this kind.
std::vector<size_t> ends_of(const std::vector<uint8_t>& file, std::initializer_list<ChunkKind> kinds) {
    RecordingReader reader(file, "good");
    EXPECT_TRUE(reader.begin().ok());
    std::vector<size_t> ends;
    for (Chunk chunk; reader.next(chunk);)
        if (std::find(kinds.begin(), kinds.end(), chunk.kind) != kinds.end())
            ends.push_back(chunk.first_byte + chunk.bytes.size() + 8);
    return ends;
}

/// The file cut at `size`, replayed: the good prefix gives its hashes, and a sentence names the first bad byte, unless
/// it is whole.
void expect_prefix(const std::string& path, const std::vector<uint8_t>& good, size_t size, bool is_whole = false) {
    const std::string cut = path + ".cut";
    std::ofstream(cut, std::ios::binary)
        .write(reinterpret_cast<const char*>(good.data()), static_cast<std::streamsize>(size));
    fs::remove_all(cut + ".models");
    fs::create_directory_symlink(path + ".models", cut + ".models");
    const Result<ReplayReport> report = replay(cut);
    if (report.ok()) {
        EXPECT_EQ(report->difference, "") << size;
        const bool is_named = report->damage.find("byte ") != std::string::npos;
        EXPECT_TRUE(is_whole ? report->damage.empty() : is_named) << size << ": " << report->damage;
    } else {
        EXPECT_FALSE(is_whole);
        EXPECT_NE(report.error().find(cut), std::string::npos) << report.error();
    }
}

TEST(Recording, OfManyCutsEachReplaysItsGoodPart) {
    const std::string path = file_of("cut.crec");
    (void)play_and_record(path, 24);
    const std::vector<uint8_t> good = read_whole_file(path, 1u << 30).value();
    const std::vector<size_t> whole = ends_of(good, {ChunkKind::Begin, ChunkKind::Step});
    std::vector<size_t> cuts = ends_of(good, {ChunkKind::Begin, ChunkKind::Calls, ChunkKind::Step});
    ASSERT_EQ(cuts.size(), 49u);
    const size_t others = test::few_or_all<size_t>(20, 151);
    for (size_t k = 0; k < others; ++k) cuts.push_back(k * good.size() / others);
    for (const size_t cut : cuts)
        expect_prefix(path, good, cut, std::find(whole.begin(), whole.end(), cut) != whole.end());
    remove_files();
}

/// A file of these chunks, which need not make sense.
std::string file_of_chunks(const char* name, const std::vector<std::pair<ChunkKind, std::vector<uint8_t>>>& chunks) {
    const std::string path = file_of(name);
    RecordingWriter writer(RecordingWriter::open(path).value());
    for (const auto& [kind, bytes] : chunks) writer.append(kind, bytes);
    return path;
}

TEST(Recording, ChunksOutOfOrderAndAStepWithoutItsResultAreTold) {
    const std::string path = file_of("order.crec");
    (void)play_and_record(path, 2);
    const std::vector<uint8_t> good = read_whole_file(path, 1u << 30).value();
    RecordingReader reader(good, "good");
    ASSERT_TRUE(reader.begin().ok());
    std::vector<std::pair<ChunkKind, std::vector<uint8_t>>> chunks;
    for (Chunk chunk; reader.next(chunk);)
        chunks.emplace_back(chunk.kind, std::vector<uint8_t>(chunk.bytes.begin(), chunk.bytes.end()));
    ASSERT_EQ(chunks.size(), 5u);
    const std::pair<ChunkKind, std::vector<uint8_t>> no_calls(ChunkKind::Calls, {});
    const struct {
        std::vector<std::pair<ChunkKind, std::vector<uint8_t>>> chunks;
        const char* told;
    } cases[] = {{{chunks[0], no_calls, no_calls, chunks[2]}, "stands out of order"},
                 {{chunks[0], chunks[2]}, "stands out of order"},
                 {{chunks[0], no_calls, chunks[0]}, "stands out of order"},
                 {{chunks[0], no_calls}, "has no result: the run ended in it"}};
    for (const auto& c : cases) {
        const Result<ReplayReport> report = replay(file_of_chunks("crafted.crec", c.chunks));
        ASSERT_TRUE(report.ok()) << report.error();
        EXPECT_EQ(report->frames, 0u);
        EXPECT_NE(report->damage.find(c.told), std::string::npos) << report->damage;
        EXPECT_NE(report->damage.find(" byte "), std::string::npos) << report->damage;
    }
    remove_files();
}

TEST(Recording, ACutInTheMiddleOfAStepNamesTheByteAndKeepsTheStepsBeforeIt) {
    const std::string path = file_of("middle.crec");
    (void)play_and_record(path, 24);
    std::vector<uint8_t> bytes = read_whole_file(path, 1u << 30).value();
    bytes.resize(bytes.size() - 5);
    ASSERT_TRUE(write_whole_file(bytes, path).ok());
    const Result<ReplayReport> report = replay(path);
    ASSERT_TRUE(report.ok()) << report.error();
    EXPECT_EQ(report->frames, 23u);
    EXPECT_EQ(report->difference, "");
    EXPECT_NE(report->damage.find("cut off"), std::string::npos) << report->damage;
    remove_files();
}

TEST(Recording, FlippedBytesAreRefusedOrGiveTheSameWorld) {
    const std::string path = file_of("flip.crec");
    (void)play_and_record(path, 24);
    const std::vector<uint8_t> good = read_whole_file(path, 1u << 30).value();
    const size_t flips = test::few_or_all<size_t>(60, 200);
    for (size_t k = 0; k < flips; ++k) {
        std::vector<uint8_t> damaged = good;
        damaged[k * good.size() / flips] ^= static_cast<uint8_t>(1u << (k % 8));
        expect_prefix(path, damaged, damaged.size());
    }
    remove_files();
}

TEST(Recording, EveryFlippedByteIsFoundBeforeItsChunkIsReplayed) {
    const std::string path = file_of("flips.crec");
    (void)play_and_record(path, 24);
    const std::vector<uint8_t> good = read_whole_file(path, 1u << 30).value();
    for (size_t k = 0; k < 2000; ++k) {
        std::vector<uint8_t> damaged = good;
        const size_t at = k * good.size() / 2000;
        damaged[at] ^= static_cast<uint8_t>(1u << (k % 8));
        RecordingReader reader(damaged, "flipped");
        if (!reader.begin()) continue;
        Chunk chunk;
        uint64_t end = 16;
        while (reader.next(chunk)) end = chunk.first_byte + chunk.bytes.size() + 8;
        EXPECT_LE(end, at) << "byte " << at << " was believed";
        EXPECT_NE(reader.damage(), "");
    }
    remove_files();
}

TEST(Recording, AModelThatIsGoneIsNamed) {
    const std::string path = file_of("model.crec");
    (void)play_and_record(path, 3);
    fs::remove_all(path + ".models");
    const Result<ReplayReport> report = replay(path);
    ASSERT_TRUE(report.ok()) << report.error();
    EXPECT_EQ(report->frames, 0u);
    EXPECT_NE(report->damage.find(".cmodel"), std::string::npos) << report->damage;
    remove_files();
}

TEST(Recording, WhatIsNoRecordingIsRefusedInASentence) {
    const std::string path = file_of("none.crec");
    ASSERT_TRUE(write_whole_file(std::vector<uint8_t>{1, 2, 3}, path).ok());
    EXPECT_NE(replay(path).error().find("is no recording"), std::string::npos);
    EXPECT_NE(replay(path + ".gone").error().find(path), std::string::npos);
    EXPECT_FALSE(replay(path, on({})).ok());
    World world = test::make_world(test::small_settings());
    const Result<void> started = world.start_recording("/nowhere/at/all.crec");
    EXPECT_NE(started.error().find("/nowhere/at/all.crec"), std::string::npos) << started.error();
    remove_files();
}

TEST(Recording, OneThatAsksForMoreRoomThanThereIsIsRefusedWithItsLimits) {
    const std::string path = file_of("large.crec");
    Settings settings = test::small_settings();
    settings.limits.vertices = settings.limits.elements = 1u << 23;
    Host frugal;
    frugal.allocator.allocate = [](void*, size_t size, size_t alignment) {
        constexpr size_t kMost = 1u << 26;
        return size > kMost ? nullptr : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    };
    frugal.allocator.release = [](void*, void* memory, size_t) { std::free(memory); };
    World world = test::make_world(settings);
    expect_done(world.start_recording(path));
    world.step();
    expect_done(world.stop_recording());
    const Result<ReplayReport> report = replay(path, {}, frugal);
    EXPECT_NE(report.error().find(path), std::string::npos) << report.error();
    EXPECT_NE(report.error().find("vertices 8388608"), std::string::npos) << report.error();
    remove_files();
}

TEST(Recording, AWorldOfMoreBytesThanAChunkIsRefused) {
    const std::string path = file_of("chunk.crec");
    Recorder recorder(RecordingWriter::open(path).value(), path + ".models", damage_models());
    const std::vector<uint8_t> small(100);
    // The bytes behind the first hundred are not looked at.
    const Result<void> begun = recorder.begin({small.data(), size_t{kMostChunkBytes}});
    EXPECT_NE(begun.error().find("takes 21474836"), std::string::npos) << begun.error();
    expect_done(recorder.begin(small));
    remove_files();
}

TEST(Recording, AFullDiskEndsTheRecordingAndTheLogIsToldOnce) {
    std::vector<std::string> told;
    Host host;
    host.user = &told;
    host.log = [](void* user, LogLevel, const char* sentence) {
        static_cast<std::vector<std::string>*>(user)->push_back(sentence);
    };
    World world = test::make_world(test::small_settings(), host);
    ASSERT_TRUE(world.start_recording("/dev/full").ok());
    ASSERT_TRUE(world.add_sphere(test::ball_at({0, 0, 0}, 1, 1)).ok());
    for (int frame = 0; frame < 5; ++frame) world.step();
    ASSERT_EQ(told.size(), 1u);
    EXPECT_NE(told[0].find("disk"), std::string::npos) << told[0];
    EXPECT_FALSE(world.stop_recording().ok());
}

/// What first_difference tells of two runs of a recording when one of them is pushed in the step behind `steps`.
std::string told_of_a_push(const std::string& path, uint64_t steps) {
    const std::vector<uint8_t> bytes = read_whole_file(path, 1u << 30).value();
    const Replayer::Source source{bytes, path, path + ".models", &create_with};
    return first_difference([&](int which) {
        auto run = std::make_unique<Replayer>(source, 1, Host{});
        EXPECT_TRUE(run->begin().ok());
        for (uint64_t step = 0; step < steps; ++step) EXPECT_TRUE(run->step());
        if (which == 1)
            run->world().contents().after_each_system = [&run = *run](const PlannedSystem<WorldData>& system) {
                if (system.name != "read_rigid") return;
                test::state_of(run.world()).bodies.velocity.set(1, {1, 2, 3});
                run.world().contents().data.counts.work_from_outside += 1000;  // J, more than that
            };
        return run;
    });
}

TEST(Recording, TwoRunsThatPartAreToldBySystemFrameTableColumnAndRow) {
    const std::string path = file_of("part.crec");
    (void)play_and_record(path, 30);
    const std::string found = told_of_a_push(path, 12);
    EXPECT_NE(found.find("after read_rigid, frame 12: bodies.velocity[1].x"), std::string::npos) << found;
    remove_files();
}

TEST(Recording, RunsThatPartInAStepThatRestoresAreToldByTheFrameThatTheClockWasSetTo) {
    const std::string path = file_of("restore.crec");
    World world = test::make_world(test::small_settings());
    ASSERT_TRUE(world.start_recording(path).ok());
    for (const float x : {0.0f, 1.0f}) (void)world.add_sphere(test::ball_at({x, 0, 0}, 1, 1)).value();
    std::vector<uint8_t> bytes;
    for (int step = 0; step < 10; ++step) {
        if (step == 3) bytes = world.snapshot().value();
        if (step == 7) expect_done(world.restore(bytes.data(), bytes.size()));
        world.step();
    }
    ASSERT_TRUE(world.stop_recording().ok());
    for (const uint64_t steps : {7, 9}) {
        const std::string found = told_of_a_push(path, steps);
        const std::string frame = "frame " + std::to_string(steps - 4) + ": bodies.velocity[1].x";
        EXPECT_NE(found.find("after read_rigid, " + frame), std::string::npos) << found;
    }
    const Result<ReplayReport> report = replay(path, on({1, 2}));
    ASSERT_TRUE(report.ok()) << report.error();
    EXPECT_EQ(report->frames, 10u);
    EXPECT_EQ(report->difference, "");
    remove_files();
}

TEST(Recording, AWorldThatTheGameChangedBehindTheCallsIsToldByFrameAndColumn) {
    const std::string path = file_of("behind.crec");
    World world = test::make_world(test::small_settings());
    ASSERT_TRUE(world.start_recording(path).ok());
    (void)world.add_sphere(test::ball_at({0, 0, 0}, 1, 1));
    for (int frame = 0; frame < 10; ++frame) {
        if (frame == 6) test::state_of(world).bodies.friction[0] = 0.7f;
        world.step();
    }
    ASSERT_TRUE(world.stop_recording().ok());
    const Result<ReplayReport> report = replay(path, on({1, 2}));
    ASSERT_TRUE(report.ok()) << report.error();
    EXPECT_EQ(report->frames, 6u);
    EXPECT_NE(report->difference.find("frame 6: bodies.friction differ"), std::string::npos) << report->difference;
    remove_files();
}

}  // namespace
}  // namespace cullet
