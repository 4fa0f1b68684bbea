#include "engine/import/passed_over.hpp"

#include <gtest/gtest.h>

namespace cullet {
namespace {

using Notes = std::vector<std::string>;

const std::string kNoUnit = "It names no unit; its numbers were taken for centimetres.";
const std::string kCurved = "Its curves and curved surfaces were left out.";

std::string text_fbx(const std::string& setting, const std::string& objects) {
    return "; FBX 7.4.0 project file\nGlobalSettings:  {\n    P: \"" + setting +
           "\", \"double\", \"Number\", \"\",1\n}\nObjects:  {\n" + objects + "}\n";
}

std::string geometry(const std::string& name, const std::string& kind) {
    return "\tGeometry: 1001, \"Geometry::" + name + "\", \"" + kind + "\" {\n\t}\n";
}

std::string binary_text(const std::string& text) {
    std::string bytes = "S";
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(text.size() >> (8 * i));
    return bytes + text;
}

std::string binary_fbx(const std::string& setting, const std::string& name, const std::string& kind) {
    return std::string("Kaydara FBX Binary  \0\x1a\0", 23) + binary_text(setting) + binary_text("double") +
           "L12345678" + binary_text(name + std::string("\0\1Geometry", 10)) + binary_text(kind);
}

TEST(PassedOver, AUnitIsNamedByItsWholeNameOnly) {
    const std::string mesh = geometry("House", "Mesh");
    EXPECT_EQ(notes_of_fbx(text_fbx("UnitScaleFactor", mesh)), Notes{});
    EXPECT_EQ(notes_of_fbx(text_fbx("OriginalUnitScaleFactor", mesh)), Notes{kNoUnit});
    EXPECT_EQ(notes_of_fbx(text_fbx("UnitScaleFactors", mesh)), Notes{kNoUnit});
    EXPECT_EQ(notes_of_fbx(binary_fbx("UnitScaleFactor", "House", "Mesh")), Notes{});
    EXPECT_EQ(notes_of_fbx(binary_fbx("OriginalUnitScaleFactor", "House", "Mesh")), Notes{kNoUnit});
}

TEST(PassedOver, CurvesAreKnownByTheClassOfAGeometryAndNotByNames) {
    for (const char* kind : {"NurbsCurve", "NurbsSurface", "TrimNurbsSurface", "Patch", "Boundary"}) {
        EXPECT_EQ(notes_of_fbx(text_fbx("UnitScaleFactor", geometry("a", "Mesh") + geometry("b", kind))),
                  Notes{kCurved});
        EXPECT_EQ(notes_of_fbx(binary_fbx("UnitScaleFactor", "b", kind)), Notes{kCurved});
        for (const std::string& name : {std::string(kind), std::string(kind) + "_left", "\"" + std::string(kind)}) {
            const std::string node = "\tModel: 2, \"Model::" + name + "\", \"Mesh\" {\n\t}\n";
            EXPECT_EQ(notes_of_fbx(text_fbx("UnitScaleFactor", geometry(name, "Mesh") + node)), Notes{}) << name;
            EXPECT_EQ(notes_of_fbx(binary_fbx("UnitScaleFactor", name, "Shape")), Notes{}) << name;
        }
    }
    EXPECT_EQ(notes_of_fbx(text_fbx("UnitScaleFactor", geometry("a", "Cloud"))),
              Notes{"Its geometry of the class \"Cloud\" was left out."});
}

TEST(PassedOver, CutOffFilesDoNoHarm) {
    for (const std::string& whole :
         {text_fbx("UnitScaleFactor", geometry("a", "Patch")), binary_fbx("UnitScaleFactor", "a", "Patch")})
        for (size_t size = 0; size <= whole.size(); ++size) notes_of_fbx(whole.substr(0, size));
}

}  // namespace
}  // namespace cullet
