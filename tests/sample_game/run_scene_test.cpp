// What a run leaves behind: a trace that Perfetto opens, a report that names the dearest systems and the worst frame, a
// film.
#include "sample_game/run_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "sample_game/film.hpp"

namespace cullet {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kBreaking = R"(
    local vase = game.cook{mesh = game.mesh.vase{edge = 0.0125}, material = "porcelain", thickness = 0.005}
    game.floor()
    game.spawn{cooked = vase, at = {0, 0.1, 0}, velocity = {0, -6, 0}}
)";

fs::path folder_for(const std::string& name) {
    const fs::path folder = fs::path(testing::TempDir()) / ("cullet_run_" + name);
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
}

Result<Report> run(const std::string& text, const RunOptions& options) {
    return play(plan_scene({"test", "test.lua", text}, options), options);
}

/// A breaking vase on two threads, played once for all tests of its trace and report.
struct Played {
    Report report;
    Json trace;
};
const Played& played() {
    static const Played once = [] {
        RunOptions options;
        options.threads = 2;
        options.frames = 60;
        options.set.push_back("frames_ahead=0");  // a hit is held
        options.trace = folder_for("trace") / "trace.json";
        Result<Report> report = run(kBreaking, options);
        EXPECT_TRUE(report.ok()) << report.error();
        std::ifstream file(options.trace);
        return Played{std::move(report).value(), Json::parse(file)};
    }();
    return once;
}

/// In whole nanoseconds, so that no sum rounds.
struct Span {
    int64_t start = 0, end = 0;
    std::string name;
};
int64_t nanoseconds(const Json& microseconds) {
    return std::llround(1000 * microseconds.get<double>());
}

std::map<int, std::vector<Span>> tracks_of(const Json& trace) {
    std::map<int, std::vector<Span>> tracks;
    for (const Json& event : trace["traceEvents"])
        if (event["ph"] == "X") {
            const int64_t start = nanoseconds(event["ts"]);
            tracks[event["tid"]].push_back({start, start + nanoseconds(event["dur"]), event["name"]});
        }
    return tracks;
}

TEST(Trace, EveryEventHasWhatTheFormatAsksFor) {
    const std::set<std::string> kinds{"M", "X", "C"};
    for (const Json& event : played().trace["traceEvents"]) {
        ASSERT_TRUE(event["name"].is_string() && event["pid"].is_number_integer()) << event;
        ASSERT_TRUE(kinds.count(event["ph"])) << event;
        if (event["ph"] == "M") continue;
        ASSERT_GE(event["ts"].get<double>(), 0) << event;
        if (event["ph"] == "X") {
            ASSERT_TRUE(event["tid"].is_number_integer() && event["dur"].get<double>() >= 0) << event;
        } else {
            ASSERT_TRUE(event["args"].size() == 1 && event["args"]["value"].is_number_unsigned()) << event;
        }
    }
}

TEST(Trace, HasOneNamedTrackAWorker) {
    std::map<int, std::string> names;
    for (const Json& event : played().trace["traceEvents"])
        if (event["name"] == "thread_name") {
            EXPECT_TRUE(names.try_emplace(event["tid"], event["args"]["name"]).second);
        }
    // How many did any work is oneTBB's choice: on a busy machine the first may be done before another comes, and a
    // pass may be served by other threads of its pool than the last one. profiler_test has two for certain.
    EXPECT_EQ(names[0], "worker 0, the one that steps");
    std::set<int> used;
    for (const auto& [track, spans] : tracks_of(played().trace)) used.insert(track);
    for (const auto& [track, name] : names) EXPECT_TRUE(used.count(track)) << name;
    EXPECT_EQ(used.size(), names.size());
}

TEST(Trace, SpansOfATrackLieInEachOtherOrApart) {
    for (auto& [track, spans] : tracks_of(played().trace)) {
        std::vector<Span> sorted = spans, open;
        std::stable_sort(sorted.begin(), sorted.end(), [](const Span& a, const Span& b) {
            return a.start != b.start ? a.start < b.start : a.end > b.end;
        });
        for (const Span& span : sorted) {
            while (!open.empty() && open.back().end <= span.start) open.pop_back();
            if (!open.empty()) {
                ASSERT_LE(span.end, open.back().end)
                    << span.name << " on track " << track << " sticks out of " << open.back().name;
            }
            open.push_back(span);
        }
    }
}

TEST(Trace, EveryFrameHasItsSystemsAndItsCounters) {
    std::map<std::string, std::vector<uint64_t>> counters;
    std::map<std::string, uint64_t> spans;
    for (const Json& event : played().trace["traceEvents"]) {
        if (event["ph"] == "C") counters[event["name"]].push_back(event["args"]["value"]);
        if (event["ph"] == "X") ++spans[event["name"]];
    }
    const auto sum = [&](const char* name) {
        uint64_t all = 0;
        for (const uint64_t value : counters[name]) all += value;
        return all;
    };
    for (const char* name : {"units used", "units left", "open tasks", "births", "holds", "refusals"})
        EXPECT_EQ(counters[name].size(), 60u) << name;
    const Report& report = played().report;
    EXPECT_EQ(sum("units used"), report.units.used);
    EXPECT_EQ(sum("births"), report.fragments.born);
    EXPECT_EQ(sum("refusals"), 0u);
    EXPECT_GT(sum("births"), 0u);
    EXPECT_GT(sum("open tasks"), 0u);
    EXPECT_GT(sum("holds"), 0u);
    EXPECT_EQ(spans["frame 0"], 1u);
    EXPECT_EQ(spans["frame 59"], 1u);
    EXPECT_GE(spans["solve_rigid"], 60u);
    EXPECT_GT(spans["damage task"], 0u);
}

