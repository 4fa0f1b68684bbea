// Every setting of every damage model in scripts and options, by its line.
#include "sample_game/script/setting_calls.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sample_game/game_world.hpp"
#include "sample_game/model_settings.hpp"
#include "sample_game/options.hpp"
#include "sample_game/run_scene.hpp"
#include "sample_game/script/script.hpp"
#include "systems/world_contents.hpp"
#include "tests/support/setting_values.hpp"

namespace cullet {
namespace {

/// "" or the sentence that ended the script at its start. `notes`: what it noted.
std::string failure_of(const std::string& text, std::vector<std::string>* notes = nullptr,
                       const std::vector<std::string>& set = {}) {
    RunOptions options;
    options.threads = 1;
    options.set = set;
    Stage stage;
    stage.plan = plan_scene({"test", "test.lua", text}, options);
    Script script(stage);
    const Result<void> done = script.start();
    if (notes) *notes = stage.notes;
    return done.ok() ? "" : done.error();
}

/// As Lua reads it.
std::string lua_text(const Setting& setting, double value) {
    if (std::isnan(value)) return "0/0";
    if (setting.kind == SettingKind::Switch) return value != 0 ? "true" : "false";
    if (setting.kind == SettingKind::Word) return fmt::format("\"{}\"", text_of(setting, value));
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

/// The setting as an argument: steps = 7, or quick = {steps = 7}.
template <class Settings>
std::string argument(const SettingGroup<Settings>& group, const Setting& setting, const std::string& value) {
    const std::string given = std::string(setting.name) + " = " + value;
    return *group.name ? std::string(group.name) + " = {" + given + "}" : given;
}

template <class Settings>
void expect_refused(const char* call, const char* rest, const SettingGroup<Settings>& group, const Setting& setting,
                    const std::string& value) {
    const std::string text = std::string(call) + "{" + rest + ", " + argument(group, setting, value) + "}";
    const std::string said = failure_of(text), where = std::string(call) + (*group.name ? "." : "") + group.name;
    EXPECT_TRUE(said.starts_with("test.lua:1: " + where + ": " + setting.name + " is ")) << text << ": " << said;
    EXPECT_TRUE(said.ends_with("; expected " + expected_of(setting))) << text << ": " << said;
}

constexpr const char* kBox = "mesh = game.mesh.box{half_extents = {1, 1, 1}}";

TEST(SettingCalls, AScriptIsToldOfEveryValueBelowOrAboveItsRange) {
    size_t refused = 0;
    for (const auto& group : all_spawn_settings())
        for (const Setting& setting : group.list) {
            // A fracture that is no mode is one of game.cook's kinds.
            if (std::string(setting.name) == "fracture") continue;
            for (const double value : test::wrong_values(setting))
                expect_refused("game.spawn", kBox, group, setting, lua_text(setting, value)), ++refused;
            expect_refused("game.spawn", kBox, group, setting, "{}"), ++refused;
            if (setting.kind == SettingKind::Whole) expect_refused("game.spawn", kBox, group, setting, "8.5");
        }
    for (const auto& group : all_cook_settings())
        for (const Setting& setting : group.list) {
            for (const double value : test::wrong_values(setting))
                expect_refused("game.cook", kBox, group, setting, lua_text(setting, value)), ++refused;
            expect_refused("game.cook", kBox, group, setting, "{}"), ++refused;
        }
    EXPECT_GT(refused, 40u);
    EXPECT_EQ(failure_of("game.cook{mesh = game.mesh.pane{}, join_walls = 7}"),
              "test.lua:1: game.cook: join_walls is 7; expected true or false");
    const std::string said = failure_of(std::string("game.spawn{") + kBox + ", quick = {bump = 1}}");
    EXPECT_TRUE(said.starts_with("test.lua:1: game.spawn.quick: there is no bump; it knows layers, steps, ")) << said;
}

TEST(SettingCalls, WhatAScriptGivesComesIntoTheWorld) {
    std::string arguments;
    for (const auto& group : all_spawn_settings()) {
        std::string fields;
        for (const Setting& setting : group.list)
            fields += (fields.empty() ? "" : ", ") + std::string(setting.name) + " = " +
                      lua_text(setting, test::right_values(setting)[1]);
        arguments += ", " + (*group.name ? std::string(group.name) + " = {" + fields + "}" : fields);
    }
    RunOptions options;
    options.threads = 1;
    const std::string text =
        "game.spawn{mesh = game.mesh.pane{side = 0.3, edge = 0.1}, material = \"glass\"" + arguments + "}";
    Stage stage;
    stage.plan = plan_scene({"test", "test.lua", text}, options);
    Script script(stage);
    const Result<void> done = script.start();
    ASSERT_TRUE(done.ok()) << text << ": " << done.error();
    const QuickBodies& quick = stage.world->contents().data.state.quick_bodies;
    ASSERT_EQ(quick.size(), 1u);
    EXPECT_TRUE(quick.is_quick[0] == 1 && quick.layers[0] == 2 && quick.steps[0] == 100 && quick.layout[0] == 1);
    EXPECT_TRUE(quick.crack_length[0] == 4 && quick.length_factor[0] == 5 && quick.volume_energy[0] == 100);
}

TEST(SettingCalls, EverySettingOfASpawnIsAKeyOfAScene) {
    std::string text = "local shell = game.shell_keys{}\n";
    std::vector<std::string> set, wanted;
    for (const auto& group : all_spawn_settings())
        for (const Setting& setting : group.list) {
            const std::string value = text_of(setting, setting.most);
            set.push_back(std::string("scene.") + setting.name + "=" + value);
            wanted.push_back(std::string(setting.name) + " is " + value);
            text += std::string("game.note(\"") + setting.name + " is \" .. game_text(shell" +
                    (*group.name ? std::string(".") + group.name : "") + "." + setting.name + "))\n";
        }
    text =
        "local function game_text(v) return type(v) == \"number\" and string.format(\"%g\", v) or tostring(v) end\n" +
        text;
    std::vector<std::string> notes;
    EXPECT_EQ(failure_of(text, &notes, set), "");
    EXPECT_EQ(notes, wanted);
    EXPECT_EQ(failure_of("local s = game.shell_keys{steps = 9, layout = \"crossed\"}\n"
                         "game.expect(s.quick.steps == 9 and s.springs.layout == \"crossed\", \"defaults\")"),
              "");
    EXPECT_EQ(failure_of("game.shell_keys{steps = 7}"),
              "test.lua:1: game.shell_keys: steps is 7; expected a whole number: 8 to 100");
}

TEST(SettingCalls, EverySettingOfCookingIsAnOption) {
    for (const auto& group : all_cook_settings())
        for (const Setting& setting : group.list) {
            std::string option = std::string("--") + setting.name;
            std::replace(option.begin(), option.end(), '_', '-');
            const std::string value = text_of(setting, setting.most);
            const auto given = parse_options({"cook", "a.obj", "--out", "a.cmodel", option, value});
            ASSERT_TRUE(given.ok()) << given.error();
            EXPECT_EQ(given.value().cook.of_model.at(setting.name), value);
            const auto wrong = parse_options({"cook", "a.obj", "--out", "a.cmodel", option, "so"});
            ASSERT_FALSE(wrong.ok()) << option;
            EXPECT_NE(wrong.error().find(std::string(setting.name) + " is \"so\"; use " + range_of(setting)),
                      std::string::npos)
                << wrong.error();
            EXPECT_NE(parse_options({"cook", "--help"}).value().help.find(option), std::string::npos);
        }
}

}  // namespace
}  // namespace cullet
