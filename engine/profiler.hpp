// Where a frame's time goes: a zone a system, one sample a frame, and spans for a Chrome trace. Its memory is taken
// when it is made; when it is full the later spans are left out and counted, and the last frame is written over.
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
    static constexpr uint32_t kMostTracks = 256;  // from there on threads share the last one

    explicit Profiler(uint32_t frame_limit = 1u << 15, uint32_t span_limit = 1u << 19);
    ~Profiler();
    Profiler(const Profiler&) = delete;
    Profiler& operator=(const Profiler&) = delete;

    /// Its number. From the last place on all names share one zone.
    uint32_t add_zone(const std::string& name);
    uint32_t zone_count() const { return static_cast<uint32_t>(zones_.size()); }
    const std::string& zone_name(uint32_t zone) const { return zones_[zone]; }

    void begin_frame(uint64_t frame);
    void end_frame();
    /// Time of `zone` in this frame; several are added up. Between begin_frame and end_frame, on their thread.
    void add(uint32_t zone, uint64_t start_ns, uint64_t end_ns, uint64_t rows);
    /// The same without a span in the trace: for systems that ran at once, whose chunks have spans of their own.
    void add_time(uint32_t zone, uint64_t busy_ns, uint64_t rows);
    /// A span on the calling thread's track of the trace; any thread. Some 50 ns.
    void add_span(uint32_t zone, uint64_t start_ns, uint64_t end_ns);
    /// Its number.
    uint32_t add_counter(const std::string& name);
    /// A counter's value from now on, in the trace.
    void count(uint32_t counter, uint64_t value);

    uint32_t frame_count() const { return frame_count_; }
    /// Milliseconds of the whole step, and of a zone, in the n-th frame recorded.
    float frame_ms(uint32_t n) const { return frames()[n].ms; }
    float zone_ms(uint32_t n, uint32_t zone) const { return frames()[n].zone_ms[zone]; }
    uint64_t zone_rows(uint32_t zone) const { return rows_[zone]; }
    /// Threads that have a track: that of begin_frame is the first, the others follow as they come.
    uint32_t track_count() const;
    /// Spans and counters that found no room.
    uint64_t left_out() const { return span_count_ > span_limit_ ? span_count_ - span_limit_ : 0; }

    Result<void> write_trace(const std::string& path) const;

 private:
    struct Frame {
        uint64_t number, start_ns, end_ns;
        float ms;
        float zone_ms[kMostZones];
    };
    struct Span {
        uint64_t start_ns, end_ns;  // a counter: start_ns, value
        uint16_t zone, track;       // a counter: its number, 0
        uint32_t is_counter;
    };
    Frame* frames() const { return reinterpret_cast<Frame*>(frame_memory_); }
    Span* spans() const { return reinterpret_cast<Span*>(span_memory_); }

    uint32_t track_of_this_thread();

    std::byte *frame_memory_, *span_memory_;
    uint32_t frame_limit_, span_limit_, frame_count_ = 0;
    uint64_t span_count_ = 0;            // asked for; those past the limit are not there
    uint64_t tracks_[kMostTracks] = {};  // threads; 0: free
    bool is_in_frame_ = false;
    std::vector<std::string> zones_, counters_;
    std::vector<uint64_t> rows_;
};

/// The smallest of `values` that at least `share` of them do not exceed (nearest rank); 0 without values. 0.5: median,
/// 1: largest.
float percentile(std::vector<float> values, double share);

}  // namespace cullet
