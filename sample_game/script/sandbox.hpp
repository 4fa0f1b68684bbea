// A Lua state in which a script can do no harm and gives the same on every run: no files, no programs, no clock, no
// addresses, pairs() in sorted order, bounded memory, bounded work a frame.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

struct lua_State;
struct lua_Debug;

namespace cullet {

struct SandboxLimits {
    size_t bytes = size_t{256} << 20;
    /// Lua instructions between two steps; 20 million take about 0.2 s. Doubled, a script that never ends is found
    /// later.
    uint64_t instructions = 20'000'000;
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

 private:
    static void* allocate(void* self, void* block, size_t old_size, size_t new_size);
    static void count(lua_State* lua, lua_Debug* where);

    SandboxLimits limits_;
    size_t used_ = 0;
    uint64_t spent_ = 0;
    void* owner_;
    lua_State* state_ = nullptr;
};

void* owner_of(lua_State* lua);
/// The value at the place, for a sentence: 12, "text", a table. Never an address.
std::string describe(lua_State* lua, int place);

}  // namespace cullet
