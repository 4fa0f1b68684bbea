// Fragments born and retired without end, so many alive at most: does memory stay flat, do frames stay as fast, is
// every handle of what is gone refused?
#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "cullet/world.hpp"

namespace cullet {

struct SoakSettings {
    uint64_t fragments = 1'000'000;  // born until it ends
    uint32_t alive = 4096;           // at most
    uint32_t panes_a_frame = 16;     // of 35 or 36 fragments each
    unsigned threads = 1;
};

struct SoakReport {
    uint64_t born = 0, retired = 0, faded = 0, refused = 0, faults = 0, frames = 0;
    uint32_t most_alive = 0;
    bool is_stale_refused = true;    // every question to a handle of what is gone
    std::vector<double> memory_mib;  // resident, at the end of each tenth of the frames
    // Of the last nine tenths:
    double memory_rise_mib = 0;        // of the line of least squares through them, from its first frame to its last
    double early_ms = 0, late_ms = 0;  // a frame, what a tenth of the first half is below, and of the second
    std::string wrong;                 // a sentence: what the game asked for and was refused, or tables that are bad
};

/// Panes of glass appear in a field of places and are cut to 36 pieces each, which fly apart as the pane turns. What is
/// left of a pane goes after half a second, and of the pieces the oldest, so that at most `alive` are there. Steps of
/// the world alone are timed.
class Soak {
 public:
    static Result<Soak> create(const SoakSettings& settings);
    void step();
    bool is_done() const { return born_ >= settings_.fragments || !wrong_.empty(); }
    SoakReport report() const;
    World& world() { return world_; }

 private:
    Soak(const SoakSettings& settings, World world, ModelId model);
    void fill_profiler();
    void cut_pane();
    void retire_oldest();
    void expect(bool is_good, const char* what);
    void keep_stale(BodyId id);

    SoakSettings settings_;
    World world_;
    ModelId model_;
    uint32_t panes_ = 0, most_alive_ = 0;
    uint64_t born_ = 0, refused_ = 0, faults_ = 0;
    std::vector<double> frame_ms_, memory_mib_;
    std::deque<BodyId> rests_;
    std::vector<BodyId> stale_;
    size_t next_stale_ = 0, last_birth_ = 0;  // a frame
    bool is_stale_refused_ = true;
    std::string wrong_;
};

}  // namespace cullet
