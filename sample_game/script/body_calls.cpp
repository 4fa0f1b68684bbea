// game.cook, spawn, throw, kinematic, and what a body can be asked and told.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <lua.hpp>

#include "engine/math.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/model_settings.hpp"
#include "sample_game/script/arguments.hpp"
#include "sample_game/script/calls.hpp"
#include "sample_game/script/script.hpp"
#include "sample_game/script/setting_calls.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

constexpr const char *kCookedName = "cooked model", *kBodyName = "body";
// Work in instructions. A body takes 10 to 500 us to put into the world, so four thousand of them fit one frame. What
// cooking takes counts less than it is: the limit on models ends a loop of it.
constexpr uint64_t kWorkABody = 3000, kWorkACook = 10'000;
constexpr size_t kMostPins = 256;
// Of game.cook a kind of cracks, of game.spawn a mode.
constexpr const char* kFracture = "fracture";
// What scripts called joins_walls before it had a list.
constexpr const char* kOlderJoinsWalls = "join_walls";

/// What game.cook reads.
std::vector<const char*> names_of_cook() {
    std::vector<const char*> names = {"mesh", "model", "material", "fracture", "grain", "thickness", "edge", "seed"};
    add_names(names, all_cook_settings());
    names.push_back(kOlderJoinsWalls);
    return names;
}

/// Of game.spawn: how the body breaks, which is no affair of cooking, and not how near to each other cracks start.
bool names_mode(const Arguments& given) {
    if (!given.has(kFracture)) return false;
    const std::string name = given.word(kFracture, "hidden or quick");
    return name == "hidden" || name == "quick";
}

FractureKind fracture_of(const Arguments& given) {
    const std::string name = given.word("fracture", "large, coarse or fine");
    for (const FractureKind kind : {FractureKind::Large, FractureKind::Coarse, FractureKind::Fine})
        if (name == name_of(kind)) return kind;
    given.refuse_value("fracture", "large, coarse or fine");
}

// A box or table of the script's is cut as coarsely as a scene's shapes are, so that it cooks in seconds.
float edge_of_plain(const Mesh& mesh, const CookSettings& settings) {
    const MeshExtent extent = extent_of(mesh);
    return std::max(2 * settings.thickness, 0.05f * length(extent.high - extent.low));
}

/// Cooks what the call's table says; the place in Stage::models. `has_kind`: its `fracture` is a kind of cracks.
uint32_t cook_given(lua_State* lua, const Arguments& given, bool has_kind, bool may_break) {
    Stage& stage = script_of(lua).act(lua);
    spend(lua, kWorkACook);
    if (stage.models.size() >= stage.limits.models)
        given.refuse(
            fmt::format("the run has {} models already; cook each once and spawn it as cooked = ..., or raise "
                        "the limit with game.setting{{limits = {{models = ...}}}}",
                        stage.models.size()));
    const std::vector<std::string> models = damage_model_names();
    const std::string model =
        stage.plan.model.empty() ? given.word("model", "the name of a model", "") : stage.plan.model;
    if (!model.empty() && std::find(models.begin(), models.end(), model) == models.end())
        given.refuse(fmt::format("model is \"{}\"; expected one of {}", model, fmt::join(models, ", ")));
    given.push("mesh");
    const ScriptMesh& mesh = mesh_at(lua, lua_gettop(lua), "game.cook: mesh");
    CookSettings settings;
    settings.model = model;
    settings.material = given.word("material", stage.materials.names().c_str(), settings.material);
    if (has_kind) settings.fracture = fracture_of(given);
    settings.grain = given.vector("grain", {"a direction", -1e6, 1e6}, settings.grain);
    settings.thickness = given.real("thickness", {"a length in m above 0", 1e-6, 10}, 0.005);
    settings.seed = static_cast<uint64_t>(
        given.number("seed", {"a whole number from 0 to 1e15", 0, 1e15}, static_cast<double>(stage.seed())));
    const float edge = given.real("edge", {"a length in m, or 0 for what cooking chooses", 0, 100}, 0);
    // What never breaks needs no more triangles than it has.
    const bool is_left = mesh.edges == Edges::AsAskedFor || (mesh.is_made_here && !may_break);
    settings.longest_edge = is_left                          ? 100.0f
                            : edge == 0 && mesh.is_made_here ? edge_of_plain(mesh.mesh, settings)
                                                             : edge;
    settings.thick_shell.joins_walls = given.is(kOlderJoinsWalls, settings.thick_shell.joins_walls);
    read_settings(lua, "game.cook", given, all_cook_settings(), settings);
    const Result<uint32_t> cooked = stage.cook(mesh.mesh, settings, !mesh.is_made_here);
    if (!cooked.ok()) given.refuse(cooked.error());
    lua_pop(lua, 1);
    return *cooked;
}

