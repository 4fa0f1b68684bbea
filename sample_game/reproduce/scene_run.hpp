// A script played for a claim: pictures of the frames that it names, and what each frame cost.
#pragma once
#include <string>
#include <vector>

#include "sample_game/reproduce/bench.hpp"

namespace cullet::reproduce {

struct ScenePlay {
    std::string name, lua;
    std::vector<std::string> set;  // KEY=VALUE
    uint32_t frames = 120;         // of 1/60 s
    std::vector<uint32_t> drawn;   // frames, ascending
};

struct SceneRun {
    std::vector<Picture> pictures;  // one a drawn frame
    std::vector<float> frame_ms, rigid_ms;
    std::vector<float> breaking_ms;           // of the frames that worked on a hit, or in which something came off
    uint32_t vertices = 0, triangles = 0;     // of the first cooked model
    uint64_t pieces = 0, debris = 0;          // bodies with a shell at the end; lumps too small to be bodies
    double largest = 1;                       // piece at the end, as a share of all shells' mass
    double debris_share = 0;                  // of that mass
    double mass_put_in = 0, mass_at_end = 0;  // kg, all that moves
    uint64_t late = 0, dropped = 0;           // hits
    uint64_t tears = 0;                       // vertices of soft bodies that were split
    std::vector<std::string> notes;
};

Result<SceneRun> run_scene(Bench& bench, const ScenePlay& play);

/// Mean piece that came off, as a share of the mass: of all but the largest, without debris. 0: none did.
double mean_piece(const SceneRun& run);

/// Frames a second while something breaks, from the mean time of those frames; 0 when nothing broke.
double frame_rate(const SceneRun& run);
/// By nearest rank, ms; 0 without values.
double percentile_of(std::vector<float> values, double share);

/// The text with each "@name@" replaced.
std::string filled(std::string text, const std::string& name, const std::string& value);

}  // namespace cullet::reproduce
