// game.expect, on, note; how the world is, and chance from the seed.
#include <fmt/format.h>

#include <lua.hpp>

#include "engine/random.hpp"
#include "sample_game/event_list.hpp"
#include "sample_game/game_world.hpp"
#include "sample_game/script/arguments.hpp"
#include "sample_game/script/calls.hpp"
#include "sample_game/script/script.hpp"

namespace cullet {
namespace {

constexpr uint64_t kRandomStream = 0x7a11;  // apart from that of game.seeded

int expect(lua_State* lua) {
    const Stage& stage = script_of(lua).act(lua);
    const char* sentence = lua_type(lua, 2) == LUA_TSTRING ? lua_tostring(lua, 2) : nullptr;
    if (!sentence)
        refuse(lua,
               fmt::format("game.expect: the sentence is {}; expected game.expect(condition, \"what is to be so\")",
                           describe(lua, 2)));
    if (!lua_toboolean(lua, 1)) refuse(lua, fmt::format("game.expect failed in frame {}: {}", stage.frame, sentence));
    return 0;
}

const char* event_at(lua_State* lua, const char* call) {
    const std::string name = lua_type(lua, 1) == LUA_TSTRING ? lua_tostring(lua, 1) : "";
    const char* found = nullptr;
    each_event({}, [&](const char* event, const auto&) { found = name == event ? event : found; });
    if (found) return found;
    refuse(lua, fmt::format("{}: there is no event {}; expected one of {}", call, describe(lua, 1), event_names()));
}

int on(lua_State* lua) {
    script_of(lua).act(lua);
    const char* event = event_at(lua, "game.on");
    if (!lua_isfunction(lua, 2))
        refuse(lua, fmt::format("game.on: given {}; expected a function of an event", describe(lua, 2)));
    script_of(lua).listen(lua, event, 2);
    return 0;
}

int count(lua_State* lua) {
    const Stage& stage = script_of(lua).act(lua);
    const auto found = stage.sums.events.find(event_at(lua, "game.count"));
    lua_pushinteger(lua, found == stage.sums.events.end() ? 0 : static_cast<lua_Integer>(found->second));
    return 1;
}

int note(lua_State* lua) {
    script_of(lua).act(lua);
    if (lua_type(lua, 1) != LUA_TSTRING)
        refuse(lua, fmt::format("game.note: given {}; expected a sentence", describe(lua, 1)));
    add_note(lua, lua_tostring(lua, 1));
    return 0;
}

// How the world is. Sums over all bodies: some microseconds each.

Matter matter_of(lua_State* lua, const char* call) {
    const World& world = world_of(lua, call);
    spend(lua, 2 * world.report().bodies);
    return measure_matter(world);
}

int frame(lua_State* lua) {
    lua_pushinteger(lua, static_cast<lua_Integer>(script_of(lua).stage().frame));
    return 1;
}

int time(lua_State* lua) {
    const Stage& stage = script_of(lua).stage();
    lua_pushnumber(lua, 0.001 * stage.plan.step_ms * static_cast<double>(stage.frame));
    return 1;
}

int fragments(lua_State* lua) {
    lua_pushinteger(lua, static_cast<lua_Integer>(matter_of(lua, "game.fragments").fragments));
    return 1;
}

int debris(lua_State* lua) {
    lua_pushinteger(lua, world_of(lua, "game.debris").report().debris);
    return 1;
}

int mass(lua_State* lua) {
    lua_pushnumber(lua, matter_of(lua, "game.mass").mass);
    return 1;
}

int mass_put_in(lua_State* lua) {
    lua_pushnumber(lua, script_of(lua).act(lua).sums.mass_put_in);
    return 1;
}

int kinetic_energy(lua_State* lua) {
    lua_pushnumber(lua, matter_of(lua, "game.kinetic_energy").kinetic_energy);
    return 1;
}

int asleep_share(lua_State* lua) {
    const Matter matter = matter_of(lua, "game.asleep_share");
    const uint64_t moving = matter.asleep + matter.awake;
    lua_pushnumber(lua, moving == 0 ? 1 : static_cast<double>(matter.asleep) / static_cast<double>(moving));
    return 1;
}

int bodies(lua_State* lua) {
    const World& world = world_of(lua, "game.bodies");
    std::vector<BodyId> ids(world.bodies(nullptr, 0));
    world.bodies(ids.data(), static_cast<uint32_t>(ids.size()));
    lua_createtable(lua, static_cast<int>(ids.size()), 0);
    for (size_t n = 0; n < ids.size(); ++n) {
        push_body(lua, ids[n]);
        lua_rawseti(lua, -2, static_cast<lua_Integer>(n + 1));
    }
    return 1;
}

// Chance: the same for the same scene.seed.

int random(lua_State* lua) {
    Script& script = script_of(lua);
    const double drawn = Random{script.stage().seed()}.uniform(kRandomStream, script.next_random());
    const bool has_range = lua_gettop(lua) > 0;
    const double low = lua_tonumber(lua, 1), high = lua_tonumber(lua, 2);
    if (has_range && (lua_type(lua, 1) != LUA_TNUMBER || lua_type(lua, 2) != LUA_TNUMBER || !(low <= high)))
        refuse(lua, fmt::format("game.random: given {} and {}; expected nothing, or the least and the most number",
                                describe(lua, 1), describe(lua, 2)));
    lua_pushnumber(lua, has_range ? low + (high - low) * drawn : drawn);
    return 1;
}

uint32_t number_at(lua_State* lua, const char* call) {
    const lua_Integer number = lua_tointeger(lua, 1);
    if (!lua_isinteger(lua, 1) || number < 0 || number > 0xffffffff)
        refuse(lua, fmt::format("{}: given {}; expected a whole number from 0 on, another one for each use", call,
                                describe(lua, 1)));
    return static_cast<uint32_t>(number);
}

int seeded_number(lua_State* lua) {
    lua_pushnumber(lua, seeded(script_of(lua).stage().seed(), number_at(lua, "game.seeded")));
    return 1;
}

int seeded_turn(lua_State* lua) {
    push_turn(lua, any_turn(script_of(lua).stage().seed(), number_at(lua, "game.any_turn")));
    return 1;
}

int seed(lua_State* lua) {
    lua_pushinteger(lua, static_cast<lua_Integer>(script_of(lua).stage().seed()));
    return 1;
}

/// The nearest number of single precision, which is what the world holds.
int single(lua_State* lua) {
    if (lua_type(lua, 1) != LUA_TNUMBER)
        refuse(lua, fmt::format("game.single: given {}; expected a number", describe(lua, 1)));
    lua_pushnumber(lua, static_cast<double>(static_cast<float>(lua_tonumber(lua, 1))));
    return 1;
}

// Events as tables.

void set(lua_State* lua, const char* name, BodyId id) {
    push_body(lua, id);
    lua_setfield(lua, -2, name);
}
void set(lua_State* lua, const char* name, Vec3 v) {
    push_vector(lua, v);
    lua_setfield(lua, -2, name);
}
void set(lua_State* lua, const char* name, double value) {
    lua_pushnumber(lua, value);
    lua_setfield(lua, -2, name);
}
void set(lua_State* lua, const char* name, const char* text) {
    lua_pushstring(lua, text);
    lua_setfield(lua, -2, name);
}

void fill(lua_State* lua, const ImpactEvent& e) {
    set(lua, "body", e.body), set(lua, "place", e.place), set(lua, "normal", e.normal);
    set(lua, "speed", static_cast<double>(e.approach_speed)), set(lua, "energy", e.energy);
    if (e.striker) set(lua, "striker", e.striker);
    lua_pushboolean(lua, e.is_held), lua_setfield(lua, -2, "is_held");
    lua_pushnumber(lua, static_cast<lua_Number>(e.load)), lua_setfield(lua, -2, "load");
}
void fill(lua_State* lua, const CrackStartedEvent& e) {
    set(lua, "body", e.body), set(lua, "place", e.place);
}
void fill(lua_State* lua, const FragmentBornEvent& e) {
    set(lua, "body", e.fragment), set(lua, "parent", e.parent), set(lua, "place", e.place);
    set(lua, "velocity", e.motion.velocity), set(lua, "spin", e.motion.angular_velocity), set(lua, "mass", e.mass);
    lua_pushinteger(lua, e.generation), lua_setfield(lua, -2, "generation");
}
void fill(lua_State* lua, const DebrisEvent& e) {
    set(lua, "parent", e.parent), set(lua, "place", e.place), set(lua, "velocity", e.velocity),
        set(lua, "mass", e.mass);
}
void fill(lua_State* lua, const RefusedEvent& e) {
    set(lua, "body", e.body), set(lua, "place", e.place), set(lua, "setting", e.setting);
}
void fill(lua_State* lua, const FaultEvent& e) {
    set(lua, "body", e.body), set(lua, "place", e.place), set(lua, "reason", e.reason);
}
void fill(lua_State* lua, const AsleepEvent& e) {
    set(lua, "body", e.body), set(lua, "place", e.place);
}
void fill(lua_State* lua, const SqueezedEvent& e) {
    set(lua, "body", e.body), set(lua, "by", e.by), set(lua, "place", e.place);
}

template <class E>
bool push_nth(lua_State* lua, const EventSpan<E>& events, uint32_t n) {
    if (n >= events.count) return false;
    lua_newtable(lua);
    fill(lua, events[n]);
    return true;
}

}  // namespace

bool push_event(lua_State* lua, const World& world, const std::string& event, uint32_t n) {
    bool is_pushed = false;
    each_event(world.events(), [&](const char* name, const auto& events) {
        if (event == name) is_pushed = push_nth(lua, events, n);
    });
    return is_pushed;
}

void open_queries(lua_State* lua) {
    static constexpr luaL_Reg calls[] = {{"expect", expect},
                                         {"on", on},
                                         {"count", count},
                                         {"note", note},
                                         {"frame", frame},
                                         {"time", time},
                                         {"fragments", fragments},
                                         {"debris", debris},
                                         {"mass", mass},
                                         {"mass_put_in", mass_put_in},
                                         {"kinetic_energy", kinetic_energy},
                                         {"asleep_share", asleep_share},
                                         {"bodies", bodies},
                                         {"random", random},
                                         {"seeded", seeded_number},
                                         {"any_turn", seeded_turn},
                                         {"seed", seed},
                                         {"single", single},
                                         {nullptr, nullptr}};
    add_calls(lua, calls);
}

}  // namespace cullet
