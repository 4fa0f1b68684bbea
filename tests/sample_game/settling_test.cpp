// From the last break or fall on: pieces sleep in time, then nothing moves, and what is not hit any more only loses
// energy. In the same plays, ten seconds after their start: how what is drawn lies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>

#include "components/body_id.hpp"
#include "sample_game/rest.hpp"
#include "sample_game/run_scene.hpp"
#include "systems/world_contents.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/scene_hashes.hpp"

namespace cullet {
namespace {

constexpr uint32_t kAsleepBy = 300, kStillBy = 600, kStillFor = 120;  // frames after the last break or fall
constexpr uint32_t kMostFrames = 3000;
constexpr uint32_t kRestAfter = 600;  // frames from the start
constexpr uint32_t kWindow = 30;      // frames
// What closes this fast has fallen: a piece of the castle leans on what stands for three seconds, tips over and comes
// down from two metres. What shakes in a heap is slower.
constexpr float kFallSpeed = 1;  // m/s
// A hit closes faster than this: what the rigid world wakes a sleeper for, above the 0.04 m/s of settled piles.
constexpr float kHitSpeed = 0.05f;  // m/s
// What the last bits of a solve leave over: half a millimetre a second.
constexpr double kNoise = 1e-7;  // J/kg

struct Moment {
    double kinetic = 0, height = 0;  // J, of the pieces
    bool is_hit = false;
};

struct Settling {
    uint64_t last_break = 0;         // or fall
    uint32_t loads = 0;              // of all frames: what was taken for more than a body bears
    std::vector<Moment> moments;     // after it
    size_t pieces = 0, asleep = 0;   // kAsleepBy frames after it
    std::vector<std::string> awake;  // then
    size_t moved = 0;                // pieces that did between kStillBy and kStillBy + kStillFor
    size_t fallen_off = 0;
    double mass = 0;
    Rest rest;  // kRestAfter frames after the start, where that is asked for
};

/// Dynamic bodies that are not pinned; those that left the floor over its edge fall for ever and are only counted.
std::vector<uint32_t> pieces_of(const Bodies& bodies, size_t& fallen_off) {
    std::vector<uint32_t> pieces;
    fallen_off = 0;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        if (bodies.kind[b] != static_cast<uint8_t>(BodyKind::Dynamic) || bodies.has_pins[b]) continue;
        if (centre_of(bodies, Row<Bodies>(b)).y < -1)
            ++fallen_off;
        else
            pieces.push_back(b);
    }
    return pieces;
}

Moment measure(const WorldData& data, const std::vector<uint32_t>& pieces) {
    Moment moment;
    const Bodies& bodies = data.state.bodies;
    for (const uint32_t b : pieces) {
        const Vec3d v(bodies.velocity[b]), w(rotate(conjugate(bodies.orientation[b]), bodies.spin[b]));
        moment.kinetic += 0.5 * (bodies.mass[b] * dot(v, v) + dot(w, bodies.inertia[b] * w));
        const Vec3 centre = to_world({bodies.position[b], bodies.orientation[b]}, bodies.centre[b].to_float());
        moment.height += bodies.mass[b] * 9.81 * static_cast<double>(centre.y);
    }
    for (const RigidContact& c : data.rigid->contacts()) moment.is_hit |= c.approach_speed > kHitSpeed;
    return moment;
}

/// Where a piece is; by row and generation, because rows are given to others once a piece is gone.
struct Place {
    struct Piece {
        uint32_t index, generation;
        bool operator==(const Piece&) const = default;
    } piece;
    Pose pose;
};

std::vector<Place> places_of(const Bodies& bodies, const std::vector<uint32_t>& pieces) {
    std::vector<Place> places;
    for (const uint32_t b : pieces)
        places.push_back({{b, bodies.generation[b]}, {bodies.position[b], bodies.orientation[b]}});
    return places;
}

/// Pieces that are not where they were. What is gone since has not moved, what is new has.
size_t count_moved(const std::vector<Place>& before, const std::vector<Place>& after) {
    size_t moved = 0;
    for (const Place& now : after) {
        const auto same = [&](const Place& then) {
            return then.piece == now.piece && std::memcmp(&then.pose, &now.pose, sizeof(Pose)) == 0;
        };
        moved += std::none_of(before.begin(), before.end(), same);
    }
    return moved;
}

bool has_fallen(const RigidWorld& rigid) {
    const auto contacts = rigid.contacts();
    return std::any_of(contacts.begin(), contacts.end(),
                       [](const RigidContact& c) { return c.approach_speed > kFallSpeed; });
}

Settling settle(GameWorld& game, bool measures_rest) {
    Settling out;
    Rest rest;
    double peak = measure_matter(game.world()).kinetic_energy;
    uint32_t loads = 0;
    const WorldData& data = game.world().contents().data;
    const Bodies& bodies = data.state.bodies;
    std::vector<Place> places;
    for (uint32_t frame = 0; frame < kMostFrames && out.moments.size() < kStillBy + kStillFor; ++frame) {
        test::play_frame(game);
        if (measures_rest && frame < kRestAfter) peak = std::max(peak, measure_matter(game.world()).kinetic_energy);
        if (measures_rest && frame + 1 == kRestAfter) rest = measure_rest(game, peak);
        for (const ImpactEvent& event : game.world().events().impacts) loads += event.load > 0;
        EXPECT_EQ(game.failure(), "");
        if (game.broke() || !game.waits_at().empty() || has_fallen(*data.rigid)) {
            out = {};
            out.last_break = frame;
            continue;
        }
        const std::vector<uint32_t> pieces = pieces_of(bodies, out.fallen_off);
        out.moments.push_back(measure(data, pieces));
        if (out.moments.size() == kAsleepBy) {
            out.pieces = pieces.size();
            for (const uint32_t b : pieces) {
                out.mass += bodies.mass[b];
                out.asleep += bodies.is_asleep[b];
                if (bodies.is_asleep[b]) continue;
                char text[160];
                std::snprintf(text, sizeof text, "  awake: %u of %.3g kg at %.3f %.3f %.3f, %.3g m/s, %.3g rad/s", b,
                              bodies.mass[b], bodies.position[b].x, bodies.position[b].y, bodies.position[b].z,
                              length(bodies.velocity[b]), length(bodies.spin[b]));
                out.awake.push_back(text);
            }
        }
        if (out.moments.size() == kStillBy) places = places_of(bodies, pieces);
        if (out.moments.size() < kStillBy + kStillFor) continue;
        out.moved = count_moved(places, places_of(bodies, pieces));
    }
    out.loads = loads;
    out.rest = rest;
    return out;
}

/// Of the frames of a window.
struct Window {
    double most = 0;                 // kinetic energy
    double highest = 0, lowest = 0;  // energy of height: what rocks has all of its energy there twice a period
};

/// From the frame after the last hit on.
std::vector<Window> windows_after_last_hit(const std::vector<Moment>& moments) {
    size_t first = 0;
    for (size_t f = 0; f < moments.size(); ++f)
        if (moments[f].is_hit) first = f + 1;
    std::vector<Window> windows;
    for (size_t f = first; f + kWindow <= moments.size(); f += kWindow) {
        Window& w = windows.emplace_back();
        w.highest = w.lowest = moments[f].height;
        for (size_t k = f; k < f + kWindow; ++k) {
            w.most = std::max(w.most, moments[k].kinetic);
            w.highest = std::max(w.highest, moments[k].height), w.lowest = std::min(w.lowest, moments[k].height);
        }
    }
    return windows;
}

struct Case {
    const char* scene;
    int seed;
    const char* setting = "";  // KEY=VALUE
};

/// Small enough that each piece is compared with each.
bool measures_rest(const Case& c) {
    const std::string scene = c.scene;
    return scene == "wall" || (c.seed == 1 && (scene == "vase" || scene == "pane" || scene == "drop"));
}

void print_rest(const Rest& rest) {
    std::printf(
        "  after %u frames %.1f %% asleep, kinetic share %.2g, sink %.2f and %.2f mm, into each other %.2f and %.2f "
        "mm, "
        "hover %.2f mm, hulls %.2f mm\n",
        kRestAfter, 100 * rest.asleep_share, rest.kinetic_share, rest.sink_p95_mm, rest.sink_max_mm,
        rest.overlap_p95_mm, rest.overlap_max_mm, rest.hover_max_mm, rest.hover_hulls_max_mm);
}

/// Plays it to its end and tells what it saw.
Settling settle(const Case& c) {
    RunOptions options;
    options.scene = c.scene;
    options.set.push_back("scene.seed=" + std::to_string(c.seed));
    if (*c.setting) options.set.push_back(c.setting);
    options.threads = 2;
    Result<GameWorld> game = GameWorld::create(plan_scene(*find_scene(options.scene), options));
    EXPECT_TRUE(game.ok()) << game.error();
    if (!game.ok()) return {};
    const Settling s = settle(*game, measures_rest(c));
    EXPECT_EQ(s.moments.size(), kStillBy + kStillFor);
    size_t first_still = s.moments.size(), last_hit = 0;
    for (size_t f = 0; f < s.moments.size(); ++f)
        if (s.moments[f].is_hit) last_hit = f;
    while (first_still > 0 && s.moments[first_still - 1].kinetic == 0) --first_still;
    std::printf(
        "%s %d: last break or fall in frame %llu; last hit %zu frames later, all still after %zu; asleep %zu of %zu, "
        "moved %zu, off the floor %zu, %u breaks asked for by loads\n",
        c.scene, c.seed, static_cast<unsigned long long>(s.last_break), last_hit, first_still, s.asleep, s.pieces,
        s.moved, s.fallen_off, s.loads);
    for (const std::string& line : s.awake) std::printf("%s\n", line.c_str());
    if (measures_rest(c)) print_rest(s.rest);
    return s;
}

/// Played once for all tests that look at it.
const Settling& settled(const Case& c) {
    static std::map<std::string, Settling> plays;
    const std::string name = c.scene + std::to_string(c.seed);
    if (const auto found = plays.find(name); found != plays.end()) return found->second;
    return plays[name] = settle(c);
}

// Nothing is hit, so nothing may gain speed but by falling: a piece that stands on its edge tips over.
void expect_only_losses(const Settling& s) {
    const std::vector<Window> windows = windows_after_last_hit(s.moments);
    for (const Window& w : windows)
        if (w.most > 0) std::printf("  %.3g", w.most);
    std::printf(" J in windows of %u frames\n", kWindow);
    EXPECT_GE(windows.size(), 4u) << "what is hit to the end shows nothing";
    for (size_t k = 1; k < windows.size(); ++k) {
        const double fell = std::max(0.0, windows[k - 1].highest - windows[k].lowest);
        EXPECT_LE(windows[k].most, windows[k - 1].most + fell + kNoise * s.mass) << "window " << k;
    }
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
    return info.param.scene + std::to_string(info.param.seed);
}

class Settles : public testing::TestWithParam<Case> {};

TEST_P(Settles, NearlyAllSleepFiveSecondsAfterTheLastBreakOrFallAndNoneMovesAfterTen) {
    const Settling& s = settled(GetParam());
    // Heaps bear themselves.
    EXPECT_EQ(s.loads, 0u);
    // Of a heap of a thousand two may rock on. Of the 1,500 of
    // demolition 0 to 6 are awake eight seconds after its last explosion, in 14 plays: wanted 3.
    const bool is_street = std::string(GetParam().scene) == "demolition";
    EXPECT_LE(s.pieces - s.asleep, is_street ? 8 : s.pieces / 500);
    EXPECT_EQ(s.moved, 0u);
    expect_only_losses(s);
}

// A wall leaves twenty slabs, some as long as a man, which lean on each other: a few of them rock on for longer than
// five seconds. Wanted: none. How many walls that happens in is a rate, and no four of them tell it: 1 to 5 of 30 were
// seen in a day's versions.
const int kWalls = test::few_or_all(8, 30);
TEST(ManyWalls, HardlyAnyKeepsASlabRockingForFiveSecondsOrTen) {
    size_t rocking = 0, moving = 0, loads = 0;
    for (int seed = 1; seed <= kWalls; ++seed) {
        const Settling& s = settled(Case{"wall", seed});
        loads += s.loads;
        if (s.asleep < s.pieces) ++rocking;
        if (s.moved > 0) ++moving;
        expect_only_losses(s);
    }
    std::printf("%zu of %d rock after five seconds, %zu after ten\n", rocking, kWalls, moving);
    EXPECT_LE(rocking, test::few_or_all(2u, 4u));
    EXPECT_LE(moving, 1u);
    // Wanted: none. In wall 12 one break is asked for by a load; nobody has looked at it.
    EXPECT_LE(loads, 1u);
}

/// The usual run has the first of each scene. The heap of a thousand and the street are the long run's.
std::vector<Case> cases() {
    std::vector<Case> few{{"vase", 1},   {"pane", 1},
                          {"drop", 1},   {"castle", 1},
                          {"castle", 2}, {"pile", 1, test::few_or_all("scene.count=100", "scene.count=200")}};
    const Case others[] = {{"vase", 2},   {"vase", 3},      {"drop", 2},
                           {"castle", 3}, {"castle", 4},    {"pile", 2, "scene.count=200"},
                           {"pile", 3},   {"demolition", 1}};
    if (test::plays_all()) few.insert(few.end(), std::begin(others), std::end(others));
    return few;
}
INSTANTIATE_TEST_SUITE_P(Scenes, Settles, testing::ValuesIn(cases()), name_of);

class SceneRest : public testing::TestWithParam<Case> {};

TEST_P(SceneRest, TenSecondsAfterTheStartNearlyAllSleepAndNothingSinksHoversOrFallsThrough) {
    const Rest& rest = settled(GetParam()).rest;
    EXPECT_GT(rest.measured, 3u);
    EXPECT_GE(rest.asleep_share, 0.95);
    EXPECT_LT(rest.kinetic_share, 1e-4);
    EXPECT_LT(rest.sink_p95_mm, 2);
    EXPECT_LT(rest.sink_max_mm, 4);
    EXPECT_LT(rest.overlap_max_mm, 4);
    EXPECT_LT(rest.hover_p95_mm, 1);
    EXPECT_LT(rest.hover_max_mm, 1);
    EXPECT_LT(rest.hover_boxes_max_mm, 6);  // a slab of 0.3 m whose box is 1.15 times it: half of 4 % a side
    // One that is 1.4 times it may fill notches: those of a wall's slab, which lies on its edge, by 12 mm at 1.09.
    EXPECT_LT(rest.hover_hulls_max_mm, 15);
    EXPECT_EQ(rest.through, 0u);
}

// Slabs of a wall reach two metres and lean on each other. Convex parts fill notches of their outlines: in one wall of
// eight a slab hovers for it by more than a millimetre (of 120 walls; up to 24 mm; what has a single hull up to 38). A
// rate needs more walls than three.
TEST(ManyWalls, ComeToRestAndHardlyAnyHovers) {
    uint32_t awake = 0, moving = 0, deep = 0, hovering = 0;
    for (int seed = 1; seed <= kWalls; ++seed) {
        const Rest& rest = settled(Case{"wall", seed}).rest;
        EXPECT_GT(rest.measured, 3u);
        EXPECT_LT(rest.sink_max_mm, 4);
        EXPECT_LT(rest.hover_max_mm, 25);
        EXPECT_LT(rest.hover_hulls_max_mm, 50);
        EXPECT_EQ(rest.through, 0u);
        awake += rest.asleep_share < 0.95, moving += rest.kinetic_share >= 1e-3;
        deep += rest.overlap_max_mm > 4, hovering += rest.hover_max_mm > 1;
    }
    std::printf("of %d: %u not asleep, %u with slabs 4 mm in each other, %u hovering\n", kWalls, awake, deep, hovering);
    EXPECT_LE(awake, test::few_or_all(1u, 2u));
    // Wanted: none. In wall 16 a slab that stood on its edge tips over in these very frames.
    EXPECT_LE(moving, test::few_or_all(0u, 1u));
    EXPECT_LE(deep, test::few_or_all(1u, 3u));
    EXPECT_LE(hovering, test::few_or_all(2u, 6u));
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneRest, testing::Values(Case{"vase", 1}, Case{"pane", 1}, Case{"drop", 1}),
                         name_of);

}  // namespace
}  // namespace cullet
