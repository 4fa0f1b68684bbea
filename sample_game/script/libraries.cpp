// What a script has of Lua's own libraries, and pairs, print, tostring, sin and cos of ours.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <lua.hpp>

#include "engine/math.hpp"
#include "sample_game/script/sandbox.hpp"
#include "sample_game/script/script.hpp"

namespace cullet {
namespace {

constexpr const char* kSort = "cullet.sort";

/// Of a library, by name; with what its work depends on besides strings.
struct Kept {
    Kept(const char* its_name, Price its_price = nullptr) : name(its_name), price(its_price) {}
    const char* name;
    Price price;
};

/// Copies the named members of the library (a table on top of the stack, popped) into a new table on top; to read
/// another name of the library is an error of its own.
void keep(lua_State* lua, const char* prefix, std::initializer_list<Kept> members) {
    lua_newtable(lua);
    for (const Kept& member : members) {
        lua_getfield(lua, -2, member.name);
        if (lua_iscfunction(lua, -1)) {
            push_call(lua, lua_tocfunction(lua, -1), member.price);
            lua_remove(lua, -2);
        }
        lua_setfield(lua, -2, member.name);
    }
    guard_names(lua, prefix, -2);
    lua_remove(lua, -2);
}

// Prices. A list's length is a border of it (rawlen), which is what the library goes by.

uint64_t between(lua_Integer first, lua_Integer last) {
    constexpr uint64_t kMost = uint64_t{1} << 40;
    return last < first ? 0 : std::min(static_cast<uint64_t>(last) - static_cast<uint64_t>(first), kMost);
}

lua_Integer integer_or(lua_State* lua, int place, lua_Integer otherwise) {
    int is_integer = 0;
    const lua_Integer value = lua_tointegerx(lua, place, &is_integer);
    return is_integer ? value : otherwise;
}

lua_Integer length_of(lua_State* lua) {
    return lua_istable(lua, 1) ? static_cast<lua_Integer>(lua_rawlen(lua, 1)) : 0;
}

uint64_t price_of_concat(lua_State* lua) {
    return 2 * between(integer_or(lua, 3, 1), integer_or(lua, 4, length_of(lua)));
}
uint64_t price_of_sort(lua_State* lua) {
    return 32 * static_cast<uint64_t>(length_of(lua));
}
/// insert(list, place, value): what comes after it moves.
uint64_t price_of_insert(lua_State* lua) {
    return lua_gettop(lua) < 3 ? 0 : between(integer_or(lua, 2, 1), length_of(lua));
}
uint64_t price_of_remove(lua_State* lua) {
    return lua_gettop(lua) < 2 ? 0 : between(integer_or(lua, 2, 1), length_of(lua));
}

int rank_of(lua_State* lua, int place) {
    switch (lua_type(lua, place)) {
        case LUA_TNUMBER:
            return 0;
        case LUA_TSTRING:
            return 1;
        case LUA_TBOOLEAN:
            return 2;
        default:
            return 3;
    }
}

/// Numbers by value, then strings by their bytes (not by the locale), then false, then true.
int comes_before(lua_State* lua) {
    const int a = rank_of(lua, 1), b = rank_of(lua, 2);
    bool before = a < b;
    if (a == b && a == 0) before = lua_compare(lua, 1, 2, LUA_OPLT);
    if (a == b && a == 1) {
        size_t length_a = 0, length_b = 0;
        const char *text_a = lua_tolstring(lua, 1, &length_a), *text_b = lua_tolstring(lua, 2, &length_b);
        const int order = std::memcmp(text_a, text_b, std::min(length_a, length_b));
        before = order < 0 || (order == 0 && length_a < length_b);
    }
    if (a == b && a == 2) before = !lua_toboolean(lua, 1) && lua_toboolean(lua, 2);
    lua_pushboolean(lua, before);
    return 1;
}

/// Upvalues: the table, its sorted keys, the place in them. A key whose value has gone meanwhile is passed over.
int next_pair(lua_State* lua) {
    lua_Integer at = lua_tointeger(lua, lua_upvalueindex(3));
    while (true) {
        lua_rawgeti(lua, lua_upvalueindex(2), ++at);
        if (lua_isnil(lua, -1)) return 1;
        lua_pushvalue(lua, -1);
        lua_rawget(lua, lua_upvalueindex(1));
        if (!lua_isnil(lua, -1)) break;
        lua_pop(lua, 2);
    }
    lua_pushinteger(lua, at);
    lua_replace(lua, lua_upvalueindex(3));
    return 2;
}

int sorted_pairs(lua_State* lua) {
    if (!lua_istable(lua, 1)) refuse(lua, fmt::format("pairs: given {}; expected a table", describe(lua, 1)));
    lua_settop(lua, 1);
    lua_newtable(lua);
    lua_Integer count = 0;
    for (lua_pushnil(lua); lua_next(lua, 1); lua_pop(lua, 1)) {
        if (rank_of(lua, -2) == 3)
            refuse(lua, fmt::format("pairs: a key is {}, which has no order; use numbers, strings or booleans",
                                    describe(lua, -2)));
        lua_pushvalue(lua, -2);
        lua_rawseti(lua, 2, ++count);
    }
    spend(lua, 150 * static_cast<uint64_t>(count));  // the sort
    lua_getfield(lua, LUA_REGISTRYINDEX, kSort);
    lua_pushvalue(lua, 2);
    lua_pushcfunction(lua, comes_before);
    lua_call(lua, 2, 0);
    lua_pushinteger(lua, 0);
    lua_pushcclosure(lua, next_pair, 3);
    return 1;
}

int to_text(lua_State* lua) {
    luaL_checkany(lua, 1);
    const int type = lua_type(lua, 1);
    if (type == LUA_TNUMBER || type == LUA_TSTRING || type == LUA_TBOOLEAN || type == LUA_TNIL)
        luaL_tolstring(lua, 1, nullptr);
    else
        lua_pushstring(lua, describe(lua, 1).c_str());
    return 1;
}

/// Of string.format: refuses what would print an address, and puts words in place of values that would.
uint64_t price_of_format(lua_State* lua) {
    const std::string pattern = lua_type(lua, 1) == LUA_TSTRING ? lua_tostring(lua, 1) : "";
    for (size_t c = 0; c + 1 < pattern.size(); ++c) {
        if (pattern[c] != '%') continue;
        for (++c; c < pattern.size() && std::strchr("-+ #0123456789.", pattern[c]);) ++c;
        if (c < pattern.size() && pattern[c] == 'p')
            refuse(lua, "string.format: %p is an address, which is another one in every run; leave it out");
    }
    for (int n = 2; n <= lua_gettop(lua); ++n)
        if (const int type = lua_type(lua, n);
            type != LUA_TNUMBER && type != LUA_TSTRING && type != LUA_TBOOLEAN && type != LUA_TNIL) {
            lua_pushstring(lua, describe(lua, n).c_str());
            lua_replace(lua, n);
        }
    return 0;
}

int print_line(lua_State* lua) {
    std::string line;
    for (int n = 1; n <= lua_gettop(lua); ++n) {
        size_t length = 0;
        const bool is_text = lua_type(lua, n) == LUA_TSTRING;
        const char* text = is_text ? lua_tolstring(lua, n, &length) : nullptr;
        line += (n > 1 ? " " : "") + (is_text ? std::string(text, length) : describe(lua, n));
    }
    spend(lua, 100 + line.size() / 8);
    script_of(lua).say(line);
    return 0;
}

// The library's own, whose last bits do not depend on the machine's libm.
int sine(lua_State* lua) {
    double s = 0, c = 0;
    sine_cosine(luaL_checknumber(lua, 1), s, c);
    lua_pushnumber(lua, s);
    return 1;
}
int cosine(lua_State* lua) {
    double s = 0, c = 0;
    sine_cosine(luaL_checknumber(lua, 1), s, c);
    lua_pushnumber(lua, c);
    return 1;
}

/// The methods of strings, and what "10" + 1 calls: the kept ones, counted.
void count_string_methods(lua_State* lua, int kept) {
    lua_pushliteral(lua, "");
    lua_getmetatable(lua, -1);
    const int methods = lua_gettop(lua);
    for (lua_pushnil(lua); lua_next(lua, methods); lua_pop(lua, 1))
        if (lua_iscfunction(lua, -1)) {
            lua_pushvalue(lua, -2);
            push_call(lua, lua_tocfunction(lua, -2));
            lua_rawset(lua, methods);
        }
    lua_pushvalue(lua, kept);
    lua_setfield(lua, methods, "__index");
    lua_pop(lua, 2);
}

}  // namespace

/// Left out: what reads files or loads code; what hides errors (pcall) or order (next); metatables; patterns and
/// string.rep, whose time no length tells; what rounds as the machine's libm does.
void open_libraries(lua_State* lua) {
    luaL_requiref(lua, LUA_GNAME, luaopen_base, 0);
    for (const char* name : {"coroutine", "debug", "io", "loadstring", "os", "package", "require", "utf8"}) {
        lua_pushboolean(lua, true);
        lua_setfield(lua, -2, name);
    }
    keep(lua, "", {"assert", "error", "ipairs", "select", "tonumber", "type"});  // the new globals
    static constexpr luaL_Reg calls[] = {
        {"tostring", to_text}, {"print", print_line}, {"pairs", sorted_pairs}, {nullptr, nullptr}};
    add_calls(lua, calls);

    luaL_requiref(lua, LUA_TABLIBNAME, luaopen_table, 0);
    lua_getfield(lua, -1, "sort");
    lua_setfield(lua, LUA_REGISTRYINDEX, kSort);
    keep(lua, "table.",
         {{"concat", price_of_concat},
          {"insert", price_of_insert},
          "pack",
          {"remove", price_of_remove},
          {"sort", price_of_sort},
          "unpack"});
    lua_setfield(lua, -2, "table");

    luaL_requiref(lua, LUA_MATHLIBNAME, luaopen_math, 0);
    keep(lua, "math.",
         {"abs", "ceil", "floor", "fmod", "huge", "max", "maxinteger", "min", "mininteger", "modf", "pi", "sqrt",
          "tointeger", "type", "ult"});
    static constexpr luaL_Reg own[] = {{"sin", sine}, {"cos", cosine}, {nullptr, nullptr}};
    add_calls(lua, own);
    lua_setfield(lua, -2, "math");

    luaL_requiref(lua, LUA_STRLIBNAME, luaopen_string, 0);
    keep(lua, "string.", {"byte", "char", {"format", price_of_format}, "len", "lower", "reverse", "sub", "upper"});
    count_string_methods(lua, lua_gettop(lua));
    lua_setfield(lua, -2, "string");

    lua_rawseti(lua, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
    lua_pushnil(lua);
    lua_setfield(lua, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
}

}  // namespace cullet
