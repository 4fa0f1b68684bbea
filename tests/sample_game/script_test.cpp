// Scripts: what they can do, when, and what ends them.
#include "sample_game/script/script.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "sample_game/game_world.hpp"
#include "sample_game/run_scene.hpp"
#include "tests/support/places.hpp"

namespace cullet {
namespace {

ScenePlan plan_of(const std::string& text, uint32_t threads = 2) {
    RunOptions options;
    options.threads = threads;
    return plan_scene({"test", "test.lua", text}, options);
}

/// "" or the sentence that ended the script within so many frames, the end's own wake included.
std::string failure_of(const ScenePlan& plan, uint32_t frames = 3) {
    Result<GameWorld> game = GameWorld::create(plan);
    if (!game.ok()) return game.error();
    for (uint32_t f = 0; f < frames; ++f) game->before_step(), game->step(), game->after_step();
    game->before_step();
    return game->failure();
}
std::string failure_of(const std::string& text, uint32_t frames = 3) {
    return failure_of(plan_of(text), frames);
}

struct Case {
    const char *text, *sentence;
};

TEST(Script, AnErrorNamesFileLineWhatWasGivenAndWhatWasExpected) {
    const Case cases[] = {
        {"\n\ngame.spawn{mesh = game.mesh.vase{}, thickness = -1}",
         "test.lua:3: game.spawn: thickness is -1; expected a length in m above 0"},
        {"game.spawn{mesh = 3}", "test.lua:1: game.cook: mesh is 3; expected a mesh, such as game.mesh.vase{}"},
        {"game.spawn{}",
         "test.lua:1: game.spawn: expected either mesh = game.mesh..., or cooked = what game.cook returned"},
        {"game.throw{radius = 0.1, at = {0, 1, 0}}",
         "test.lua:1: game.throw: mass is missing; expected a mass in kg above 0, at most 1e9"},
        {"game.explode{at = {0, 1, 0}, radius = 1}",
         "test.lua:1: game.explode: expected either impulse in N s/m2, or pressure in Pa with seconds"},
        {"game.explode{at = {0, 1, 0}, impulse = -5}",
         "test.lua:1: game.explode: impulse is -5; expected an impulse in N s/m2 above 0, at most 1e9"},
        {"game.explode{at = {0, 1, 0}, pressure = 5}",
         "test.lua:1: game.explode: seconds is missing; expected seconds above 0, at most 10"},
        {"\ngame.cut{at = {0, 1, 0}, normal = {0, 0, 0}}",
         "test.lua:2: game.cut: normal has no length; expected a direction such as {0, 1, 0}"},
        {"game.cut{points = {{0, 0, 0}}, direction = {0, 0, 1}}",
         "test.lua:1: game.cut: points is a table; expected a list of 2 to 32 places {x, y, z}"},
        {"game.cut{points = {{0, 0, 0}, {1, 0}}, direction = {0, 0, 1}}",
         "test.lua:1: game.cut: points[2] is a table; expected {x, y, z}, each a place in m, at most 1000000 from the "
         "origin"},
        {"game.cut{at = {0, 1, 0}, points = {}}", "test.lua:1: game.cut: at belongs to a plane, and points are given"},
        {"local b = game.throw{radius = 0.1, mass = 1, at = {0, 1, 0}} b:cut{at = {0, 1, 0}, normal = {0, 1, 0}}",
         "test.lua:1: body:cut: body 0 is not breakable, and cannot be cut: it was not spawned from a model; cut one "
         "that was."},
        {"local b = game.throw{radius = 0.1, mass = 1, at = {0, 1, 0}} b:push_impact{at = {0, 1, 0}, speed = 1, mass = "
         "1}",
         "test.lua:1: body:push_impact: direction is missing; expected {x, y, z}, each a direction, each part at most "
         "1e6"},
        {"game.throw{radius = 'big', mass = 1, at = {0, 1, 0}}",
         "test.lua:1: game.throw: radius is \"big\"; expected a length in m above 0, at most 10000"},
        {"game.throw{radius = 0.1, mass = 1, at = {0, 1}}",
         "test.lua:1: game.throw: at is a table; expected {x, y, z}, each a place in m, at most 1000000 from the "
         "origin"},
        {"game.throw{radius = 0.1, mass = 1, at = {0, 1, 0/0}}",
         "test.lua:1: game.throw: at.z is -nan; expected a place in m, at most 1000000 from the origin"},
        {"game.throw{radius = 0.1, mass = 1, at = {0, 1, 0}, colour = 3}",
         "test.lua:1: game.throw: there is no colour; it knows radius, mass, at, velocity, spin, friction, "
         "restitution, rolling_friction"},
        {"game.throw(3)", "test.lua:1: game.throw: given 3; expected a table: game.throw{radius = ...}"},
        {"game.cook{mesh = game.mesh.vase{}, model = 'jelly'}",
         "test.lua:1: game.cook: model is \"jelly\"; expected one of thick_shell, metal_shell, lattice"},
        {"wait(-1)", "test.lua:1: wait: the time is -1; expected seconds from 0 on, or {frames = number}"},
        {"every(0, print)", "test.lua:1: every: 0 is less than half a frame; expected at least one"},
        {"wait{frames = 2} at(0, print)",
         "test.lua:1: at: 0 is frame 0, and this is already frame 2; expected a time to come"},
        {"game.on('boom', print)",
         "test.lua:1: game.on: there is no event \"boom\"; expected one of impact, "
         "crack_started, fragment_born, debris, refused, fault, asleep, squeezed"},
        {"game.floor()\ngame.key{name = 'x', default = 1}",
         "test.lua:2: game.key: this is a declaration; it goes before all calls that do something"},
        {"game.floor()\ngame.setting{hold_s = 0}",
         "test.lua:2: game.setting: the world stands already; set it before anything is put into it"},
        {"local b = game.throw{radius = 0.1, mass = 1, at = {0, 1, 0}}\nb:remove()\nb:mass()",
         "test.lua:3: body:mass: body handle 0 names nothing that is alive; it was removed, or never was. Ask "
         "is_alive() "
         "first"},
        {"local b = nil\nb:mass()", "test.lua:2: attempt to index a nil value (local 'b')"},
        {"x = = 1", "test.lua:1: unexpected symbol near '='"},
        {"error('enough')", "test.lua:1: enough"},
        {"\nerror({})", "test.lua:2: error was given a table; expected a sentence that says what went wrong"},
        {"\nerror()", "test.lua:2: error was given nil; expected a sentence that says what went wrong"},
        {"assert(false, 7)", "test.lua:1: error was given 7; expected a sentence that says what went wrong"},
        {"table.sort({2, 1}, function()\nerror({}) end)",
         "test.lua:2: error was given a table; expected a sentence that says what went wrong"},
        {"string.format('%d', 'x')", "test.lua:1: bad argument #2 to 'format' (number expected, got string)"},
        {"\x1bLuaT", "test.lua: this is compiled Lua; give the text of the script"},
        {"\xff\xfex", "test.lua: this is UTF-16; save the script as UTF-8"},
        {"\xef\xbb\xbfx = = 1", "test.lua:1: unexpected symbol near '='"},
        {"game.key{name = 'x', choices = 'y, z', default = 'w'}",
         "test.lua:1: game.key: default is \"w\"; expected one of y, z"},
        {"game.key{name = 'x', choices = '', default = 'w'}",
         "test.lua:1: game.key: choices is \"\"; expected words with commas, such as \"glass, brick\""},
        {"game.shell_keys{material = 'jelly'}",
         "test.lua:1: game.shell_keys: material is \"jelly\"; expected one of glass, porcelain, brick, "
         "concrete, steel, aluminium, copper, rubber, cloth, wood"},
        {"game.shell_keys{thickness = 2}",
         "test.lua:1: game.shell_keys: thickness is 2; expected a length in m from 0.0001 to 1"},
    };
    for (const Case& c : cases) EXPECT_EQ(failure_of(c.text), c.sentence) << c.text;
}

TEST(Script, ANameThatIsNotThereIsAnErrorThatKnowsTheNearest) {
    const Case cases[] = {
        {"game.thorw{}", "test.lua:1: there is no game.thorw; do you mean game.throw?"},
        {"if game.fragmnts then end", "test.lua:1: there is no game.fragmnts; do you mean game.fragments?"},
        {"game.mesh.vaze{}", "test.lua:1: there is no game.mesh.vaze; do you mean game.mesh.vase?"},
        {"game.mesh.vase{}:mov{0, 1, 0}", "test.lua:1: there is no mesh:mov; do you mean mesh:move?"},
        {"game.floor():postion()", "test.lua:1: there is no body:postion; do you mean body:position?"},
        {"math.sqr(2)", "test.lua:1: there is no math.sqr; do you mean math.sqrt?"},
        {"prnit('x')", "test.lua:1: there is no prnit; do you mean print?"},
        {"speed = 3\nprint(sped)", "test.lua:2: there is no sped; do you mean speed?"},
        {"if is_over then end",
         "test.lua:1: there is no is_over; give it a value before it is read, such as local is_over = false"},
        {"local x = game.mesh[1]",
         "test.lua:1: there is no game.mesh.1; there are ball, bowl, box, car, castle, cow, drum, file, given, house, "
         "pane, "
         "pig, piggy_bank, pole, slab, table, tower, vase, wall"},
    };
    for (const Case& c : cases) EXPECT_EQ(failure_of(c.text), c.sentence) << c.text;
    EXPECT_EQ(failure_of("count = 1 count = count + 1 game.expect(count == 2, 'a global with a value is read')"), "");
}

TEST(Script, AnExpectationThatIsNotMetEndsTheRunWithItsSentence) {
    const std::string text =
        "wait{frames = 2}\ngame.expect(1 + 1 == 2, 'sums add up')\n"
        "game.expect(game.frame() == 3, 'the frame is the third')";
    EXPECT_EQ(failure_of(text), "test.lua:3: game.expect failed in frame 2: the frame is the third");
    RunOptions options;
    options.frames = 5;
    const Result<Report> report = play(plan_of(text), options);
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.error(), "test.lua:3: game.expect failed in frame 2: the frame is the third");
}

TEST(Script, WhatWasNeverReachedIsNoSuccess) {
    const std::string text = "game.scene{seconds = 0.1}\nwait(1)\ngame.expect(false, 'never seen')";
    RunOptions options;
    const Result<Report> report = play(plan_of(text), options);
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.error().find("test.lua:2: the script still waits here when the run ends after 6 frames"), 0u)
        << report.error();
    // At the very end is early enough.
    EXPECT_TRUE(play(plan_of("game.scene{seconds = 0.1}\nwait(0.1)\ngame.expect(true, 'seen')"), options).ok());
}

