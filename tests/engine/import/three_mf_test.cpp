#include "engine/import/three_mf.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tests/support/damage.hpp"
#include "tests/support/house.hpp"
#include "tests/support/small_zip.hpp"

namespace cullet {
namespace {

using Files = std::vector<std::pair<std::string, std::string>>;

/// Files stand in memory: there are thousands of them.
class ThreeMf : public testing::Test {
 protected:
    ThreeMf() : file_(::memfd_create("three_mf_test", MFD_CLOEXEC)) {}
    ~ThreeMf() override { ::close(file_); }
    Result<Corners> read(const std::string& bytes) {
        const auto size = static_cast<ssize_t>(bytes.size());
        EXPECT_EQ(::ftruncate(file_, 0), 0);
        EXPECT_EQ(::pwrite(file_, bytes.data(), bytes.size(), 0), size);
        return read_3mf("/proc/self/fd/" + std::to_string(file_), "house.3mf");
    }
    Result<Corners> read(const Files& files) { return read(test::small_zip(files)); }

    int file_;
};

Mesh mesh_of(const Result<Corners>& corners) {
    EXPECT_TRUE(corners.ok()) << corners.error();
    if (!corners) return {};
    Corners copy = *corners;
    return joined_model(std::move(copy), "house.3mf").mesh;
}

std::string error_of(const Result<Corners>& corners) {
    EXPECT_FALSE(corners.ok());
    if (corners) return "";
    EXPECT_TRUE(test::is_a_sentence(corners.error(), "house.3mf")) << corners.error();
    return corners.error();
}

/// The house with all lengths times scale, as object `id`.
std::string house(const std::string& id, double scale) {
    std::string text = "<object id=\"" + id + "\" type=\"model\"><mesh><vertices>";
    char number[128];
    for (const Vec3d p : test::house_points()) {
        std::snprintf(number, sizeof number, "<vertex x=\"%.9g\" y=\"%.9g\" z=\"%.9g\"/>", scale * p.x, scale * p.y,
                      scale * p.z);
        text += number;
    }
    text += "</vertices><triangles>";
    for (const auto& t : test::house_triangles()) {
        std::snprintf(number, sizeof number, "<triangle v1=\"%d\" v2=\"%d\" v3=\"%d\"/>", t[0], t[1], t[2]);
        text += number;
    }
    return text + "</triangles></mesh></object>";
}

std::string model(const std::string& attributes, const std::string& resources, const std::string& build) {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?><model " + attributes +
           " xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources>" + resources +
           "</resources><build>" + build + "</build></model>";
}

const std::string kRelations =
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship Id=\"r\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\" Target=\"/3D/some.model\"/></Relationships>";
const std::string kItem = "<item objectid=\"1\"/>";

Files package(const std::string& text) {
    return {{"[Content_Types].xml", "<Types/>"}, {"_rels/.rels", kRelations}, {"3D/some.model", text}};
}

TEST_F(ThreeMf, EveryUnitComesInMetres) {
    const struct {
        const char* unit;
        double metres;
    } all[] = {{"micron", 1e-6}, {"millimeter", 1e-3}, {"centimeter", 1e-2},
               {"inch", 0.0254}, {"foot", 0.3048},     {"meter", 1}};
    for (const auto& [unit, metres] : all) {
        const std::string text = model(std::string("unit=\"") + unit + "\"", house("1", 1 / metres), kItem);
        test::expect_house(mesh_of(read(package(text))), unit);
    }
    test::expect_house(mesh_of(read(package(model("", house("1", 1000), kItem)))), "millimetres when it says nothing");
    EXPECT_NE(error_of(read(package(model("unit=\"furlong\"", house("1", 1), kItem)))).find("its unit is \"furlong\""),
              std::string::npos);
}

TEST_F(ThreeMf, PicturesAndOtherFilesBesideTheModelDoNoHarm) {
    for (const std::string name :
         {"Metadata/thumbnail.png", "Metadata/thumbnail.jpeg", "3D/Textures/wood.png", "Thumbnails/x.jpg"})
        for (const std::string& bytes : {std::string("\x89PNG\r\n"), std::string(), std::string(3000, 'x')}) {
            Files files = package(model("unit=\"meter\"", house("1", 1), kItem));
            files.insert(files.begin(), {name, bytes});
            test::expect_house(mesh_of(read(files)), name);
        }
}

TEST_F(ThreeMf, ComponentsInComponentsStandWhereTheyBelong) {
    // Right, then a turn about y, then twice as large: undone by the item.
    const std::string resources =
        house("7", 500) +
        "<object id=\"8\"><components><component objectid=\"7\" transform=\"1 0 0 0 1 0 0 0 1 10 20 30\"/>"
        "</components></object><object id=\"9\"><components><component objectid=\"8\" transform=\"0 0 -1 0 1 0 1 0 0 0 "
        "0 0\"/>"
        "</components></object>";
    // After 8: p + (10, 20, 30). After 9: x' = z, z' = -x. The item turns back, doubles and moves back.
    const std::string item = "<item objectid=\"9\" transform=\"0 0 2 0 2 0 -2 0 0 -20 -40 -60\"/>";
    test::expect_house(mesh_of(read(package(model("unit=\"millimeter\"", resources, item)))), "nested");
    const auto two = read(package(model("unit=\"millimeter\"", house("1", 1000),
                                        kItem + "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5000 0 0\"/>")));
    const Mesh mesh = mesh_of(two);
    EXPECT_EQ(mesh.triangles.size(), 28u);
    EXPECT_NEAR(test::volume_of(mesh), 13, 1e-4);
    const auto mirrored = read(package(
        model("unit=\"meter\"", house("1", 1), "<item objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>")));
    EXPECT_NEAR(test::volume_of(mesh_of(mirrored)), 6.5, 1e-4);
}

TEST_F(ThreeMf, PartsOfTheirOwnAreRead) {
    const std::string production =
        "unit=\"millimeter\" xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" "
        "requiredextensions=\"p\"";
    Files files =
        package(model(production,
                      "<object id=\"2\"><components><component p:path=\"/3D/Objects/a.model\" objectid=\"1\"/>"
                      "</components></object>",
                      "<item objectid=\"2\" p:UUID=\"x\"/>"));
    files.push_back({"3D/Objects/a.model", model("unit=\"millimeter\"", house("1", 1000), "")});
    test::expect_house(mesh_of(read(files)), "a part");
    files.back().second = model("unit=\"inch\"", house("1", 1 / 0.0254), "");
    test::expect_house(mesh_of(read(files)), "a part in inches");
    files.back().second = model("", house("1", 1000), "");
    test::expect_house(mesh_of(read(files)), "a part without a unit");
    files.pop_back();
    EXPECT_NE(error_of(read(files)).find("its part \"/3D/Objects/a.model\" is not there"), std::string::npos);
}

TEST_F(ThreeMf, TheXmlMayBeUtf16OrHaveAMark) {
    const std::string text = model("unit=\"meter\"", house("1", 1), kItem);
    test::expect_house(mesh_of(read(package("\xEF\xBB\xBF" + text))), "UTF-8");
    std::string little = "\xFF\xFE", big = "\xFE\xFF", coded = text;
    coded.replace(coded.find("UTF-8"), 5, "UTF-16");
    for (const char c : coded) {
        little += {c, '\0'};
        big += {'\0', c};
    }
    test::expect_house(mesh_of(read(package(little))), "UTF-16 LE");
    test::expect_house(mesh_of(read(package(big))), "UTF-16 BE");
    test::expect_house(mesh_of(read(package(little.substr(2)))), "UTF-16 LE without a mark");
}

TEST_F(ThreeMf, WhatIsNotReadIsSaidOrRefusedByName) {
    const auto unused = read(package(model("unit=\"meter\"", house("1", 1) + house("2", 1), kItem)));
    test::expect_house(mesh_of(unused), "unused");
    ASSERT_EQ(unused->notes.size(), 1u);
    EXPECT_EQ(unused->notes[0], "1 object that the build does not name was left out.");
    const auto no_build = read(package(model("unit=\"meter\"", house("1", 1), "")));
    test::expect_house(mesh_of(no_build), "no build");
    EXPECT_EQ(no_build->notes.size(), 1u);
    const std::string beams =
        "unit=\"meter\" xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\"";
    EXPECT_NE(error_of(read(package(model(beams + " requiredextensions=\"b\"", house("1", 1), kItem))))
                  .find("3dmanufacturing/beamlattice/2017/02"),
              std::string::npos);
    std::string lattice = house("1", 1);
    lattice.insert(lattice.find("</mesh>"),
                   "<b:beamlattice><b:beams><b:beam v1=\"0\" v2=\"1\"/></b:beams></b:beamlattice>");
    const auto optional = read(package(model(beams, lattice, kItem)));
    test::expect_house(mesh_of(optional), "beams");
    ASSERT_EQ(optional->notes.size(), 1u);
    EXPECT_EQ(optional->notes[0], "1 beam of a lattice was left out.");
}

TEST_F(ThreeMf, WrongNumbersCirclesAndBombsAreRefused) {
    const auto refused = [this](const std::string& resources, const std::string& build) {
        return error_of(read(package(model("unit=\"meter\"", resources, build))));
    };
    refused(house("1", 1), "<item objectid=\"2\"/>");
    refused("<object id=\"1\"><components><component objectid=\"1\"/></components></object>", kItem);
    refused(house("1", 1), "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 5\"/>");
    refused(house("1", 1) + house("1", 1), kItem);
    std::string wrong = house("1", 1);
    wrong.replace(wrong.find("v1=\"0\""), 6, "v1=\"9\"");
    EXPECT_NE(refused(wrong, kItem).find("names vertex 9, but there are 9"), std::string::npos);
    wrong.replace(wrong.find("v1=\"9\""), 6, "v1=\"x\"");
    refused(wrong, kItem);
    error_of(read(package("<!DOCTYPE m [<!ENTITY a \"xxxxxxxxxx\"><!ENTITY b \"&a;&a;&a;&a;&a;\">]><model>&b;")));
    error_of(read(package("<model><resources>")));
    error_of(read(Files{{"x", "y"}}));
    error_of(read(std::string("no zip")));
}

TEST_F(ThreeMf, DamagedFilesEndInAMeshOrASentence) {
    test::expect_meshes_or_sentences(test::small_zip(package(model("unit=\"meter\"", house("1", 1), kItem))),
                                     "house.3mf", 3000, [this](const std::string& bytes) { return read(bytes); });
    // A ZIP whose checksums fit: what the XML itself may hold.
    test::expect_meshes_or_sentences(model("unit=\"meter\"", house("1", 1), kItem), "house.3mf", 3000,
                                     [this](const std::string& text) { return read(package(text)); });
}

}  // namespace
}  // namespace cullet
