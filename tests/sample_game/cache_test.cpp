// The cache of cooked models: equal content is cooked once, and nothing in the folder is believed.
#include "sample_game/cache.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "engine/mesh_file.hpp"
#include "sample_game/cook_cached.hpp"
#include "tests/support/simple_meshes.hpp"

namespace cullet {
namespace {

namespace fs = std::filesystem;

class Cache : public testing::Test {
 protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("cache_test." + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        mesh_ = test::sphere_mesh(0.1, 2);
        mesh_.name = "ball";
        settings_.thick_shell.measures_threshold = false;
    }
    void TearDown() override { fs::remove_all(folder_); }

    CachedModel cooked() { return cook_cached(mesh_, settings_, folder_).value(); }
    std::vector<fs::path> entries() const {
        std::vector<fs::path> paths;
        for (const auto& entry : fs::directory_iterator(folder_)) paths.push_back(entry.path());
        std::sort(paths.begin(), paths.end());
        return paths;
    }
    void put(const std::string& name, size_t bytes, std::chrono::hours age) {
        std::ofstream(folder_ / name) << std::string(bytes, 'x');
        fs::last_write_time(folder_ / name, fs::file_time_type::clock::now() - age);
    }

    fs::path folder_;
    Mesh mesh_;
    CookSettings settings_;
};

std::vector<uint8_t> bytes_of(const Model& model) {
    const std::string path = fs::temp_directory_path() / ("cache_test." + std::to_string(getpid()) + ".cmodel");
    EXPECT_TRUE(write_model(model, path).ok());
    const std::vector<uint8_t> bytes = read_whole_file(path, 1u << 30).value();
    fs::remove(path);
    return bytes;
}

TEST_F(Cache, TheSecondCookingComesFromTheCacheAndIsTheSame) {
    const CachedModel first = cooked(), second = cooked();
    EXPECT_FALSE(first.is_from_cache);
    EXPECT_TRUE(second.is_from_cache);
    EXPECT_EQ(first.trouble, "");
    EXPECT_EQ(bytes_of(first.model), bytes_of(second.model));
    EXPECT_EQ(entries().size(), 1u);
}

TEST_F(Cache, OtherMeshesAndOtherSettingsAreCookedAnew) {
    cooked();
    const auto expect_new = [this](const char* what) {
        EXPECT_FALSE(cooked().is_from_cache) << what;
        EXPECT_TRUE(cooked().is_from_cache) << what;
    };
    settings_.material = "glass";
    expect_new("material");
    settings_.thickness = 0.004f;
    expect_new("thickness");
    settings_.longest_edge = 0.05f;
    expect_new("edge");
    settings_.weld_tolerance = 1e-6f;
    expect_new("weld");
    settings_.seed = 2;
    expect_new("seed");
    settings_.thick_shell.measures_threshold = true;
    expect_new("threshold");
    mesh_.positions[5].x *= 1.0001f;
    expect_new("mesh");
    EXPECT_EQ(entries().size(), 8u);
}

TEST_F(Cache, DamagedAndHalfWrittenEntriesAreMadeAnew) {
    const std::vector<uint8_t> good = bytes_of(cooked().model);
    const fs::path entry = entries()[0];
    const auto expect_healed = [&](const char* what) {
        EXPECT_FALSE(cooked().is_from_cache) << what;
        EXPECT_EQ(read_whole_file(entry, 1u << 30).value(), good) << what;
        EXPECT_TRUE(cooked().is_from_cache) << what;
    };
    fs::resize_file(entry, good.size() / 2);
    expect_healed("half of it");
    fs::resize_file(entry, 0);
    expect_healed("nothing of it");
    std::fstream(entry, std::ios::in | std::ios::out | std::ios::binary).seekp(5000).put('!');
    expect_healed("one byte of it");
    std::ofstream(entry) << "something else";
    expect_healed("something else");
}

TEST_F(Cache, WhatCannotBeCookedLeavesNothing) {
    settings_.material = "cheese";
    EXPECT_FALSE(cook_cached(mesh_, settings_, folder_).ok());
    EXPECT_TRUE(entries().empty());
}

TEST_F(Cache, AFolderThatIsNotThereCostsASentenceAndNoModel) {
    const Result<CachedModel> model = cook_cached(mesh_, settings_, folder_ / "none");
    ASSERT_TRUE(model.ok()) << model.error();
    EXPECT_NE(model->trouble.find("cannot create the file"), std::string::npos) << model->trouble;
    EXPECT_FALSE(cook_cached(mesh_, settings_, "")->is_from_cache);
}

TEST_F(Cache, ThreadsThatCookTheSameAtOnceLeaveOneSoundEntry) {
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([this] { EXPECT_TRUE(cook_cached(mesh_, settings_, folder_).ok()); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(entries().size(), 1u);
    EXPECT_TRUE(cooked().is_from_cache);
}

TEST_F(Cache, TheLongestUnusedGoFirstUntilTheRestFits) {
    using std::chrono::hours;
    put("a.cmesh", 1000, hours(3));
    put("b.cmodel", 1000, hours(2));
    put("c.cmodel", 1000, hours(1));
    put("notes.txt", 5000, hours(9));
    trim_cache(folder_, 3000);
    EXPECT_EQ(entries().size(), 4u);
    touch_entry(folder_ / "a.cmesh");
    trim_cache(folder_, 2500);
    EXPECT_FALSE(fs::exists(folder_ / "b.cmodel"));
    trim_cache(folder_, 0);
    ASSERT_EQ(entries().size(), 1u);
    EXPECT_EQ(entries()[0].filename(), "notes.txt");
}

TEST_F(Cache, WhatAnEndedRunLeftHalfWrittenGoesAfterAnHour) {
    put("x.cmodel.17.part", 10, std::chrono::hours(2));
    put("y.cmodel.18.part", 10, std::chrono::hours(0));
    trim_cache(folder_);
    ASSERT_EQ(entries().size(), 1u);
    EXPECT_EQ(entries()[0].filename(), "y.cmodel.18.part");
}

}  // namespace
}  // namespace cullet