/// The notes of a script, after so many frames.
std::vector<std::string> notes_of(const ScenePlan& plan, uint32_t frames) {
    Result<GameWorld> game = GameWorld::create(plan);
    EXPECT_TRUE(game.ok()) << game.error();
    if (!game.ok()) return {};
    for (uint32_t f = 0; f < frames; ++f) game->before_step(), game->step(), game->after_step();
    EXPECT_EQ(game->failure(), "");
    return game->stage().notes;
}

TEST(Script, WaitAtAndEveryComeInTheirFrame) {
    const std::string text = R"(
        local function tell(what) return function() game.note(what .. " " .. game.frame()) end end
        at(0.25, tell("at"))
        every({frames = 7}, tell("every"))
        every({frames = 10}, function()
            game.note("slow " .. game.frame())
            wait{frames = 12}
            if game.frame() > 30 then return false end
        end)
        wait(0.1)
        game.note("main " .. game.frame())
        wait(0)
        game.note("main " .. game.frame())
        wait{frames = 1}
        game.note("main " .. game.frame())
    )";
    const std::vector<std::string> wanted{"main 6",   "main 6",   "main 7",   "every 7",  "slow 10",
                                          "every 14", "at 15",    "every 21", "every 28", "slow 30",
                                          "every 35", "every 42", "every 49"};
    EXPECT_EQ(notes_of(plan_of(text), 55), wanted);
}

