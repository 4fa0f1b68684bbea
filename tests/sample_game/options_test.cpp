// The command line: what is understood, and what is refused with one sentence.
#include "sample_game/options.hpp"

#include <gtest/gtest.h>

#include "cullet/version.hpp"
#include "sample_game/run_scene.hpp"

namespace cullet {
namespace {

/// One line, with a full stop, that says something.
void expect_a_sentence(const std::string& text) {
    EXPECT_GT(text.size(), 20u) << text;
    EXPECT_EQ(text.back(), '.') << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

TEST(Options, ARunIsReadWithAllThatCanBeGiven) {
    const auto parsed =
        parse_options({"run",     "drop",    "--mesh",    "cow.obj",    "--frames",        "90",
                       "--dt-ms", "8",       "--threads", "2",          "--repeat",        "3",
                       "--out",   "out",     "--draw",    "10",         "--contact-sheet", "--trace",
                       "t.json",  "--hash",  "last",      "--validate", "--set",           "scene.speed_mps=3",
                       "--set",   "hold_s=0"});
    ASSERT_TRUE(parsed.ok()) << parsed.error();
    const RunOptions& run = parsed.value().run;
    EXPECT_EQ(parsed.value().command, Command::Run);
    EXPECT_EQ(run.scene, "drop");
    EXPECT_EQ(run.mesh, "cow.obj");
    EXPECT_EQ(run.frames, 90u);
    EXPECT_EQ(run.dt_ms, 8);
    EXPECT_EQ(run.threads, 2u);
    EXPECT_EQ(run.repeat, 3u);
    EXPECT_EQ(run.out, "out");
    EXPECT_EQ(run.draw, 10u);
    EXPECT_TRUE(run.has_sheet);
    EXPECT_EQ(run.trace, "t.json");
    EXPECT_EQ(run.hash, HashWhen::Last);
    EXPECT_TRUE(run.validates);
    EXPECT_EQ(run.set, (std::vector<std::string>{"scene.speed_mps=3", "hold_s=0"}));
}

TEST(Options, PicturesShowMaterialsUnlessPiecesAreAskedFor) {
    EXPECT_EQ(parse_options({"run", "vase"})->run.look, PictureLook::Material);
    EXPECT_EQ(parse_options({"run", "vase", "--look", "pieces"})->run.look, PictureLook::Pieces);
    EXPECT_EQ(parse_options({"run", "vase", "--width", "640"})->run.width, 640u);
    expect_a_sentence(parse_options({"run", "vase", "--look", "nice"}).error());
}

TEST(Options, EverySceneCanBeRunByItsName) {
    for (const Scene& scene : scenes()) EXPECT_TRUE(parse_options({"run", scene.name}).ok()) << scene.name;
    EXPECT_TRUE(parse_options({"run", "show_reel"}).ok());
}

TEST(Options, AnOptionWithoutWhatBelongsToItSaysWhatItWants) {
    for (const char* name : {"--frames", "--dt-ms", "--threads", "--repeat", "--draw"})
        EXPECT_EQ(parse_options({"run", "vase", name}).error().rfind(std::string(name) + ": wants a number. ", 0), 0u)
            << parse_options({"run", "vase", name}).error();
    for (const char* name : {"--mesh", "--out", "--set", "--materials", "--hash"})
        EXPECT_EQ(
            parse_options({"run", "vase", name}).error().rfind(std::string(name) + ": wants a word behind it. ", 0), 0u)
            << parse_options({"run", "vase", name}).error();
    EXPECT_EQ(parse_options({"cook", "a.obj", "--seed"}).error().rfind("--seed: wants a number. ", 0), 0u);
}

TEST(Options, WhatMakesNoSenseIsRefusedInOneSentence) {
    const std::vector<std::vector<std::string>> wrong{
        {},
        {"walk"},
        {"run"},
        {"run", "cathedral"},
        {"run", "wall", "vase"},
        {"run", "wall", "--frames", "0"},
        {"run", "wall", "--frames", "many"},
        {"run", "wall", "--frames", "-5"},
        {"run", "wall", "--dt-ms", "100"},
        {"run", "wall", "--threads", "0"},
        {"run", "wall", "--repeat", "0"},
        {"run", "wall", "--hash", "sometimes"},
        {"run", "wall", "--model", "jelly"},
        {"run", "wall", "--video"},
        {"run", "wall", "--draw", "10"},
        {"run", "wall", "--contact-sheet"},
        {"run", "wall", "--nonsense"},
        {"truth"},
        {"frame", "frame"},
        {"cook"},
        {"cook", "cow.obj"},
        {"cook", "--out", "cow.cmodel"},
        {"cook", "cow.obj", "--out", "cow.cmodel", "--thickness-m", "0"},
        {"cook", "cow.obj", "--out", "cow.cmodel", "--weld", "1"},
    };
    for (const auto& arguments : wrong) {
        const auto parsed = parse_options(arguments);
        ASSERT_FALSE(parsed.ok()) << arguments.size();
        expect_a_sentence(parsed.error());
    }
}

TEST(Options, ANumberIsRefusedWithWhatItMayBe) {
    const auto said = [](const std::vector<std::string>& arguments) { return parse_options(arguments).error(); };
    EXPECT_EQ(
        said({"run", "wall", "--frames", "abc"}).rfind("--frames: \"abc\" is no whole number from 1 to 1000000. ", 0),
        0u)
        << said({"run", "wall", "--frames", "abc"});
    EXPECT_EQ(said({"run", "wall", "--frames", "3.5"}).rfind("--frames: \"3.5\" is no whole number", 0), 0u);
    EXPECT_EQ(said({"cook", "a.obj", "--out", "a.cmodel", "--thickness-m", "0"})
                  .rfind("--thickness-m: \"0\" is no number from 1e-09 to 1000000. ", 0),
              0u)
        << said({"cook", "a.obj", "--out", "a.cmodel", "--thickness-m", "0"});
    EXPECT_EQ(said({"cook", "a.obj", "--out", "a.cmodel", "--thickness-m", "nan"}).rfind("--thickness-m: \"nan\"", 0),
              0u);
}

TEST(Options, WhatIsNearlyAnOptionOrACommandIsGuessed) {
    EXPECT_NE(parse_options({"run", "wall", "--thread", "2"}).error().find("Did you mean --threads?"),
              std::string::npos);
    EXPECT_NE(parse_options({"rnu", "wall"}).error().find("Did you mean run?"), std::string::npos);
    EXPECT_EQ(parse_options({"run", "wall", "--nonsense"}).error().find("Did you mean"), std::string::npos);
}

TEST(Options, ACookIsReadWithAllThatCanBeGiven) {
    const auto parsed = parse_options({"cook", "cow.obj", "--out", "cow.cmodel", "--material", "glass", "--thickness-m",
                                       "0.01", "--edge-m", "0.02", "--weld", "1e-7", "--seed", "7"});
    ASSERT_TRUE(parsed.ok()) << parsed.error();
    EXPECT_EQ(parsed.value().command, Command::Cook);
    const CookOptions& cook = parsed.value().cook;
    EXPECT_EQ(cook.mesh, "cow.obj");
    EXPECT_EQ(cook.out, "cow.cmodel");
    EXPECT_EQ(cook.material, "glass");
    EXPECT_EQ(cook.thickness_m, 0.01);
    EXPECT_EQ(cook.edge_m, 0.02);
    EXPECT_EQ(cook.weld, 1e-7);
    EXPECT_EQ(cook.seed, 7u);
}

TEST(Options, HelpIsNoError) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"}, {"run", "--help"}}) {
        const auto parsed = parse_options(arguments);
        ASSERT_TRUE(parsed.ok()) << parsed.error();
        EXPECT_EQ(parsed.value().command, Command::Help);
        EXPECT_NE(parsed.value().help.find("pane"), std::string::npos);
    }
}

size_t times_said(const std::string& text, const std::string& words) {
    size_t times = 0;
    for (size_t at = text.find(words); at != text.npos; at = text.find(words, at + words.size())) ++times;
    return times;
}

TEST(Options, HelpTellsOfEachSceneOnceAndOnlyWhereOneIsPlayed) {
    for (const Scene& scene : scenes()) {
        const std::string line = "\n  " + scene.name + " ", shows = read_story(plan_scene(scene, {})).value().shows;
        for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"}, {"run", "--help"}}) {
            const std::string help = parse_options(arguments).value().help;
            EXPECT_EQ(times_said(help, line), 1u) << help;
            EXPECT_EQ(times_said(help, shows), 1u) << help;
        }
        for (const char* command : {"cook", "replay", "reproduce", "frame", "truth"})
            EXPECT_EQ(times_said(parse_options({command, "--help"}).value().help, shows), 0u) << command;
    }
}

