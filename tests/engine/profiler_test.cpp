#include "engine/profiler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

namespace cullet {
namespace {

std::string trace_path() {
    return (std::filesystem::path(testing::TempDir()) / "cullet_profiler_test.json").string();
}
nlohmann::json trace_of(const Profiler& profiler) {
    const auto written = profiler.write_trace(trace_path());
    EXPECT_TRUE(written.ok()) << written.error();
    std::ifstream file(trace_path());
    return nlohmann::json::parse(file);
}

TEST(Profiler, TimesOfAZoneAddUpInAFrameAndStartAnewInTheNext) {
    Profiler profiler;
    const uint32_t a = profiler.add_zone("a"), b = profiler.add_zone("b");
    profiler.begin_frame(0);
    profiler.add(a, 1'000'000, 3'000'000, 10);
    profiler.add(a, 3'000'000, 3'500'000, 5);
    profiler.end_frame();
    profiler.begin_frame(1);
    profiler.add(b, 0, 1'000'000, 1);
    profiler.end_frame();
    EXPECT_EQ(profiler.frame_count(), 2u);
    EXPECT_FLOAT_EQ(profiler.zone_ms(0, a), 2.5f);
    EXPECT_FLOAT_EQ(profiler.zone_ms(1, a), 0.0f);
    EXPECT_FLOAT_EQ(profiler.zone_ms(1, b), 1.0f);
    EXPECT_EQ(profiler.zone_rows(a), 15u);
    EXPECT_GE(profiler.frame_ms(0), 0.0f);
}

TEST(Profiler, TheTraceIsJsonWithFramesZonesAndCounters) {
    Profiler profiler;
    std::string name = "say \"hi\" \\ \n there";
    const uint32_t zone = profiler.add_zone(name), count = profiler.add_counter("bodies");
    name = "gone";  // the profiler keeps its own
    for (uint64_t f = 0; f < 3; ++f) {
        profiler.begin_frame(40 + f);
        const uint64_t now = now_ns();
        profiler.add(zone, now, now + 1'234'567, 1);
        std::thread([&] { profiler.add_span(zone, now, now + 5); }).join();
        profiler.count(count, 17);
        profiler.end_frame();
    }
    const nlohmann::json trace = trace_of(profiler);
    uint32_t frames = 0, zones = 0, counters = 0;
    for (const auto& event : trace["traceEvents"]) {
        if (event["ph"] == "X") {
            EXPECT_GE(event["ts"].get<double>(), 0.0);
            EXPECT_LT(event["ts"].get<double>(), 1e7);
        }
        if (event["name"] == "frame " + std::to_string(40 + frames)) ++frames;
        if (event["name"] == "say \"hi\" \\   there") {
            ++zones;
            if (event["tid"] == 0) {
                EXPECT_DOUBLE_EQ(event["dur"].get<double>(), 1234.567);
            }
        }
        if (event["ph"] == "C") {
            ++counters;
            EXPECT_EQ(event["name"], "bodies");
            EXPECT_EQ(event["args"]["value"], 17);
        }
    }
    EXPECT_EQ(frames, 3u);
    EXPECT_EQ(zones, 6u);
    EXPECT_EQ(counters, 3u);
}

TEST(Profiler, EveryThreadWithASpanHasATrackAndAName) {
    Profiler profiler;
    const uint32_t zone = profiler.add_zone("a");
    profiler.begin_frame(0);
    profiler.add(zone, now_ns(), now_ns(), 1);
    std::thread([&] { profiler.add_span(zone, now_ns(), now_ns()); }).join();
    profiler.end_frame();
    std::map<int, std::string> names;
    const nlohmann::json trace = trace_of(profiler);
    for (const auto& event : trace["traceEvents"])
        if (event["name"] == "thread_name") names[event["tid"]] = event["args"]["name"];
    EXPECT_EQ(names, (std::map<int, std::string>{{0, "worker 0, the one that steps"}, {1, "worker 1"}}));
}

TEST(Profiler, AnEmptyTraceIsJson) {
    const Profiler profiler;
    EXPECT_EQ(trace_of(profiler)["traceEvents"].size(), 1u);
}

TEST(Profiler, TheTraceIsJsonWhereNumbersHaveACommaToo) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    bool has_comma = false;
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"})
        has_comma = has_comma || std::setlocale(LC_ALL, name);
    Profiler profiler;
    profiler.begin_frame(0);
    profiler.add(profiler.add_zone("a"), now_ns(), now_ns() + 1500, 1);
    profiler.end_frame();
    const auto written = profiler.write_trace(trace_path());
    std::setlocale(LC_ALL, before.c_str());
    ASSERT_TRUE(written.ok());
    std::ifstream file(trace_path());
    EXPECT_TRUE(nlohmann::json::accept(file));
    if (!has_comma) GTEST_SKIP() << "no such locale is installed";
}

TEST(Profiler, WhenItIsFullTheLastFrameIsWrittenOverAndSpansAreCounted) {
    Profiler profiler(2, 3);
    const uint32_t zone = profiler.add_zone("a");
    for (uint64_t f = 0; f < 5; ++f) {
        profiler.begin_frame(f);
        profiler.add(zone, 0, 1'000'000 * (f + 1), 1);
        profiler.end_frame();
        profiler.add(zone, 0, 1'000'000, 1);  // between frames: no frame to belong to
    }
    profiler.end_frame();
    EXPECT_EQ(profiler.frame_count(), 2u);
    EXPECT_FLOAT_EQ(profiler.zone_ms(0, zone), 1.0f);
    EXPECT_FLOAT_EQ(profiler.zone_ms(1, zone), 5.0f);
    EXPECT_EQ(profiler.left_out(), 7u);
    EXPECT_EQ(trace_of(profiler)["traceEvents"].size() <= 1 + 1 + 2 + 3, true);
}

TEST(Profiler, MoreZonesThanItHasRoomForShareTheLast) {
    Profiler profiler(1, 1);
    for (uint32_t z = 0; z < Profiler::kMostZones; ++z) EXPECT_EQ(profiler.add_zone(std::to_string(z)), z);
    EXPECT_EQ(profiler.add_zone("one too many"), Profiler::kMostZones - 1);
    EXPECT_EQ(profiler.zone_count(), Profiler::kMostZones);
}

TEST(Profiler, SpansComeFromAnyThread) {
    Profiler profiler(1, 1500);
    const uint32_t zone = profiler.add_zone("a");
    profiler.begin_frame(0);
    std::vector<std::thread> threads;
    for (uint32_t t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            for (int n = 0; n < 500; ++n) profiler.add_span(zone, now_ns(), now_ns());
        });
    for (std::thread& thread : threads) thread.join();
    profiler.end_frame();
    EXPECT_EQ(profiler.left_out(), 500u);
    EXPECT_EQ(profiler.track_count(), 5u);
    EXPECT_EQ(trace_of(profiler)["traceEvents"].size(), 1507u);  // a process, five tracks, a frame, the spans
}

TEST(Profiler, AFileThatCannotBeOpenedIsASentence) {
    const Profiler profiler;
    const auto written = profiler.write_trace("/nowhere/at/all.json");
    EXPECT_FALSE(written.ok());
    EXPECT_NE(written.error().find("/nowhere/at/all.json"), std::string::npos);
}

TEST(Profiler, APercentileIsTheValueThatSoManyDoNotExceed) {
    std::vector<float> values;
    for (int n = 100; n >= 1; --n) values.push_back(static_cast<float>(n));
    EXPECT_EQ(percentile(values, 0.5), 50.0f);
    EXPECT_EQ(percentile(values, 0.95), 95.0f);
    EXPECT_EQ(percentile(values, 0.99), 99.0f);
    EXPECT_EQ(percentile(values, 1.0), 100.0f);
    EXPECT_EQ(percentile(values, 0.0), 1.0f);
    EXPECT_EQ(percentile({7}, 0.99), 7.0f);
    EXPECT_EQ(percentile({}, 0.5), 0.0f);
}

}  // namespace
}  // namespace cullet
