// game.explode, game.cut, body:cut, body:push_impact.
#include <fmt/format.h>

#include <lua.hpp>

#include "components/blows.hpp"
#include "engine/math.hpp"
#include "sample_game/script/arguments.hpp"
#include "sample_game/script/calls.hpp"
#include "sample_game/script/script.hpp"

namespace cullet {
namespace {

constexpr uint64_t kWorkABlow = 3000;  // instructions, as a body put into the world

void check(const Arguments& given, const Result<void>& done) {
    if (!done.ok()) given.refuse(done.error());
}

/// A direction of any length above 0.
Vec3 direction_of(const Arguments& given, const char* name) {
    const Vec3 v = given.vector(name, {"a direction, each part at most 1e6", -1e6, 1e6});
    if (!(length(v) > 1e-6f))
        given.refuse(fmt::format("{} has no length; expected a direction such as {{0, 1, 0}}", name));
    return normalised(v);
}

BodyId body_of(lua_State* lua, const char* call) {
    const BodyId* id = body_at(lua, 1);
    if (!id)
        refuse(lua, fmt::format("{}: called on {}; expected a body and a colon, as in b:cut{{...}}", call,
                                describe(lua, 1)));
    return *id;
}

int explode(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.explode", {"at", "radius", "impulse", "pressure", "seconds"});
    if (given.has("impulse") == given.has("pressure"))
        given.refuse("expected either impulse in N s/m2, or pressure in Pa with seconds");
    if (given.has("impulse") && given.has("seconds")) given.refuse("seconds belongs to pressure, not to impulse");
    ExplosionSettings explosion;
    explosion.centre = given.vector("at", kPlace);
    explosion.radius = given.real("radius", {"a length in m from 0.001 to 100000", 1e-3, 1e5}, explosion.radius);
    const Wanted strength{"an impulse in N s/m2 above 0, at most 1e9", 1e-9, 1e9};
    if (given.has("impulse")) {
        explosion.impulse = static_cast<float>(given.number("impulse", strength));
    } else {
        explosion.pressure =
            static_cast<float>(given.number("pressure", {"a pressure in Pa above 0, at most 1e12", 1e-9, 1e12}));
        explosion.seconds = static_cast<float>(given.number("seconds", {"seconds above 0, at most 10", 1e-9, 10}));
    }
    World& world = world_of(lua, "game.explode");
    spend(lua, kWorkABlow);
    check(given, world.explode(explosion));
    return 0;
}

/// A plane {at =, normal =}, or {points = {...}, direction =}.
int cut_along(lua_State* lua, const char* call, BodyId body, int place) {
    script_of(lua).act(lua);
    const Arguments given(lua, call, {"at", "normal", "points", "direction"}, false, place);
    CutSettings cut;
    Vec3 points[kMostCutPoints];
    if (given.has("points")) {
        for (const char* name : {"at", "normal"})
            if (given.has(name)) given.refuse(fmt::format("{} belongs to a plane, and points are given", name));
        given.push("points");
        const int list = lua_gettop(lua);
        const std::string expected = fmt::format("a list of 2 to {} places {{x, y, z}}", kMostCutPoints);
        if (!lua_istable(lua, list) || lua_rawlen(lua, list) < 2 || lua_rawlen(lua, list) > kMostCutPoints)
            given.refuse_value("points", expected);
        cut.point_count = static_cast<uint32_t>(lua_rawlen(lua, list));
        for (uint32_t i = 0; i < cut.point_count; ++i) {
            lua_rawgeti(lua, list, i + 1);
            points[i] = read_vector(lua, lua_gettop(lua), fmt::format("{}: points[{}]", call, i + 1), kPlace);
            lua_pop(lua, 1);
        }
        lua_pop(lua, 1);
        cut.points = points;
        cut.direction = direction_of(given, "direction");
    } else {
        if (given.has("direction")) given.refuse("direction belongs to points, and none are given");
        cut.place = given.vector("at", kPlace);
        cut.normal = direction_of(given, "normal");
    }
    World& world = world_of(lua, call);
    spend(lua, kWorkABlow);
    check(given, world.cut(body, cut));
    return 0;
}

int cut_all(lua_State* lua) {
    return cut_along(lua, "game.cut", {}, 1);
}

int cut_body(lua_State* lua) {
    return cut_along(lua, "body:cut", body_of(lua, "body:cut"), 2);
}

int push_impact(lua_State* lua) {
    const BodyId body = body_of(lua, "body:push_impact");
    script_of(lua).act(lua);
    const Arguments given(lua, "body:push_impact", {"at", "direction", "speed", "mass", "radius"}, false, 2);
    PushSettings push;
    push.place = given.vector("at", kPlace);
    push.normal = direction_of(given, "direction");
    push.approach_speed =
        static_cast<float>(given.number("speed", {"a speed in m/s above 0, at most 100000", 1e-9, 1e5}));
    push.mass = static_cast<float>(given.number("mass", {"a mass in kg from 1e-6 to 1e9", 1e-6, 1e9}));
    push.radius = given.real("radius", {"a length in m, or 0 for a flat striker", 0, 1e4}, 0);
    World& world = world_of(lua, "body:push_impact");
    spend(lua, kWorkABlow);
    check(given, world.push_impact(body, push));
    return 0;
}

}  // namespace

void open_blows(lua_State* lua) {
    static constexpr luaL_Reg calls[] = {{"explode", explode}, {"cut", cut_all}, {nullptr, nullptr}};
    add_calls(lua, calls);
}

void open_body_blows(lua_State* lua) {
    static constexpr luaL_Reg methods[] = {{"cut", cut_body}, {"push_impact", push_impact}, {nullptr, nullptr}};
    add_calls(lua, methods);
}

}  // namespace cullet
