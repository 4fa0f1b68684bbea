#include "engine/import/three_mf.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <functional>

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
    test::expect_house(mesh_of(read(package("\n " + text + std::string("\n\0\0", 3)))), "blanks and zeros");
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
                  .find("3dmanufacturing/beamlattice/2017/02\", which is not read. Export the model without it."),
              std::string::npos);
    std::string lattice = house("1", 1);
    lattice.insert(lattice.find("</mesh>"),
                   "<b:beamlattice><b:beams><b:beam v1=\"0\" v2=\"1\"/></b:beams></b:beamlattice>");
    const auto optional = read(package(model(beams, lattice, kItem)));
    test::expect_house(mesh_of(optional), "beams");
    ASSERT_EQ(optional->notes.size(), 1u);
    EXPECT_EQ(optional->notes[0], "1 beam of a lattice was left out.");
}

/// Triangle t of the house gets attributes of its own.
std::string house_with(const std::string& object, const std::function<std::string(int)>& attributes) {
    std::string text = house("1", 1);
    text.insert(text.find(" type="), object);
    int t = 0;
    for (size_t at = text.find("<triangle "); at != text.npos; at = text.find("<triangle ", at + 10))
        text.insert(at + 10, attributes(t++));
    return text;
}

const std::string kMaterials =
    "<basematerials id=\"5\"><base name=\"a\" displaycolor=\"#FFFFFF\"/><base name=\"b\" displaycolor=\"#000000\"/>"
    "</basematerials><basematerials id=\"6\"><base name=\"c\" displaycolor=\"#FF0000\"/></basematerials>";

TEST_F(ThreeMf, BaseMaterialsAreTheirNumbersInTheFileAndNoneIsTheNumberAfterTheLast) {
    const auto materials = [this](const std::string& object, const std::function<std::string(int)>& attributes) {
        const auto corners = read(package(model("unit=\"meter\"", kMaterials + house_with(object, attributes), kItem)));
        test::expect_house(mesh_of(corners), object);
        EXPECT_TRUE(corners->notes.empty()) << corners->notes[0];
        return mesh_of(corners).materials;
    };
    EXPECT_EQ(materials("", [](int) { return ""; }), std::vector<uint16_t>(14, 3));
    EXPECT_EQ(materials(" pid=\"6\" pindex=\"0\"", [](int) { return ""; }), std::vector<uint16_t>(14, 2));
    std::vector<uint16_t> wanted(14, 1);
    wanted[3] = 0, wanted[4] = 2;
    EXPECT_EQ(materials(" pid=\"5\" pindex=\"1\"",
                        [](int t) { return t == 3   ? "p1=\"0\" "
                                           : t == 4 ? "pid=\"6\" p1=\"0\" "
                                                    : ""; }),
              wanted);
    wanted.assign(14, 3);
    wanted[13] = 1;
    EXPECT_EQ(materials("", [](int t) { return t == 13 ? "pid=\"5\" p1=\"1\" " : ""; }), wanted);
    EXPECT_EQ(mesh_of(read(package(model("unit=\"meter\"", house("1", 1), kItem)))).materials,
              std::vector<uint16_t>(14, 0));
}

TEST_F(ThreeMf, TextureCoordinatesAreThoseOfTheCorners) {
    const std::string group =
        "<m:texture2dgroup id=\"7\" texid=\"9\"><m:tex2coord u=\"0.25\" v=\"1\"/><m:tex2coord u=\"0.5\" v=\"-2\"/>"
        "</m:texture2dgroup>";
    const std::string space =
        "unit=\"meter\" xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\"";
    const auto corners = read(package(model(space,
                                            group + house_with("",
                                                               [](int t) -> std::string {
                                                                   return t == 2
                                                                              ? "pid=\"7\" p1=\"1\" p2=\"0\" p3=\"1\" "
                                                                          : t == 3 ? "pid=\"7\" p1=\"1\" "
                                                                                   : "";
                                                               }),
                                            kItem)));
    const Mesh mesh = mesh_of(corners);
    test::expect_house(mesh, "coordinates");
    ASSERT_EQ(mesh.corner_uvs.size(), 42u);
    const float wanted[6] = {0.5f, 0.25f, 0.5f, 0.5f, 0.5f, 0.5f};
    for (size_t c = 0; c < 6; ++c) {
        EXPECT_EQ(mesh.corner_uvs[6 + c].x, wanted[c]);
        EXPECT_EQ(mesh.corner_uvs[6 + c].y, wanted[c] == 0.5f ? -2.0f : 1.0f);
    }
    EXPECT_EQ(corners->unusable_uvs, 0u);
    const auto lost = read(
        package(model(space, group + house_with(" pid=\"7\" pindex=\"2\"", [](int) { return std::string(); }), kItem)));
    EXPECT_EQ(lost->unusable_uvs, 42u);
}

TEST_F(ThreeMf, MixedAndMissingMaterialsSupportsAndSlicesAreSaid) {
    const auto note = [this](const std::string& resources, const std::string& build) {
        const auto corners = read(package(model("unit=\"meter\"", resources, build)));
        test::expect_house(mesh_of(corners), resources);
        return corners.ok() && corners->notes.size() == 1 ? corners->notes[0] : "not one note";
    };
    const auto none = [](int) { return std::string(); };
    for (const char* kind : {"compositematerials", "multiproperties"})
        EXPECT_EQ(note("<" + std::string(kind) + " id=\"8\"/>" + house_with(" pid=\"8\" pindex=\"0\"", none), kItem),
                  "14 triangles of mixed materials have no material's number.");
    EXPECT_EQ(
        note(kMaterials + house_with(" pid=\"5\"", [](int t) { return t == 1 ? "p1=\"9\" " : "p1=\"0\" "; }), kItem),
        "1 triangle names a material that is not there.");
    for (const char* kind : {"support", "solidsupport"}) {
        std::string support = house("2", 1);
        support.replace(support.find("\"model\""), 7, "\"" + std::string(kind) + "\"");
        EXPECT_EQ(note(house("1", 1) + support, kItem + "<item objectid=\"2\"/>"),
                  "1 object that is a support was left out.");
    }
    EXPECT_EQ(
        note(house("1", 1) + "<object id=\"2\" s:slicestackid=\"3\"><mesh><vertices/><triangles/></mesh></object>",
             kItem + "<item objectid=\"2\"/>"),
        "1 object without triangles, such as one of slices alone, was left out.");
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
