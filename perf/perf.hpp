// What the measurements share. Each scene is one function in a file of its own.
#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "perf/figures.hpp"

namespace cullet::perf {

struct Options {
    std::string scene = "all";
    std::vector<unsigned> threads{1, 2};
    std::string simd = "best";  // best, scalar, sse4, avx2, avx512
    std::string json;           // a file; empty: none
    uint32_t rounds = 0;        // runs of which the least is taken; 0: the scene's own number
    uint32_t passes = 3;        // over all scenes; a scene's own rounds are shared out among them

    uint32_t rounds_of_a_pass(uint32_t own) const { return rounds ? rounds : (own + passes - 1) / passes; }
};

/// Seconds that the call took.
template <class Call>
double seconds(Call call) {
    const auto start = std::chrono::steady_clock::now();
    call();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The hidden brittle step and stress check, beside the bare kernel and plain element loops. False: some results
/// differ.
bool measure_hidden_step(const Options& options, Figures& figures);
/// A whole hit on the vase, beside the bare steps that it made.
bool measure_hit(const Options& options, Figures& figures);
bool measure_large_hit(const Options& options, Figures& figures);
/// What surrounds the inner loop of a hit, and finding its pieces. False: the flood finds others than relabelling.
bool measure_parts(const Options& options, Figures& figures);
/// A hit on bodies of 10 and 100 thousand elements, system by system.
bool measure_local_hit(const Options& options, Figures& figures);
/// Every way of propagation, in Embree builds of the same mesh; processor time of one thread.
bool measure_generation(const Options& options, Figures& figures);
/// A settled pile of hulls in plain Bullet and in our world.
bool measure_pile(const Options& options, Figures& figures);
/// A thousand new pieces enter our rigid world, and plain Bullet in a bare loop.
bool measure_handoff(const Options& options, Figures& figures);
/// Link iterations and the whole world step of Bullet's soft body; the plain spring loop and the bare spring kernel on
/// the same links. False: their results differ.
bool measure_soft_body(const Options& options, Figures& figures);
/// The spring substep as the frame runs it on three grids, beside the bare kernel, the plain loop and Bullet; two
/// layers beside one. False: ours and the bare kernel differ.
bool measure_springs(const Options& options, Figures& figures);
/// The quick mode at a castle, in substeps of the bare spring kernel on it.
bool measure_quick(const Options& options, Figures& figures);
/// Sheet metal: sub-shells in Embree builds, impacts in passes of the plain spring loop, quiet frames beside a rigid
/// body's. False: the sum of distances rose.
bool measure_metal(const Options& options, Figures& figures);
/// Frame times, hitch and share of each system of the sample game's scenes: the least of three runs, frame by frame,
/// and one run of the pile.
bool measure_vase_frames(const Options& options, Figures& figures);
bool measure_wall_frames(const Options& options, Figures& figures);
bool measure_pane_frames(const Options& options, Figures& figures);
/// The same of the scenes with solids.
bool measure_solid_frames(const Options& options, Figures& figures);
bool measure_demolition_frames(const Options& options, Figures& figures);
bool measure_pile_frames(const Options& options, Figures& figures);
/// A million fragments (or as many as `rounds` says) born and retired, at most 4,096 alive. False: a handle of what is
/// gone was answered, or a call refused.
bool measure_soak(const Options& options, Figures& figures);

}  // namespace cullet::perf
