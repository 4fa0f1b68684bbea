// Random loads from a third to three times of what a thing bears: by half it stands, by one and a half it breaks.
#include <gtest/gtest.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "sample_game/game_world.hpp"
#include "sample_game/run_scene.hpp"
#include "tests/support/effort.hpp"

namespace cullet {
namespace {

std::string format(const char* text, ...) {
    char buffer[4000];
    va_list values;
    va_start(values, text);
    std::vsnprintf(buffer, sizeof buffer, text, values);
    va_end(values);
    return buffer;
}

struct Played {
    double seconds = 0;  // until the first piece came off, or all
    uint32_t pieces = 0;
    std::string failure;
};
Played play_script(const std::string& text, double seconds, double rate) {
    RunOptions options;
    options.threads = 1;
    options.dt_ms = 1000 / rate;
    Result<GameWorld> game = GameWorld::create(plan_scene({"bearing", "bearing.lua", text}, options));
    Played played;
    if (!game.ok()) return played.failure = game.error(), played;
    for (; played.seconds < seconds && played.pieces == 0; played.seconds += 1 / rate) {
        game->before_step(), game->step(), game->after_step();
        played.pieces = game->world().fragments(nullptr, 0);
    }
    played.failure = game->failure();
    return played;
}

const std::string kScene = "game.scene{shows = 'a load', seconds = 60} game.floor() ";
constexpr double kGravity = 9.81;
constexpr double kRates[] = {30, 60, 120};

/// What is drawn for a case.
struct Draw {
    std::mt19937 engine;

    explicit Draw(uint32_t seed) : engine(seed) {}
    double within(double low, double high) {
        return low + (high - low) * static_cast<double>(engine() >> 8) / 0x1000000;
    }
    template <class T, size_t n>
    const T& of(const T (&all)[n]) {
        return all[engine() % n];
    }
    /// Of what is borne: below a half, or above one and a half.
    double share(bool breaks) { return breaks ? std::exp2(within(0.6, 1.6)) : within(0.3, 0.5); }
};

struct Stone {
    const char* name;
    double strength;  // Pa
    double density;   // kg/m3
};
constexpr Stone kStones[] = {
    {"glass", 45e6, 2500}, {"porcelain", 50e6, 2400}, {"concrete", 3e6, 2400}, {"brick", 3e6, 1900}};

/// A bar of length x height x width, m, walls of so much; solid where that is half of the height.
struct Bar {
    Stone stone;
    double length, height, width, wall;

