// Soft bodies among others: against each other, under explosions, removed, saved, replayed, hit again, short of units.
#include <filesystem>

#include "components/state.hpp"
#include "cullet/recording.hpp"
#include "tests/support/write_watch.hpp"
#include "tests/systems/models/thick_shell/soft/soft_world.hpp"

namespace cullet::test {
namespace {

/// A rubber sheet that flies along -z at a cloth that hangs free, both without gravity.
struct TwoSheets {
    Sheet first;
    BodyId second;
    Row<SoftBodies> soft(BodyId body) { return first.state().bodies.soft[Row<Bodies>(body.index)]; }
    SpringMotion motion(BodyId body) {
        State& state = first.state();
        return motion_of(SpringView(state, springs_of(state, soft(body))));
    }
};

TwoSheets make_two(uint32_t threads, float speed = 3, bool is_pinned = false) {
    TwoSheets two{make_sheet(cloth_sheet(), soft_settings(threads), is_pinned ? frame_pins() : std::vector<Box>{}), {}};
    World& world = two.first.world;
    SpawnSettings spawn;
    spawn.pose.position = {0.02f, 0.03f, 0.08f};
    spawn.motion.velocity = {0, 0, -speed};
    two.second = world.spawn(world.add_model(rubber_sheet()).value(), spawn).value();
    two.first.call();
    two.first.state().soft_bodies.is_called[two.soft(two.second)] = 1;
    return two;
}

TEST(SoftMeetings, TwoSheetsKeepTheirMomentumAndLoseEnergy) {
    TwoSheets two = make_two(1);
    two.first.world.step();
    const SpringMotion a = two.motion(two.first.body), b = two.motion(two.second);
    const Vec3d momentum = a.momentum + b.momentum;
    const double start = a.kinetic + b.kinetic;
    double most_change = 0;
    for (int frame = 0; frame < 60; ++frame) {
        two.first.world.step();
        const SpringMotion c = two.motion(two.first.body), d = two.motion(two.second);
        EXPECT_LT(length(c.momentum + d.momentum - momentum), 2e-3 * length(momentum)) << "frame " << frame;
        EXPECT_LT(c.kinetic + d.kinetic, start * 1.003) << "frame " << frame;
        most_change = std::max(most_change, length(c.momentum - a.momentum));
    }
    EXPECT_GT(most_change, 0.05 * length(momentum)) << "they met";
}

TEST(SoftMeetings, TwoSheetsGiveTheSameBytesOnAnyNumberOfThreads) {
    TwoSheets one = make_two(1), two = make_two(2), three = make_two(3), eight = make_two(8);
    for (int frame = 0; frame < 30; ++frame) {
        for (TwoSheets* sheets : {&one, &two, &three, &eight}) sheets->first.world.step();
        ASSERT_EQ(one.first.world.hash(), two.first.world.hash()) << "frame " << frame;
        ASSERT_EQ(one.first.world.hash(), three.first.world.hash()) << "frame " << frame;
        ASSERT_EQ(one.first.world.hash(), eight.first.world.hash()) << "frame " << frame;
    }
}

TEST(SoftMeetings, AnExplosionWakesASheetAndBlowsItAway) {
    for (const bool is_pinned : {false, true}) {
        Sheet sheet = make_sheet(steel_sheet(), soft_settings(), is_pinned ? frame_pins() : std::vector<Box>{});
        const std::vector<Vec3> before = sheet.shape();
        ExplosionSettings explosion;
        explosion.centre = {0, 0.2f, 0.3f};
        explosion.radius = 1;
        explosion.impulse = 60;
        ASSERT_TRUE(sheet.world.explode(explosion).ok());
        sheet.world.step();
        EXPECT_TRUE(sheet.is_awake());
        const double pushed = sheet.world.motion(sheet.body).value().velocity.z;
        if (!is_pinned) {
            EXPECT_LT(pushed, -0.5) << "along -z, away from it";
        }
        float deepest = 0;
        for (int frame = 0; frame < 40; ++frame) {
            sheet.world.step();
            deepest = std::max(deepest, farthest(before, sheet.shape()));
        }
        EXPECT_TRUE(sheet.world.is_alive(sheet.body));
        if (is_pinned) {
            EXPECT_GT(deepest, 0.003f) << "it bulges";
        }
        EXPECT_LT(deepest, 0.4f);
    }
}

TEST(SoftMeetings, RemovingASheetOrItsStrikerInMidRunLeavesTheRestSound) {
    for (const bool is_striker : {false, true}) {
        TwoSheets two = make_two(2);
        World& world = two.first.world;
        throw_ball(two.first, 0.2f, 4);
        expect_valid_after_each_system(world);
        for (int frame = 0; frame < 5; ++frame) world.step();
        ASSERT_TRUE(two.first.is_awake());
        ASSERT_TRUE(world.remove(is_striker ? two.first.ball : two.first.body).ok());
        for (int frame = 0; frame < 20; ++frame) world.step();
        const Result<std::vector<uint8_t>> bytes = world.snapshot();
        ASSERT_TRUE(bytes.ok()) << bytes.error();
        World other = make_world(soft_settings());
        const Result<void> loaded = other.restore(bytes.value().data(), bytes.value().size());
        ASSERT_TRUE(loaded.ok()) << loaded.error();
        EXPECT_EQ(world.is_alive(two.first.body), is_striker);
        // The row is used again.
        SpawnSettings spawn;
        spawn.pose.position = {2, 0, 0};
        EXPECT_TRUE(world.spawn(world.add_model(cloth_sheet()).value(), spawn).ok());
        world.step();
    }
}

TEST(SoftMeetings, ATornSheetGoesOnFromASnapshot) {
    Settings settings = soft_settings(2);
    settings.gravity = {0, -9.81f, 0};
    Sheet sheet = make_sheet(cloth_sheet(), settings, frame_pins(), 0.3f);
    throw_ball(sheet, 5, 20, 0.09f);
    uint32_t frame = 0;
    while (frame < 60 && sheet.state().soft_bodies.tear_count[sheet.soft()] < 20) sheet.world.step(), ++frame;
    ASSERT_LT(frame, 60u) << "it tears";
    const Result<std::vector<uint8_t>> bytes = sheet.world.snapshot();
    ASSERT_TRUE(bytes.ok()) << bytes.error();
    World other = make_world(soft_settings(1));
    const Result<void> loaded = other.restore(bytes.value().data(), bytes.value().size());
    ASSERT_TRUE(loaded.ok()) << loaded.error();
    for (frame = 0; frame < 30; ++frame) {
        sheet.world.step();
        other.step();
        ASSERT_EQ(sheet.world.hash(), other.hash()) << "frame " << frame;
    }
}

TEST(SoftMeetings, ARecordedRunIsReplayedToTheSameBytes) {
    const std::string path = (std::filesystem::temp_directory_path() / "cullet_soft_replay.crec").string();
    {
        World world = make_world(soft_settings(2));
        ASSERT_TRUE(world.start_recording(path).ok());
        ASSERT_TRUE(world.set_gravity({0, -9.81f, 0}).ok());
        SpawnSettings spawn;
        const std::vector<Box> pins = frame_pins();
        spawn.pins = pins.data();
        spawn.pin_count = static_cast<uint32_t>(pins.size());
        spawn.strength_scale = 0.3f;
        const ModelId cloth = world.add_model(cloth_sheet()).value();
        const BodyId sheet = world.spawn(cloth, spawn).value();
        ASSERT_TRUE(world.add_sphere(ball_at({0.01f, 0.21f, 0}, 5, 20, 0.09f)).ok());
        for (int frame = 0; frame < 40; ++frame) {
            ExplosionSettings explosion;
            explosion.centre = {0, 0.2f, 0.5f};
            explosion.impulse = 5;
            const bool is_done = frame == 20   ? world.explode(explosion).ok()
                                 : frame == 30 ? world.remove(sheet).ok()
                                               : true;
            ASSERT_TRUE(is_done) << "frame " << frame;
            world.step();
        }
        ASSERT_TRUE(world.stop_recording().ok());
    }
    ReplaySettings settings;
    settings.threads = {1, 3};
    const Result<ReplayReport> report = replay(path, settings);
    ASSERT_TRUE(report.ok()) << report.error();
    EXPECT_TRUE(report->difference.empty()) << report->difference;
    EXPECT_EQ(report->frames, 40u);
    std::filesystem::remove(path);
}

/// How far all springs have flowed for good, together: m.
float flow_of(Sheet& sheet) {
    const SpringView view = sheet.view();
    const Springs& springs = sheet.state().springs;
    float sum = 0;
    for (uint32_t s = 0; s < view.spring_count(); ++s)
        sum += std::fabs(springs.plastic_length[view.spring(s)] - springs.rest_length[view.spring(s)]);
    return sum;
}

TEST(SoftMeetings, ADentedPlateThatIsHitAgainKeepsItsDentAndWhatHasFlowed) {
    Sheet sheet = make_sheet(steel_sheet(), soft_settings(), frame_pins());
    const std::vector<Vec3> flat = sheet.shape();
    throw_ball(sheet, 3, 8, 0.05f);
    for (uint32_t frame = 0; frame < 900 && (frame < 30 || sheet.is_awake()); ++frame) sheet.world.step();
    ASSERT_FALSE(sheet.is_awake());
    const std::vector<Vec3> dented = sheet.shape();
    const float dent = farthest(flat, dented), flowed = flow_of(sheet);
    ASSERT_GT(dent, 0.002f);
    // Woken by nothing: its inner layer stands where it stood, so that nothing jumps.
    sheet.call();
    sheet.world.step();
    EXPECT_LT(farthest(dented, sheet.shape()), 0.05f * dent);
    for (uint32_t frame = 0; frame < 900 && sheet.is_awake(); ++frame) sheet.world.step();
    EXPECT_LT(farthest(dented, sheet.shape()), 0.1f * dent);
    EXPECT_GE(flow_of(sheet), 0.999f * flowed);
    // A lighter ball than the first.
    ASSERT_TRUE(sheet.world.remove(sheet.ball).ok());
    throw_ball(sheet, 1, 6, 0.05f);
    for (uint32_t frame = 0; frame < 900 && (frame < 30 || sheet.is_awake()); ++frame) sheet.world.step();
    EXPECT_GT(farthest(flat, sheet.shape()), 0.6f * dent)
        << "softened as it is, the plate waves, and the dent flattens";
    EXPECT_GE(flow_of(sheet), flowed) << "the second blow adds to the first";
}

TEST(SoftMeetings, ShortOfUnitsASheetRunsSlowerAndThatIsCounted) {
    Settings settings = soft_settings();
    settings.gravity = {0, -9.81f, 0};
    const auto fall = [&](uint64_t units, uint64_t& slow, uint64_t& used) {
        Sheet sheet = make_sheet(rubber_sheet(), settings);
        sheet.call();
        sheet.world.contents().data.damage_settings.units_a_frame = units;
        for (int frame = 0; frame < 10; ++frame) sheet.world.step();
        slow = sheet.world.contents().data.counts.slow_soft_frames;
        used = sheet.world.contents().data.counts.units_used;
        EXPECT_GE(sheet.state().soft_bodies.granted[sheet.soft()], kLeastSubsteps);
        EXPECT_EQ(sheet.state().soft_bodies.slow_frames[sheet.soft()], slow);
        return double{sheet.world.pose(sheet.body).value().position.y};
    };
    uint64_t slow = 0, used = 0;
    const double whole = fall(settings.units_a_frame, slow, used);
    EXPECT_EQ(slow, 0u);
    EXPECT_GT(used, 0u) << "its substeps are booked";
    const uint64_t full = used;
    const double half = fall(full / 2, slow, used);
    EXPECT_EQ(slow, 10u);
    EXPECT_LE(used, full / 2);
    EXPECT_LT(half, 0);
    EXPECT_NEAR(half / whole, 0.25, 0.08) << "half of the time, a quarter of the way";
    const double least = fall(1, slow, used);
    EXPECT_LT(least, 0) << "it never stands still";
}

TEST(SoftMeetings, SystemsWriteTheTablesThatTheySayThatTheyWrite) {
    Settings settings = soft_settings();
    settings.gravity = {0, -9.81f, 0};
    Sheet sheet = make_sheet(cloth_sheet(), settings, frame_pins(), 0.3f);
    throw_ball(sheet, 5, 20, 0.09f);
    WriteWatch watch(sheet.world);
    for (int frame = 0; frame < 30; ++frame) {
        watch.watch_next_step();
        sheet.world.step();
    }
    for (const std::string& sentence : watch.unsaid()) ADD_FAILURE() << sentence;
}

}  // namespace
}  // namespace cullet::test