int cook_model(lua_State* lua) {
    const Arguments given(lua, "game.cook", names_of_cook());
    const uint32_t cooked = cook_given(lua, given, given.has("fracture"), true);
    *static_cast<uint32_t*>(lua_newuserdatauv(lua, sizeof(uint32_t), 0)) = cooked;
    luaL_setmetatable(lua, kCookedName);
    return 1;
}

/// Pushes the new body. What finds no room after the start is a note and nil: the run goes on without it.
int added(lua_State* lua, const char* call, const Result<BodyId>& id) {
    Stage& stage = script_of(lua).stage();
    if (id.ok()) {
        push_body(lua, *id);
        return 1;
    }
    if (stage.frame == 0) refuse(lua, fmt::format("{}: {}", call, id.error()));
    add_note(lua, id.error());
    lua_pushnil(lua);
    return 1;
}

std::vector<Box> pins_of(lua_State* lua, const Arguments& given) {
    std::vector<Box> pins;
    given.push("pins");
    if (lua_isnil(lua, -1)) return pins;
    if (!lua_istable(lua, -1)) given.refuse_value("pins", "a list of boxes {{low = {x, y, z}, high = {x, y, z}}}");
    const int list = lua_gettop(lua);
    for (lua_Integer n = 1; lua_rawgeti(lua, list, n) != LUA_TNIL; ++n) {
        const Arguments box(lua, "game.spawn.pins", {"low", "high"}, false, lua_gettop(lua));
        if (pins.size() == kMostPins) given.refuse(fmt::format("pins has more than {} boxes", kMostPins));
        pins.push_back({box.vector("low", kPlace), box.vector("high", kPlace)});
        lua_settop(lua, list);
    }
    lua_settop(lua, list - 1);
    return pins;
}

/// `pivot` is the point of the body that comes to `at`.
Pose pose_of(const Arguments& given) {
    Pose pose;
    pose.orientation = given.turn("turn");
    pose.position = given.vector("at", kPlace, {});
    if (given.has("pivot")) pose.position = pose.position - rotate(pose.orientation, given.vector("pivot", kPlace));
    return pose;
}

int spawn(lua_State* lua) {
    script_of(lua).act(lua);
    std::vector<const char*> known = names_of_cook();
    for (const char* name : {"cooked", "at", "turn", "pivot", "velocity", "spin", "friction", "restitution",
                             "rolling_friction", "strength_scale", "strength_seed", "breakable", "pins"})
        known.push_back(name);
    add_names(known, all_spawn_settings());
    const Arguments given(lua, "game.spawn", known);
    if (given.has("mesh") == given.has("cooked"))
        given.refuse("expected either mesh = game.mesh..., or cooked = what game.cook returned");
    SpawnSettings settings;
    read_settings(lua, "game.spawn", given, all_spawn_settings(), settings, names_mode(given) ? "" : kFracture);
    uint32_t model = 0;
    if (given.has("cooked")) {
        for (const char* name : names_of_cook())
            if (std::string(name) != "mesh" && given.has(name) &&
                !(std::string(name) == "fracture" && names_mode(given)))
                given.refuse(fmt::format("{} belongs to game.cook, beside its mesh", name));
        given.push("cooked");
        model = cooked_at(lua, lua_gettop(lua), "game.spawn: cooked");
        lua_pop(lua, 1);
    } else {
        model = cook_given(lua, given, given.has("fracture") && !names_mode(given), given.is("breakable", true));
    }
    settings.pose = pose_of(given);
    settings.motion = given.motion();
    settings.contact = given.contact();
    settings.strength_scale = given.real("strength_scale", {"a number above 0", 1e-6, HUGE_VAL}, 1);
    settings.strength_seed =
        static_cast<uint64_t>(given.number("strength_seed", {"a whole number from 0 to 1e15", 0, 1e15}, 0));
    settings.is_breakable = given.is("breakable", true);
    const std::vector<Box> pins = pins_of(lua, given);
    settings.pins = pins.data();
    settings.pin_count = static_cast<uint32_t>(pins.size());
    World& world = world_of(lua, "game.spawn");
    spend(lua, kWorkABody);
    Stage& stage = script_of(lua).stage();
    settings.user_data = stage.models[model].look;
    const Result<BodyId> id = world.spawn(stage.models[model].id, settings);
    if (id.ok()) stage.sums.mass_put_in += world.mass(*id).value();
    if (id.ok() && settings.is_breakable && settings.thick_shell.fracture == FractureMode::Hidden) stage.advise(model);
    return added(lua, "game.spawn", id);
}

