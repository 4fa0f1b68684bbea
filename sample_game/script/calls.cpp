#include "sample_game/script/calls.hpp"

#include <fmt/format.h>

#include <lua.hpp>

#include "sample_game/script/arguments.hpp"
#include "sample_game/script/script.hpp"

namespace cullet {
namespace {

/// Seconds, or {frames = n}, as whole frames.
uint64_t frames_at(lua_State* lua, int place, const char* call) {
    if (lua_istable(lua, place)) {
        const Arguments given(lua, call, {"frames"}, false, place);
        return static_cast<uint64_t>(given.number("frames", {"a whole number of frames from 0 to 1e9", 0, 1e9}));
    }
    const double seconds = lua_tonumber(lua, place);
    if (lua_type(lua, place) != LUA_TNUMBER || !(seconds >= 0 && seconds <= 1e7))
        refuse(lua, fmt::format("{}: the time is {}; expected seconds from 0 on, or {{frames = number}}", call,
                                describe(lua, place)));
    return script_of(lua).stage().steps_in(seconds);
}

void expect_function(lua_State* lua, int place, const char* call) {
    if (!lua_isfunction(lua, place))
        refuse(lua, fmt::format("{}: given {}; expected a function", call, describe(lua, place)));
}

int call_wait(lua_State* lua) {
    Script& script = script_of(lua);
    script.act(lua);
    const uint64_t frames = frames_at(lua, 1, "wait");
    if (!lua_isyieldable(lua) || script.is_telling())
        refuse(lua, "wait: this function cannot wait; give one that does to at() or every()");
    return script.wait(lua, frames);
}

int call_at(lua_State* lua) {
    Script& script = script_of(lua);
    const uint64_t now = script.act(lua).frame, due = frames_at(lua, 1, "at");
    expect_function(lua, 2, "at");
    if (due < now)
        refuse(lua, fmt::format("at: {} is frame {}, and this is already frame {}; expected a time to come",
                                describe(lua, 1), due, now));
    script.plan_call(lua, 2, due, 0);
    return 0;
}

int call_every(lua_State* lua) {
    Script& script = script_of(lua);
    const uint64_t now = script.act(lua).frame, period = frames_at(lua, 1, "every");
    expect_function(lua, 2, "every");
    if (period == 0)
        refuse(lua, fmt::format("every: {} is less than half a frame; expected at least one", describe(lua, 1)));
    script.plan_call(lua, 2, now + period, period);
    return 0;
}

}  // namespace

void open_calls(lua_State* lua) {
    static constexpr luaL_Reg calls[] = {
        {"wait", call_wait}, {"at", call_at}, {"every", call_every}, {nullptr, nullptr}};
    lua_pushglobaltable(lua);
    add_calls(lua, calls);
    lua_pop(lua, 1);
    lua_newtable(lua);
    guard_names(lua, "game.");
    open_declarations(lua);
    open_meshes(lua);
    open_bodies(lua);
    open_blows(lua);
    open_surroundings(lua);
    open_costs(lua);
    open_queries(lua);
    lua_setglobal(lua, "game");
}

void add_note(lua_State* lua, const std::string& sentence) {
    hold(lua, sizeof(std::string) + sentence.size());
    script_of(lua).stage().notes.push_back(sentence);
}

World& world_of(lua_State* lua, const char* call) {
    const Result<World*> stands = script_of(lua).act(lua).stand();
    if (!stands.ok()) refuse(lua, fmt::format("{}: {}", call, stands.error()));
    return **stands;
}

}  // namespace cullet
