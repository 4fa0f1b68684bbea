// A name that a table does not have ends the script, with the nearest that it has.
#include <fmt/format.h>

#include <algorithm>
#include <lua.hpp>
#include <vector>

#include "sample_game/script/sandbox.hpp"

namespace cullet {
namespace {

/// Letters to be changed, added, left out, or two neighbours exchanged (the optimal string alignment distance).
size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::vector<size_t>> best(a.size() + 1, std::vector<size_t>(b.size() + 1));
    for (size_t i = 0; i <= a.size(); ++i)
        for (size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                best[i][j] = i + j;
                continue;
            }
            best[i][j] =
                std::min({best[i - 1][j] + 1, best[i][j - 1] + 1, best[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                best[i][j] = std::min(best[i][j], best[i - 2][j - 2] + 1);
        }
    return best[a.size()][b.size()];
}

/// The table's names in order of their bytes, short ones only: Lua's own order is another one in every run.
std::vector<std::string> names_in(lua_State* lua, int table) {
    std::vector<std::string> names;
    for (lua_pushnil(lua); lua_next(lua, table); lua_pop(lua, 1))
        if (lua_type(lua, -2) == LUA_TSTRING && lua_rawlen(lua, -2) < 40) names.push_back(lua_tostring(lua, -2));
    std::sort(names.begin(), names.end());
    return names;
}

/// __index of a table of names. Upvalues: what scripts write before the name; all names of the library that it was
/// made from, or nil.
int refuse_name(lua_State* lua) {
    return guarded(lua, [lua]() -> int {
        const std::string prefix = lua_tostring(lua, lua_upvalueindex(1));
        const std::string asked = lua_type(lua, 2) == LUA_TSTRING ? lua_tostring(lua, 2) : describe(lua, 2);
        const std::string name = asked.substr(0, 40);
        if (lua_istable(lua, lua_upvalueindex(2))) {
            lua_pushvalue(lua, 2);
            if (lua_rawget(lua, lua_upvalueindex(2)) != LUA_TNIL)
                refuse(lua,
                       fmt::format("{}{} is left out of scripts; docs/scripting.md says what there is", prefix, name));
            lua_pop(lua, 1);
        }
        const std::vector<std::string> names = names_in(lua, 1);
        std::string nearest, list;
        size_t least = (1 + name.size()) / 4;  // a short name has many neighbours
        for (const std::string& known : names) {
            list += (list.empty() ? "" : ", ") + known;
            if (const size_t d = distance(name, known); d < least || (d == least && nearest.empty()))
                nearest = known, least = d;
        }
        if (!nearest.empty())
            refuse(lua, fmt::format("there is no {0}{1}; do you mean {0}{2}?", prefix, name, nearest));
        if (prefix.empty())
            refuse(lua, fmt::format("there is no {}; give it a value before it is read, such as local {} = false", name,
                                    name));
        refuse(lua, fmt::format("there is no {}{}; there are {}", prefix, name, list));
    });
}

}  // namespace

void guard_names(lua_State* lua, const char* prefix, int library) {
    if (library == 0)
        lua_pushnil(lua);
    else
        lua_pushvalue(lua, library);
    lua_pushstring(lua, prefix);
    lua_insert(lua, -2);
    lua_pushcclosure(lua, refuse_name, 2);
    lua_createtable(lua, 0, 1);
    lua_insert(lua, -2);
    lua_setfield(lua, -2, "__index");
    lua_setmetatable(lua, -2);
}

}  // namespace cullet