TEST(Script, SecondsAreTheSameWhateverTheStep) {
    const std::string text = "wait(0.5)\ngame.note(game.frame() .. ' ' .. game.time())";
    for (const double ms : {1000.0 / 60, 8.0, 1000.0 / 240}) {
        ScenePlan plan = plan_of(text);
        plan.step_ms = ms;
        const auto frames = static_cast<uint32_t>(std::lround(500 / ms));
        const std::vector<std::string> notes = notes_of(plan, frames + 1);
        ASSERT_EQ(notes.size(), 1u);
        EXPECT_EQ(notes[0].substr(0, notes[0].find(' ')), std::to_string(frames));
        EXPECT_NEAR(std::stod(notes[0].substr(notes[0].find(' '))), 0.5, 0.001 * ms);
    }
}

TEST(Script, PairsComeSortedAndNoAddressCanBeSeen) {
    const std::string text = R"(
        local seen = ""
        for key, value in pairs{zebra = 1, [3] = 2, apple = 3, [-1] = 4, [true] = 5, [2.5] = 6, [false] = 7, ab = 8} do
            seen = seen .. tostring(key) .. "=" .. value .. " "
        end
        game.note(seen)
        game.note(tostring({}) .. ", " .. tostring(print) .. ", " .. string.format("%s", {}))
    )";
    EXPECT_EQ(notes_of(plan_of(text), 1),
              (std::vector<std::string>{"-1=4 2.5=6 3=2 ab=8 apple=3 zebra=1 false=7 true=5 ",
                                        "a table, a function, a table"}));
    EXPECT_EQ(failure_of("for _ in pairs{[{}] = 1} do end"),
              "test.lua:1: pairs: a key is a table, which has no order; use numbers, strings or booleans");
    EXPECT_EQ(failure_of("string.format('%p', {})"),
              "test.lua:1: string.format: %p is an address, which is another one in every run; leave it out");
}

TEST(Script, ThereIsNoWayOutOfTheSandbox) {
    for (const char* name : {"os",
                             "io",
                             "debug",
                             "load",
                             "loadstring",
                             "loadfile",
                             "dofile",
                             "require",
                             "package",
                             "next",
                             "pcall",
                             "xpcall",
                             "setmetatable",
                             "getmetatable",
                             "rawset",
                             "rawget",
                             "rawequal",
                             "collectgarbage",
                             "coroutine",
                             "utf8",
                             "_G",
                             "string.rep",
                             "string.find",
                             "string.gsub",
                             "string.match",
                             "string.gmatch",
                             "string.dump",
                             "math.random",
                             "math.randomseed",
                             "math.exp"})
        EXPECT_EQ(failure_of(std::string("local way = ") + name),
                  std::string("test.lua:1: ") + name + " is left out of scripts; docs/scripting.md says what there is");
    EXPECT_EQ(failure_of("('x'):rep(9)"),
              "test.lua:1: string.rep is left out of scripts; docs/scripting.md says what there is");
}

