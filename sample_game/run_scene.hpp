// Plays a scene as often as asked and says how it went.
#pragma once
#include "cullet/settings.hpp"
#include "sample_game/options.hpp"
#include "sample_game/report.hpp"
#include "sample_game/scene.hpp"

namespace cullet {

/// Hashes of one run, and what each frame cost.
struct RunRecord {
    std::vector<uint64_t> hashes;  // after each step; empty unless taken every frame
    uint64_t last_hash = 0;
    std::vector<float> frame_ms;
    std::vector<std::vector<float>> zone_ms;  // by zone, then frame
    std::vector<uint64_t> zone_rows;
    std::vector<std::string> zone_names;
    std::vector<uint8_t> broke, has_damage;  // of each frame: something came off or cracked; damage work was done
    std::vector<FrameFacts> facts;
    Settings settings;
    uint64_t allocations = 0, rigid_allocations = 0;  // within step(), from frame 30 on
    std::string first_fault;                          // of --validate
};

/// Frames from which on a step is to allocate nothing: pools and arenas have met every size by then.
inline constexpr uint64_t kFirstCountedFrame = 30;

/// What it takes to play the scene with these options, again and again.
ScenePlan plan_scene(const Scene& scene, const RunOptions& options);
/// Keys of the scene with --set and --threads applied.
Result<Keys> keys_of(const Scene& scene, const RunOptions& options);
/// Plays the plan, writes what the options ask for and fills the report.
Result<Report> play(const ScenePlan& plan, const RunOptions& options);

/// Steps of a run: --frames, or as many as the story's seconds hold.
uint32_t frame_count(const Story& story, const RunOptions& options);

/// `sample_game run`: all of the above, with a summary on standard output. The exit code: 0 went well, 1 it did not.
int run_command(const RunOptions& options);
/// `--set help`: the keys of one scene, or of all when the name is empty or "show_reel".
Result<std::string> keys_help(const std::string& scene_name);

}  // namespace cullet
