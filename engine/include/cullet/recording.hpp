// Recordings: all that a game asked of a world, and a hash after every step. A replay gives the same bytes, or tells
// where it first gives others. World::start_recording writes a recording.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "cullet/host.hpp"
#include "cullet/result.hpp"

namespace cullet {

struct ReplaySettings {
    /// One run for each number of threads, compared with the recording and so with each other.
    std::vector<uint32_t> threads{1};
    /// Called after each replayed step with the share of the file that is done, over all runs.
    void (*progress)(void* user, float share) = nullptr;
    void* progress_user = nullptr;
};

struct ReplayReport {
    uint64_t frames = 0;        // steps that gave their recorded hash in every run
    uint64_t first_frame = 0;   // number of the first step that was recorded
    std::string recorded_with;  // version, compiler and processor features of the program that recorded
    /// Empty, or one sentence: the first byte of the file that is not good. What stands before it was replayed.
    std::string damage;
    /// Empty, or one sentence: the first frame whose hash is another one, and the table and column. It names the system
    /// and the row too when two numbers of threads differ from each other.
    std::string difference;
};

/// Steps a new world through the recording. Refuses what is no recording, or cannot be begun. Models stand in the
/// folder `path`.models, by the hash of their bytes. It is in cullet::cullet alone, since it makes both kinds of world.
/// A program of cullet::core records, and one of cullet::cullet replays, with the rows that the host gave.
Result<ReplayReport> replay(const std::string& path, const ReplaySettings& settings = {}, const Host& host = {});

}  // namespace cullet
