// The order of one frame. Systems are listed as a story; which of them may run at once follows from their signatures:
// two systems are ordered when one writes what the other touches. Neighbours in the list without such an edge share one
// pass.
#pragma once
#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/assert.hpp"
#include "engine/fp_mode.hpp"
#include "engine/jobs.hpp"
#include "engine/profiler.hpp"
#include "engine/system.hpp"

namespace cullet {

/// A system as the plan and the inner loops call it.
template <class World>
struct PlannedSystem {
    std::string name, stage;
    CallKind kind = CallKind::Serial;
    std::vector<Access> accesses;
    uint32_t chunk_rows = 1;
    /// Rows (in an inner loop: of the task) or events to call it for.
    uint32_t (*row_count)(World&) = nullptr;
    Rows<void> (*rows_of_body)(World&, uint32_t body) = nullptr;
    void (*invoke)(Call<World>&) = nullptr;
    uint32_t owner = 0;
    bool (*is_own)(World&, uint32_t event, uint32_t owner) = nullptr;  // null: called for all events
    uint32_t every = 1;                                                // inner loops: in each n-th repetition
    uint32_t zone = 0;
    std::vector<uint32_t> after;  // systems that must have ended, by place in the list
};

template <class World, auto System>
PlannedSystem<World> plan_system(std::string stage) {
    using Sig = Signature<decltype(System)>;
    PlannedSystem<World> planned;
    planned.name = system_name<System>();
    planned.stage = std::move(stage);
    planned.kind = Sig::kKind;
    planned.accesses = Sig::accesses();
    planned.invoke = [](Call<World>& call) { Sig::template invoke<System>(call); };
    if constexpr (Sig::kKind == CallKind::Rows) {
        using T = std::remove_pointer_t<std::tuple_element_t<0, typename Sig::RowTables>>;
        planned.chunk_rows = kRowsPerChunk<T>;
        planned.row_count = [](World& world) { return world.template table<T>().size(); };
        if constexpr (requires(World & w) { w.template rows_of<T>(0u); })
            planned.rows_of_body = [](World& world, uint32_t body) {
                const auto range = world.template rows_of<T>(body);
                return Rows<void>{range.first, range.count};
            };
    } else if constexpr (Sig::kKind == CallKind::Bodies) {
        if constexpr (std::tuple_size_v<typename Sig::Eaches> == 1) {
            using E = std::remove_pointer_t<std::tuple_element_t<0, typename Sig::Eaches>>;
            planned.row_count = [](World& world) { return world.template resource<Events<E>>().size(); };
            if constexpr (Sig::kIsOfOwner)
                planned.is_own = [](World& world, uint32_t event, uint32_t owner) {
                    return world.template resource<Events<E>>().all()[event].owner == owner;
                };
        }
    } else {
        planned.row_count = [](World&) { return 1u; };
    }
    return planned;
}

/// Fills `after` of each system from the accesses of those before it; a path through another system is left out.
template <class World>
void derive_edges(std::vector<PlannedSystem<World>>& systems) {
    const auto conflicts = [](const PlannedSystem<World>& a, const PlannedSystem<World>& b) {
        for (const Access& x : a.accesses)
            for (const Access& y : b.accesses)
                if ((x.writes || y.writes) && x.overlaps(y)) return true;
        return false;
    };
    std::vector<std::vector<bool>> reaches(systems.size(), std::vector<bool>(systems.size(), false));
    for (uint32_t later = 0; later < systems.size(); ++later) {
        systems[later].after.clear();
        for (uint32_t earlier = later; earlier-- > 0;) {
            if (reaches[later][earlier] || !conflicts(systems[earlier], systems[later])) continue;
            systems[later].after.push_back(earlier);
            reaches[later][earlier] = true;
            for (uint32_t before = 0; before < earlier; ++before)
                if (reaches[earlier][before]) reaches[later][before] = true;
        }
    }
}

/// A system and what it reads and writes, as text of one line or more.
template <class World>
std::string describe(const PlannedSystem<World>& system, const std::vector<PlannedSystem<World>>& list) {
    static const char* const kKinds[] = {"rows", "bodies", "serial"};
    std::string reads, writes, after;
    const auto add = [](std::string& text, const std::string& name) { text += (text.empty() ? "" : ", ") + name; };
    // Two parameters may name the same table: it is said once.
    const auto is_said = [&](const Access& access, bool Access::*what) {
        for (const Access* before = system.accesses.data(); before != &access; ++before)
            if (before->*what && before->name == access.name) return true;
        return false;
    };
    for (const Access& access : system.accesses) {
        if (access.reads && !is_said(access, &Access::reads)) add(reads, access.name);
        if (access.writes && !is_said(access, &Access::writes))
            add(writes, access.name + (access.is_two_sided ? " (new side)" : ""));
    }
    for (uint32_t a : system.after) add(after, list[a].name);
    std::string text = system.name + "  [" + kKinds[static_cast<int>(system.kind)] + "]";
    if (system.every > 1) text += "  every " + std::to_string(system.every) + " repetitions";
    text += "\n        reads  " + (reads.empty() ? "-" : reads) + "\n        writes " + (writes.empty() ? "-" : writes);
    if (!after.empty()) text += "\n        after  " + after;
    return text + "\n";
}

template <class World>
class FramePlan {
 public:
    /// The systems that follow belong to this part of the story.
    FramePlan& stage(std::string name) {
        stage_ = std::move(name);
        return *this;
    }
    /// The systems that follow are of this owner: EachOwn and Own give them its events alone.
    FramePlan& owner(uint32_t number) {
        owner_ = number;
        return *this;
    }
    template <auto System>
    FramePlan& then() {
        static_assert(!Signature<decltype(System)>::kHasTwoSided,
                      "the sides of a two-sided column take turns in inner loops only");
        systems_.push_back(plan_system<World, System>(stage_));
        systems_.back().owner = owner_;
        return *this;
    }
    /// A loop that repeats inside of the system named last; shown with it. It must outlive the plan.
    template <class Loop>
    FramePlan& shows(std::string title, const Loop& loop) {
        loops_.push_back({systems_.size() - 1, std::move(title), [&loop] { return loop.describe(); }});
        return *this;
    }
    /// After the last then(): edges, passes, profiler zones.
    void finish(Profiler& profiler) {
        derive_edges(systems_);
        passes_.clear();
        for (uint32_t s = 0; s < systems_.size(); ++s) {
            systems_[s].zone = profiler.add_zone(systems_[s].name);
            bool fits = !passes_.empty() && passes_.back().count < kMostInPass;
            if (fits)
                for (uint32_t a : systems_[s].after) fits = fits && a < passes_.back().first;
            if (fits)
                ++passes_.back().count;
            else
                passes_.push_back({s, 1, ""});
            passes_.back().name += (fits ? ", " : "") + systems_[s].name;
        }
    }