TEST(Script, AScriptThatNeverEndsIsEnded) {
    for (const char* text : {"while true do end", "local function f() return f() end f()",
                             "at(0, function() while true do end end)", "game.on('asleep', print) while true do end"})
        EXPECT_EQ(failure_of(text),
                  "test.lua:1: the script took more than 20 million instructions in one frame; end the loop, or wait() "
                  "in it")
            << text;
    // The count starts anew in each frame.
    EXPECT_EQ(failure_of("for _ = 1, 4 do for _ = 1, 9000000 do end wait{frames = 1} end", 6), "");
}

constexpr const char* kNoWorkLeft =
    "test.lua:1: the script took more than 20 million instructions in one frame; end the loop, or wait() in it";
constexpr const char* kNoMemoryLeft = "test.lua:1: the script has used up its memory of 256 MiB; keep less";

TEST(Script, WorkThatIsNoInstructionOfItsOwnCountsAsWell) {
    const std::string text = "local s = 'x' for n = 1, 15 do s = s .. s end ";
    const std::string list = "local t = {} for n = 1, 1e5 do t[n] = '' end ";
    const std::string loops[] = {
        "local function f() at(game.time(), f) end f()",
        "for n = 1, 1e5 do at(0, function() end) end",
        text + "while true do s:reverse() end",
        text + "while true do local longer = s .. s end",
        text + "while true do string.format('%s%s', s, s) end",
        text + "while true do s:byte(1, -1) end",
        list + "while true do table.concat(t) end",
        list + "while true do table.sort(t) end",
        list + "while true do table.insert(t, 1, '') end",
        list + "while true do for _ in pairs(t) do break end end",
        "while true do table.unpack({}, 1, 1e5) end",
        "while true do local t = {} end",
        "for n = 1, 1e6 do game.mesh.wall{} end",
        "local m = game.mesh.ball{radius = 1, subdivisions = 5} while true do m:move{0, 1, 0} end",
        "while true do game.throw{radius = 0.1, mass = 1, at = {0, 1, 0}}:remove() end",
        "game.floor() while true do game.bodies() end",
    };
    for (const std::string& loop : loops) EXPECT_EQ(failure_of(loop), kNoWorkLeft) << loop;
    EXPECT_EQ(failure_of("local function f(...) while true do local function g() end g(...) end end\n"
                         "f(table.unpack({}, 1, 1e5))"),
              "test.lua:1: a function was given 1000 values or more; give it a table");
    EXPECT_EQ(failure_of("local m = game.mesh.pane{edge = 0.25} game.setting{limits = {models = 3}}\n"
                         "for n = 1, 4 do game.cook{mesh = m, material = 'glass', seed = n} end")
                  .substr(0, 56),
              "test.lua:2: game.cook: the run has 3 models already; coo");
}

/// Wakes and events use up nothing that an honest script misses.
TEST(Script, AThousandJobsAFrameAndATableOfAHundredThousandFit) {
    EXPECT_EQ(failure_of("local t = {} for n = 1, 1e5 do t[n] = {n} end\n"
                         "for n = 1, 1000 do every({frames = 1}, function() t[n][1] = t[n][1] + 1 end) end\n"
                         "wait{frames = 2} game.expect(t[9][1] == 10, 'every job has run once')",
                         4),
              "");
}

TEST(Script, AScriptThatFillsTheMemoryIsEnded) {
    const std::string text = "local s = 'x' for n = 1, 15 do s = s .. s end ";
    const std::string keeps[] = {
        text + "local t = {} for n = 1, 1e9 do t[n] = s .. n end",
        text + "while true do for n = 1, 4000 do game.note(s) end wait{frames = 1} end",
        "local t = {} while true do for n = 1, 20 do t[#t + 1] = game.mesh.ball{radius = 1, subdivisions = 6} end "
        "wait{frames = 1} end",
        "while true do for n = 1, 2e5 do at(1e6, print) end wait{frames = 1} end",
        "while true do for n = 1, 2e5 do game.on('impact', print) end wait{frames = 1} end",
    };
    for (const std::string& keep : keeps) EXPECT_EQ(failure_of(keep, 30), kNoMemoryLeft) << keep;
    EXPECT_EQ(failure_of("local s = 'x'\nfor n = 1, 30 do s = s .. s end"),
              "test.lua:2: a string has grown above 64 KiB; print, note or keep it in parts");
    EXPECT_NE(failure_of("local function f() return 1 + f() end f()").find("stack overflow"), std::string::npos);
}

/// 192 balls of 1.5 MB, one at a time.
TEST(Script, MeshesThatAreNoLongerHeldGiveTheirMemoryBack) {
    EXPECT_EQ(failure_of("for n = 1, 12 do for m = 1, 16 do game.mesh.ball{radius = 1, subdivisions = 6} end "
                         "wait{frames = 1} end",
                         14),
              "");
}

TEST(Script, AFunctionOfAnEventMayNotWait) {
    const std::string text =
        "game.floor()\n"
        "game.spawn{mesh = game.mesh.pane{edge = 0.1}, material = 'glass', at = {0, 0.1, 0}, velocity = {0, -9, 0}}\n"
        "game.on('impact', function()\nwait(1) end)";
    EXPECT_EQ(failure_of(text, 10),
              "test.lua:4: wait: this function cannot wait; give one that does to at() or every()");
    EXPECT_EQ(failure_of(text.substr(0, text.find("wait")) + "error({}) end)", 10),
              "test.lua:4: error was given a table; expected a sentence that says what went wrong");
}

