// What a run was like: one struct, and report.json from it.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cullet/result.hpp"

namespace cullet {

/// Of one series of milliseconds: percentiles by nearest rank over frames.
struct Spread {
    float p50 = 0, p95 = 0, p99 = 0, max = 0;
    double total = 0;
    uint64_t rows = 0;  // of a system, over the run; a whole frame has none
};
Spread spread_of(const std::vector<float>& milliseconds, uint64_t rows = 0);

using Vector = std::array<double, 3>;

/// What happened in one frame.
struct FrameFacts {
    uint64_t opened = 0, broke = 0, late = 0, frames_held = 0;  // hits
    uint64_t born = 0, debris = 0, refused = 0, units = 0;

    friend FrameFacts operator-(const FrameFacts& a, const FrameFacts& b) {
        return {a.opened - b.opened, a.broke - b.broke,   a.late - b.late,       a.frames_held - b.frames_held,
                a.born - b.born,     a.debris - b.debris, a.refused - b.refused, a.units - b.units};
    }
};

/// How still a world lies at the end of a run (sample_game/rest.hpp).
struct Rest {
    double asleep_share = 1;   // of the moving bodies
    double kinetic_share = 0;  // of the most that the run had
    // Of bodies asleep; percentiles by nearest rank.
    double sink_p95_mm = 0, sink_max_mm = 0, overlap_p95_mm = 0, overlap_max_mm = 0, hover_p95_mm = 0, hover_max_mm = 0;
    double hover_boxes_max_mm = 0, hover_hulls_max_mm = 0;  // the others' stand above
    uint64_t measured = 0;                                  // bodies asleep
    uint64_t through = 0;                                   // bodies that fell through what never moves, awake ones too
};

/// Fragments that one kind of shape stands for: how much larger than the solid its tightest box and its convex hull
/// are.
struct FragmentShapes {
    struct Ratio {
        double min = 0, median = 0, max = 0;
    };
    uint64_t count = 0;
    uint64_t measured = 0;  // not those of too many elements
    Ratio box_ratio, hull_ratio;
};

struct Report {
    std::string scene;
    uint64_t seed = 0;
    double dt_s = 0;
    uint64_t frames = 0;
    uint32_t threads = 0;
    std::string machine;           // processor, threads, compiler, build
    std::string hash, hash_chain;  // hexadecimal; empty when not taken
    std::map<std::string, uint64_t> tables;
    struct {
        double start = 0, end = 0, debris = 0;  // start: all that was ever put in; end counts debris
    } mass_kg;
    struct {
        Vector start{}, end{},
            impulse{};  // of moving bodies and debris; impulse: passed by breaking to what cannot move
    } momentum_ns;
    struct {
        double start = 0, peak = 0, end = 0;  // kinetic, of moving bodies and debris
    } energy_j;
    struct {
        uint64_t born = 0, live = 0, asleep = 0, debris = 0;
        uint64_t retired = 0, faded = 0;  // by the game; debris that was there long enough
    } fragments;
    struct {
        uint64_t bodies = 0, cells = 0;
    } awake;  // at the end
    Rest rest;
    struct {
        uint64_t used = 0, left = 0, most = 0;  // over the run; of the last frame; of the worst frame
        uint64_t slow_soft_frames = 0;          // soft bodies that had too few and ran slower, a frame each
        double softening = 1;                   // of the softest of them: its springs have E over this to fit a frame
    } units;
    std::map<std::string, uint64_t> events, refused;
    uint64_t faults = 0;
    std::vector<std::string> fault_list;
    Spread frame_ms;
    std::map<std::string, Spread> systems;
    struct {
        uint64_t frame = 0;
        float ms = 0;
        FrameFacts facts;
        std::string system;  // that took most of it
        float system_ms = 0;
    } worst_frame;
    /// Worst frame that broke something / (median frame without damage + the budget's time); where nothing broke, the
    /// worst from the first on that worked on a hit. 0: there was none.
    double hitch = 0;
    struct {
        uint64_t count = 0;
        float p50_ms = 0, p99_ms = 0, max_ms = 0;
    } fracture_frames;  // in which something broke
    struct {
        uint64_t count = 0;
        float p50_ms = 0, p99_ms = 0, max_ms = 0;
        double p99_budgets = 0;  // of the frame without the rigid step, in times of the budget
    } damage_frames;             // in which hits were worked on
    std::map<std::string, double> yardsticks;
    struct {
        uint64_t opened = 0, broke = 0, dropped = 0, redone = 0, late = 0, frames_held = 0, ahead_hits = 0,
                 ahead_misses = 0;
        uint64_t first_breaks = 0, first_ready = 0;  // of whole bodies by touch; in the very frame of the touch
    } tasks;
    uint64_t sweeps = 0, clamped = 0;
    double crushed_j = 0;  // at cracks whose faces were on their way into each other when their pieces were born
    std::map<std::string, uint64_t> shapes;                        // of all bodies at the end
    std::map<std::string, FragmentShapes> fragment_shapes;         // of what broke: box, hull, cells
    uint64_t allocations_in_frames = 0, allocations_in_rigid = 0;  // within step(), from frame 30 on
    uint64_t peak_rss_bytes = 0;
    // Of this program, beside the names above.
    uint64_t repeats = 1;
    bool repeats_agree = true;
    std::vector<std::string> notes;
    // Of each frame, for report.html alone.
    std::vector<float> each_frame_ms;
    std::vector<bool> each_frame_broke;
};

std::string to_json(const Report& report);
Result<void> write_text(const std::string& text, const std::string& path);

/// The systems as a table: the five that took most of the run, then all others above a hundredth of it, then the rest
/// in one line.
std::string systems_table(const Report& report);
/// "worst frame 41: 12.30 ms: 1 hit opened, 14 pieces born, 9.10 ms in make_births".
std::string worst_frame_line(const Report& report);

/// Processor's name, hardware threads, compiler and build.
std::string describe_machine();
uint64_t peak_resident_bytes();

}  // namespace cullet