TEST(Options, TheVersionIsTheLibrarys) {
    const auto parsed = parse_options({"--version"});
    ASSERT_TRUE(parsed.ok()) << parsed.error();
    EXPECT_EQ(parsed.value().command, Command::Help);
    EXPECT_EQ(parsed.value().help, std::string("sample_game of cullet ") + version() + "\n");
}

TEST(Options, AnUnknownCommandIsCalledThatAndAllThatThereAreAreNamed) {
    for (const char* wrong : {"walk", "vase", "Run", "runn", "my.lua"}) {
        const std::string refused = parse_options({wrong, "--frames", "3"}).error();
        EXPECT_EQ(refused.rfind(std::string(wrong) + ": there is no such command", 0), 0u) << refused;
        for (const char* command : {"run", "cook", "replay", "reproduce", "frame", "truth"})
            EXPECT_NE(refused.find(command), std::string::npos) << refused;
    }
    EXPECT_NE(parse_options({"--walk"}).error().find("--walk"), std::string::npos) << parse_options({"--walk"}).error();
}

TEST(Options, WhatNothingTakesIsNamedWithTheHelpOfItsCommand) {
    EXPECT_EQ(
        parse_options({"run", "vase", "--frmes", "3"}).error(),
        "--frmes: there is no such option. Did you mean --frames? sample_game run --help shows what can be given.");
    EXPECT_EQ(parse_options({"run", "wall", "vase"}).error(),
              "vase: one argument too many. sample_game run --help shows what can be given.");
    EXPECT_EQ(parse_options({"frame", "by", "frame"}).error(),
              "by: one argument too many. sample_game frame --help shows what can be given.");
    const std::string refused = parse_options({"cook", "--out", "x.cmodel"}).error();
    EXPECT_NE(refused.find("sample_game cook --help"), std::string::npos) << refused;
}

