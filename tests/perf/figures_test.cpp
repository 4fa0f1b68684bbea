#include "perf/figures.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "perf/compare.hpp"

using namespace cullet;
using namespace cullet::perf;

TEST(Figures, AFigureIsTheMiddleOfItsPassesAndItsNoiseHowFarTheyLieApart) {
    Figures figures;
    figures.begin("hit");
    for (const double v : {10.0, 13.0, 11.0}) figures.add("whole hit", v, "ms");
    ASSERT_EQ(figures.all().size(), 1u);
    EXPECT_EQ(figures.all()[0].value(), 11);
    EXPECT_DOUBLE_EQ(figures.all()[0].noise(), 1.4826);  // distances 1, 2, 0
    EXPECT_EQ(median({4, 1}), 2.5);
    EXPECT_EQ(median({}), 0);
}

TEST(Figures, TheSameNameInAnotherSceneIsAnotherFigure) {
    Figures figures;
    figures.begin("vase");
    figures.add("frame", 1, "ms");
    figures.begin("wall");
    figures.add("frame", 2, "ms");
    ASSERT_EQ(figures.all().size(), 2u);
    EXPECT_EQ(figures.all()[1].scene, "wall");
}

TEST(Figures, ARatioIsOursOverTheirsOrTheOtherWayRoundWhenItIsToBeLarge) {
    Figures figures;
    figures.begin("hit");
    figures.add_ratio("bare", 3, 2, "ns", 1.25);
    figures.add_ratio("plain", 3, 12, "ns", 5, true);
    EXPECT_EQ(figures.all()[0].value(), 1.5);
    EXPECT_TRUE(figures.all()[0].is_missed());
    EXPECT_EQ(figures.all()[1].value(), 4);
    EXPECT_TRUE(figures.all()[1].is_missed());
    EXPECT_EQ(figures.missed(), 2u);
    figures.add("frame", 1, "ms", 2);
    figures.add("pieces", 1, "");
    EXPECT_EQ(figures.missed(), 2u);
}

TEST(Figures, TheFileSaysWhereItIsFromAndIsReadBackAsItWas) {
    Figures figures;
    figures.begin("hit");
    for (const double v : {10.0, 11.0}) figures.add("whole \"hit\"", v, "ms");
    figures.add_ratio("bare", 3, 2, "ns", 1.25);
    const std::string text = figures.json(describe_origin());

    const nlohmann::json json = nlohmann::json::parse(text);
    EXPECT_EQ(json["format"], "cullet_perf 1");
    EXPECT_GT(json["machine"]["hardware_threads"], 0);
    for (const char* key : {"processor", "features"}) EXPECT_TRUE(json["machine"][key].is_string()) << key;
    for (const char* key : {"compiler", "type", "flags", "commit"})
        EXPECT_FALSE(json["build"][key].get<std::string>().empty()) << key;
    EXPECT_NE(json["build"]["flags"].get<std::string>().find("-ffp-contract=off"), std::string::npos);
    EXPECT_EQ(json["date"].get<std::string>().size(), std::string("2000-01-01T00:00:00Z").size());
    const auto& bare = json["figures"][1];
    EXPECT_EQ(bare["ours"], 3);
    EXPECT_EQ(bare["yardstick"], 2);
    EXPECT_EQ(bare["at_most"], 1.25);
    EXPECT_FALSE(json["figures"][0].contains("at_most"));

    const Result<FigureFile> read = parse_figures(text, "written");
    ASSERT_TRUE(read.ok()) << read.error();
    ASSERT_EQ(read->figures.size(), 2u);
    EXPECT_EQ(read->figures[0].name, "whole \"hit\"");
    EXPECT_EQ(read->figures[0].value, 10.5);
    EXPECT_DOUBLE_EQ(read->figures[0].noise, 1.4826 * 0.5);
    EXPECT_TRUE(compare(*read, *read).moved.empty());
}