TEST(Script, KeysAreDeclaredListedSetAndRefused) {
    const std::string text = R"(
        game.scene{shows = "keys", seconds = 2}
        local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 3, least = 0, most = 9, text = "of it"}
        local kind = game.key{name = "scene.kind", default = "a", choices = "a, b", text = "which"}
        game.setting{gravity_mps2 = 1.62}
        game.note(speed .. " " .. kind)
    )";
    ScenePlan plan = plan_of(text);
    const Result<Story> story = read_story(plan);
    ASSERT_TRUE(story.ok()) << story.error();
    EXPECT_EQ(story->shows, "keys");
    EXPECT_EQ(story->seconds, 2);
    EXPECT_NE(story->keys.help().find("scene.speed_mps         3          of it (0 to 9 m/s)"), std::string::npos)
        << story->keys.help();
    EXPECT_EQ(story->keys["gravity_mps2"], 1.62);
    EXPECT_EQ(notes_of(plan, 1), std::vector<std::string>{"3.0 a"});
    plan.set = {"scene.kind=b", "scene.speed_mps=4.5", "gravity_mps2=5"};
    EXPECT_EQ(notes_of(plan, 1), std::vector<std::string>{"4.5 b"});
    EXPECT_EQ(read_story(plan)->keys["gravity_mps2"], 5);  // --set has the last word
    for (const char* wrong : {"scene.kind=c", "scene.speed_mps=10", "scene.other=1", "scene.kind"}) {
        plan.set = {wrong};
        EXPECT_NE(read_story(plan).error().find(wrong), std::string::npos) << wrong;
        EXPECT_NE(GameWorld::create(plan).error().find(wrong), std::string::npos) << wrong;
    }
}

TEST(Script, TheLastSheetThatIsGivenCounts) {
    const Result<Story> story = read_story(plan_of("for n = 1, 9 do game.scene{sheet = {0, n}} end"));
    ASSERT_TRUE(story.ok()) << story.error();
    EXPECT_EQ(story->sheet_frames, (std::vector<uint32_t>{0, 9}));
}

TEST(Script, AMeshThatIsNotAskedForIsRefused) {
    ScenePlan plan = plan_of("game.floor()");
    plan.mesh_path = "cow.obj";
    EXPECT_EQ(GameWorld::create(plan).error(),
              "--mesh cow.obj: test takes no mesh: it never asks for game.mesh.given().");
    plan = plan_of("game.mesh.given{}");
    plan.mesh_path = "no_such.obj";
    EXPECT_NE(GameWorld::create(plan).error().find("no_such.obj"), std::string::npos);
}

/// A box of 1 x 2.5 x 3 m whose lowest corner is the origin.
std::string box_file() {
    return "v 0 0 0\nv 1 0 0\nv 1 0 3\nv 0 0 3\nv 0 2.5 0\nv 1 2.5 0\nv 1 2.5 3\nv 0 2.5 3\n"
           "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
}

// A game team's files are modelled in metres: what is not asked for is not scaled.
TEST(Script, AMeshOfAFileIsAsLargeAsTheFileSaysUnlessASizeIsGiven) {
    const auto path = std::filesystem::path(testing::TempDir()) / "cullet_script_box.obj";
    std::ofstream(path) << box_file();
    const std::string text =
        "local function is(mesh, x, y, z) local s = mesh:size() game.expect(math.abs(s.x - x) + "
        "math.abs(s.y - y) + math.abs(s.z - z) < 1e-5, s.x .. ' ' .. s.y .. ' ' .. s.z) end\n";
    const std::string file = "path = '" + path.string() + "'";
    ScenePlan plan = plan_of(text + "is(game.mesh.file{" + file + "}, 1, 2.5, 3)\nis(game.mesh.file{" + file +
                             ", stands = true}, 1, 2.5, 3)\nis(game.mesh.file{" + file +
                             ", size = 0.6}, 0.2, 0.5, 0.6)\nis(game.mesh.given{}, 1, 2.5, 3)\n"
                             "is(game.mesh.given{size = 6, stands = true}, 2, 5, 6)");
    plan.mesh_path = path.string();
    EXPECT_EQ(failure_of(plan), "");
    // Its middle, or the middle of its foot, is the origin.
    EXPECT_EQ(failure_of("local mesh = game.mesh.file{" + file + ", stands = true}\ngame.static{mesh = mesh}\n" +
                         "local ball = game.throw{radius = 0.1, mass = 1, at = {0.3, 2.59, 1.3}}\nwait{frames = 2}\n" +
                         "game.expect(ball:position().y > 2.58, 'the ball lies on the box')"),
              "");
}

