#include "sample_game/script/sandbox.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <lua.hpp>

namespace cullet {
namespace {

constexpr int kInstructionsACount = 1000;
// What work counts for; an instruction takes about 10 ns. Halved, a loop of such work takes twice as long until it is
// ended; doubled, fewer honest scripts fit a frame.
constexpr uint64_t kInstructionsACall = 20;    // the arguments are read and looked at
constexpr uint64_t kInstructionsABlock = 10;   // of fresh memory, which is to be collected again
constexpr size_t kBytesAnInstruction = 64;     // of the same: filled
constexpr size_t kBytesReadAnInstruction = 8;  // of strings that a library call goes through byte by byte
constexpr size_t kBytesCollected = 32;         // of all of Lua's memory, in a whole collection
/// Values given to one function. Without an end, `...` copies a million in one instruction.
constexpr int kMostValues = 1000;

Sandbox& sandbox_of(lua_State* lua) {
    void* sandbox = nullptr;
    lua_getallocf(lua, &sandbox);
    return *static_cast<Sandbox*>(sandbox);
}

/// Upvalues: the function, its price or null. Runs in the frame of the call itself: errors of Lua's libraries name the
/// call, its file and line.
int counted(lua_State* lua) {
    return guarded(lua, [lua] {
        const int given = lua_gettop(lua);
        uint64_t work = kInstructionsACall + static_cast<uint64_t>(given);
        for (int n = 1; n <= given; ++n)
            if (lua_type(lua, n) == LUA_TSTRING) work += lua_rawlen(lua, n) / kBytesReadAnInstruction;
        if (const auto price = reinterpret_cast<Price>(lua_touserdata(lua, lua_upvalueindex(2)))) work += price(lua);
        spend(lua, work);
        const int results = lua_tocfunction(lua, lua_upvalueindex(1))(lua);
        spend(lua, static_cast<uint64_t>(results));
        return results;
    });
}

std::string shown(const std::string& text) {
    constexpr size_t kMost = 80;  // bytes in a sentence
    return text.size() > kMost ? fmt::format("\"{}...\"", text.substr(0, kMost)) : fmt::format("\"{}\"", text);
}

}  // namespace

std::string Sandbox::refusal(size_t more, size_t string_size) const {
    if (string_size > limits_.string_bytes + 32)  // Lua's own header
        return fmt::format("a string has grown above {} KiB; print, note or keep it in parts",
                           limits_.string_bytes >> 10);
    if (used_ + held_ + more > limits_.bytes)
        return fmt::format("the script has used up its memory of {} MiB; keep less", limits_.bytes >> 20);
    // Just above the limit the hook says so, with more ease. Near the memory's end each refusal is a collection.
    if (spent_ / 2 > limits_.instructions) return no_work_left();
    return "";
}

// A refused block makes Lua collect everything and ask again.
void* Sandbox::allocate(void* self, void* block, size_t old_size, size_t new_size) {
    Sandbox& sandbox = *static_cast<Sandbox*>(self);
    const bool is_string = !block && old_size == LUA_TSTRING;
    if (!block) old_size = 0;  // it is a kind of object then
    if (new_size == 0) {
        std::free(block);
        sandbox.used_ -= old_size;
        return nullptr;
    }
    if (new_size > old_size) {
        sandbox.spent_ += kInstructionsABlock + new_size / kBytesAnInstruction;
        if (std::string refusal = sandbox.refusal(new_size - old_size, is_string ? new_size : 0); !refusal.empty()) {
            sandbox.no_memory_left_ = std::move(refusal);
            sandbox.spent_ += sandbox.used_ / kBytesCollected;
            return nullptr;
        }
    }
    void* moved = std::realloc(block, new_size);
    if (moved)
        sandbox.used_ += new_size - old_size;
    else
        sandbox.no_memory_left_ = "the machine has no memory left for the script";
    return moved;
}

void Sandbox::count(lua_State* lua, lua_Debug*) {
    cullet::spend(lua, kInstructionsACount);
    lua_Debug call;
    for (int level = 0; level < 2 && lua_getstack(lua, level, &call); ++level)
        if (lua_getlocal(lua, &call, -kMostValues))
            refuse(lua, fmt::format("a function was given {} values or more; give it a table", kMostValues));
}

bool Sandbox::spend(uint64_t instructions) {
    spent_ += instructions;
    return spent_ <= limits_.instructions;
}

std::string Sandbox::no_work_left() const {
    return fmt::format("the script took more than {} million instructions in one frame; end the loop, or wait() in it",
                       limits_.instructions / 1'000'000);
}

Sandbox::Sandbox(void* owner, const SandboxLimits& limits) : limits_(limits), owner_(owner) {
    state_ = lua_newstate(&Sandbox::allocate, this);
    *static_cast<void**>(lua_getextraspace(state_)) = owner_;
    open_libraries(state_);
    lua_settop(state_, 0);
    lua_sethook(state_, &Sandbox::count, LUA_MASKCOUNT, kInstructionsACount);
}

Sandbox::~Sandbox() {
    limits_ = {SIZE_MAX, UINT64_MAX, SIZE_MAX};  // closing must not be refused: meshes are destroyed by it
    lua_close(state_);
}

std::string Sandbox::load(const std::string& text, const std::string& file) {
    file_ = file;
    if (text.starts_with(LUA_SIGNATURE[0])) return file + ": this is compiled Lua; give the text of the script";
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
        return file + ": this is UTF-16; save the script as UTF-8";
    // Editors of Windows put a mark before the text.
    const size_t mark = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
    const int status = luaL_loadbufferx(state_, text.data() + mark, text.size() - mark, ("@" + file).c_str(), "t");
    if (status == LUA_OK) return "";
    const char* message = status == LUA_ERRMEM ? nullptr : lua_tostring(state_, -1);
    std::string sentence = message ? message : file + ": " + no_memory_left();
    lua_pop(state_, 1);
    return sentence;
}

std::string line_of(lua_State* lua) {
    lua_Debug where;
    for (int level = 0; lua_getstack(lua, level, &where); ++level)
        if (lua_getinfo(lua, "l", &where) && where.currentline > 0)
            return fmt::format("{}:{}", sandbox_of(lua).file_, where.currentline);
    return sandbox_of(lua).file_;
}

void refuse(lua_State* lua, const std::string& sentence) {
    const std::string whole = line_of(lua) + ": " + sentence;
    lua_pushlstring(lua, whole.data(), whole.size());
    lua_error(lua);
    std::abort();  // not reached
}

void spend(lua_State* lua, uint64_t instructions) {
    Sandbox& sandbox = sandbox_of(lua);
    if (!sandbox.spend(instructions)) refuse(lua, sandbox.no_work_left());
}

void hold(lua_State* lua, size_t bytes) {
    Sandbox& sandbox = sandbox_of(lua);
    std::string refusal = sandbox.refusal(bytes, 0);
    if (!refusal.empty()) {
        spend(lua, sandbox.used_ / kBytesCollected);
        lua_gc(lua, LUA_GCCOLLECT);
        refusal = sandbox.refusal(bytes, 0);
    }
    if (!refusal.empty()) refuse(lua, refusal);
    sandbox.held_ += bytes;
}

void give_back(lua_State* lua, size_t bytes) {
    sandbox_of(lua).held_ -= bytes;
}

void push_call(lua_State* lua, lua_CFunction call, Price price) {
    lua_pushcfunction(lua, call);
    lua_pushlightuserdata(lua, reinterpret_cast<void*>(price));
    lua_pushcclosure(lua, counted, 2);
}

void add_calls(lua_State* lua, const luaL_Reg* calls) {
    for (; calls->name; ++calls) {
        push_call(lua, calls->func);
        lua_setfield(lua, -2, calls->name);
    }
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
            return shown(lua_tostring(lua, place));
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