    /// One frame. `after_each(system)` is called between passes when given (validation). The host's zones, when given,
    /// begin and end here, on the calling thread, around each pass that has something to do.
    void step(World& world, JobSystem& jobs, Profiler& profiler,
              const std::function<void(const PlannedSystem<World>&)>* after_each = nullptr,
              const Host* host = nullptr) {
        static const Host no_host;
        const FpMode mode;  // passes of one call run here, not in a job
        for (const Pass& pass : passes_) {
            run_pass(pass, world, jobs, profiler, host ? *host : no_host);
            if (after_each)
                for (uint32_t s = pass.first; s < pass.first + pass.count; ++s) (*after_each)(systems_[s]);
        }
    }

    const std::vector<PlannedSystem<World>>& systems() const { return systems_; }
    uint32_t pass_count() const { return static_cast<uint32_t>(passes_.size()); }
    std::string describe() const {
        std::string text, stage;
        for (size_t s = 0; s < systems_.size(); ++s) {
            if (systems_[s].stage != stage) text += (stage = systems_[s].stage) + "\n";
            text += "    pass " + std::to_string(pass_of(s)) + "  " + cullet::describe(systems_[s], systems_);
            for (const Shown& loop : loops_)
                if (loop.system == s) text += "      repeats: " + loop.title + "\n" + loop.text();
        }
        return text;
    }

