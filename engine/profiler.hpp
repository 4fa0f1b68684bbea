// Where a frame's time goes: a zone a system, one sample a frame, and spans for a Chrome trace. Its memory is taken
// when it is made; when it is full the later samples are left out and counted.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cullet/result.hpp"
#include "engine/memory.hpp"

namespace cullet {

/// Nanoseconds of a monotonic clock. Never enters state.
uint64_t now_ns();

class Profiler {
 public:
    static constexpr uint32_t kMostZones = 96;

    explicit Profiler(uint32_t frame_limit = 1u << 15, uint32_t span_limit = 1u << 19);
    ~Profiler();
    Profiler(const Profiler&) = delete;
    Profiler& operator=(const Profiler&) = delete;

    /// `name` must outlive the profiler.
    uint32_t add_zone(const char* name);
    uint32_t zone_count() const { return static_cast<uint32_t>(zones_.size()); }
    const char* zone_name(uint32_t zone) const { return zones_[zone]; }

    void begin_frame(uint64_t frame);
    void end_frame();
    /// Time of `zone` in this frame; several are added up. Calling thread of step() only.
    void add(uint32_t zone, uint64_t start_ns, uint64_t end_ns, uint64_t rows);
    /// A span on a worker's track of the trace; any thread. `worker` 0 is the caller's.
    void add_span(uint32_t zone, uint32_t worker, uint64_t start_ns, uint64_t end_ns);
    /// A counter's value in the trace, at this frame.
    void add_counter(uint32_t zone, uint64_t value);

    uint32_t frame_count() const { return frame_count_; }
    /// Milliseconds of the whole step, and of a zone, in the n-th frame recorded.
    float frame_ms(uint32_t n) const { return frames()[n].ms; }
    float zone_ms(uint32_t n, uint32_t zone) const { return frames()[n].zone_ms[zone]; }
    uint64_t zone_rows(uint32_t zone) const { return rows_[zone]; }

    Result<void> write_trace(const std::string& path) const;

 private:
    struct Frame {
        uint64_t number, start_ns;
        float ms;
        float zone_ms[kMostZones];
    };
    struct Span {
        uint64_t start_ns, end_ns;  // a counter: start_ns, value
        uint16_t zone, worker;
        uint32_t is_counter;
    };
    Frame* frames() const { return reinterpret_cast<Frame*>(frame_memory_); }
    Span* spans() const { return reinterpret_cast<Span*>(span_memory_); }

    std::byte *frame_memory_, *span_memory_;
    uint32_t frame_limit_, span_limit_, frame_count_ = 0, span_count_ = 0;
    std::vector<const char*> zones_;
    std::vector<uint64_t> rows_;
};

}  // namespace cullet
