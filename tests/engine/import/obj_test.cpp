#include "engine/import/obj.hpp"

#include <gtest/gtest.h>

namespace cullet {
namespace {

const std::string kPoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

Result<Corners> read(const std::string& text) {
    return read_obj(text, "m.obj", [](const std::string& name) -> std::optional<std::string> {
        if (name != "my house.mtl" && name != "b.mtl") return std::nullopt;
        return "newmtl first one\nKd 1 0 0\nNewmtl second\n";
    });
}

std::string refusal(const std::string& text) {
    const Result<Corners> corners = read(text);
    return corners.ok() ? "" : corners.error();
}

using Notes = std::vector<std::string>;

Notes notes_of(const std::string& text) {
    const Result<Corners> corners = read(text);
    return corners.ok() ? corners->notes : Notes{corners.error()};
}

TEST(Obj, WhatProgramsWriteIsLeftAlone) {
    for (const std::string text : {
             "f 1 2 3\n",
             "vt 0 0\nvt 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nf 1/1 2/2/2 3//3 # a face\n",
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

TEST(Obj, ABadPointIsToldWithItsLineAndWhatStandsThere) {
    const std::string how = "; write points as in \"v 0.5 1 2\".";
    EXPECT_EQ(refusal(kPoints + "v 1,5 0 0\n"), "m.obj: line 4: \"1,5\" is no finite number" + how);
    EXPECT_EQ(refusal("v 0 0 0\r\nv 0 nan 0\r\n"), "m.obj: line 2: \"nan\" is no finite number" + how);
    EXPECT_EQ(refusal("# one\rv 0 0 1e999\r"), "m.obj: line 2: \"1e999\" is no finite number" + how);
    EXPECT_EQ(refusal("v 0 0\n"), "m.obj: line 1: a point has 2 numbers; write three, as in \"v 0.5 1 2\".");
    EXPECT_EQ(refusal("v 0 # 0 0\n"), "m.obj: line 1: a point has 1 number; write three, as in \"v 0.5 1 2\".");
}

TEST(Obj, AFaceWithoutItsPointsIsToldWithItsLine) {
    EXPECT_EQ(refusal(kPoints + "f 1 2 4\n"),
              "m.obj: line 4: the face names a point that is not there (4); the file has 3 points. The file is damaged "
              "or cut off; export it again.");
    for (const std::string corner : {"0", "-4", "a", "1.5", "/1", "99999999999999999999"})
        EXPECT_EQ(refusal(kPoints + "f 1 2 3\nf 1 2 " + corner + "\n"),
                  "m.obj: line 5: \"" + corner +
                      "\" names no point of the 3 before it; points count from 1, or from -1 backwards.");
}

TEST(Obj, BlanksInFrontAndCapitalsChangeNothing) {
    for (const std::string text : {
             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n",
             "  v 0 0 0\n\tv 1 0 0\n \t v 0 1 0\nv 0 0 1\n\tf 1 2 3\n  f 1 2 4\n",
             "V 0 0 0\nV 1 0 0\nV 0 1 0\nV 0 0 1\nF 1 2 3\nF 1 2 4\n",
         }) {
        const Result<Corners> corners = read(text);
        ASSERT_TRUE(corners.ok()) << corners.error();
        EXPECT_EQ(corners->materials.size(), 2u) << text;
        EXPECT_EQ(corners->points, 4u);
        EXPECT_EQ(corners->notes, Notes{}) << text;
    }
}

TEST(Obj, AFaceThatNamesWhatIsNotThereIsToldWithItsLine) {
    const std::string looks = "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";
    EXPECT_EQ(refusal(kPoints + looks + "f 1/1 2/2 3/3\nf 1/1 3/3 2/9\n"),
              "m.obj: line 9: the face names a texture coordinate that is not there (9); the file has 3 texture "
              "coordinates. The file is damaged or cut off; export it again.");
    EXPECT_EQ(refusal(kPoints + "f 1//1 2//1 3//2\n"),
              "m.obj: line 4: the face names a normal that is not there (1); the file has 0 normals. The file is "
              "damaged or cut off; export it again.");
    for (const std::string uv : {"0", "-9"})
        EXPECT_NE(refusal(kPoints + looks + "f 1/1 3/3 2/" + uv + "\n").find("line 8: the face names a texture"),
                  std::string::npos);
    EXPECT_EQ(refusal(kPoints + looks + "f 1/1 2/x 3/3\n"),
              "m.obj: line 8: \"2/x\" is no corner; write corners as in \"7/1/3\".");
}

TEST(Obj, AFaceWithoutAllOfItsLooksLosesThemAndThisIsSaid) {
    const std::string looks = "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";
    EXPECT_EQ(notes_of(kPoints + looks + "f 1/1/1 2/-2/-1 3/3/1\n"), Notes{});
    const Result<Corners> corners = read(kPoints + looks + "f 1/1 2/2 3/3\nf 1/1 3/3 2\n");
    ASSERT_TRUE(corners.ok()) << corners.error();
    EXPECT_EQ(corners->notes, Notes{"The texture coordinates of 1 face are not all there and went unread."});
    ASSERT_TRUE(corners->has_uvs);
    EXPECT_EQ(corners->uvs[1].x, 1);
    EXPECT_EQ(corners->uvs[1].y, 0);
    EXPECT_EQ(notes_of(kPoints + looks + "f 1//1 2//1 3\n"),
              Notes{"The normals of 1 face are not all there and went unread."});
}

TEST(Obj, WhatIsNotReadIsSaidAndAttributesAreNoLines) {
    EXPECT_EQ(notes_of(kPoints + "lod 3\nbevel on\ns off\ng a\no b\nf 1 2 3\n"), Notes{});
    EXPECT_EQ(
        notes_of(kPoints + "call other.obj\nf 1 2 3\nwhat 1\nwhat 2\n"),
        (Notes{"1 line that begins with \"call\" went unread.", "2 lines that begin with \"what\" went unread."}));
    EXPECT_EQ(
        notes_of(kPoints + "surf 0 1\n curv 0 1\nsurface 1\nf 1 2 3"),
        (Notes{"2 curves or curved surfaces were left out.", "1 line that begins with \"surface\" went unread."}));
    EXPECT_EQ(refusal(kPoints + "f\n"), "m.obj: line 4: a face has no points; write three or more, as in \"f 1 2 3\".");
    const Result<Corners> lines = read(kPoints + "l 1 2 3\np 1 2\nf 1 2\nf 1 2 3\n");
    ASSERT_TRUE(lines.ok());
    EXPECT_EQ(lines->left_out, 5u);
}

TEST(Obj, PolygonsOfAnyShapeAreCut) {
    const Result<Corners> corners =
        read("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\nf 1 2 3 4 5 # hollow\nf -5 -4 -3\n");
    ASSERT_TRUE(corners.ok()) << corners.error();
    ASSERT_EQ(corners->materials.size(), 4u);
    double area = 0;
    for (size_t t = 0; t < 3; ++t) {
        const Vec3 *p = &corners->positions[3 * t], n = cross(p[1] - p[0], p[2] - p[0]);
        EXPECT_GT(n.z, 0);
        area += 0.5 * n.z;
    }
    EXPECT_NEAR(area, 2.5, 1e-6);
}

TEST(Obj, MaterialsAreNumberedAsTheirFileHasThemThenByUse) {
    const std::string faces = "usemtl new\nf 1 2 3\nusemtl second\nf 1 2 3\nusemtl first one\nf 1 2 3\n";
    for (const std::string library : {"mtllib my house.mtl\n", "mtllib a.mtl b.mtl\n"})
        EXPECT_EQ(read(kPoints + library + faces)->materials, (std::vector<uint16_t>{2, 1, 0})) << library;
    EXPECT_EQ(read(kPoints + faces)->materials, (std::vector<uint16_t>{0, 1, 2}));
    EXPECT_EQ(read(kPoints + "f 1 2 3\n" + faces)->materials, (std::vector<uint16_t>{3, 0, 1, 2}));
    EXPECT_EQ(read(kPoints + "f 1 2 3\n")->materials, std::vector<uint16_t>{0});
}

TEST(Obj, CutOffFilesDoNoHarm) {
    const std::string whole = kPoints + "vt 0 0\nvn 0 0 1\nmtllib b.mtl\nusemtl second\nf 1/1/1 2/1/1 3/1/1\nl 1 2\n";
    for (size_t size = 0; size <= whole.size(); ++size) read(whole.substr(0, size)).ok();
}

}  // namespace
}  // namespace cullet
