// game.floor, box, static: what never moves. game.camera, sun: from where, in what light.
#include <fmt/format.h>

#include <lua.hpp>

#include "sample_game/script/arguments.hpp"
#include "sample_game/script/calls.hpp"
#include "sample_game/script/script.hpp"

namespace cullet {
namespace {

constexpr uint64_t kWorkAVertex = 20;  // the rigid world's tree of triangles: 10 us in truth, see mesh_calls.cpp

int add(lua_State* lua, const Arguments& given, const char* call, Prop prop) {
    prop.contact = given.contact();
    hold_mesh(lua, prop.mesh);  // to the run's end, even when the body is removed: it is drawn
    spend(lua, kWorkAVertex * prop.mesh.positions.size());
    (void)world_of(lua, call);
    const Result<BodyId> id = script_of(lua).stage().add_prop(std::move(prop));
    if (!id.ok()) given.refuse(id.error());
    push_body(lua, *id);
    return 1;
}

/// How it looks, by a material's name; what it is like to the touch stays as it is.
Finish finish_in(const Arguments& given) {
    constexpr const char* kNames = "brick, concrete, glass, porcelain, wood, steel, aluminium, copper, cloth or rubber";
    if (!given.has("finish")) return Finish::Plain;
    const Finish finish = finish_of(given.word("finish", kNames));
    if (finish == Finish::Plain) given.refuse_value("finish", kNames);
    return finish;
}

int add_floor(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.floor", {"half_side", "height", "friction", "restitution", "rolling_friction"},
                          true);
    return add(lua, given, "game.floor",
               floor_prop(given.real("half_side", kLength, 30), given.real("height", kAnyNumber, 0)));
}

int add_box(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.box",
                          {"low", "high", "colour", "finish", "friction", "restitution", "rolling_friction"});
    const Vec3 low = given.vector("low", kPlace), high = given.vector("high", kPlace);
    if (!(low.x < high.x && low.y < high.y && low.z < high.z))
        given.refuse("high is not above low along all three axes; expected two opposite corners");
    Prop prop = box_prop(low, high, given.vector("colour", kShare, Prop().colour));
    prop.finish = finish_in(given);
    return add(lua, given, "game.box", std::move(prop));
}

int add_static(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(
        lua, "game.static",
        {"mesh", "at", "colour", "finish", "friction", "restitution", "rolling_friction", "one_sided"});
    given.push("mesh");
    Prop prop;
    prop.mesh = mesh_at(lua, lua_gettop(lua), "game.static: mesh").mesh;
    lua_pop(lua, 1);
    if (given.has("at")) prop.mesh = moved(std::move(prop.mesh), given.vector("at", kPlace));
    prop.colour = given.vector("colour", kShare, prop.colour);
    prop.finish = finish_in(given);
    prop.one_sided = given.is("one_sided", false);
    return add(lua, given, "game.static", std::move(prop));
}

int set_camera(lua_State* lua) {
    Stage& stage = script_of(lua).act(lua);
    stage.has_camera = true;
    Camera& camera = stage.camera;
    const Arguments given(lua, "game.camera", {"eye", "target", "field_of_view"});
    camera.eye = given.vector("eye", kPlace, camera.eye);
    camera.target = given.vector("target", kPlace, camera.target);
    camera.vertical_field_of_view = given.real("field_of_view", {"an angle in rad from 0.01 to 3", 0.01, 3},
                                               static_cast<double>(camera.vertical_field_of_view));
    return 0;
}

int set_sun(lua_State* lua) {
    Sun& sun = script_of(lua).act(lua).sun;
    const Arguments given(lua, "game.sun", {"towards", "colour", "strength", "angular_radius"});
    sun.towards = given.vector("towards", kAnyNumber, sun.towards);
    sun.colour = given.vector("colour", kShare, sun.colour);
    sun.strength = given.real("strength", {"a number from 0 to 100", 0, 100}, static_cast<double>(sun.strength));
    sun.angular_radius =
        given.real("angular_radius", {"an angle in rad from 0 to 1", 0, 1}, static_cast<double>(sun.angular_radius));
    return 0;
}

}  // namespace

void open_surroundings(lua_State* lua) {
    static constexpr luaL_Reg calls[] = {{"floor", add_floor},   {"box", add_box}, {"static", add_static},
                                         {"camera", set_camera}, {"sun", set_sun}, {nullptr, nullptr}};
    add_calls(lua, calls);
}

}  // namespace cullet