// Twelve triangles do not crack, so that cooking has to cut them.
TEST(Script, ABoxAndATableBreak) {
    for (const std::string shape :
         {"box{half_extents = {0.15, 0.15, 0.15}}", "table{width = 0.5, depth = 0.4, height = 0.3}"}) {
        const std::string script =
            "game.scene{shows = 'a fall', seconds = 2} game.floor() local thing = game.spawn{mesh = game.mesh." +
            shape +
            ", material = 'glass', thickness = 0.003, at = {0, 0.6, 0}, turn = {axis = {1, 0, 1}, angle = 0.4}, "
            "velocity = {0, -10, 0}} wait(1) game.expect(game.fragments() > 3, 'it breaks')";
        EXPECT_EQ(failure_of(script, 62), "") << shape;
    }
}

TEST(Script, AKeyThatIsSetAndDeclaredTooLateIsToldOfAsThat) {
    ScenePlan plan = plan_of("game.floor()\nlocal k = game.key{name = \"scene.k\", default = 1}");
    plan.set = {"scene.k=2"};
    const std::string said = read_story(plan).error();
    EXPECT_NE(said.find("test.lua:1 does something already"), std::string::npos) << said;
    plan.set = {"scene.other=2"};
    EXPECT_EQ(read_story(plan).error().find("does something already"), std::string::npos);
}

constexpr const char* kBreaking = R"(
    game.setting{units_a_frame = 20e6}
    local vase = game.cook{mesh = game.mesh.vase{edge = 0.0125}, material = "porcelain", thickness = 0.005}
    game.floor()
    local body = game.spawn{cooked = vase, at = {0, 0.5, 0}, turn = game.any_turn(3), velocity = {0, -6, 0}}
    local lift = game.kinematic{half_extents = {0.3, 0.1, 0.3}, at = {2, 0.5, 0}}
    local born, mass = 0, 0
    game.on("fragment_born", function(e)
        born = born + 1
        game.expect(e.parent:is_alive() and e.mass > 0, "a fragment has a parent and a mass")
    end)
    every({frames = 20}, function()
        game.throw{radius = 0.03, mass = 0.5, at = {game.random(-0.2, 0.2), 1, 0}, velocity = {0, -8, 0}}
    end)
    at(0.5, function() lift:set_velocity{0, 1, 0} end)
    wait(1)
    game.expect(born > 0 and born == game.count("fragment_born"), "every birth is told of")
    game.expect(game.fragments() == born, "all fragments live")
    local before = game.mass_put_in()
    game.expect(game.mass() > before * 0.999999 and game.mass() < before * 1.000001, "no mass is lost")
    local y = lift:position().y
    game.expect(y > 0.99 and y < 1.01, "the lift has come up by half a metre")
    lift:set_velocity{0, 0, 0}
    game.note("end")
)";

std::vector<uint64_t> hashes_of(const ScenePlan& plan) {
    Result<GameWorld> game = GameWorld::create(plan);
    EXPECT_TRUE(game.ok()) << game.error();
    std::vector<uint64_t> hashes;
    for (uint32_t f = 0; game.ok() && f < 70; ++f) {
        game->before_step(), game->step(), game->after_step();
        hashes.push_back(game->world().hash());
    }
    if (game.ok()) {
        EXPECT_EQ(game->failure(), "");
        EXPECT_EQ(game->waits_at(), "");
        EXPECT_EQ(game->stage().notes.back(), "end");
    }
    return hashes;
}

TEST(Script, TheSameScriptAndSeedGiveTheSameBytesOnOneTwoAndThreeThreads) {
    ScenePlan plan = plan_of(kBreaking, 1);
    const std::vector<uint64_t> one = hashes_of(plan);
    for (const uint32_t threads : {1u, 2u, 3u}) {
        plan.threads = threads;
        EXPECT_EQ(hashes_of(plan), one) << threads;
    }
    plan.set = {"scene.seed=2"};
    EXPECT_NE(hashes_of(plan), one);
}

std::string text_of(const std::string& path) {
    std::ifstream file(source_folder() + path);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Script, TheExampleOfThePageOnScriptsMeetsItsExpectation) {
    const std::string page = text_of("/docs/scripting.md");
    const size_t from = page.find("```lua\n") + 7, to = page.find("```", from);
    ASSERT_NE(to, std::string::npos);
    const Result<Report> report = play(plan_of(page.substr(from, to - from)), RunOptions());
    ASSERT_TRUE(report.ok()) << report.error();
    EXPECT_GT(report->fragments.born, 3u);
}

TEST(Script, ThePageOnScriptsNamesEveryCall) {
    const std::string page = text_of("/docs/scripting.md");
    Stage stage;
    stage.plan = plan_of(R"(
        local all = ""
        for name in pairs(game) do all = all .. "game." .. name .. " " end
        for name in pairs(game.mesh) do all = all .. name .. " " end
        game.note(all)
    )");
    Script script(stage);
    ASSERT_TRUE(script.start().ok());
    std::istringstream names(stage.notes.at(0));
    uint32_t count = 0;
    for (std::string name; names >> name; ++count)
        if (name != "game.mesh") {
            EXPECT_NE(page.find(name), std::string::npos) << name;
        }
    EXPECT_GT(count, 35u);
}

