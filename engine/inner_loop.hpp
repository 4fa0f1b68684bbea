// A short list of systems repeated many times on the rows of one task, by one thread or by a team of all workers with
// one barrier a system. The barrier counts chunks that are done, not threads that arrived: a worker that is busy
// elsewhere holds up nobody, and a host that runs the team's jobs one after another lets the first do everything.
#pragma once
#include <immintrin.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "engine/frame_plan.hpp"

namespace cullet {

template <class World>
class InnerLoop {
 public:
    template <auto System>
    InnerLoop& then(uint32_t every = 1) {
        using Sig = Signature<decltype(System)>;
        static_assert(std::tuple_size_v<typename Sig::Eaches> == 0, "Each belongs to the frame");
        CULLET_ASSERT(every == 1 || (every > 1 && !Sig::kHasTwoSided),
                      "every %u: the sides of a two-sided column take turns each repetition", every);
        systems_.push_back(plan_system<World, System>("inner loop"));
        systems_.back().every = every;
        return *this;
    }
    void finish() { derive_edges(systems_); }
    const std::vector<PlannedSystem<World>>& systems() const { return systems_; }
    std::string describe() const {
        std::string text;
        for (const auto& system : systems_) text += "        " + cullet::describe(system, systems_);
        return text;
    }

    /// Up to `repetitions` repetitions for task `body`, the first of them numbered `first` (the old side of two-sided
    /// columns is its parity; `every` counts from it); ends early when `goes_on(world, body)` is false after one.
    struct Run {
        uint32_t body = 0, first = 0, repetitions = 0;
        bool (*goes_on)(World&, uint32_t body) = nullptr;
    };

    void run_alone(World& world, const Run& run) const {
        const FpMode mode;
        for (uint32_t r = run.first; r < run.first + run.repetitions; ++r) {
            for (const PlannedSystem<World>& system : systems_) {
                if ((r + 1) % system.every != 0) continue;
                const Rows<void> rows = rows_of(system, world, run.body);
                if (rows.count) run_chunks(system, world, run.body, rows, 0, chunks_of(system, rows), r);
            }
            if (run.goes_on && !run.goes_on(world, run.body)) return;
        }
    }

    /// What a team shares. Lives on the stack of the thread that starts the team.
    class Team {
     public:
        Team(const InnerLoop& loop, World& world, const Run& run, uint32_t workers)
            : loop_(loop), world_(world), run_(run), claims_(2 * workers) {
            const FpMode mode;
            repetition_ = run.first;
            if (run.repetitions == 0)
                is_over_.store(true, std::memory_order_relaxed);
            else
                open_next(0);
        }
        /// Called by each worker; returns when the run is over. Even workers take chunks from the front, odd ones from
        /// the back, so that each meets nearly the same rows in every repetition and finds them in its cache. A claim
        /// takes a share of what is left. What a worker has done is counted when it finds nothing more to claim. A
        /// pass lasts 20 microseconds, and each word that passes between two cores takes a tenth of one.
        void work(uint32_t worker = 0) {
            const bool is_front = worker % 2 == 0;
            uint32_t idle = 0, done = 0;
            for (;;) {
                uint64_t ticket = ticket_.load(std::memory_order_acquire);
                if (is_over_.load(std::memory_order_acquire)) return;
                const auto front = static_cast<uint32_t>(ticket & 0xffff),
                           back = static_cast<uint32_t>(ticket >> 16 & 0xffff);
                if (front == back) {
                    if (done > 0) {
                        const bool is_last = left_.fetch_sub(done, std::memory_order_acq_rel) == done;
                        done = 0;
                        if (is_last) open_next(system_ + 1);
                    } else if (++idle < 4096) {
                        _mm_pause();
                    } else {
                        idle = 0;
                        std::this_thread::yield();
                    }
                    continue;
                }
                const uint32_t count = std::max(1u, (back - front) / claims_);
                const uint64_t claimed = is_front ? ticket + count : ticket - count * 0x10000u;
                if (!ticket_.compare_exchange_weak(ticket, claimed, std::memory_order_acq_rel)) continue;
                // From here on until these chunks are counted the pass cannot end: its plain members stand still.
                idle = 0;
                const uint32_t first = is_front ? front : back - count;
                loop_.run_chunks(loop_.systems_[system_], world_, run_.body, rows_, first, count, repetition_);
                done += count;
            }
        }

     private:
        // Only the thread that finished the last chunk is here. Serial systems and passes of one chunk run at once.
        void open_next(uint32_t system) {
            for (;;) {
                if (system == loop_.systems_.size()) {
                    ++repetition_;
                    const bool is_last = repetition_ == run_.first + run_.repetitions;
                    if ((run_.goes_on && !run_.goes_on(world_, run_.body)) || is_last) {
                        is_over_.store(true, std::memory_order_release);
                        return;
                    }
                    system = 0;
                }
                const PlannedSystem<World>& planned = loop_.systems_[system];
                if ((repetition_ + 1) % planned.every != 0) {
                    ++system;
                    continue;
                }
                const Rows<void> rows = loop_.rows_of(planned, world_, run_.body);
                const uint32_t chunks = chunks_of(planned, rows);
                if (chunks <= 1) {
                    if (chunks) loop_.run_chunks(planned, world_, run_.body, rows, 0, chunks, repetition_);
                    ++system;
                    continue;
                }
                rows_ = rows;
                system_ = system;
                CULLET_ASSERT(chunks <= 0xffff, "%u chunks in one pass of %s", chunks, planned.name.c_str());
                left_.store(chunks, std::memory_order_relaxed);
                ticket_.store((((ticket_.load(std::memory_order_relaxed) >> 32) + 1) << 32) | (chunks << 16),
                              std::memory_order_release);
                return;
            }
        }

        const InnerLoop& loop_;
        World& world_;
        Run run_;
        Rows<void> rows_;
        uint32_t system_ = 0, repetition_ = 0;
        const uint32_t claims_;  // a claim takes one part in so many
        // Pass number << 32 | end << 16 | begin of the chunks nobody has claimed. One word: with the count in another,
        // a worker that holds the last pass's exhausted ticket beside the next pass's count claims a chunk that does
        // not exist.
        alignas(64) std::atomic<uint64_t> ticket_{0};
        alignas(64) std::atomic<uint32_t> left_{0};  // chunks not counted as done
        std::atomic<bool> is_over_{false};
    };

 private:
    Rows<void> rows_of(const PlannedSystem<World>& system, World& world, uint32_t body) const {
        return system.kind == CallKind::Rows ? system.rows_of_body(world, body) : Rows<void>{0, 1};
    }
    static uint32_t chunks_of(const PlannedSystem<World>& system, Rows<void> rows) {
        return (rows.count + system.chunk_rows - 1) / system.chunk_rows;
    }
    // In one call: systems take any number of rows, and each call looks its task and columns up anew.
    void run_chunks(const PlannedSystem<World>& system, World& world, uint32_t body, Rows<void> rows, uint32_t first,
                    uint32_t count, uint32_t repetition) const {
        Call<World> call{world};
        call.body = body;
        call.side = static_cast<int>(repetition & 1);
        call.first = rows.first + first * system.chunk_rows;
        call.count = std::min(count * system.chunk_rows, rows.first + rows.count - call.first);
        system.invoke(call);
    }
    std::vector<PlannedSystem<World>> systems_;
};

}  // namespace cullet