 private:
    struct Pass {
        uint32_t first, count;
        std::string name;  // the host's zone: its systems
    };
    struct Shown {
        size_t system;
        std::string title;
        std::function<std::string()> text;
    };
    struct Chunks {
        uint32_t rows, count;
        uint64_t busy_ns = 0;  // of all chunks, where systems share the pass
    };
    static constexpr uint32_t kMostInPass = 16;

    /// From 1 on; 0 before finish().
    size_t pass_of(size_t system) const {
        size_t pass = 0;
        while (pass < passes_.size() && passes_[pass].first <= system) ++pass;
        return pass;
    }
    static uint32_t chunk_count(const PlannedSystem<World>& system, uint32_t rows) {
        return (rows + system.chunk_rows - 1) / system.chunk_rows;
    }
    void run_chunk(const PlannedSystem<World>& system, const Chunks& chunks, World& world, uint32_t chunk) {
        Call<World> call{world};
        call.first = chunk * system.chunk_rows;
        call.count = chunks.rows - call.first < system.chunk_rows ? chunks.rows - call.first : system.chunk_rows;
        call.owner = system.owner;
        if (system.kind == CallKind::Bodies) call.body = chunk;
        if (system.is_own && !system.is_own(world, chunk, system.owner)) return;
        system.invoke(call);
    }
    void run_pass(const Pass& pass, World& world, JobSystem& jobs, Profiler& profiler, const Host& host) {
        Chunks chunks[kMostInPass];
        uint32_t total = 0;
        for (uint32_t i = 0; i < pass.count; ++i) {
            const PlannedSystem<World>& system = systems_[pass.first + i];
            chunks[i] = {system.row_count(world), 0};
            chunks[i].count = chunk_count(system, chunks[i].rows);
            total += chunks[i].count;
        }
        if (total > 0 && host.zone_begin) host.zone_begin(host.user, pass.name.c_str());
        const uint64_t start = now_ns();
        if (total == 1) {
            for (uint32_t i = 0; i < pass.count; ++i)
                if (chunks[i].count) run_chunk(systems_[pass.first + i], chunks[i], world, 0);
        } else if (total > 1) {
            parallel_for(jobs, total, [&](uint32_t job) {
                uint32_t i = 0;
                while (job >= chunks[i].count) job -= chunks[i++].count;
                const uint64_t begun = now_ns();
                run_chunk(systems_[pass.first + i], chunks[i], world, job);
                const uint64_t ended = now_ns();
                if (pass.count > 1)
                    std::atomic_ref<uint64_t>(chunks[i].busy_ns).fetch_add(ended - begun, std::memory_order_relaxed);
                profiler.add_span(systems_[pass.first + i].zone, begun, ended);
            });
        }
        const uint64_t end = now_ns();
        if (total > 0 && host.zone_end) host.zone_end(host.user);
        for (uint32_t i = 0; i < pass.count; ++i) {
            const PlannedSystem<World>& system = systems_[pass.first + i];
            const bool is_shared = pass.count > 1 && total > 1;
            if (chunks[i].count == 0) continue;
            if (is_shared)
                profiler.add_time(system.zone, chunks[i].busy_ns, chunks[i].rows);
            else
                profiler.add(system.zone, start, end, chunks[i].rows);
        }
    }

    std::vector<PlannedSystem<World>> systems_;
    std::vector<Pass> passes_;
    std::vector<Shown> loops_;
    std::string stage_;
    uint32_t owner_ = 0;
};

}  // namespace cullet
