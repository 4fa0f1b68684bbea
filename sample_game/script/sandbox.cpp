#include "sample_game/script/sandbox.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <lua.hpp>

#include "engine/math.hpp"

namespace cullet {
namespace {

constexpr int kInstructionsACount = 1000;

/// Copies the named members of the library (a table on top of the stack, popped) into a new table on top.
void keep(lua_State* lua, std::initializer_list<const char*> names) {
    lua_newtable(lua);
    for (const char* name : names) {
        lua_getfield(lua, -2, name);
        lua_setfield(lua, -2, name);
    }
    lua_remove(lua, -2);
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

/// Upvalue: table.sort.
int sorted_pairs(lua_State* lua) {
    if (!lua_istable(lua, 1)) luaL_error(lua, "pairs: given %s; expected a table", describe(lua, 1).c_str());
    lua_settop(lua, 1);
    lua_newtable(lua);
    lua_Integer count = 0;
    for (lua_pushnil(lua); lua_next(lua, 1); lua_pop(lua, 1)) {
        if (rank_of(lua, -2) == 3)
            luaL_error(lua, "pairs: a key is %s, which has no order; use numbers, strings or booleans",
                       describe(lua, -2).c_str());
        lua_pushvalue(lua, -2);
        lua_rawseti(lua, 2, ++count);
    }
    lua_pushvalue(lua, lua_upvalueindex(1));
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

/// string.format without what would print an address. Upvalue: Lua's own.
int format_text(lua_State* lua) {
    const std::string pattern = luaL_checkstring(lua, 1);
    for (size_t c = 0; c + 1 < pattern.size(); ++c) {
        if (pattern[c] != '%') continue;
        for (++c; c < pattern.size() && std::strchr("-+ #0123456789.", pattern[c]);) ++c;
        if (c < pattern.size() && pattern[c] == 'p')
            luaL_error(lua, "string.format: %%p is an address, which is another one in every run; leave it out");
    }
    const int count = lua_gettop(lua);
    for (int n = 2; n <= count; ++n)
        if (const int type = lua_type(lua, n);
            type != LUA_TNUMBER && type != LUA_TSTRING && type != LUA_TBOOLEAN && type != LUA_TNIL) {
            lua_pushstring(lua, describe(lua, n).c_str());
            lua_replace(lua, n);
        }
    lua_pushvalue(lua, lua_upvalueindex(1));
    lua_insert(lua, 1);
    lua_call(lua, count, 1);
    return 1;
}

int print_line(lua_State* lua) {
    std::string line;
    for (int n = 1; n <= lua_gettop(lua); ++n) {
        size_t length = 0;
        const bool is_text = lua_type(lua, n) == LUA_TSTRING;
        const char* text = is_text ? lua_tolstring(lua, n, &length) : nullptr;
        line += (n > 1 ? " " : "") + (is_text ? std::string(text, length) : describe(lua, n));
    }
    fmt::print("{}\n", line);
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

/// Left out: what reads files or loads code; what hides errors (pcall) or order (next); metatables; patterns and
/// string.rep, whose time no instruction counts; what rounds as the machine's libm does.
void open_libraries(lua_State* lua) {
    luaL_requiref(lua, LUA_GNAME, luaopen_base, 0);
    keep(lua, {"assert", "error", "ipairs", "select", "tonumber", "type"});  // the new globals
    lua_pushcfunction(lua, to_text);
    lua_setfield(lua, -2, "tostring");
    lua_pushcfunction(lua, print_line);
    lua_setfield(lua, -2, "print");

    luaL_requiref(lua, LUA_TABLIBNAME, luaopen_table, 0);
    lua_getfield(lua, -1, "sort");
    lua_pushcclosure(lua, sorted_pairs, 1);
    lua_setfield(lua, -3, "pairs");
    keep(lua, {"concat", "insert", "pack", "remove", "sort", "unpack"});
    lua_setfield(lua, -2, "table");

    luaL_requiref(lua, LUA_MATHLIBNAME, luaopen_math, 0);
    keep(lua, {"abs", "ceil", "floor", "fmod", "huge", "max", "maxinteger", "min", "mininteger", "modf", "pi", "sqrt",
               "tointeger", "type", "ult"});
    lua_pushcfunction(lua, sine);
    lua_setfield(lua, -2, "sin");
    lua_pushcfunction(lua, cosine);
    lua_setfield(lua, -2, "cos");
    lua_setfield(lua, -2, "math");

    luaL_requiref(lua, LUA_STRLIBNAME, luaopen_string, 0);
    lua_getfield(lua, -1, "format");
    lua_pushcclosure(lua, format_text, 1);
    lua_setfield(lua, -2, "format");
    keep(lua, {"byte", "char", "format", "len", "lower", "reverse", "sub", "upper"});
    lua_pushliteral(lua, "");
    lua_getmetatable(lua, -1);
    lua_pushvalue(lua, -3);
    lua_setfield(lua, -2, "__index");
    lua_pop(lua, 2);
    lua_setfield(lua, -2, "string");

    lua_rawseti(lua, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
    lua_pushnil(lua);
    lua_setfield(lua, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
}

}  // namespace

void* Sandbox::allocate(void* self, void* block, size_t old_size, size_t new_size) {
    Sandbox& sandbox = *static_cast<Sandbox*>(self);
    if (!block) old_size = 0;  // it is a kind of object then
    if (new_size == 0) {
        std::free(block);
        sandbox.used_ -= old_size;
        return nullptr;
    }
    if (new_size > old_size && sandbox.used_ + (new_size - old_size) > sandbox.limits_.bytes) return nullptr;
    void* moved = std::realloc(block, new_size);
    if (moved) sandbox.used_ += new_size - old_size;
    return moved;
}

void Sandbox::count(lua_State* lua, lua_Debug*) {
    Sandbox* sandbox = nullptr;
    lua_getallocf(lua, reinterpret_cast<void**>(&sandbox));
    sandbox->spent_ += kInstructionsACount;
    if (sandbox->spent_ <= sandbox->limits_.instructions) return;
    luaL_where(lua, 0);  // no call stands between: the hook comes in the midst of the function
    lua_pushstring(lua, fmt::format("the script took more than {} million instructions in one frame; end the loop, or "
                                    "wait() in it",
                                    sandbox->limits_.instructions / 1'000'000)
                            .c_str());
    lua_concat(lua, 2);
    lua_error(lua);
}

Sandbox::Sandbox(void* owner, const SandboxLimits& limits) : limits_(limits), owner_(owner) {
    state_ = lua_newstate(&Sandbox::allocate, this);
    *static_cast<void**>(lua_getextraspace(state_)) = owner_;
    open_libraries(state_);
    lua_settop(state_, 0);
    lua_sethook(state_, &Sandbox::count, LUA_MASKCOUNT, kInstructionsACount);
}

Sandbox::~Sandbox() {
    lua_close(state_);
}

std::string Sandbox::load(const std::string& text, const std::string& file) {
    if (luaL_loadbufferx(state_, text.data(), text.size(), ("@" + file).c_str(), "t") == LUA_OK) return "";
    const char* message = lua_tostring(state_, -1);
    std::string sentence = message ? message : file + ": cannot be compiled";
    lua_pop(state_, 1);
    return sentence;
}

void* owner_of(lua_State* lua) {
    return *static_cast<void**>(lua_getextraspace(lua));
}

std::string describe(lua_State* lua, int place) {
    switch (lua_type(lua, place)) {
        case LUA_TNONE:
        case LUA_TNIL:
            return "nil";
        case LUA_TBOOLEAN:
            return lua_toboolean(lua, place) ? "true" : "false";
        case LUA_TNUMBER:
            return lua_isinteger(lua, place) ? fmt::format("{}", lua_tointeger(lua, place))
                                             : fmt::format("{:.6g}", lua_tonumber(lua, place));
        case LUA_TSTRING:
            return fmt::format("\"{}\"", lua_tostring(lua, place));
        case LUA_TUSERDATA:
            if (luaL_getmetafield(lua, place, "__name") == LUA_TSTRING) {
                const std::string name = lua_tostring(lua, -1);
                lua_pop(lua, 1);
                return "a " + name;
            }
            return "a value of the game";
        default:
            return std::string("a ") + luaL_typename(lua, place);
    }
}

}  // namespace cullet
