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

const char kDeclared = 0;  // its address is raised where a run of declarations alone ends

std::string text_of(lua_State* lua, int place) {
    const char* text = lua_tostring(lua, place);
    return text ? text : "the script raised " + describe(lua, place) + " in place of a sentence";
}

std::string key_of(const std::string& assignment) {
    return assignment.substr(0, assignment.find('='));
}

std::string line_of(lua_State* lua, const std::string& file) {
    lua_Debug where;
    for (int level = 0; lua_getstack(lua, level, &where); ++level)
        if (lua_getinfo(lua, "l", &where) && where.currentline > 0)
            return fmt::format("{}:{}", file, where.currentline);
    return file;
}

}  // namespace

Script& script_of(lua_State* lua) {
    return *static_cast<Script*>(owner_of(lua));
}

Script::Script(Stage& stage, const SandboxLimits& limits) : stage_(stage), sandbox_(this, limits) {}

Result<void> Script::protect(const std::function<void()>& work) {
    lua_State* lua = sandbox_.state();
    lua_pushcfunction(lua, [](lua_State* l) {
        (*static_cast<const std::function<void()>*>(lua_touserdata(l, 1)))();
        return 0;
    });
    lua_pushlightuserdata(lua, const_cast<std::function<void()>*>(&work));
    const int status = lua_pcall(lua, 1, 0, 0);
    if (status == LUA_OK) return {};
    const bool is_declared = lua_touserdata(lua, -1) == &kDeclared;
    std::string sentence = status == LUA_ERRMEM
                               ? stage_.plan.scene.file + ": the script has used up its memory of 256 MiB; keep less"
                               : (is_declared ? "" : text_of(lua, -1));
    lua_settop(lua, 0);
    if (is_declared) return {};
    return Error{std::move(sentence)};
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
    if (!fault.empty()) refuse(lua, fault);
    Job& own = jobs_.emplace_back();
    make_thread(own.thread);
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
    return start();
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

lua_State* Script::make_thread(int& reference) {
    lua_State* lua = sandbox_.state();
    lua_State* thread = lua_newthread(lua);
    lua_insert(lua, -2);
    lua_xmove(lua, thread, 1);
    reference = luaL_ref(lua, LUA_REGISTRYINDEX);
    return thread;
}

// The order of jobs_ is that of their making; a job made on the way that is due at once has its turn in the same pass.
void Script::wake_all() {
    while (true) {
        size_t next = jobs_.size();
        for (size_t j = 0; j < jobs_.size(); ++j)
            if (!jobs_[j].is_over && jobs_[j].due <= stage_.frame &&
                (next == jobs_.size() || jobs_[j].due < jobs_[next].due))
                next = j;
        if (next == jobs_.size()) break;
        wake(next);
    }
    // The first place stays the script's own.
    if (jobs_.size() > 1)
        jobs_.erase(std::remove_if(jobs_.begin() + 1, jobs_.end(), [](const Job& job) { return job.is_over; }),
                    jobs_.end());
}

void Script::wake(size_t j) {
    lua_State* lua = sandbox_.state();
    if (jobs_[j].thread == 0) {
        lua_rawgeti(lua, LUA_REGISTRYINDEX, jobs_[j].function);
        int reference = 0;
        make_thread(reference);
        jobs_[j].thread = reference;
        jobs_[j].started = jobs_[j].due;
    }
    lua_rawgeti(lua, LUA_REGISTRYINDEX, jobs_[j].thread);
    lua_State* thread = lua_tothread(lua, -1);
    lua_pop(lua, 1);
    int results = 0;
    const int status = lua_resume(thread, lua, 0, &results);
    Job& job = jobs_[j];  // the call may have made others
    if (status == LUA_YIELD) {
        lua_pop(thread, results);
        job.due = stage_.frame + pause_;
        return;
    }
    if (status != LUA_OK) {
        lua_xmove(thread, lua, 1);
        lua_error(lua);
    }
    const bool goes_on = job.period > 0 && !(results > 0 && lua_isboolean(thread, -1) && !lua_toboolean(thread, -1));
    luaL_unref(lua, LUA_REGISTRYINDEX, job.thread);
    job.thread = 0;
    job.is_over = !goes_on;
    if (goes_on)
        for (job.due = job.started; job.due <= stage_.frame;) job.due += job.period;
    else if (job.function != 0)
        luaL_unref(lua, LUA_REGISTRYINDEX, job.function);
}

Stage& Script::act(lua_State* lua) {
    if (has_acted_) return stage_;
    has_acted_ = true;
    for (const std::string& assignment : stage_.plan.set)
        if (!is_given(key_of(assignment)) || !stage_.story.keys.has(key_of(assignment)))
            if (const auto done = stage_.story.keys.set(assignment); !done.ok()) {
                lua_pushstring(lua, done.error().c_str());
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
    Job job;
    job.due = due;
    job.period = period;
    lua_pushvalue(lua, place);
    job.function = luaL_ref(lua, LUA_REGISTRYINDEX);
    jobs_.push_back(job);
}

void Script::listen(lua_State* lua, const std::string& event, int place) {
    lua_pushvalue(lua, place);
    listeners_.push_back({event, luaL_ref(lua, LUA_REGISTRYINDEX)});
}

void Script::call_listeners() {
    lua_State* lua = sandbox_.state();
    const size_t count = listeners_.size();  // those added meanwhile hear of the next step
    for (size_t n = 0; n < count; ++n)
        for (uint32_t e = 0; push_event(lua, *stage_.world, listeners_[n].event, e); ++e) {
            lua_rawgeti(lua, LUA_REGISTRYINDEX, listeners_[n].function);
            lua_insert(lua, -2);
            lua_call(lua, 1, 0);
        }
}

std::string Script::waits_at() const {
    lua_State* lua = sandbox_.state();
    for (const Job& job : jobs_) {
        if (job.is_over || job.period > 0) continue;
        if (job.thread == 0) return stage_.plan.scene.file + ", in a function given to at()";
        lua_rawgeti(lua, LUA_REGISTRYINDEX, job.thread);
        std::string place = line_of(lua_tothread(lua, -1), stage_.plan.scene.file);
        lua_pop(lua, 1);
        return place;
    }
    return "";
}

}  // namespace cullet