int throw_ball(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.throw",
                          {"radius", "mass", "at", "velocity", "spin", "friction", "restitution", "rolling_friction"});
    SphereSettings ball;
    ball.radius = static_cast<float>(given.number("radius", kLength));
    ball.mass = static_cast<float>(given.number("mass", kMass));
    ball.pose.position = given.vector("at", kPlace);
    ball.motion = given.motion();
    ball.contact = given.contact();
    World& world = world_of(lua, "game.throw");
    spend(lua, kWorkABody);
    const Result<BodyId> id = world.add_sphere(ball);
    if (id.ok()) script_of(lua).stage().sums.mass_put_in += static_cast<double>(ball.mass);
    return added(lua, "game.throw", id);
}

int kinematic(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.kinematic",
                          {"half_extents", "at", "turn", "pivot", "velocity", "spin", "friction", "restitution",
                           "rolling_friction", "colour"});
    KinematicSettings settings;
    settings.half_extents = given.vector("half_extents", kLength);
    settings.pose = pose_of(given);
    settings.motion = given.motion();
    settings.contact = given.contact();
    const Vec3 colour = given.vector("colour", kShare, {0.33f, 0.36f, 0.42f});
    World& world = world_of(lua, "game.kinematic");
    spend(lua, kWorkABody);
    const Result<BodyId> id = world.add_kinematic_box(settings);
    if (id.ok()) script_of(lua).stage().movers.push_back({*id, make_box(settings.half_extents), colour});
    return added(lua, "game.kinematic", id);
}

// What a body can be asked.

struct Asked {
    World& world;
    BodyId body;
};

Asked asked(lua_State* lua, const char* call) {
    const BodyId* id = body_at(lua, 1);
    if (!id)
        refuse(lua,
               fmt::format("{}: called on {}; expected a body and a colon, as in b:mass()", call, describe(lua, 1)));
    return {world_of(lua, call), *id};
}

template <class T>
T living(lua_State* lua, const char* call, const Result<T>& value) {
    if (!value.ok()) refuse(lua, fmt::format("{}: {} Ask is_alive() first", call, value.error()));
    return *value;
}

void check(lua_State* lua, const char* call, const Result<void>& done) {
    if (!done.ok()) refuse(lua, fmt::format("{}: {}", call, done.error()));
}

int body_position(lua_State* lua) {
    const auto [world, body] = asked(lua, "body:position");
    const Pose pose = living(lua, "body:position", world.pose(body));
    push_vector(lua, to_world(pose, world.contents().data.state.bodies.centre[body.index].to_float()));
    return 1;
}

int body_turn(lua_State* lua) {
    const auto [world, body] = asked(lua, "body:turn");
    push_turn(lua, living(lua, "body:turn", world.pose(body)).orientation);
    return 1;
}

int body_velocity(lua_State* lua) {
    const auto [world, body] = asked(lua, "body:velocity");
    push_vector(lua, living(lua, "body:velocity", world.motion(body)).velocity);
    return 1;
}

int body_spin(lua_State* lua) {
    const auto [world, body] = asked(lua, "body:spin");
    push_vector(lua, living(lua, "body:spin", world.motion(body)).angular_velocity);
    return 1;
}

int body_mass(lua_State* lua) {
    const auto [world, body] = asked(lua, "body:mass");
    lua_pushnumber(lua, living(lua, "body:mass", world.mass(body)));
    return 1;
}

int body_is_alive(lua_State* lua) {
    const auto [world, body] = asked(lua, "body:is_alive");
    lua_pushboolean(lua, world.is_alive(body));
    return 1;
}

int body_is_asleep(lua_State* lua) {
    const auto [world, body] = asked(lua, "body:is_asleep");
    lua_pushboolean(lua, living(lua, "body:is_asleep", world.is_asleep(body)));
    return 1;
}

// What a body can be told.

int body_set_velocity(lua_State* lua) {
    const auto [world, body] = asked(lua, "body:set_velocity");
    Motion motion = living(lua, "body:set_velocity", world.motion(body));
    motion.velocity = read_vector(lua, 2, "body:set_velocity: the velocity", kSpeed);
    check(lua, "body:set_velocity", world.set_motion(body, motion));
    return 0;
}