TEST(Script, WhatIsAskedAndToldOfABodyIsSo) {
    EXPECT_EQ(failure_of(R"(
        game.setting{gravity_mps2 = 0}
        game.camera{eye = {1, 1, 2}, target = {0, 0.5, 0}, field_of_view = 0.7}
        game.sun{towards = {0.4, 0.8, 0.3}, strength = 2.3}
        game.box{low = {-1, -1, -1}, high = {1, -0.5, 1}, colour = {0.4, 0.4, 0.4}}
        game.static{mesh = game.mesh.table{}:move{0, -3, 0}, at = {0, 0, 1}}
        game.expect(game.mesh.ball{radius = 2, subdivisions = 2}:fit(0.5):size().x <= 0.5, "a mesh is fitted")
        local function near(a, b) return math.abs(a - b) < 1e-5 end
        local b = game.throw{radius = 0.1, mass = 2, at = {0, 1, 0}, velocity = {1, 2, 3}, spin = {0, 1, 0}}
        game.expect(near(b:velocity().z, 3) and near(b:spin().y, 1) and near(b:mass(), 2), "it is as thrown")
        b:set_velocity{0, 0, 0}
        b:set_spin{0, 0, 2}
        game.expect(near(b:velocity().z, 0) and near(b:spin().z, 2), "it is as told")
        b:push{impulse = {4, 0, 0}}
        b:put{at = {5, 5, 5}, turn = {axis = {0, 1, 0}, angle = math.pi}}
        game.expect(near(b:velocity().x, 2) and near(b:position().y, 5) and near(math.abs(b:turn().y), 1), "it was pushed and put")
        wait{frames = 1}
        game.expect(near(b:position().x, 5 + 2 / 60), "it has moved on")
        game.expect(#game.bodies() == 3 and game.bodies()[3] == b, "three bodies")
        local energy = 0.5 * 2 * b:velocity().x ^ 2 + 0.5 * (0.4 * 2 * 0.01) * b:spin().z ^ 2
        game.expect(near(game.kinetic_energy(), energy) and energy > 4, "energy of flight and spin")
        b:wake()
        local before = b:velocity().z
        b:push_impact{at = b:position(), direction = {0, 0, -2}, speed = 3, mass = 2}
        game.expect(near(b:velocity().z, before), "a blow is taken in the next frame")
        wait{frames = 1}
        game.expect(near(b:velocity().z, before - 1.2 * 3 / 2), "as from a ball of its own mass")
        game.explode{at = {5, 5, 4}, radius = 3, impulse = 10}
        wait{frames = 1}
        game.expect(b:velocity().z > before - 1.8, "thrown away from the explosion")
        game.cut{points = {{0, 0, 0}, {1, 0, 0}}, direction = {0, 0, 1}}
        b:remove()
        game.expect(not b:is_alive() and game.mass_put_in() == 0 and game.mass() == 0, "it is gone")
        local r = game.random(-1, 1)
        game.expect(r >= -1 and r < 1 and game.random() ~= game.random(), "chance")
        game.expect(game.seeded(7) == game.seeded(7) and game.any_turn(7).w == game.any_turn(7).w, "the same again")
        game.expect(game.single(0.1) ~= 0.1 and game.single(0.5) == 0.5 and game.debris() == 0, "single")
        game.expect(game.asleep_share() == 1 and game.seed() == 1, "nothing moves")
    )"),
              "");
}

/// Hashes of a short run, before the scenes became scripts. A change of the simulation changes them on purpose.
struct KnownHash {
    const char *scene, *hash;
};
class SceneHash : public testing::TestWithParam<KnownHash> {};

TEST_P(SceneHash, IsWhatTheSceneAlwaysGave) {
    RunOptions options;
    options.threads = 2;
    options.hash = HashWhen::Last;
    const Result<Report> report = play(plan_scene(*find_scene(GetParam().scene), options), options);
    ASSERT_TRUE(report.ok()) << report.error();
    EXPECT_EQ(report->hash, GetParam().hash);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneHash,
                         testing::Values(KnownHash{"vase", "5b67b42a94436b99"}, KnownHash{"wall", "e1f31af837d9e093"},
                                         KnownHash{"pane", "d86c4628fc3f83f0"}, KnownHash{"drop", "67b83ebe8a114a0c"}),
                         [](const auto& known) { return std::string(known.param.scene); });

TEST(Script, AFileIsPlayedByItsPathAndOneThatIsNotThereIsNamed) {
    const auto path = std::filesystem::path(testing::TempDir()) / "cullet_script_test.lua";
    std::ofstream(path) << "game.floor()\n";
    EXPECT_TRUE(load_scene(path.string()).ok());
    EXPECT_EQ(load_scene("vase")->file, "vase.lua");
    EXPECT_NE(load_scene("/nowhere/x.lua").error().find("/nowhere/x.lua"), std::string::npos);
    EXPECT_NE(load_scene("cathedral").error().find("vase"), std::string::npos);
}

size_t times_in(const std::string& text, const std::string& words) {
    size_t times = 0;
    for (size_t at = text.find(words); at != text.npos; at = text.find(words, at + 1)) ++times;
    return times;
}

TEST(Script, WhatItPrintsComesOnce) {
    const auto path = (std::filesystem::path(testing::TempDir()) / "cullet_script_prints_once.lua").string();
    std::ofstream(path) << "game.scene{seconds = 0.1}\nprint('before')\ngame.floor()\nprint('first')\n"
                           "wait{frames = 2}\nprint('later')\n";
    RunOptions options;
    options.scene = path;
    options.threads = 1;
    for (const uint32_t repeat : {1u, 3u}) {
        options.repeat = repeat;
        testing::internal::CaptureStdout();
        const int code = run_command(options);
        const std::string said = testing::internal::GetCapturedStdout();
        EXPECT_EQ(code, 0);
        for (const char* line : {"before\n", "first\n", "later\n"}) EXPECT_EQ(times_in(said, line), 1u) << said;
    }
}

// Who looks for the fault of a script wants to see what it printed until then.
TEST(Script, WhatItPrintsBeforeItFailsComesOnceToo) {
    const auto path = (std::filesystem::path(testing::TempDir()) / "cullet_script_prints_and_fails.lua").string();
    RunOptions options;
    options.scene = path;
    options.threads = 1;
    for (const char* fault : {"game.key{}", "game.spawn{}", "wait(0.1) game.spawn{}"}) {
        std::ofstream(path) << "game.scene{seconds = 1}\nprint('before')\n" << fault << "\n";
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        const int code = run_command(options);
        const std::string said = testing::internal::GetCapturedStdout(), why = testing::internal::GetCapturedStderr();
        EXPECT_NE(code, 0) << fault;
        EXPECT_EQ(times_in(said, "before\n"), 1u) << fault << ": " << said;
        EXPECT_NE(why.find(":3: "), std::string::npos) << why;
    }
}

/// Of what is printed before declarations fail 64 KiB are kept; a silent plan says nothing at all.
TEST(Script, LinesThatAreNotKeptAreCounted) {
    ScenePlan plan;
    plan.scene.file = plan.scene.name = "test.lua";
    plan.scene.text =
        "game.scene{seconds = 1}\nfor n = 1, 3000 do print('" + std::string(99, 'x') + "') end\ngame.key{}\n";
    for (const bool is_silent : {false, true}) {
        plan.is_silent = is_silent;
        testing::internal::CaptureStdout();
        const auto story = read_story(plan);
        std::fflush(stdout);
        const std::string said = testing::internal::GetCapturedStdout();
        EXPECT_FALSE(story.ok());
        EXPECT_NE(story.error().find("test.lua:3: "), std::string::npos) << story.error();
        const auto lines = std::count(said.begin(), said.end(), '\n');
        if (is_silent) {
            EXPECT_EQ(said, "");
        } else {
            EXPECT_EQ(lines, 657);  // 656 of 100 bytes are the first above 65,536
            EXPECT_NE(said.find("... and 2344 more lines that the script printed before it failed.\n"), said.npos);
        }
    }
}

TEST(Script, AFolderAndAFileThatIsTooLongAreRefused) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "cullet_script_folder.lua";
    std::filesystem::create_directories(folder);
    EXPECT_EQ(load_scene(folder.string()).error(),
              folder.string() + ": cannot be read (Is a directory); give the path of a script.");
    const auto file = std::filesystem::path(testing::TempDir()) / "cullet_script_long.lua";
    std::ofstream(file) << std::string(size_t{1} << 20, ' ');
    EXPECT_EQ(load_scene(file.string())->text.size(), size_t{1} << 20);
    std::ofstream(file, std::ios::app) << ' ';
    EXPECT_EQ(load_scene(file.string()).error(), file.string() + ": has more than 1024 KiB; give a shorter script.");
    std::filesystem::remove(file);
}

