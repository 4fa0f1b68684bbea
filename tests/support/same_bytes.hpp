// Worlds that are played more than once and must give the same bytes: on other numbers of threads, from a snapshot,
// from a recording.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cullet/recording.hpp"
#include "cullet/world.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {

/// After each frame.
inline std::vector<uint64_t> hashes_of(World& world, int frames) {
    std::vector<uint64_t> list;
    for (int frame = 0; frame < frames; ++frame) {
        world.step();
        list.push_back(world.hash());
    }
    return list;
}

/// make(number of threads): the world, always the same.
template <class Make>
void expect_same_on_threads(Make make, int frames) {
    World one = make(1u);
    const std::vector<uint64_t> wanted = hashes_of(one, frames);
    for (const uint32_t threads : {2u, 3u, 8u}) {
        World other = make(threads);
        EXPECT_EQ(hashes_of(other, frames), wanted) << threads;
    }
}

/// Saves the world in each frame that is_due(frame) says, loads it into another one that make_other() gives, and plays
/// both on for three frames. How often.
template <class MakeOther, class IsDue>
uint32_t expect_loads(World& world, MakeOther make_other, int frames, IsDue is_due) {
    uint32_t loads = 0;
    for (int frame = 0; frame < frames; ++frame) {
        if (is_due(frame)) {
            const Result<std::vector<uint8_t>> bytes = world.snapshot();
            EXPECT_TRUE(bytes.ok()) << bytes.error();
            if (!bytes.ok()) return loads;
            World loaded = make_other();
            const Result<void> restored = loaded.restore(bytes->data(), bytes->size());
            EXPECT_TRUE(restored.ok()) << restored.error();
            if (!restored.ok()) return loads;
            EXPECT_EQ(loaded.hash(), world.hash()) << frame;
            ++loads;
            for (int later = 0; later < 3; ++later, ++frame) {
                world.step(), loaded.step();
                EXPECT_EQ(loaded.hash(), world.hash()) << frame;
                if (loaded.hash() != world.hash()) return loads;
            }
        }
        world.step();
    }
    return loads;
}

/// A folder of this program's own, which goes with it.
class OwnFolder {
 public:
    explicit OwnFolder(const std::string& name)
        : path_(std::filesystem::temp_directory_path() / (name + "." + std::to_string(getpid()))) {
        std::filesystem::create_directories(path_);
    }
    OwnFolder(const OwnFolder&) = delete;
    OwnFolder& operator=(const OwnFolder&) = delete;
    ~OwnFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
    std::filesystem::path path_;
};

/// Records what play(world) does from the first call on, so many frames, and replays it on 1, 2, 3 and 8 threads.
template <class Play>
void expect_replays(const Settings& settings, int frames, Play play) {
    const OwnFolder folder("cullet_replays");
    const std::string path = folder.file("play.crec");
    {
        World world = make_world(settings);
        ASSERT_TRUE(world.start_recording(path).ok());
        play(world);
        ASSERT_TRUE(world.stop_recording().ok());
    }
    ReplaySettings on;
    on.threads = {1, 2, 3, 8};
    const Result<ReplayReport> report = replay(path, on);
    ASSERT_TRUE(report.ok()) << report.error();
    EXPECT_EQ(report->frames, static_cast<uint64_t>(frames));
    EXPECT_EQ(report->difference, "");
    EXPECT_EQ(report->damage, "");
}

}  // namespace cullet::test
