#include "engine/import/obj_lines.hpp"

#include <gtest/gtest.h>

namespace cullet {
namespace {

const std::string kPoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string refusal(const std::string& text) {
    const Result<void> checked = check_obj(text, "m.obj");
    return checked.ok() ? "" : checked.error();
}

TEST(ObjLines, WhatProgramsWriteIsLeftAlone) {
    for (const std::string text : {
             "f 1 2 3\n",
             "f 1/1 2/2/2 3//3 # a face\n",
             "f -3 -2 -1\r\n",
             "v 1 2 3 0.5 0.5 0.5\nv\t+.5 -1e-3 1.\nv 1 2 3 1# weight\nf 4 5 6",
             "f 1 \\\n2 3\nf 1\\\r\n 2 3\n",
             "# v a b c\n#f 9 9 9\nvn nan 0 1\nvt 0,5 1\nl 1 2\ncurv 0 1 7\n",
             "  v 1 2 3\n  f 1 2 4\n",
             "",
         })
        EXPECT_EQ(refusal(kPoints + text), "") << text;
    EXPECT_EQ(refusal("f 1 2 3\n" + kPoints), "") << "points may stand behind the faces";
}

TEST(ObjLines, ABadPointIsToldWithItsLineAndWhatStandsThere) {
    const std::string how = "; write points as in \"v 0.5 1 2\".";
    EXPECT_EQ(refusal(kPoints + "v 1,5 0 0\n"), "m.obj: line 4: \"1,5\" is no finite number" + how);
    EXPECT_EQ(refusal("v 0 0 0\r\nv 0 nan 0\r\n"), "m.obj: line 2: \"nan\" is no finite number" + how);
    EXPECT_EQ(refusal("# one\rv 0 0 1e999\r"), "m.obj: line 2: \"1e999\" is no finite number" + how);
    EXPECT_EQ(refusal("v 0 0\n"), "m.obj: line 1: a point has 2 numbers; write three, as in \"v 0.5 1 2\".");
    EXPECT_EQ(refusal("v 0 # 0 0\n"), "m.obj: line 1: a point has 1 number; write three, as in \"v 0.5 1 2\".");
}

TEST(ObjLines, AFaceWithoutItsPointsIsToldWithItsLine) {
    EXPECT_EQ(refusal(kPoints + "f 1 2 4\n"),
              "m.obj: line 4: the face names point 4, and the file has 3 points. The file is damaged or cut off; "
              "export it again.");
    for (const std::string corner : {"0", "-4", "a", "1.5", "/1", "99999999999999999999"})
        EXPECT_EQ(refusal(kPoints + "f 1 2 3\nf 1 2 " + corner + "\n"),
                  "m.obj: line 5: \"" + corner +
                      "\" names no point of the 3 before it; points count from 1, or from -1 backwards.");
}

}  // namespace
}  // namespace cullet