    double modulus() const {
        const double inner = height - 2 * wall, between = width - 2 * wall;
        const double hollow = inner > 1e-6 && between > 0 ? between * inner * inner * inner : 0;
        return (width * height * height * height - hollow) / (6 * height);
    }
    std::string spawn(double low, const char* more = "") const {
        return format(
            "game.spawn{mesh = game.mesh.box{half_extents = {%g, %g, %g}}, material = '%s', thickness = %g, "
            "edge = %g, at = {0, %g, 0}%s} ",
            length / 2, height / 2, width / 2, stone.name, wall, length / 12, low + height / 2, more);
    }
};
Bar random_bar(Draw& draw) {
    Bar bar{draw.of(kStones), draw.within(0.6, 1.6), draw.within(0.01, 0.06), 0, 0};
    // Its own weight is to be a small load: 3 rho g L^2 / 4 h.
    const double own = 0.75 * bar.stone.density * kGravity * bar.length * bar.length;
    bar.height = std::max(bar.height, own / (0.12 * bar.stone.strength));
    bar.width = draw.within(0.12, 0.35) * bar.length;
    bar.wall = bar.height / 2;
    if (bar.height > 0.03 && draw.engine() % 2) bar.wall = draw.within(0.2, 0.35) * bar.height;
    return bar;
}
std::string ball(double mass, double x, double low, double radius = 0.15) {
    return format("game.throw{mass = %.9g, radius = %g, at = {%g, %g, 0}, velocity = {0, 0, 0}} ", mass, radius, x,
                  low + radius);
}

struct Case {
    std::string script, told;
};

/// On two supports, under a ball somewhere between them.
Case shelf_case(Draw& draw, bool breaks) {
    const Bar bar = random_bar(draw);
    const double s = draw.within(0.28, 0.45) * bar.length, x = draw.within(-0.4, 0.4) * s, share = draw.share(breaks);
    const double borne = bar.stone.strength * bar.modulus() * 2 * s / ((s - x) * (s + x));
    std::string script = kScene;
    for (const double side : {-1.0, 1.0}) {
        const double inner = side * s, outer = side * 0.55 * bar.length;
        script += format("game.box{low = {%g, 0, %g}, high = {%g, 0.5, %g}} ", std::min(inner, outer), -bar.width,
                         std::max(inner, outer), bar.width);
    }
    return {script + bar.spawn(0.5005) + ball(share * borne / kGravity, x, 0.5015 + bar.height),
            format("%s %.2f x %.3f x %.2f m, wall %.3f, span %.2f, at %.2f, %.2f of %.0f kg", bar.stone.name,
                   bar.length, bar.height, bar.width, bar.wall, 2 * s, x, share, borne / kGravity)};
}

/// Fixed at one end.
Case bracket_case(Draw& draw, bool breaks) {
    const Bar bar = random_bar(draw);
    const double fixed = 0.2 * bar.length, x = draw.within(0.1, 0.35) * bar.length, share = draw.share(breaks);
    const double borne = bar.stone.strength * bar.modulus() / (x + bar.length / 2 - fixed);
    const std::string pins =
        format(", pins = {{low = {-9, -9, -9}, high = {%g, 9, 9}}}", -bar.length / 2 + fixed + 1e-4);
    return {kScene + bar.spawn(0.5, pins.c_str()) + ball(share * borne / kGravity, x, 0.501 + bar.height),
            format("bracket: %s %.2f x %.3f x %.2f m, wall %.3f, at %.2f, %.2f of %.0f kg", bar.stone.name, bar.length,
                   bar.height, bar.width, bar.wall, x, share, borne / kGravity)};
}

/// The ends fixed, a gap of air below.
Case bridge_case(Draw& draw, bool breaks) {
    const Bar bar = random_bar(draw);
    const double s = draw.within(0.3, 0.4) * bar.length, x = draw.within(-0.5, 0.5) * s, share = draw.share(breaks);
    const double borne = bar.stone.strength * bar.modulus() * 2 * s / ((s - x) * (s + x));
    const std::string pins = format(
        ", pins = {{low = {-9, -9, -9}, high = {%g, 9, 9}}, {low = {%g, -9, -9}, high = {9, "
        "9, 9}}}",
        -s + 1e-4, s - 1e-4);
    return {kScene + bar.spawn(0.5, pins.c_str()) + ball(share * borne / kGravity, x, 0.501 + bar.height),
            format("bridge: %s %.2f x %.3f x %.2f m, wall %.3f, at %.2f, %.2f of %.0f kg", bar.stone.name, bar.length,
                   bar.height, bar.width, bar.wall, x, share, borne / kGravity)};
}

/// On two loose blocks of steel that stand on the floor, much lighter than the load where it breaks.
Case blocks_case(Draw& draw, bool breaks) {
    const Bar bar = random_bar(draw);
    const double half = 0.06 * bar.length, s = 0.3 * bar.length, share = draw.share(breaks);
    const double borne = bar.stone.strength * bar.modulus() * 2 / s;
    std::string script = kScene;
    for (const double side : {-1.0, 1.0})
        script += format(
            "game.spawn{mesh = game.mesh.box{half_extents = {%g, 0.05, %g}}, material = 'steel', thickness = "
            "0.02, edge = 0.2, breakable = false, at = {%g, 0.0505, 0}} ",
            half, bar.width / 2, side * (s + half));
    return {script + bar.spawn(0.1015) + ball(share * borne / kGravity, 0, 0.1025 + bar.height),
            format("blocks: %s %.2f x %.3f x %.2f m, wall %.3f, %.2f of %.0f kg", bar.stone.name, bar.length,
                   bar.height, bar.width, bar.wall, share, borne / kGravity)};
}

/// A weight that grows: ball upon ball along the middle of the width is laid on in tenths of what is borne, and the
/// last of them is the share. What breaks it may be less than that.
Case growing_case(Draw& draw, bool breaks) {
    const Bar bar = random_bar(draw);
    const double s = 0.4 * bar.length, share = draw.share(breaks);
    const double borne = bar.stone.strength * bar.modulus() * 2 / s, one = share * borne / kGravity / 10;
    const double radius = bar.width / 24;
    std::string script = kScene;
    for (const double side : {-1.0, 1.0})
        script += format("game.box{low = {%g, 0, -1}, high = {%g, 0.5, 1}} ", std::min(side * s, side * bar.length),
                         std::max(side * s, side * bar.length));
    script += bar.spawn(0.5005);
    for (int k = 0; k < 10; ++k)
        script += format(
            "at(%g, function() game.throw{mass = %.9g, radius = %g, at = {0, %g, %g}, rolling_friction = 1} "
            "end) ",
            0.15 * (k + 1), one, radius, 0.5012 + bar.height + radius, 2.05 * radius * (k - 4.5));
    return {script, format("growing: %s %.2f x %.3f x %.2f m, wall %.3f, to %.2f of %.0f kg", bar.stone.name,
                           bar.length, bar.height, bar.width, bar.wall, share, borne / kGravity)};
}

struct Kind {
    const char* name;
    Case (*of)(Draw&, bool);
    double seconds;
};
void PrintTo(const Kind& kind, std::ostream* out) {
    *out << kind.name;
}
constexpr Kind kKinds[] = {{"Shelf", shelf_case, 1.5},
                           {"Bracket", bracket_case, 1.5},
                           {"Bridge", bridge_case, 1.5},
                           {"OnLooseBlocks", blocks_case, 1.5},
                           {"Growing", growing_case, 3}};
const uint32_t kCases = test::few_or_all(4u, 14u);  // of each kind, that stand and that break
uint32_t cases() {
    const char* asked = std::getenv("CULLET_BEARING_CASES");
    return asked ? static_cast<uint32_t>(std::atoi(asked)) : kCases;
}

class Bearing : public testing::TestWithParam<std::tuple<Kind, bool>> {};

TEST_P(Bearing, StandsBelowAHalfAndBreaksAboveOneAndAHalf) {
    const auto& [kind, breaks] = GetParam();
    uint32_t wrong = 0;
    for (uint32_t seed = 1; seed <= cases(); ++seed) {
        Draw draw(1000 * seed + static_cast<uint32_t>(kind.name[0]));
        const Case of = kind.of(draw, breaks);
        const double rate = draw.of(kRates);
        const Played played = play_script(of.script, kind.seconds, rate);
        ASSERT_EQ(played.failure, "") << of.script;
        if ((played.pieces > 0) == breaks) continue;
        ++wrong;
        std::printf("seed %u: %s, %g steps a second: %u pieces after %.2f s\n", seed, of.told.c_str(), rate,
                    played.pieces, played.seconds);
    }
    EXPECT_EQ(wrong, 0u);
}
INSTANTIATE_TEST_SUITE_P(All, Bearing, testing::Combine(testing::ValuesIn(kKinds), testing::Bool()),
                         [](const auto& of) {
                             return std::string(std::get<0>(of.param).name) +
                                    (std::get<1>(of.param) ? "Breaks" : "Stands");
                         });

// ---- what closes slowly

/// A vase, a box with thin walls or a hollow ball: it stands on the floor at the origin.
struct Thing {
    std::string spawn;
    double height, width;  // m
    std::string told;
};
Thing random_thing(Draw& draw, double low = 0, bool is_solid = false) {
    const char* const stone = draw.of(kStones).name;
    const double size = std::exp2(draw.within(-3.3, 0)), wall = draw.within(0.012, 0.03) * size;
    const double edge = draw.within(0.035, 0.1) * size;
    const auto kind = static_cast<uint32_t>(is_solid ? 1 + draw.engine() % 2 : draw.engine() % 3);
    const std::string mesh = kind == 0 ? format("game.mesh.vase{height = %g, edge = %g}", size, edge)
                             : kind == 1
                                 ? format("game.mesh.slab{width = %g, height = %g, thickness = %g, vertices = 500}",
                                          0.8 * size, size, 0.8 * size)
                                 : format("game.mesh.ball{radius = %g, subdivisions = 3}", 0.5 * size);
    const double above = kind == 2 ? 0.5 * size : 0;
    const double width = kind == 0 ? 0.66 * size : kind == 1 ? 0.8 * size : size;
    return {format("game.spawn{mesh = %s, material = '%s', thickness = %g, edge = %g, at = {0, %g, 0}%s} ",
                   mesh.c_str(), stone, wall, edge, low + above + 1e-3 * size,
                   is_solid ? ", model = 'lattice', lattice = {wanted_cells = 300}" : ""),
            size, width,
            format("%s%s %u of %.3f m, wall %.4f, edge %.4f", is_solid ? "solid " : "", stone, kind, size, wall, edge)};
}
std::string press(Vec3 half, Vec3 at, Vec3 velocity) {
    const auto d = [](float v) { return static_cast<double>(v); };
    return format("game.kinematic{half_extents = {%g, %g, %g}, at = {%g, %g, %g}, velocity = {%g, %g, %g}} ", d(half.x),
                  d(half.y), d(half.z), d(at.x), d(at.y), d(at.z), d(velocity.x), d(velocity.y), d(velocity.z));
}

struct Closing {
    std::string script, told;
    double gap, size, speed;
};
Closing press_case(Draw& draw) {
    const Thing t = random_thing(draw);
    const double speed = draw.within(0.03, 0.4) * t.height, gap = 0.02 * t.height;
    const auto s = static_cast<float>(t.height);
    return {kScene + t.spawn +
                press({s, 0.2f * s, s}, {0, 1.2f * s + static_cast<float>(gap), 0}, {0, -static_cast<float>(speed), 0}),
            "press: " + t.told, gap, t.height, speed};
}
Closing lift_case(Draw& draw) {
    const Thing t = random_thing(draw);
    const double speed = draw.within(0.03, 0.4) * t.height, gap = 0.05 * t.height, h = t.height;
    const auto s = static_cast<float>(h);
    return {"game.scene{shows = 'a lift', seconds = 60} " +
                format("game.box{low = {%g, %g, %g}, high = {%g, %g, %g}} ", -h, h + gap, -h, h, h + gap + 0.3 * h, h) +
                press({s, 0.2f * s, s}, {0, -0.2f * s, 0}, {0, static_cast<float>(speed), 0}) + t.spawn,
            "lift: " + t.told, gap, h, speed};
}
/// Against a wall; where it does not stand square it may turn or slide first.
Closing door_case(Draw& draw) {
    const Thing t = random_thing(draw);
    const double speed = draw.within(0.03, 0.4) * t.height, gap = 0.04 * t.height, h = t.height, wall = 0.5 * t.width;
    const auto s = static_cast<float>(h);
    return {kScene + t.spawn +
                format("game.box{low = {%g, 0, %g}, high = {%g, %g, %g}} ", wall + 0.02 * h, -h, wall + 0.4 * h,
                       1.5 * h, h) +
                press({0.1f * s, 0.7f * s, s}, {-0.1f * s - static_cast<float>(wall + 0.02 * h), 0.71f * s, 0},
                      {static_cast<float>(speed), 0, 0}),
            "door: " + t.told, gap, h, speed};
}
/// A light block between the press and the thing.
Closing between_case(Draw& draw) {
    const Thing t = random_thing(draw);
    const double speed = draw.within(0.03, 0.4) * t.height, gap = 0.04 * t.height, h = t.height, half = 0.1 * h;
    const auto s = static_cast<float>(h);
    return {
        kScene + t.spawn +
            format("game.spawn{mesh = game.mesh.box{half_extents = {%g, %g, %g}}, material = 'wood', thickness = %g, "
                   "edge = 1, breakable = false, at = {0, %g, 0}} ",
                   0.6 * h, half, 0.6 * h, half, 1.005 * h + half) +
            press({s, 0.2f * s, s}, {0, static_cast<float>(h + 2 * half + gap) + 0.2f * s, 0},
                  {0, -static_cast<float>(speed), 0}),
        "through a block: " + t.told, gap, h, speed};
}

/// One block or two of anything, as large as it likes to be, and solids too.
Closing between_any_case(Draw& draw) {
    constexpr const char* kMaterials[] = {"wood", "steel", "brick", "concrete", "aluminium"};
    const bool is_solid = draw.engine() % 3 == 0;
    const Thing t = random_thing(draw, 0, is_solid);
    const double speed = draw.within(0.03, 0.4) * t.height, h = t.height;
    std::string script = kScene + t.spawn, told;
    double top = 1.002 * h, gap = 0.005 * h;
    const uint32_t count = 1 + draw.engine() % 2;
    for (uint32_t i = 0; i < count; ++i, gap += 0.003 * h) {
        const char* const material = draw.of(kMaterials);
        const double half = draw.within(0.03, 0.2) * h, wide = draw.within(0.25, 0.7) * h;
        script += format(
            "game.spawn{mesh = game.mesh.box{half_extents = {%g, %g, %g}}, material = '%s', thickness = %g, edge = 1, "
            "breakable = false, at = {0, %g, 0}} ",
            wide, half, wide, material, 0.9 * half, top + 0.003 * h + half);
        told += format(", %s %.2f x %.2f", material, wide / h, half / h);
        top += 0.003 * h + 2 * half;
    }
    const auto s = static_cast<float>(h);
    return {script + press({s, 0.2f * s, s}, {0, static_cast<float>(top + 0.005 * h) + 0.2f * s, 0},
                           {0, -static_cast<float>(speed), 0}),
            "through blocks: " + t.told + told, gap, h, speed};
}

struct ClosingKind {
    const char* name;
    Closing (*of)(Draw&);
};
void PrintTo(const ClosingKind& kind, std::ostream* out) {
    *out << kind.name;
}
class SlowClosing : public testing::TestWithParam<ClosingKind> {};

// A fifteenth of the size and a quarter of a second: what is closed in on turns and shifts first, and a hit takes some
// frames.
TEST_P(SlowClosing, BreaksBeforeAnythingIsDeepInIt) {
    uint32_t wrong = 0;
    for (uint32_t seed = 1; seed <= cases(); ++seed) {
        Draw draw(77 * seed + static_cast<uint32_t>(GetParam().name[0]));
        const Closing of = GetParam().of(draw);
        const double rate = draw.of(kRates), seconds = (of.gap + of.size / 15) / of.speed + 0.25;
        const Played played = play_script(of.script, seconds, rate);
        ASSERT_EQ(played.failure, "") << of.script;
        if (played.pieces > 0) continue;
        ++wrong;
        std::printf("seed %u: %s, %.4f m/s, %g steps a second: whole after %.2f s\n", seed, of.told.c_str(), of.speed,
                    rate, played.seconds);
    }
    EXPECT_EQ(wrong, 0u);
}
INSTANTIATE_TEST_SUITE_P(All, SlowClosing,
                         testing::Values(ClosingKind{"Press", press_case}, ClosingKind{"Lift", lift_case},
                                         ClosingKind{"Door", door_case}, ClosingKind{"ThroughABlock", between_case},
                                         ClosingKind{"AnyBlocks", between_any_case}),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace cullet
