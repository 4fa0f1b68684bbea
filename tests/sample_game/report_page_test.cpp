// report.html says what the run was like, without anything from elsewhere.
#include "sample_game/report_page.hpp"

#include <gtest/gtest.h>

namespace cullet {
namespace {

Report some_report() {
    Report report;
    report.scene = "a<b.lua";
    report.dt_s = 1.0 / 60;
    report.frames = 3;
    report.each_frame_ms = {1, 9, 2};
    report.each_frame_broke = {false, true, false};
    report.yardsticks["budget_ms"] = 8;
    report.notes = {"The mesh had 3 holes & more.", "Again.", "Again."};
    return report;
}

TEST(ReportPage, HasThePlotTheBudgetTheNotesAndNothingFromElsewhere) {
    const std::string page = report_page(some_report(), {});
    EXPECT_NE(page.find("<svg"), std::string::npos);
    EXPECT_NE(page.find("budget 8.00 ms"), std::string::npos);
    EXPECT_NE(page.find("a&lt;b.lua"), std::string::npos);
    EXPECT_EQ(page.find("a<b.lua"), std::string::npos);
    EXPECT_NE(page.find("3 holes &amp; more."), std::string::npos);
    EXPECT_NE(page.find("2 times: Again."), std::string::npos);
    for (const char* word : {"http://", "https://", "<script", "sheet.png", "film.mp4"})
        EXPECT_EQ(page.find(word), std::string::npos) << word;
}

TEST(ReportPage, ShowsTheSheetAndTheFilmWhereTheRunMadeThem) {
    RunOptions options;
    options.has_sheet = options.has_video = true;
    const std::string page = report_page(some_report(), options);
    EXPECT_NE(page.find("src=\"sheet.png\""), std::string::npos);
    EXPECT_NE(page.find("src=\"film.mp4\""), std::string::npos);
}

TEST(ReportPage, ARunWithoutFramesHasAPageToo) {
    EXPECT_NE(report_page(Report(), {}).find("</html>"), std::string::npos);
}

}  // namespace
}  // namespace cullet
