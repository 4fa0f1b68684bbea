#include "engine/import/stl.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/damage.hpp"
#include "tests/support/house.hpp"

namespace cullet {
namespace {

Mesh mesh_of(const Result<Corners>& corners) {
    EXPECT_TRUE(corners.ok()) << corners.error();
    if (!corners) return {};
    Corners copy = *corners;
    return joined_model(std::move(copy), "house.stl").mesh;
}

Mesh read(const std::string& bytes) {
    return mesh_of(read_stl(bytes, "house.stl"));
}

std::string error_of(const std::string& bytes) {
    const auto corners = read_stl(bytes, "house.stl");
    EXPECT_FALSE(corners.ok());
    if (corners) return "";
    EXPECT_TRUE(test::is_a_sentence(corners.error(), "house.stl")) << corners.error();
    return corners.error();
}

std::string text_house(const std::string& normal = "0 0 0", const std::string& end_of_line = "\n") {
    std::string text = "solid house" + end_of_line;
    for (const auto& t : test::house_triangles()) {
        text += "  facet normal " + normal + end_of_line + "    outer loop" + end_of_line;
        for (const int v : t) {
            const Vec3d p = test::house_points()[static_cast<size_t>(v)];
            text += "      vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) +
                    end_of_line;
        }
        text += "    endloop" + end_of_line + "  endfacet" + end_of_line;
    }
    return text + "endsolid house" + end_of_line;
}

std::string binary_house(const std::string& front = "binary", int more_facets = 0) {
    std::string bytes = front;
    bytes.resize(80);
    const auto append = [&bytes](const void* from, size_t size) { bytes.append(static_cast<const char*>(from), size); };
    const uint32_t count = static_cast<uint32_t>(static_cast<int>(test::house_triangles().size()) + more_facets);
    append(&count, 4);
    for (const auto& t : test::house_triangles()) {
        bytes.append(12, '\0');
        for (const int v : t) {
            const Vec3 p = test::house_points()[static_cast<size_t>(v)].to_float();
            append(&p, 12);
        }
        bytes.append(2, '\0');
    }
    return bytes;
}

std::string with_capitals(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(c));
    return text;
}

TEST(Stl, WordsMayHaveCapitalLetters) {
    test::expect_house(read(text_house()), "plain");
    test::expect_house(read(with_capitals(text_house())), "capitals");
    std::string mixed = text_house();
    mixed.replace(0, 5, "Solid");
    test::expect_house(read(mixed), "mixed");
}

TEST(Stl, FirstLinesMayBeOdd) {
    const std::string house = text_house();
    for (const std::string front : {"   ", "\t", "\n\n", "\r\n \r\n", "\xEF\xBB\xBF", "\xEF\xBB\xBF  "})
        test::expect_house(read(front + house), front);
    for (const std::string front : {"# exported by hand\n", "; a comment\n\n", "// facet solid\n"}) {
        const auto corners = read_stl(front + house, "house.stl");
        test::expect_house(mesh_of(corners), front);
        ASSERT_EQ(corners->notes.size(), 1u) << front;
        EXPECT_EQ(corners->notes[0], "1 line before the first solid was left unread.");
    }
    for (const std::string name : {"solid\n", "solid facet\n", "solid a b 1.5 vertex endloop\n", "solid \"x\"\r\n"})
        test::expect_house(read(name + house.substr(house.find('\n') + 1)), name);
}

TEST(Stl, ASolidWithoutItsFirstWordIsRead) {
    const std::string house = text_house();
    const size_t begin = house.find('\n') + 1;
    for (const size_t end : {house.size(), house.rfind("endsolid")}) {
        const auto corners = read_stl(house.substr(begin, end - begin), "house.stl");
        test::expect_house(mesh_of(corners), "facets alone");
        EXPECT_TRUE(corners->notes.empty()) << corners->notes[0];
    }
}

TEST(Stl, LinesThatAreNoFacetsAreSkippedAndCounted) {
    const std::string house = text_house(), house_with_ends = text_house("0 0 0", " ");
    const size_t first = house.find("  facet"), middle = house.find("  facet", house.size() / 2);
    for (const std::string lines : {"# by hand\n; 1999\n", "units mm\nfacets 14\n", "author facet solid\n\nx\n"}) {
        std::string text = house;
        const auto corners = read_stl(text.insert(first, lines), "house.stl");
        test::expect_house(mesh_of(corners), lines);
        ASSERT_EQ(corners->notes.size(), 1u) << lines;
        EXPECT_EQ(corners->notes[0], "2 lines that are no facets were left unread.");
    }
    std::string text = house;
    const auto corners = read_stl(text.insert(middle, "// facet normal 0 0 0\n"), "house.stl");
    test::expect_house(mesh_of(corners), "a comment between facets");
    EXPECT_EQ(corners->notes, (std::vector<std::string>{"1 line that is no facet was left unread."}));
    text = house;
    EXPECT_NE(error_of(text.insert(middle, "units mm\n")).find("has the word \"units\""), std::string::npos);
}

TEST(Stl, ATextThatEndsBehindAWholeFacetIsReadAndSaid) {
    const std::string house = text_house();
    const auto corners = read_stl(house.substr(0, house.rfind("endsolid")), "house.stl");
    test::expect_house(mesh_of(corners), "no endsolid");
    EXPECT_EQ(corners->notes,
              (std::vector<std::string>{"It ends without its \"endsolid\"; the facets that are there were read."}));
}

TEST(Stl, EndsMayBeTwoWords) {
    std::string house = text_house();
    for (const std::string word : {"loop", "facet", "solid"})
        for (size_t at = house.find("end" + word); at != house.npos; at = house.find("end" + word, at + 1))
            house.insert(at + 3, " ");
    test::expect_house(read(house), "two words");
}

TEST(Stl, TheNameOfATextMayBeFilledWithZeros) {
    const std::string house = text_house();
    for (const size_t zeros : {1u, 70u, 300u}) {
        std::string text = house;
        test::expect_house(read(text.insert(house.find('\n'), std::string(zeros, '\0'))), std::to_string(zeros));
        test::expect_house(read("solid" + std::string(zeros, '\0') + house.substr(house.find('\n'))), "no name");
    }
}

TEST(Stl, ABinaryFileWithoutItsCountIsReadToItsEndAndSaid) {
    for (const std::string front : {"binary", "solid", "facet normal"}) {
        std::string bytes = binary_house(front);
        std::memset(bytes.data() + 80, 0, 4);
        const auto corners = read_stl(bytes, "house.stl");
        test::expect_house(mesh_of(corners), front);
        EXPECT_EQ(corners->notes, (std::vector<std::string>{"It states 0 facets; the 14 that are there were read."}));
        bytes.pop_back();
        error_of(bytes);
        bytes = binary_house(front);
        std::memset(bytes.data() + 80, 0xFF, 4);
        EXPECT_NE(error_of(bytes).find("states 4294967295 facets"), std::string::npos);
    }
}

TEST(Stl, LinesEndWithAnyOfThree) {
    for (const std::string end : {"\n", "\r\n", "\r", "\n\n"}) test::expect_house(read(text_house("0 0 0", end)), end);
    test::expect_house(read(text_house("0 0 0", " ")), "one line");
}

TEST(Stl, NormalsThatAreNoNumbersAreTakenFromTheTriangle) {
    for (const std::string normal : {"-nan(ind) -nan(ind) -nan(ind)", "nan nan nan", "NaN NaN NaN", "1.#QNAN 0 0",
                                     "-1.#IND00 0 0", "inf -inf inf", "1.#INF 0 0", "", "x y z", "1e999 0 0", "0 0"}) {
        const std::string house = text_house(normal);
        test::expect_house(read(house), normal);
        const Mesh mesh = read(house);
        for (const Vec3 n : mesh.corner_normals) EXPECT_NEAR(length(n), 1, 1e-3) << normal;
    }
    std::string one = text_house("0 0 1");
    one.replace(one.find("0 0 1"), 5, "-nan(ind) 0 0");
    const auto corners = read_stl(one, "house.stl");
    ASSERT_TRUE(corners.ok());
    EXPECT_EQ(corners->unusable_normals, 3u);
    EXPECT_NEAR(std::fabs(corners->normals[0].y), 1, 1e-6);  // the first triangle lies on the ground
}

TEST(Stl, NumbersAreReadInEveryUsualForm) {
    const std::string text =
        "solid\nfacet normal 0 0 1 outer loop\nvertex +.5 -0.0 1E0\nvertex 1.5e+00 .0 1.\nvertex 5e-1 1d 1\n"
        "endloop endfacet\nendsolid";
    EXPECT_NE(error_of(text).find("line 5 has \"1d\" in place of a coordinate"), std::string::npos) << error_of(text);
    std::string good = text;
    good.replace(good.find("1d"), 2, "1");
    const Mesh mesh = read(good);
    ASSERT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.positions[0], (Vec3{0.5f, 0, 1}));
    EXPECT_EQ(mesh.positions[1], (Vec3{1.5f, 0, 1}));
    EXPECT_EQ(mesh.positions[2], (Vec3{0.5f, 1, 1}));
}

