// game.scene, key, shell_keys, setting: what a script says before it does anything; --set help and a scene's list are
// made from it. at_least and fit_budget raise what a script cannot do without.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <lua.hpp>

#include "sample_game/model_settings.hpp"
#include "sample_game/script/arguments.hpp"
#include "sample_game/script/calls.hpp"
#include "sample_game/script/script.hpp"
#include "sample_game/script/setting_calls.hpp"

namespace cullet {
namespace {

constexpr size_t kMostKeys = 256;         // each look-up goes through all
constexpr uint64_t kWorkAFile = 200'000;  // instructions, as a mesh file
constexpr Wanted kAny{"a number", -HUGE_VAL, HUGE_VAL};

/// Refuses a declaration that comes after something was done.
Story& story_of(lua_State* lua, const char* call) {
    Script& script = script_of(lua);
    if (script.has_acted())
        refuse(lua, fmt::format("{}: this is a declaration; it goes before all calls that do something", call));
    return script.stage().story;
}

void push_key(lua_State* lua, const Keys& keys, const std::string& name) {
    for (const Key& key : keys.all())
        if (key.name == name && key.choices.empty())
            lua_pushnumber(lua, key.value);
        else if (key.name == name)
            lua_pushstring(lua, key.word.c_str());
}

int scene(lua_State* lua) {
    Story& story = story_of(lua, "game.scene");
    const Arguments given(lua, "game.scene", {"shows", "seconds", "sheet"});
    story.shows = given.word("shows", "a sentence", "");
    story.has_length = given.has("seconds");
    story.seconds = given.number("seconds", {"seconds above 0, at most 10000", 1e-3, 1e4}, story.seconds);
    given.push("sheet");
    if (lua_isnil(lua, -1)) return 0;
    if (!lua_istable(lua, -1)) given.refuse_value("sheet", "a list of frames, such as {0, 10, 60}");
    story.sheet_frames.clear();
    for (lua_Integer n = 1; lua_rawgeti(lua, -1, n) != LUA_TNIL; ++n, lua_pop(lua, 1)) {
        if (!lua_isinteger(lua, -1) || lua_tointeger(lua, -1) < 0 || n > 12)
            given.refuse(fmt::format("sheet has {} at place {}; expected at most 12 whole frames from 0 on",
                                     describe(lua, -1), n));
        story.sheet_frames.push_back(static_cast<uint32_t>(lua_tointeger(lua, -1)));
    }
    return 0;
}

bool is_key_name(const std::string& name) {
    return !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_.0123456789") == std::string::npos;
}

int key(lua_State* lua) {
    Keys& keys = story_of(lua, "game.key").keys;
    const Arguments given(lua, "game.key", {"name", "default", "unit", "least", "most", "choices", "text"});
    const std::string name = given.word("name", "a name such as \"scene.speed_mps\"");
    if (!is_key_name(name)) given.refuse_value("name", "small letters, digits, _ and dots");
    if (keys.has(name)) given.refuse(fmt::format("there is a key {} already", name));
    if (keys.all().size() >= kMostKeys) given.refuse(fmt::format("there are {} keys already", kMostKeys));
    const std::string text = given.word("text", "a few words on what it is", "");
    if (given.has("choices")) {
        const std::string choices = given.word("choices", "words with commas, such as \"glass, brick\"");
        const std::string value = given.word("default", "one of the choices");
        if (choices.empty()) given.refuse_value("choices", "words with commas, such as \"glass, brick\"");
        keys.word(name, value, choices, text);
        if (!keys.set(name + "=" + value).ok()) given.refuse_value("default", "one of " + choices);
    } else {
        const double least = given.number("least", kAny, -HUGE_VAL), most = given.number("most", kAny, HUGE_VAL);
        const double value = given.number("default", {"a number from least to most", least, most});
        keys.number(name, given.word("unit", "a unit such as \"m/s\"", "1"), value, least, most, text);
    }
    script_of(lua).apply_set(lua, name);
    push_key(lua, keys, name);
    return 1;
}

/// Rows that the file adds and changes; its path starts at the script's folder.
int materials(lua_State* lua) {
    story_of(lua, "game.materials");
    if (lua_type(lua, 1) != LUA_TSTRING)
        refuse(lua, fmt::format("game.materials: given {}; expected the path of a TOML file", describe(lua, 1)));
    spend(lua, kWorkAFile);
    Stage& stage = script_of(lua).stage();
    const std::filesystem::path path = lua_tostring(lua, 1);
    const Result<void> read =
        stage.read_materials((std::filesystem::path(stage.plan.scene.file).parent_path() / path).string());
    if (!read.ok()) refuse(lua, "game.materials: " + read.error());
    return 0;
}

// Settings that two models have under one name are one key.
void add_key(Keys& keys, const Setting& setting, double value) {
    const std::string name = std::string("scene.") + setting.name;
    if (keys.has(name)) return;
    if (setting.kind == SettingKind::Switch || setting.kind == SettingKind::Word)
        keys.word(name, text_of(setting, value), setting.kind == SettingKind::Word ? setting.words : "false, true",
                  setting.help);
    else
        keys.number(name, setting.unit, value, setting.may_be_zero ? 0 : setting.least, setting.most, setting.help);
}

/// What --set says of the key, or its default, becomes a field of the table on top; a setting of two words a truth.
void push_field(lua_State* lua, Keys& keys, const std::string& key, const char* field, bool is_switch = false) {
    script_of(lua).apply_set(lua, key);
    if (is_switch)
        lua_pushboolean(lua, keys.word_of(key) == "true");
    else
        push_key(lua, keys, key);
    lua_setfield(lua, -2, field);
}

/// What every scene asks about the thing that breaks in it, and how it breaks.
int shell_keys(lua_State* lua) {
    Keys& keys = story_of(lua, "game.shell_keys").keys;
    const auto groups = all_spawn_settings();
    std::vector<const char*> known = {"material", "thickness", "edge"};
    for (const auto& group : groups)
        for (const Setting& setting : group.list) known.push_back(setting.name);
    const Arguments given(lua, "game.shell_keys", known);
    if (keys.has("scene.material")) given.refuse("these keys are there already");
    const std::string material = given.word("material", "a material", "porcelain");
    const std::string materials = script_of(lua).stage().materials.names();
    keys.word("scene.material", material, materials, "what breaks")
        .number("scene.thickness_m", "m", given.number("thickness", {"a length in m from 0.0001 to 1", 1e-4, 1}, 0.005),
                1e-4, 1, "of the shell")
        .number("scene.edge_m", "m", given.number("edge", {"a length in m from 0 to 1", 0, 1}, 0), 0, 1,
                "edge length of the mesh; 0: what cooking chooses")
        .number("scene.strength_scale", "1", 1, 1e-3, HUGE_VAL, "on the material's strength; inf never cracks")
        .word("scene.cracks", "own", "own, fine, coarse, large", "the kind of fracture; own: the material's");
    for (const auto& group : groups)
        for (const Setting& setting : group.list)
            add_key(keys, setting, setting_given(given, setting, setting.standard));
    if (!keys.set("scene.material=" + material).ok()) given.refuse_value("material", "one of " + materials);
    lua_newtable(lua);
    push_field(lua, keys, "scene.material", "material");
    push_field(lua, keys, "scene.thickness_m", "thickness");
    push_field(lua, keys, "scene.edge_m", "edge");
    push_field(lua, keys, "scene.strength_scale", "strength_scale");
    script_of(lua).apply_set(lua, "scene.cracks");
    if (keys.word_of("scene.cracks") != "own") push_field(lua, keys, "scene.cracks", "cracks");  // nil: none is given
    for (const auto& group : groups) {
        if (*group.name) lua_newtable(lua);
        for (const Setting& setting : group.list)
            push_field(lua, keys, std::string("scene.") + setting.name, setting.name,
                       setting.kind == SettingKind::Switch);
        if (*group.name) lua_setfield(lua, -2, group.name);
    }
    return 1;
}

/// Names of LimitSettings and where they stand.
struct LimitName {
    const char* name;
    uint32_t LimitSettings::*value;
};
constexpr LimitName kLimits[] = {
    {"bodies", &LimitSettings::bodies},       {"models", &LimitSettings::models},
    {"vertices", &LimitSettings::vertices},   {"elements", &LimitSettings::elements},
    {"open_hits", &LimitSettings::open_hits}, {"view_vertices", &LimitSettings::view_vertices},
    {"debris", &LimitSettings::debris},       {"queued_hits", &LimitSettings::queued_hits},
    {"fragments", &LimitSettings::fragments}, {"births_a_frame", &LimitSettings::births_a_frame}};

void set_limits(lua_State* lua, const Arguments& given, LimitSettings& limits) {
    if (!given.has("limits")) return;
    given.push("limits");
    const Arguments parts(lua, "game.setting.limits",
                          {"bodies", "models", "vertices", "elements", "open_hits", "view_vertices", "debris",
                           "queued_hits", "fragments", "births_a_frame"},
                          false, lua_gettop(lua));
    for (const LimitName& limit : kLimits)
        limits.*limit.value = static_cast<uint32_t>(
            parts.number(limit.name, {"a whole number from 1 to 268435456", 1, 268435456}, limits.*limit.value));
    lua_pop(lua, 1);
}

constexpr std::initializer_list<const char*> kSettings = {
    "units_a_frame", "hold_s",          "frames_ahead", "generations",  "break_share", "break_elements",
    "debris_share",  "debris_elements", "debris_s",     "gravity_mps2", "limits"};

Stage& stage_without_world(lua_State* lua, const char* call) {
    Stage& stage = script_of(lua).stage();
    if (stage.world)
        refuse(lua, fmt::format("{}: the world stands already; set it before anything is put into it", call));
    return stage;
}

double setting_of(const Arguments& given, const Keys& keys, const char* name) {
    for (const Key& key : keys.all())
        if (key.name == name) {
            const std::string text = fmt::format("a number from {} to {}", key.least, key.most);
            return given.number(name, {text.c_str(), key.least, key.most});
        }
    return 0;
}

int setting(lua_State* lua) {
    Stage& stage = stage_without_world(lua, "game.setting");
    const Arguments given(lua, "game.setting", kSettings);
    for (const char* name : kSettings) {
        if (!given.has(name) || std::string(name) == "limits") continue;
        const double value = setting_of(given, stage.story.keys, name);
        if (!script_of(lua).is_given(name)) stage.story.keys.put(name, value);
    }
    set_limits(lua, given, stage.limits);
    return 0;
}

int at_least(lua_State* lua) {
    Stage& stage = stage_without_world(lua, "game.at_least");
    const Arguments given(lua, "game.at_least", {"units_a_frame", "hold_s"});
    for (const char* name : {"units_a_frame", "hold_s"})
        if (given.has(name))
            stage.story.keys.put(name, std::max(stage.story.keys[name], setting_of(given, stage.story.keys, name)));
    return 0;
}

/// A blow that does not fit a hold ends late: raises the budget until the predicted one fits, and says so. Cooking's
/// advice to do that is then not given.
int fit_budget(lua_State* lua) {
    script_of(lua).act(lua);
    Stage& stage = stage_without_world(lua, "game.fit_budget");
    const ModelReport& report = stage.models[cooked_at(lua, 1, "game.fit_budget")].model.report();
    const Settings settings = stage.settings();
    const double frames = std::floor(static_cast<double>(settings.hold_seconds / settings.step_seconds) + 1e-3);
    const auto hit = static_cast<double>(report.units_of_a_hit);
    if (frames < 1) return 0;
    const auto wanted = static_cast<uint64_t>(1.1 * hit / frames);
    if (wanted <= settings.units_a_frame) return 0;
    stage.notes.push_back(fmt::format(
        "A hit on this mesh takes {:.0f} million units: units_a_frame was raised from {:.1f} to {:.1f} "
        "million so that it fits a hold of {:.0f} frames.",
        1e-6 * hit, 1e-6 * static_cast<double>(settings.units_a_frame), 1e-6 * static_cast<double>(wanted), frames));
    stage.story.keys.put("units_a_frame", static_cast<double>(wanted));
    return 0;
}

}  // namespace

void open_declarations(lua_State* lua) {
    static constexpr luaL_Reg calls[] = {{"scene", scene},         {"key", key},           {"shell_keys", shell_keys},
                                         {"setting", setting},     {"at_least", at_least}, {"fit_budget", fit_budget},
                                         {"materials", materials}, {nullptr, nullptr}};
    add_calls(lua, calls);
}

}  // namespace cullet