/// Exit code and what the program says on its standard error.
std::pair<int, std::string> outcome_of(const std::string& arguments) {
    const std::string said = testing::TempDir() + "cullet_script_said.txt";
    const int status = std::system((build_folder() + "/sample_game " + arguments + " 2>" + said).c_str());
    std::ifstream file(said);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, {std::istreambuf_iterator<char>(file), {}}};
}

TEST(Program, AFullDiskIsOneSentence) {
    if (!std::filesystem::exists(build_folder() + "/sample_game")) GTEST_SKIP() << "build the program sample_game";
    const std::pair<int, std::string> all{2, "sample_game: cannot write to file: No space left on device.\n"};
    EXPECT_EQ(outcome_of("run --set help >/dev/full"), all);
    EXPECT_EQ(outcome_of("frame >/dev/full"), all);
    // A few lines fail only at the end, when the buffer is written out.
    EXPECT_EQ(outcome_of("--help >/dev/full").first, 2);
    const auto path = (std::filesystem::path(testing::TempDir()) / "cullet_script_prints.lua").string();
    std::ofstream(path) << "game.scene{seconds = 1}\nfor n = 1, 3000 do print('a line', n) end\n";
    const auto [code, said] = outcome_of("run " + path + " >/dev/full");
    EXPECT_EQ(code, 1);  // the script's own fault, as far as the program knows
    EXPECT_EQ(said.find(path + ":2: cannot write to file: No space left on device\n"), 0u) << said;
}

}  // namespace
}  // namespace cullet
