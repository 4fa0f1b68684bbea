// report.json holds all that it promises, and what is written can be read.
#include "sample_game/report.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sample_game/run_scene.hpp"
#include "tests/support/places.hpp"

namespace cullet {
namespace {

using Json = nlohmann::json;

TEST(Report, EveryPromisedFieldIsThere) {
    const Json json = Json::parse(to_json({}));
    for (const char* name : {"scene",
                             "seed",
                             "dt_s",
                             "frames",
                             "threads",
                             "machine",
                             "hash",
                             "hash_chain",
                             "tables",
                             "mass_kg",
                             "momentum_ns",
                             "energy_j",
                             "fragments",
                             "awake",
                             "rest",
                             "units",
                             "events",
                             "refused",
                             "faults",
                             "fault_list",
                             "frame_ms",
                             "systems",
                             "hitch",
                             "fracture_frames",
                             "damage_frames",
                             "yardsticks",
                             "tasks",
                             "sweeps",
                             "clamped",
                             "crushed_j",
                             "shapes",
                             "allocations_in_frames",
                             "allocations_in_rigid",
                             "peak_rss_bytes"})
        EXPECT_TRUE(json.contains(name)) << name;
    const std::map<std::string, std::vector<const char*>> parts{
        {"mass_kg", {"start", "end", "debris"}},
        {"momentum_ns", {"start", "end", "impulse"}},
        {"fragments", {"born", "live", "asleep", "debris", "retired", "faded"}},
        {"awake", {"bodies", "cells"}},
        {"rest", {"asleep_share", "kinetic_share", "measured", "sink_mm", "overlap_mm", "hover_mm", "through"}},
        {"units", {"used", "left"}},
        {"frame_ms", {"p50", "p95", "p99", "max", "total", "rows"}},
        {"fracture_frames", {"count", "p50_ms", "p99_ms", "max_ms"}},
        {"tasks",
         {"opened", "broke", "dropped", "redone", "late", "frames_held", "ahead_hits", "ahead_misses", "first_breaks",
          "first_ready"}}};
    Report with_shapes;
    with_shapes.fragment_shapes["hull"] = {3, 2, {1.2, 1.5, 2}, {1, 1.125, 1.375}};
    const auto shapes = nlohmann::json::parse(to_json(with_shapes))["shapes"]["fragments"]["hull"];
    EXPECT_EQ(shapes["count"], 3);
    EXPECT_EQ(shapes["measured"], 2);
    EXPECT_EQ(shapes["box_ratio"]["median"], 1.5);
    EXPECT_EQ(shapes["hull_ratio"]["max"], 1.375);
    for (const auto& [name, members] : parts)
        for (const char* member : members) EXPECT_TRUE(json[name].contains(member)) << name << "." << member;
}

TEST(Report, ValuesComeBackAsTheyWere) {
    Report report;
    report.scene = "a \"quoted\" scene\n";
    report.seed = ~uint64_t{0};
    report.hash = "00ff";
    report.mass_kg = {1.0 / 3, 2, 0.5};
    report.momentum_ns.impulse = {1, -2, 3};
    report.systems["solve_rigid"] = spread_of({1, 2, 3, 4}, 12);
    report.fault_list = {"one", "two"};
    report.refused["limits.bodies"] = 7;
    const Json json = Json::parse(to_json(report));
    EXPECT_EQ(json["scene"], report.scene);
    EXPECT_EQ(json["seed"].get<uint64_t>(), report.seed);
    EXPECT_EQ(json["hash"], "00ff");
    EXPECT_EQ(json["mass_kg"]["start"].get<double>(), 1.0 / 3);
    EXPECT_EQ(json["momentum_ns"]["impulse"], (std::vector<double>{1, -2, 3}));
    EXPECT_EQ(json["systems"]["solve_rigid"]["p50"], 2);
    EXPECT_EQ(json["systems"]["solve_rigid"]["max"], 4);
    EXPECT_EQ(json["systems"]["solve_rigid"]["total"], 10);
    EXPECT_EQ(json["systems"]["solve_rigid"]["rows"], 12);
    EXPECT_EQ(json["fault_list"].size(), 2u);
    EXPECT_EQ(json["refused"]["limits.bodies"], 7);
}

TEST(Report, BytesThatAreNoTextDoNotStopIt) {
    Report report;
    report.notes = {"caf\xe9.obj"};
    EXPECT_FALSE(Json::parse(to_json(report))["notes"][0].get<std::string>().empty());
}

TEST(Report, EqualNotesAreOneLineWithANumber) {
    Report report;
    report.notes = {"a ball found no room", "a pane stands", "a ball found no room", "a ball found no room"};
    const Json notes = Json::parse(to_json(report))["notes"];
    EXPECT_EQ(notes, Json({"3 times: a ball found no room", "a pane stands"}));
}

// 5,000 balls are thrown where 4,096 bodies fit.
TEST(Report, RefusedSpawnsAreToldOfInALine) {
    const std::string path = source_folder() + "/tests/cases/notes_of_refused_spawns.lua";
    std::stringstream script;
    script << std::ifstream(path).rdbuf();
    const RunOptions options;
    const Result<Report> report = play(plan_scene({"test", path, script.str()}, options), options);
    ASSERT_TRUE(report.ok()) << report.error();
    const Json notes = Json::parse(to_json(*report))["notes"];
    EXPECT_LE(notes.size(), 3u) << notes;
    EXPECT_NE(notes.dump().find("905 times: "), std::string::npos) << notes;
}

TEST(Report, AFolderThatIsNotThereIsNamed) {
    const auto written = write_text("x", "/nowhere/at/all/report.json");
    ASSERT_FALSE(written.ok());
    EXPECT_NE(written.error().find("/nowhere/at/all/report.json"), std::string::npos);
}

TEST(Report, ASpreadOfNothingIsZero) {
    const Spread spread = spread_of({});
    EXPECT_EQ(spread.p50, 0);
    EXPECT_EQ(spread.total, 0);
}

}  // namespace
}  // namespace cullet
