#include "sample_game/script/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <lua.hpp>
#include <thread>

#include "engine/simd.hpp"
#include "sample_game/script/arguments.hpp"
#include "sample_game/script/calls.hpp"

namespace cullet {
namespace {

const char kDeclared = 0;                      // its address is raised where a run of declarations alone ends
const char kFailed = 0;                        // its address is raised when failure_ says why
constexpr uint64_t kInstructionsAWake = 1000;  // 10 us: a coroutine is made, and its own count starts from 0
constexpr uint64_t kInstructionsAnEvent = 50;
constexpr size_t kMostUnsaid = 65536;  // bytes; the declarations of a script that fails may print more
constexpr size_t kBytesAJob = 256, kBytesAListener = 128;

std::string key_of(const std::string& assignment) {
    return assignment.substr(0, assignment.find('='));
}

}  // namespace

Script& script_of(lua_State* lua) {
    return *static_cast<Script*>(owner_of(lua));
}

Script::Script(Stage& stage, const SandboxLimits& limits) : stage_(stage), sandbox_(this, limits) {}

// Lua takes any exception for an error without a message: whatever lies on the stack then is none.
std::string Script::sentence_of(lua_State* lua, int status) const {
    if (status == LUA_ERRRUN && lua_touserdata(lua, -1) == &kFailed) return failure_;
    const bool is_luas_own = status == LUA_ERRRUN || status == LUA_ERRMEM || status == LUA_ERRERR;
    if (!is_luas_own) return line_of(lua) + ": this call ended the script with an exception of an unknown kind";
    const std::string text = lua_type(lua, -1) == LUA_TSTRING ? lua_tostring(lua, -1) : "";
    if (text == "not enough memory") return line_of(lua) + ": " + sandbox_.no_memory_left();
    if (lua_type(lua, -1) == LUA_TSTRING) return text;
    return fmt::format("{}: error was given {}; expected a sentence that says what went wrong", line_of(lua),
                       describe(lua, -1));
}

Result<void> Script::protect(const std::function<void()>& work) {
    lua_State* lua = sandbox_.state();
    lua_pushcfunction(lua, [](lua_State* l) {
        guarded(l, *static_cast<const std::function<void()>*>(lua_touserdata(l, 1)));
        return 0;
    });
    lua_pushlightuserdata(lua, const_cast<std::function<void()>*>(&work));
    const int status = lua_pcall(lua, 1, 0, 0);
    if (status == LUA_OK) return {};
    const bool is_declared = status == LUA_ERRRUN && lua_touserdata(lua, -1) == &kDeclared;
    std::string sentence = is_declared ? "" : sentence_of(lua, status);
    lua_settop(lua, 0);
    if (is_declared) return {};
    return Error{std::move(sentence)};
}

// The calls of a coroutine that failed still stand: its sentence is made here, and carried on outside of Lua, which may
// have no memory for it.
int Script::resume(lua_State* thread, int arguments, int& results) {
    lua_State* lua = sandbox_.state();
    const int status = lua_resume(thread, lua, arguments, &results);
    if (status == LUA_OK || status == LUA_YIELD) return status;
    if (status == LUA_ERRRUN && lua_touserdata(thread, -1) == &kDeclared)
        lua_pushlightuserdata(lua, const_cast<char*>(&kDeclared));
    else
        fail(sentence_of(thread, status));
    return lua_error(lua);
}

void Script::fail(const std::string& sentence) {
    failure_ = sentence;
    lua_pushlightuserdata(sandbox_.state(), const_cast<char*>(&kFailed));
    lua_error(sandbox_.state());
}

void Script::spend_on_function(uint64_t instructions) {
    if (sandbox_.spend(instructions)) return;
    lua_State* lua = sandbox_.state();
    lua_Debug function;
    lua_pushvalue(lua, -1);
    lua_getinfo(lua, ">S", &function);
    const std::string line = function.linedefined > 0 ? fmt::format(":{}", function.linedefined) : "";
    fail(stage_.plan.scene.file + line + ": " + sandbox_.no_work_left());
}

void Script::prepare() {
    stage_.story.keys = world_keys();
    const uint32_t hardware = std::clamp(std::thread::hardware_concurrency(), 1u, 64u);
    stage_.story.keys.put("threads", stage_.plan.threads > 0 ? stage_.plan.threads : hardware);
    lua_State* lua = sandbox_.state();
    const Keys own_keys = world_keys();
    for (const Key& key : own_keys.all()) apply_set(lua, key.name);
    if (const Result<void> chosen = set_simd_level(stage_.story.keys.word_of("simd")); !chosen.ok()) {
        lua_pushstring(lua, ("--set " + chosen.error()).c_str());
        lua_error(lua);
    }
    open_calls(lua);
    const std::string fault = sandbox_.load(stage_.plan.scene.text, stage_.plan.scene.file);
    if (!fault.empty()) fail(fault);
    Job own;
    own.thread = make_thread();
    jobs_.emplace(Due{0, job_count_++}, own);
    wake_all();
    act(lua);  // a script that does nothing still has its --set looked after
    if (!stage_.plan.mesh_path.empty() && !stage_.takes_mesh) {
        lua_pushstring(lua, fmt::format("--mesh {}: {} takes no mesh: it never asks for game.mesh.given().",
                                        stage_.plan.mesh_path, stage_.plan.scene.name)
                                .c_str());
        lua_error(lua);
    }
}

Result<void> Script::declare() {
    only_declares_ = true;
    Result<void> done = start();
    if (!done.ok()) fmt::print("{}", unsaid_);
    if (!done.ok() && lost_lines_ > 0)
        fmt::print("... and {} more {} that the script printed before it failed.\n", lost_lines_,
                   lost_lines_ == 1 ? "line" : "lines");
    return done;
}

void Script::say(const std::string& line) {
    if (stage_.plan.is_silent) return;
    if (!only_declares_)
        fmt::print("{}\n", line);
    else if (unsaid_.size() < kMostUnsaid)
        unsaid_ += line + "\n";
    else
        ++lost_lines_;
}

Result<void> Script::start() {
    sandbox_.refill();
    return protect([this] { prepare(); });
}

Result<void> Script::go_on() {
    sandbox_.refill();
    return protect([this] { wake_all(); });
}

Result<void> Script::tell_events() {
    if (listeners_.empty()) return {};
    return protect([this] { call_listeners(); });
}

int Script::make_thread() {
    lua_State* lua = sandbox_.state();
    lua_State* thread = lua_newthread(lua);
    lua_insert(lua, -2);
    lua_xmove(lua, thread, 1);
    return luaL_ref(lua, LUA_REGISTRYINDEX);
}

lua_State* Script::thread_of(int reference) const {
    lua_State* lua = sandbox_.state();
    lua_rawgeti(lua, LUA_REGISTRYINDEX, reference);
    lua_State* thread = lua_tothread(lua, -1);
    lua_pop(lua, 1);
    return thread;
}

// A job made on the way that is due at once has its turn in the same pass.
void Script::wake_all() {
    while (!jobs_.empty() && jobs_.begin()->first.frame <= stage_.frame) wake(jobs_.extract(jobs_.begin()));
}

void Script::wake(std::map<Due, Job>::node_type node) {
    lua_State* lua = sandbox_.state();
    Job& job = node.mapped();
    uint64_t& due = node.key().frame;
    if (job.thread == 0) {
        lua_rawgeti(lua, LUA_REGISTRYINDEX, job.function);
        spend_on_function(kInstructionsAWake);
        job.thread = make_thread();
        job.started = due;
    }
    lua_State* thread = thread_of(job.thread);
    int results = 0;
    if (resume(thread, 0, results) == LUA_YIELD) {
        lua_pop(thread, results);
        due = stage_.frame + pause_;
        jobs_.insert(std::move(node));
        return;
    }
    const bool goes_on = job.period > 0 && !(results > 0 && lua_isboolean(thread, -1) && !lua_toboolean(thread, -1));
    luaL_unref(lua, LUA_REGISTRYINDEX, job.thread);
    job.thread = 0;
    if (goes_on) {
        for (due = job.started; due <= stage_.frame;) due += job.period;
        jobs_.insert(std::move(node));
    } else if (job.function != 0) {
        luaL_unref(lua, LUA_REGISTRYINDEX, job.function);
        give_back(lua, kBytesAJob);
    }
}

// The script is not read further than to its first call that does something, so whether the key comes later is seen
// from its text.
std::string Script::late_key(lua_State* lua, const std::string& name) const {
    if (name.empty() || stage_.story.keys.has(name)) return "";
    for (const char quote : {'"', '\''})
        if (stage_.plan.scene.text.find(quote + name + quote) != std::string::npos)
            return fmt::format(
                " The script names {} as well, but {} does something already, and game.key goes before all calls that "
                "do something.",
                name, line_of(lua));
    return "";
}

Stage& Script::act(lua_State* lua) {
    if (has_acted_) return stage_;
    has_acted_ = true;
    for (const std::string& assignment : stage_.plan.set)
        if (!is_given(key_of(assignment)) || !stage_.story.keys.has(key_of(assignment)))
            if (const auto done = stage_.story.keys.set(assignment); !done.ok()) {
                lua_pushstring(lua, (done.error() + late_key(lua, key_of(assignment))).c_str());
                lua_error(lua);
            }
    if (only_declares_) {
        lua_pushlightuserdata(lua, const_cast<char*>(&kDeclared));
        lua_error(lua);
    }
    return stage_;
}

bool Script::is_given(const std::string& name) const {
    return std::find(used_sets_.begin(), used_sets_.end(), name) != used_sets_.end();
}

void Script::apply_set(lua_State* lua, const std::string& name) {
    for (const std::string& assignment : stage_.plan.set) {
        if (key_of(assignment) != name || assignment.find('=') == std::string::npos) continue;
        used_sets_.push_back(name);
        if (name == "threads" && stage_.plan.threads > 0) continue;  // --threads goes before the key
        if (const auto done = stage_.story.keys.set(assignment); !done.ok()) {
            lua_pushstring(lua, done.error().c_str());
            lua_error(lua);
        }
    }
}

int Script::wait(lua_State* lua, uint64_t frames) {
    pause_ = frames;
    return frames > 0 ? lua_yield(lua, 0) : 0;
}

void Script::plan_call(lua_State* lua, int place, uint64_t due, uint64_t period) {
    hold(lua, kBytesAJob);
    Job job;
    job.period = period;
    lua_pushvalue(lua, place);
    job.function = luaL_ref(lua, LUA_REGISTRYINDEX);
    jobs_.emplace(Due{due, job_count_++}, job);
}

void Script::listen(lua_State* lua, const std::string& event, int place) {
    hold(lua, kBytesAListener);
    lua_pushvalue(lua, place);
    listeners_.push_back({event, luaL_ref(lua, LUA_REGISTRYINDEX)});
}

// All in one coroutine, one after the other.
void Script::call_listeners() {
    lua_State* lua = sandbox_.state();
    if (listening_thread_ == 0) {
        lua_newthread(lua);
        listening_thread_ = luaL_ref(lua, LUA_REGISTRYINDEX);
    }
    lua_State* thread = thread_of(listening_thread_);
    is_telling_ = true;
    const size_t count = listeners_.size();  // those added meanwhile hear of the next step
    for (size_t n = 0; n < count; ++n)
        for (uint32_t e = 0; push_event(lua, *stage_.world, listeners_[n].event, e); ++e) {
            lua_rawgeti(lua, LUA_REGISTRYINDEX, listeners_[n].function);
            spend_on_function(kInstructionsAnEvent);
            lua_insert(lua, -2);
            lua_xmove(lua, thread, 2);
            int results = 0;
            resume(thread, 1, results);
            lua_pop(thread, results);
        }
    is_telling_ = false;
}

std::string Script::waits_at() const {
    const auto* first = static_cast<const std::pair<const Due, Job>*>(nullptr);
    for (const auto& entry : jobs_)
        if (entry.second.period == 0 && (!first || entry.first.number < first->first.number)) first = &entry;
    if (!first) return "";
    if (first->second.thread == 0) return stage_.plan.scene.file + ", in a function given to at()";
    return line_of(thread_of(first->second.thread));
}

}  // namespace cullet