TEST(RunReport, NamesTheWorstFrameAndWhatHappenedInIt) {
    const Report& report = played().report;
    EXPECT_EQ(report.worst_frame.ms, report.frame_ms.max);
    ASSERT_TRUE(report.systems.count(report.worst_frame.system)) << report.worst_frame.system;
    EXPECT_LE(report.worst_frame.system_ms, report.systems.at(report.worst_frame.system).max);
    const Json json = Json::parse(to_json(report));
    EXPECT_EQ(json["worst_frame"]["frame"], report.worst_frame.frame);
    Report told;
    told.worst_frame.frame = 41;
    told.worst_frame.ms = 12.3f;
    told.worst_frame.facts.opened = 1;
    told.worst_frame.facts.born = 14;
    told.worst_frame.facts.units = 7'900'000;
    told.worst_frame.system = "make_births";
    told.worst_frame.system_ms = 9.1f;
    EXPECT_EQ(worst_frame_line(told),
              "worst frame 41: 12.30 ms: 1 hit opened, 14 pieces born, 7.9 million units, 9.10 ms in make_births");
    EXPECT_EQ(worst_frame_line({}), "worst frame 0: 0.00 ms: nothing broke, 0.00 ms in no system");
}

TEST(RunReport, TheTableStartsWithTheFiveDearestSystems) {
    Report report;
    for (int n = 1; n <= 9; ++n)
        report.systems["system_" + std::to_string(n)] = spread_of({static_cast<float>(n * n * n * n * n)}, 7);
    std::istringstream lines(systems_table(report));
    std::string line, all;
    std::vector<std::string> first;
    while (std::getline(lines, line)) first.push_back(line.substr(2, line.find(' ', 2) - 2));
    EXPECT_EQ(first,
              (std::vector<std::string>{"system,", "system_9", "system_8", "system_7", "system_6", "system_5", "4"}));
}

/// Puts a program called ffmpeg into PATH, as long as it lives.
struct FakeFfmpeg {
    std::string before = std::getenv("PATH");
    FakeFfmpeg(const fs::path& folder, const std::string& script) {
        const fs::path program = folder / "ffmpeg";
        std::ofstream(program) << "#!/bin/sh\n" << script << "\n";
        fs::permissions(program, fs::perms::owner_all);
        setenv("PATH", (folder.string() + ":" + before).c_str(), 1);
    }
    ~FakeFfmpeg() { setenv("PATH", before.c_str(), 1); }
};

RunOptions film_options(const fs::path& folder) {
    RunOptions options;
    options.threads = 2;
    options.frames = 5;
    options.out = folder;
    options.has_video = true;
    return options;
}

TEST(Video, EverySecondFrameGoesToFfmpegAsRawPixels) {
    const fs::path folder = folder_for("film");
    const FakeFfmpeg fake(folder, "for last; do :; done; { echo \"$@\"; wc -c; } > \"${last#file:}\"");
    EXPECT_TRUE(look_for_ffmpeg().ok());
    const Result<Report> report = run("game.floor()", film_options(folder));
    ASSERT_TRUE(report.ok()) << report.error();
    std::ifstream film(folder / "film.mp4");
    std::string words;
    uint64_t bytes = 0;
    std::getline(film, words);
    film >> bytes;
    EXPECT_NE(words.find("-f rawvideo -pixel_format rgb24 -video_size 960x540 -framerate 30.000000 -i pipe:0"),
              std::string::npos)
        << words;
    EXPECT_EQ(bytes, 3u * 960 * 540 * 3);  // frames 0, 2 and 4
}

TEST(Video, AnFfmpegThatFailsIsASentence) {
    const fs::path folder = folder_for("film_fails");
    const FakeFfmpeg fake(folder, "exit 3");
    const Result<Report> report = run("game.floor()", film_options(folder));
    ASSERT_FALSE(report.ok());
    EXPECT_NE(report.error().find("code 3"), std::string::npos) << report.error();
}

TEST(Video, WithoutFfmpegItIsRefusedInOneSentence) {
    const std::string before = std::getenv("PATH");
    setenv("PATH", folder_for("empty").c_str(), 1);
    EXPECT_EQ(
        look_for_ffmpeg().error(),
        "--video: the program ffmpeg is not in PATH; install it (Debian: apt-get install ffmpeg), or leave --video "
        "out.");
    setenv("PATH", before.c_str(), 1);
}

}  // namespace
}  // namespace cullet
