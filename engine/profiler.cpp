#include "engine/profiler.hpp"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace cullet {

uint64_t now_ns() {
    return static_cast<uint64_t>(
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
            .count());
}

Profiler::Profiler(uint32_t frame_limit, uint32_t span_limit)
    : frame_memory_(nullptr), span_memory_(nullptr), frame_limit_(std::max(frame_limit, 1u)), span_limit_(span_limit) {
    zones_.reserve(kMostZones);
    rows_.reserve(kMostZones);
    frame_memory_ = reserve_memory(size_t{frame_limit_} * sizeof(Frame));
    try {
        span_memory_ = reserve_memory(size_t{span_limit_} * sizeof(Span));
    } catch (...) {
        release_memory(frame_memory_, size_t{frame_limit_} * sizeof(Frame));
        throw;
    }
}

Profiler::~Profiler() {
    release_memory(frame_memory_, size_t{frame_limit_} * sizeof(Frame));
    release_memory(span_memory_, size_t{span_limit_} * sizeof(Span));
}

uint32_t Profiler::add_zone(const std::string& name) {
    if (zones_.size() == kMostZones) return kMostZones - 1;
    zones_.push_back(name);
    rows_.push_back(0);
    return static_cast<uint32_t>(zones_.size()) - 1;
}

void Profiler::begin_frame(uint64_t frame) {
    if (frame_count_ == frame_limit_) frame_count_ = frame_limit_ - 1;  // the last one is overwritten from here on
    Frame& f = frames()[frame_count_];
    is_in_frame_ = true;
    (void)track_of_this_thread();
    f.number = frame;
    f.start_ns = now_ns();
    std::fill(f.zone_ms, f.zone_ms + kMostZones, 0.0f);
}

void Profiler::end_frame() {
    if (!is_in_frame_) return;
    is_in_frame_ = false;
    Frame& f = frames()[frame_count_];
    f.end_ns = now_ns();
    f.ms = static_cast<float>(f.end_ns - f.start_ns) * 1e-6f;
    ++frame_count_;
}

void Profiler::add(uint32_t zone, uint64_t start_ns, uint64_t end_ns, uint64_t rows) {
    add_time(zone, end_ns - start_ns, rows);
    add_span(zone, start_ns, end_ns);
}

void Profiler::add_time(uint32_t zone, uint64_t busy_ns, uint64_t rows) {
    if (is_in_frame_) frames()[frame_count_].zone_ms[zone] += static_cast<float>(busy_ns) * 1e-6f;
    rows_[zone] += rows;
}

// A thread finds its own mark, or leaves it in the first free place.
uint32_t Profiler::track_of_this_thread() {
    const auto self = static_cast<uint64_t>(pthread_self());
    for (uint32_t t = 0; t + 1 < kMostTracks; ++t) {
        std::atomic_ref<uint64_t> track(tracks_[t]);
        uint64_t found = track.load(std::memory_order_relaxed);
        if (found == self) return t;
        if (found == 0 && track.compare_exchange_strong(found, self, std::memory_order_relaxed)) return t;
    }
    return kMostTracks - 1;
}

uint32_t Profiler::track_count() const {
    return static_cast<uint32_t>(std::find(tracks_, tracks_ + kMostTracks, uint64_t{0}) - tracks_);
}

void Profiler::add_span(uint32_t zone, uint64_t start_ns, uint64_t end_ns) {
    const uint32_t track = track_of_this_thread();
    const uint64_t at = std::atomic_ref<uint64_t>(span_count_).fetch_add(1, std::memory_order_relaxed);
    if (at < span_limit_)
        spans()[at] = {start_ns, end_ns, static_cast<uint16_t>(zone), static_cast<uint16_t>(track), 0};
}

uint32_t Profiler::add_counter(const std::string& name) {
    counters_.push_back(name);
    return static_cast<uint32_t>(counters_.size()) - 1;
}

void Profiler::count(uint32_t counter, uint64_t value) {
    const uint64_t at = std::atomic_ref<uint64_t>(span_count_).fetch_add(1, std::memory_order_relaxed);
    if (at < span_limit_) spans()[at] = {now_ns(), value, static_cast<uint16_t>(counter), 0, 1};
}

namespace {

// "12.345": never through printf's %f, which writes a comma where the host's locale does.
std::string microseconds(uint64_t ns) {
    char text[32];
    std::snprintf(text, sizeof text, "%llu.%03u", static_cast<unsigned long long>(ns / 1000),
                  static_cast<unsigned>(ns % 1000));
    return text;
}

std::string in_json(const std::string& name) {
    std::string text;
    for (const char c : name) {
        if (c == '"' || c == '\\') text += '\\';
        text += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
    return text;
}

}  // namespace

Result<void> Profiler::write_trace(const std::string& path) const {
    FILE* file = std::fopen(path.c_str(), "w");
    if (!file) return Error{path + ": could not be opened for writing; check that the folder exists."};
    const uint64_t origin = frame_count_ ? frames()[0].start_ns : 0;
    std::fputs("{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n", file);
    std::fputs("{\"name\":\"process_name\",\"ph\":\"M\",\"pid\":1,\"args\":{\"name\":\"cullet\"}}", file);
    for (uint32_t t = 0; t < track_count(); ++t)
        std::fprintf(
            file, ",\n{\"name\":\"thread_name\",\"ph\":\"M\",\"pid\":1,\"tid\":%u,\"args\":{\"name\":\"worker %u%s\"}}",
            t, t, t == 0 ? ", the one that steps" : "");
    for (uint32_t f = 0; f < frame_count_; ++f)
        std::fprintf(file, ",\n{\"name\":\"frame %llu\",\"ph\":\"X\",\"pid\":1,\"tid\":0,\"ts\":%s,\"dur\":%s}",
                     static_cast<unsigned long long>(frames()[f].number),
                     microseconds(frames()[f].start_ns - origin).c_str(),
                     microseconds(frames()[f].end_ns - frames()[f].start_ns).c_str());
    for (uint32_t s = 0; s < span_count_ && s < span_limit_; ++s) {
        const Span& span = spans()[s];
        if (span.start_ns < origin) continue;
        if (span.is_counter)
            std::fprintf(file, ",\n{\"name\":\"%s\",\"ph\":\"C\",\"pid\":1,\"ts\":%s,\"args\":{\"value\":%llu}}",
                         in_json(counters_[span.zone]).c_str(), microseconds(span.start_ns - origin).c_str(),
                         static_cast<unsigned long long>(span.end_ns));
        else
            std::fprintf(file, ",\n{\"name\":\"%s\",\"ph\":\"X\",\"pid\":1,\"tid\":%u,\"ts\":%s,\"dur\":%s}",
                         in_json(zones_[span.zone]).c_str(), unsigned{span.track},
                         microseconds(span.start_ns - origin).c_str(),
                         microseconds(span.end_ns - span.start_ns).c_str());
    }
    std::fputs("\n]}\n", file);
    if (std::fclose(file) != 0) return Error{path + ": could not be written to its end; the disk may be full."};
    return {};
}

float percentile(std::vector<float> values, double share) {
    if (values.empty()) return 0;
    const double rank = std::ceil(share * static_cast<double>(values.size()));
    const auto at = static_cast<size_t>(std::clamp(rank, 1.0, static_cast<double>(values.size()))) - 1;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
    return values[at];
}

}  // namespace cullet