TEST(Stl, BytesBehindTheLastFacetAreCounted) {
    for (const size_t count : {1u, 2u, 49u, 50u, 51u, 100u, 5000u}) {
        const auto corners = read_stl(binary_house() + std::string(count, 'x'), "house.stl");
        test::expect_house(mesh_of(corners), std::to_string(count));
        ASSERT_EQ(corners->notes.size(), 1u);
        EXPECT_EQ(corners->notes[0].rfind(std::to_string(count) + " byte", 0), 0u) << corners->notes[0];
    }
    const auto text = read_stl(text_house() + "\n\nsomething else\n", "house.stl");
    test::expect_house(mesh_of(text), "text");
    ASSERT_EQ(text->notes.size(), 1u);
    for (const std::string& behind : {std::string("\n \r\n\t"), std::string(10, '\0'), std::string("\x1a")})
        EXPECT_TRUE(read_stl(text_house() + behind, "house.stl")->notes.empty());
}

TEST(Stl, ABinaryFileMayBeginWithAnyWord) {
    for (const std::string front : {"solid", "solid house", "SOLID", " solid", "facet normal", "\xEF\xBB\xBF",
                                    "\xFF\xFE", "COLOR=\xFF\xFF\xFF\xFF,MATERIAL="}) {
        test::expect_house(read(binary_house(front)), front);
        test::expect_house(read(binary_house(front) + "behind"), front);
    }
    test::expect_house(read(binary_house("solid " + std::string(74, 'x')) + "behind"), "no zero byte in the name");
}

