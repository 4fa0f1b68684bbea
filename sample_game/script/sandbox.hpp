// A Lua state in which a script can do no harm and gives the same on every run: no files, no programs, no clock, no
// addresses, pairs() in sorted order, bounded memory, bounded work a frame.
#pragma once
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <string>

struct lua_State;
struct lua_Debug;
struct luaL_Reg;

namespace cullet {

struct SandboxLimits {
    /// Lua's own and what it holds outside of Lua: meshes, notes, planned calls.
    size_t bytes = size_t{256} << 20;
    /// Lua instructions between two steps, and what calls count for; 20 million take about 0.2 s. Doubled, a script
    /// that never ends is found later.
    uint64_t instructions = 20'000'000;
    /// Of one string. An instruction that compares two of them takes 2 us and counts as one: doubled, a loop of such
    /// takes twice as long until it is ended.
    size_t string_bytes = size_t{64} << 10;
};

class Sandbox {
 public:
    /// `owner` comes back from owner_of() in calls of the script.
    explicit Sandbox(void* owner, const SandboxLimits& limits = {});
    ~Sandbox();
    Sandbox(const Sandbox&) = delete;
    Sandbox& operator=(const Sandbox&) = delete;

    lua_State* state() const { return state_; }
    /// Compiles text (never bytecode) and leaves the function on the state's stack; a sentence if it does not compile.
    std::string load(const std::string& text, const std::string& file);
    /// A new frame: its instructions count from 0.
    void refill() { spent_ = 0; }
    /// False when the frame's instructions are used up.
    bool spend(uint64_t instructions);
    /// Without file and line: what that means, and what it means that Lua got no memory.
    std::string no_work_left() const;
    const std::string& no_memory_left() const { return no_memory_left_; }

 private:
    friend void hold(lua_State*, size_t);
    friend void give_back(lua_State*, size_t);
    friend std::string line_of(lua_State*);
    static void* allocate(void* self, void* block, size_t old_size, size_t new_size);
    static void count(lua_State* lua, lua_Debug* where);
    /// Empty, or why Lua cannot have so many bytes more.
    std::string refusal(size_t more, size_t string_size) const;

    SandboxLimits limits_;
    size_t used_ = 0, held_ = 0;  // bytes inside and outside of Lua
    uint64_t spent_ = 0;
    std::string file_, no_memory_left_;
    void* owner_;
    lua_State* state_ = nullptr;
};

void* owner_of(lua_State* lua);
/// The value at the place, for a sentence: 12, "text", a table. Never an address.
std::string describe(lua_State* lua, int place);

/// "vase.lua:12" of the innermost call that has a line; "vase.lua" when none has. Also of a coroutine that failed.
std::string line_of(lua_State* lua);
/// Ends the script: "game.spawn: thickness is -1; expected a length in m above 0", after file and line. Does not
/// return.
[[noreturn]] void refuse(lua_State* lua, const std::string& sentence);

/// Counts work that no Lua instruction shows, one for 10 ns; ends the script when the frame's are used up.
void spend(lua_State* lua, uint64_t instructions);
/// Counts bytes that the script holds outside of Lua; ends the script, after a collection, when they are too many.
void hold(lua_State* lua, size_t bytes);
void give_back(lua_State* lua, size_t bytes);

/// Work of a call before it is made, besides what every call counts for.
using Price = uint64_t (*)(lua_State*);
/// Pushes the C function so that each call counts as work by its arguments, its results and its price, and so that an
/// exception ends the script with a sentence.
void push_call(lua_State* lua, int (*call)(lua_State*), Price price = nullptr);
/// Adds such calls to the table on top of the stack; the last has no name.
void add_calls(lua_State* lua, const luaL_Reg* calls);
/// Makes it an error to read a name that the table on top of the stack does not have. `prefix` as scripts write it:
/// "game."; `library`: the place of the table that it was made from, whose other names are left out on purpose, or 0.
void guard_names(lua_State* lua, const char* prefix, int library = 0);
/// Puts Lua's libraries in place.
void open_libraries(lua_State* lua);

/// Calls it; an exception of the standard library ends the script with a sentence.
template <class F>
auto guarded(lua_State* lua, const F& work) {
    std::string sentence;
    try {
        return work();
    } catch (const std::bad_alloc&) {
        sentence = "the machine has no memory left for this";
    } catch (const std::exception& e) {
        sentence = e.what();
    }
    refuse(lua, sentence);
}

}  // namespace cullet
