#include "sample_game/script/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <lua.hpp>

#include "engine/math.hpp"
#include "sample_game/props.hpp"

namespace cullet {

Arguments::Arguments(lua_State* lua, const char* call, const std::vector<const char*>& known, bool can_be_missing,
                     int place)
    : lua_(lua), call_(call), place_(lua_absindex(lua, place)) {
    if (can_be_missing && lua_isnoneornil(lua, place)) {
        lua_settop(lua, place - 1);
        lua_newtable(lua);
    }
    if (!lua_istable(lua, place_))
        refuse(fmt::format("given {}; expected a table: {}{{{} = ...}}", describe(lua, place_), call, *known.begin()));
    for (lua_pushnil(lua); lua_next(lua, place_); lua_pop(lua, 1)) {
        const bool is_name = lua_type(lua, -2) == LUA_TSTRING;
        if (is_name && std::any_of(known.begin(), known.end(),
                                   [&](const char* name) { return std::strcmp(name, lua_tostring(lua, -2)) == 0; }))
            continue;
        std::string names;
        for (const char* name : known) names += (names.empty() ? "" : ", ") + std::string(name);
        refuse(fmt::format("there is no {}; it knows {}", is_name ? lua_tostring(lua, -2) : "value without a name",
                           names));
    }
}

void Arguments::refuse(const std::string& sentence) const {
    cullet::refuse(lua_, fmt::format("{}: {}", call_, sentence));
}

void Arguments::refuse_value(const char* name, const std::string& expected) const {
    push(name);
    const bool is_missing = lua_isnil(lua_, -1);
    refuse(fmt::format("{} is {}; expected {}", name, is_missing ? "missing" : describe(lua_, -1), expected));
}

void Arguments::push(const char* name) const {
    lua_getfield(lua_, place_, name);
}

void Arguments::pop() const {
    lua_pop(lua_, 1);
}

bool Arguments::has(const char* name) const {
    const bool found = lua_getfield(lua_, place_, name) != LUA_TNIL;
    lua_pop(lua_, 1);
    return found;
}

double Arguments::number(const char* name, const Wanted& wanted) const {
    push(name);
    const bool is_number = lua_type(lua_, -1) == LUA_TNUMBER;
    const double value = lua_tonumber(lua_, -1);
    lua_pop(lua_, 1);
    if (!is_number || !(value >= wanted.least && value <= wanted.most)) refuse_value(name, wanted.text);
    return value;
}

double Arguments::number(const char* name, const Wanted& wanted, double otherwise) const {
    return has(name) ? number(name, wanted) : otherwise;
}

float Arguments::real(const char* name, const Wanted& wanted, double otherwise) const {
    return static_cast<float>(number(name, wanted, otherwise));
}

bool Arguments::is(const char* name, bool otherwise) const {
    if (!has(name)) return otherwise;
    push(name);
    if (!lua_isboolean(lua_, -1)) refuse_value(name, "true or false");
    const bool value = lua_toboolean(lua_, -1);
    lua_pop(lua_, 1);
    return value;
}

std::string Arguments::word(const char* name, const char* expected) const {
    push(name);
    if (lua_type(lua_, -1) != LUA_TSTRING) refuse_value(name, expected);
    std::string text = lua_tostring(lua_, -1);
    lua_pop(lua_, 1);
    return text;
}

std::string Arguments::word(const char* name, const char* expected, const std::string& otherwise) const {
    return has(name) ? word(name, expected) : otherwise;
}

Vec3 Arguments::vector(const char* name, const Wanted& wanted) const {
    push(name);
    if (!lua_istable(lua_, -1)) refuse_value(name, fmt::format("{{x, y, z}}, each {}", wanted.text));
    const Vec3 v = read_vector(lua_, lua_gettop(lua_), fmt::format("{}: {}", call_, name), wanted);
    lua_pop(lua_, 1);
    return v;
}

Vec3 Arguments::vector(const char* name, const Wanted& wanted, Vec3 otherwise) const {
    return has(name) ? vector(name, wanted) : otherwise;
}

Quat Arguments::turn(const char* name) const {
    if (!has(name)) return {};
    push(name);
    const int place = lua_gettop(lua_);
    if (!lua_istable(lua_, place)) refuse_value(name, "{axis = {x, y, z}, angle = radians}, or game.any_turn(number)");
    if (lua_getfield(lua_, place, "w") != LUA_TNIL) {
        const std::string within = fmt::format("{}.{}", call_, name);
        const Arguments parts(lua_, within.c_str(), {"x", "y", "z", "w"}, false, place);
        const Wanted part{"a number from -1 to 1", -1, 1};
        const Quat q{parts.real("x", part, 0), parts.real("y", part, 0), parts.real("z", part, 0),
                     parts.real("w", part, 1)};
        lua_settop(lua_, place - 1);
        return q;
    }
    const std::string within = fmt::format("{}.{}", call_, name);
    const Arguments parts(lua_, within.c_str(), {"axis", "angle"}, false, place);
    const Vec3 axis = parts.vector("axis", kAnyNumber);
    if (!(length(axis) > 0)) parts.refuse("axis has no length; expected a direction such as {0, 1, 0}");
    const Quat q = cullet::turn(axis, parts.number("angle", {"an angle in rad", -1e6, 1e6}));
    lua_settop(lua_, place - 1);
    return q;
}

ContactSettings Arguments::contact() const {
    ContactSettings contact;
    contact.friction = real("friction", {"a number from 0 to 100", 0, 100}, -1);
    contact.restitution = real("restitution", kShare, -1);
    contact.rolling_friction = real("rolling_friction", kShare, -1);
    return contact;
}

Motion Arguments::motion() const {
    return {vector("velocity", kSpeed, {}), vector("spin", {"an angular velocity in rad/s", -1e5, 1e5}, {})};
}

Vec3 read_vector(lua_State* lua, int place, const std::string& what, const Wanted& wanted) {
    const auto expect = [&](bool is_good) {
        if (!is_good)
            refuse(lua,
                   fmt::format("{} is {}; expected {{x, y, z}}, each {}", what, describe(lua, place), wanted.text));
    };
    expect(lua_istable(lua, place));
    const bool is_list = lua_rawgeti(lua, place, 1) != LUA_TNIL;
    lua_pop(lua, 1);
    expect(!is_list || lua_rawlen(lua, place) == 3);
    static constexpr const char* kNames[] = {"x", "y", "z"};
    float parts[3];
    for (int k = 0; k < 3; ++k) {
        if (is_list)
            lua_rawgeti(lua, place, k + 1);
        else
            lua_getfield(lua, place, kNames[k]);
        const double value = lua_tonumber(lua, -1);
        if (lua_type(lua, -1) != LUA_TNUMBER || !(value >= wanted.least && value <= wanted.most))
            refuse(lua, fmt::format("{}.{} is {}; expected {}", what, kNames[k],
                                    lua_isnil(lua, -1) ? "missing" : describe(lua, -1), wanted.text));
        parts[k] = static_cast<float>(value);
        lua_pop(lua, 1);
    }
    return {parts[0], parts[1], parts[2]};
}

void push_vector(lua_State* lua, Vec3 v) {
    lua_createtable(lua, 0, 3);
    lua_pushnumber(lua, static_cast<double>(v.x)), lua_setfield(lua, -2, "x");
    lua_pushnumber(lua, static_cast<double>(v.y)), lua_setfield(lua, -2, "y");
    lua_pushnumber(lua, static_cast<double>(v.z)), lua_setfield(lua, -2, "z");
}

void push_turn(lua_State* lua, Quat q) {
    push_vector(lua, {q.x, q.y, q.z});
    lua_pushnumber(lua, static_cast<double>(q.w)), lua_setfield(lua, -2, "w");
}

}  // namespace cullet