TEST(Stl, AFileThatIsCutOffIsRefused) {
    EXPECT_NE(error_of(binary_house("binary", 1)).find("states 15 facets, which need 834 bytes, but has 784"),
              std::string::npos);
    EXPECT_NE(error_of(binary_house().substr(0, 500)).find("cut off"), std::string::npos);
    const std::string house = text_house();
    for (const double share : {0.3, 0.45, 0.9, 0.99})  // none right behind a facet
        error_of(house.substr(0, static_cast<size_t>(share * static_cast<double>(house.size()))));
    EXPECT_NE(error_of("solid house\n").find("without its \"endsolid\""), std::string::npos);
    error_of("");
    error_of("what is this");
}

TEST(Stl, SeveralSolidsAndEmptyOnesAreOneMesh) {
    const std::string house = text_house();
    const size_t cut = house.find("  facet", house.size() / 2);
    test::expect_house(read("solid nothing\nendsolid nothing\n" + house.substr(0, cut) + "endsolid\nsolid b\n" +
                            house.substr(cut) + "\nsolid\nendsolid"),
                       "several");
}

TEST(Stl, ASolidMayBeCalledSolid) {
    const std::string house = text_house();
    const std::string facets = house.substr(house.find('\n') + 1, house.find("endsolid") - house.find('\n') - 1);
    for (const std::string name : {"solid b", "solid", "Solid facet"}) {
        test::expect_house(read("solid " + name + "\n" + facets + "endsolid " + name + "\n"), name);
        test::expect_house(read("solid " + name + "\n" + facets + "end solid " + name + "\nsolid " + name +
                                "\nendsolid " + name + "\n"),
                           "twice " + name);
    }
}

TEST(Stl, AFacetOfFourCornersIsCut) {
    const Mesh mesh = read(
        "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0.5 0.5 0\nvertex 0 2 0\nendloop\n"
        "endfacet\nendsolid\n");
    EXPECT_EQ(mesh.triangles.size(), 2u);
    double area = 0;
    for (const auto& t : mesh.triangles)
        area += 0.5 * length(cross(Vec3d(mesh.positions[t[1]] - mesh.positions[t[0]]),
                                   Vec3d(mesh.positions[t[2]] - mesh.positions[t[0]])));
    EXPECT_NEAR(area, 1, 1e-6);  // an arrow's head: a fan from its first corner would do, one from the second would not
}

TEST(Stl, DamagedFilesEndInAMeshOrASentence) {
    const auto reader = [](const std::string& bytes) { return read_stl(bytes, "house.stl"); };
    test::expect_meshes_or_sentences(text_house(), "house.stl", 4000, reader);
    test::expect_meshes_or_sentences(binary_house(), "house.stl", 4000, reader);
}

}  // namespace
}  // namespace cullet
