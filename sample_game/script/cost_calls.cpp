// game.retire and game.cost: what a game does about the price of its fragments.
#include <lua.hpp>

#include "sample_game/script/arguments.hpp"
#include "sample_game/script/calls.hpp"
#include "sample_game/script/script.hpp"

namespace cullet {
namespace {

constexpr uint64_t kWorkACall = 3000;  // instructions, as a body put into the world

int retire(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.retire", {"count", "how", "age", "asleep"});
    RetireSettings settings;
    const std::string how = given.word("how", "\"remove\", \"freeze\" or \"merge\"", "remove");
    if (how == "freeze")
        settings.how = Retirement::Freeze;
    else if (how == "merge")
        settings.how = Retirement::Merge;
    else if (how != "remove")
        given.refuse_value("how", "\"remove\", \"freeze\" or \"merge\"");
    const Wanted count{"a whole number of fragments from 0 to 1e9", 0, 1e9};
    settings.count = static_cast<uint32_t>(given.number("count", count, 1e9));
    settings.least_seconds = given.real("age", {"seconds from 0 to 1e9", 0, 1e9}, 0);
    settings.only_asleep = given.is("asleep", false);
    World& world = world_of(lua, "game.retire");
    spend(lua, kWorkACall + 2 * world.report().bodies);
    const Result<uint32_t> retired = world.retire(settings);
    if (!retired.ok()) given.refuse(retired.error());
    lua_pushinteger(lua, *retired);
    return 1;
}

int cost(lua_State* lua) {
    const World& world = world_of(lua, "game.cost");
    const StepReport report = world.report();
    spend(lua, kWorkACall + 2 * report.bodies);
    FragmentAge oldest;
    lua_newtable(lua);
    const auto put = [lua](const char* name, uint64_t value) {
        lua_pushinteger(lua, static_cast<lua_Integer>(value));
        lua_setfield(lua, -2, name);
    };
    put("units_left", report.units_left);
    put("open_hits", report.open_hits);
    put("waiting_hits", report.waiting_hits);
    put("waiting_bodies", report.waiting_bodies);
    put("oldest_hit_frames", report.oldest_hit_frames);
    put("fragments", world.fragments(&oldest, 1));
    put("oldest_fragment_frames", oldest.frames);
    put("retired", report.retired);
    put("faded", report.faded);
    return 1;
}

}  // namespace

void open_costs(lua_State* lua) {
    static constexpr luaL_Reg calls[] = {{"retire", retire}, {"cost", cost}, {nullptr, nullptr}};
    add_calls(lua, calls);
}

}  // namespace cullet