int body_set_spin(lua_State* lua) {
    const auto [world, body] = asked(lua, "body:set_spin");
    Motion motion = living(lua, "body:set_spin", world.motion(body));
    motion.angular_velocity =
        read_vector(lua, 2, "body:set_spin: the spin", {"an angular velocity in rad/s", -1e5, 1e5});
    check(lua, "body:set_spin", world.set_motion(body, motion));
    return 0;
}

int body_put(lua_State* lua) {
    const auto [world, body] = asked(lua, "body:put");
    const Arguments given(lua, "body:put", {"at", "turn", "pivot"}, false, 2);
    (void)living(lua, "body:put", world.pose(body));
    check(lua, "body:put", world.set_pose(body, pose_of(given)));
    return 0;
}

int body_push(lua_State* lua) {
    const auto [world, body] = asked(lua, "body:push");
    const Arguments given(lua, "body:push", {"impulse", "place"}, false, 2);
    const Pose pose = living(lua, "body:push", world.pose(body));
    const Vec3 centre = to_world(pose, world.contents().data.state.bodies.centre[body.index].to_float());
    const Vec3 impulse = given.vector("impulse", {"an impulse in N s, at most 1e6", -1e6, 1e6});
    check(lua, "body:push", world.apply_impulse(body, impulse, given.vector("place", kPlace, centre)));
    return 0;
}

int body_wake(lua_State* lua) {
    const auto [world, body] = asked(lua, "body:wake");
    check(lua, "body:wake", world.wake(body));
    return 0;
}

int body_remove(lua_State* lua) {
    const auto [world, body] = asked(lua, "body:remove");
    const Bodies& rows = world.contents().data.state.bodies;
    const double mass = living(lua, "body:remove", world.mass(body));
    const bool counts =
        rows.structure[body.index].exists() || rows.kind[body.index] == static_cast<uint8_t>(BodyKind::Dynamic);
    check(lua, "body:remove", world.remove(body));
    Stage& stage = script_of(lua).stage();
    if (counts) stage.sums.mass_put_in -= mass;
    std::erase_if(stage.movers, [removed = body](const Mover& mover) { return mover.body == removed; });
    return 0;
}

int body_equals(lua_State* lua) {
    const BodyId *a = body_at(lua, 1), *b = body_at(lua, 2);
    lua_pushboolean(lua, a && b && *a == *b);
    return 1;
}

}  // namespace

uint32_t cooked_at(lua_State* lua, int place, const std::string& what) {
    const auto* cooked = static_cast<const uint32_t*>(luaL_testudata(lua, place, kCookedName));
    if (!cooked) refuse(lua, fmt::format("{} is {}; expected what game.cook returned", what, describe(lua, place)));
    return *cooked;
}

void push_body(lua_State* lua, BodyId id) {
    *static_cast<BodyId*>(lua_newuserdatauv(lua, sizeof(BodyId), 0)) = id;
    luaL_setmetatable(lua, kBodyName);
}

BodyId* body_at(lua_State* lua, int place) {
    return static_cast<BodyId*>(luaL_testudata(lua, place, kBodyName));
}

void open_bodies(lua_State* lua) {
    luaL_newmetatable(lua, kCookedName);
    lua_pop(lua, 1);
    luaL_newmetatable(lua, kBodyName);
    lua_pushcfunction(lua, body_equals);
    lua_setfield(lua, -2, "__eq");
    static constexpr luaL_Reg methods[] = {{"position", body_position},   {"turn", body_turn},
                                           {"velocity", body_velocity},   {"spin", body_spin},
                                           {"mass", body_mass},           {"is_alive", body_is_alive},
                                           {"is_asleep", body_is_asleep}, {"set_velocity", body_set_velocity},
                                           {"set_spin", body_set_spin},   {"put", body_put},
                                           {"push", body_push},           {"wake", body_wake},
                                           {"remove", body_remove},       {nullptr, nullptr}};
    lua_newtable(lua);
    add_calls(lua, methods);
    open_body_blows(lua);
    guard_names(lua, "body:");
    lua_setfield(lua, -2, "__index");
    lua_pop(lua, 1);
    static constexpr luaL_Reg calls[] = {
        {"cook", cook_model}, {"spawn", spawn}, {"throw", throw_ball}, {"kinematic", kinematic}, {nullptr, nullptr}};
    add_calls(lua, calls);
}

}  // namespace cullet