TEST(Options, SetHelpListsTheKeysOfAllScenesOrOfOne) {
    EXPECT_EQ(parse_options({"run", "--set", "help"}).value().command, Command::KeysHelp);
    const std::string all = keys_help("").value(), wall = keys_help("wall").value();
    for (const char* key :
         {"scene.speed_mps", "scene.height_m", "scene.edge_m", "scene.seed", "scene.thickness_m", "scene.material",
          "scene.size_m", "scene.strength_scale", "units_a_frame", "hold_s", "threads"})
        EXPECT_NE(all.find(key), std::string::npos) << key;
    EXPECT_EQ(wall.find("scene.height_m"), std::string::npos);
}

Result<Keys> wall_keys(std::vector<std::string> set) {
    RunOptions options;
    options.scene = "wall";
    options.set = std::move(set);
    return keys_of(*find_scene("wall"), options);
}

TEST(Keys, WhatIsSetIsReadBack) {
    const auto keys =
        wall_keys({"scene.speed_mps=0.7", "scene.material=concrete", "scene.strength_scale=inf", "units_a_frame=2e6"});
    ASSERT_TRUE(keys.ok()) << keys.error();
    EXPECT_EQ(keys.value()["scene.speed_mps"], 0.7);
    EXPECT_EQ(keys.value().word_of("scene.material"), "concrete");
    EXPECT_GT(keys.value()["scene.strength_scale"], 1e30);
    EXPECT_EQ(keys.value()["units_a_frame"], 2e6);
}

TEST(Keys, WrongOnesAreRefusedInOneSentenceThatNamesThem) {
    for (const char* wrong : {"scene.speed_mps", "scene.speed_mps=", "scene.speed_mps=fast", "scene.speed_mps=1 2",
                              "scene.speed_mps=-1", "scene.speed_mps=nan", "scene.height_m=2", "scene.material=cheese",
                              "scene.material=", "=3", "scene.material=glass,", "threads=0"}) {
        const auto keys = wall_keys({wrong});
        ASSERT_FALSE(keys.ok()) << wrong;
        expect_a_sentence(keys.error());
        EXPECT_NE(keys.error().find(wrong), std::string::npos) << keys.error();
    }
}

TEST(Keys, ThreadsOnTheCommandLineGoBeforeTheKey) {
    RunOptions options;
    options.threads = 3;
    options.set = {"threads=2"};
    EXPECT_EQ(keys_of(*find_scene("wall"), options).value()["threads"], 3);
}

}  // namespace
}  // namespace cullet
