// A script at work: its own course and the functions that it gave to at(), every() and game.on() are coroutines, woken
// between steps in order of their frame, then of their making.
#pragma once
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sample_game/script/sandbox.hpp"
#include "sample_game/stage.hpp"

namespace cullet {

class Script {
 public:
    explicit Script(Stage& stage, const SandboxLimits& limits = {});

    /// Declarations alone, up to the first call that does something.
    Result<void> declare();
    /// Runs up to the first wait.
    Result<void> start();
    /// Wakes all that is due before this frame's step.
    Result<void> go_on();
    /// Gives the last step's events to the functions of game.on().
    Result<void> tell_events();
    /// Where it, or a function of at(), still waits; empty when nothing is left that must be reached.
    std::string waits_at() const;

    // For its calls.
    Stage& stage() { return stage_; }
    /// Of a call that is no declaration: looks after --set, and ends a run of declarations alone.
    Stage& act(lua_State* lua);
    bool has_acted() const { return has_acted_; }
    /// Prints a line. What a run of declarations alone would print comes in the run that follows, or when there is none
    /// because the declarations failed.
    void say(const std::string& line);
    /// Adds the key's value from the command line; once for each key that is declared.
    void apply_set(lua_State* lua, const std::string& name);
    bool is_given(const std::string& name) const;
    /// In a coroutine: wakes after so many frames. The value is the caller's return value.
    int wait(lua_State* lua, uint64_t frames);
    /// Calls the function at the place in frame `due`, then every `period` frames if that is not 0.
    void plan_call(lua_State* lua, int place, uint64_t due, uint64_t period);
    /// A function of game.on() is at work, which may not wait.
    bool is_telling() const { return is_telling_; }
    void listen(lua_State* lua, const std::string& event, int place);
    /// Counts up: the number of each call of game.random().
    uint32_t next_random() { return random_count_++; }

 private:
    /// The order in which jobs are woken: their frame, then their making.
    struct Due {
        uint64_t frame = 0, number = 0;
        auto operator<=>(const Due&) const = default;
    };
    struct Job {
        uint64_t started = 0, period = 0;
        int thread = 0;    // reference; 0: it is between two calls
        int function = 0;  // reference, of at() and every()
    };
    struct Listener {
        std::string event;
        int function = 0;
    };
    Result<void> protect(const std::function<void()>& work);
    void prepare();
    void wake_all();
    void wake(std::map<Due, Job>::node_type job);
    /// Leaves the new coroutine in the registry; the function is on the stack's top, and is popped.
    int make_thread();
    lua_State* thread_of(int reference) const;
    /// Raises what ended the coroutine, as a sentence with file and line.
    int resume(lua_State* thread, int arguments, int& results);
    std::string sentence_of(lua_State* lua, int status) const;
    /// Raises the sentence.
    void fail(const std::string& sentence);
    /// Ends the script at the function on top of the stack when there is no work left for it.
    void spend_on_function(uint64_t instructions);
    void call_listeners();
    /// What else to say of a key that is not there: that it is declared too late, if so.
    std::string late_key(lua_State* lua, const std::string& name) const;

    Stage& stage_;
    Sandbox sandbox_;
    std::map<Due, Job> jobs_;  // number 0: the script's own course
    uint64_t job_count_ = 0;
    std::vector<Listener> listeners_;
    std::vector<std::string> used_sets_;
    std::string failure_, unsaid_;
    uint64_t lost_lines_ = 0;   // printed while declaring, beyond what is kept
    int listening_thread_ = 0;  // reference
    uint64_t pause_ = 0;
    uint32_t random_count_ = 0;
    bool only_declares_ = false, has_acted_ = false, is_telling_ = false;
};

Script& script_of(lua_State* lua);

}  // namespace cullet
