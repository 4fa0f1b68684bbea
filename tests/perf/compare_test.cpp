#include "perf/compare.hpp"

#include <gtest/gtest.h>

using namespace cullet;
using namespace cullet::perf;

namespace {

std::string file_of(const std::string& figures) {
    return R"({"format": "cullet_perf 1", "machine": {"processor": "P", "hardware_threads": 2}, )"
           R"("simd": "best", "passes": 3, "figures": [)" +
           figures + "]}";
}
std::string figure(const std::string& name, double value, double noise, const std::string& unit = "ms") {
    return R"({"scene": "hit", "name": ")" + name + R"(", "unit": ")" + unit + R"(", "value": )" +
           std::to_string(value) + R"(, "noise": )" + std::to_string(noise) + "}";
}
FigureFile parsed(const std::string& figures) {
    Result<FigureFile> file = parse_figures(file_of(figures), "made up");
    EXPECT_TRUE(file.ok()) << file.error();
    return file.value_or({});
}
std::string refusal(const std::string& text) {
    return parse_figures(text, "bad.json").error();
}

}  // namespace

TEST(Compare, AMoveCountsBeyondThreeTimesTheNoiseOfBoth) {
    // hypot(0.3, 0.4) = 0.5, three times that 1.5
    EXPECT_FALSE(has_moved({"", "", "", 10, 0.3}, {"", "", "", 11.4, 0.4}));
    EXPECT_TRUE(has_moved({"", "", "", 10, 0.3}, {"", "", "", 11.6, 0.4}));
    EXPECT_TRUE(has_moved({"", "", "", 10, 0.3}, {"", "", "", 8.4, 0.4})) << "to the better too";
}

TEST(Compare, AMoveOfTwoPercentOrLessIsNone) {
    EXPECT_FALSE(has_moved({"", "", "", 100, 0}, {"", "", "", 101.9, 0}));
    EXPECT_TRUE(has_moved({"", "", "", 100, 0}, {"", "", "", 102.1, 0}));
    EXPECT_TRUE(has_moved({"", "", "", 0, 0}, {"", "", "", 1, 0})) << "two percent of nothing is nothing";
    EXPECT_FALSE(has_moved({"", "", "", 0, 0}, {"", "", "", 0, 0}));
}

TEST(Compare, OnlyWhatMovedIsPrinted) {
    const FigureFile before = parsed(figure("still", 10, 1) + "," + figure("slower", 10, 0.1));
    const FigureFile after = parsed(figure("slower", 12, 0.1) + "," + figure("still", 11, 1));
    const Comparison comparison = compare(before, after);
    ASSERT_EQ(comparison.moved.size(), 1u);
    EXPECT_EQ(describe(comparison), "hit: slower  10 -> 12 ms  +20.0 %  (noise 0.1 and 0.1)\n");
    EXPECT_EQ(describe(compare(before, before)), "");
}

TEST(Compare, WhatIsMissingAndWhatIsNewIsNamed) {
    const Comparison comparison = compare(parsed(figure("gone", 1, 0) + "," + figure("both", 1, 0)),
                                          parsed(figure("both", 1, 0) + "," + figure("new", 1, 0)));
    EXPECT_TRUE(comparison.moved.empty());
    EXPECT_EQ(comparison.missing, std::vector<std::string>{"hit: gone"});
    EXPECT_EQ(comparison.gained, std::vector<std::string>{"hit: new"});
    EXPECT_EQ(describe(comparison), "hit: gone  only in the old file\nhit: new  only in the new file\n");
}

TEST(Compare, AFigureOfAnotherUnitIsAnotherFigure) {
    const Comparison comparison = compare(parsed(figure("a", 1, 0, "ms")), parsed(figure("a", 1000, 0, "us")));
    EXPECT_TRUE(comparison.moved.empty());
    EXPECT_EQ(comparison.missing.size(), 1u);
    EXPECT_EQ(comparison.gained.size(), 1u);
}

TEST(Compare, TheMachineIsItsProcessorAndItsThreads) {
    EXPECT_EQ(parsed("").machine, "P, 2 threads, kernels: best");
}

TEST(Compare, FilesThatAreNoneOfOursAreRefusedInWords) {
    EXPECT_EQ(refusal("[]"), "bad.json: is no JSON object. Give a file that cullet_perf --json wrote.");
    EXPECT_NE(refusal("{}").find("\"format\""), std::string::npos);
    EXPECT_NE(refusal(R"({"format": 1})").find("\"format\""), std::string::npos);
    EXPECT_NE(refusal(R"({"format": "cullet_perf 1"})").find("\"machine\""), std::string::npos);
    EXPECT_NE(refusal(file_of("1")).find("figure 0 is no object"), std::string::npos);
    EXPECT_NE(refusal(file_of(R"({"scene": "hit", "name": 1, "unit": ""})")).find("figure 0 lacks"), std::string::npos);
    EXPECT_NE(refusal(file_of(R"({"scene": "hit", "name": "a", "unit": "", "value": "1"})")).find("\"value\""),
              std::string::npos);
    EXPECT_NE(refusal(file_of(R"({"scene": "hit", "name": "a", "unit": "", "value": 1e999, "noise": 0})")),
              std::string());
    EXPECT_NE(refusal(file_of(figure("a", 1, -1))).find("\"noise\""), std::string::npos);
    EXPECT_NE(refusal(file_of(figure("a", 1, 0) + "," + figure("b", 1, 0) + "," + figure("a", 2, 0)))
                  .find("figures 0 and 2 are both \"hit: a\""),
              std::string::npos);
    EXPECT_FALSE(read_figures("/nowhere/figures.json").ok());
    EXPECT_NE(refusal(std::string(1'000'000, '[')), std::string()) << "a deep one is no trouble";
}

TEST(Compare, EveryTruncationOfAFileIsRefused) {
    const std::string whole = file_of(figure("a", 1, 0.1) + "," + figure("b", 2, 0));
    ASSERT_TRUE(parse_figures(whole, "whole").ok());
    for (size_t size = 0; size < whole.size(); ++size)
        EXPECT_FALSE(parse_figures(std::string_view(whole).substr(0, size), "cut").ok()) << size;
}
