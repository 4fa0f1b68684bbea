#include "engine/import/ply.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "tests/support/damage.hpp"
#include "tests/support/house.hpp"

namespace cullet {
namespace {

enum class Form { Text, Little, Big };
constexpr Form kForms[] = {Form::Text, Form::Little, Form::Big};

/// Writes rows in one of the three forms.
struct Ply {
    Form form;
    std::string head, rows;

    explicit Ply(Form f) : form(f) {
        head = std::string("ply\nformat ") +
               (f == Form::Text     ? "ascii"
                : f == Form::Little ? "binary_little_endian"
                                    : "binary_big_endian") +
               " 1.0\ncomment made by a test\n";
    }
    Ply& element(const std::string& name, size_t rows_of) {
        head += "element " + name + " " + std::to_string(rows_of) + "\n";
        return *this;
    }
    Ply& property(const std::string& line) {
        head += "property " + line + "\n";
        return *this;
    }
    template <class T>
    Ply& value(T v) {
        if (form == Form::Text) {
            rows += std::to_string(v) + " ";
            return *this;
        }
        std::string bytes(sizeof v, '\0');
        std::memcpy(bytes.data(), &v, sizeof v);
        if (form == Form::Big) std::reverse(bytes.begin(), bytes.end());
        rows += bytes;
        return *this;
    }
    Ply& end_row() {
        if (form == Form::Text) rows += "\n";
        return *this;
    }
    Ply& house_vertices() {
        element("vertex", 9).property("float x").property("float y").property("float z");
        for (const Vec3d p : test::house_points())
            value(static_cast<float>(p.x)).value(static_cast<float>(p.y)).value(static_cast<float>(p.z)).end_row();
        return *this;
    }
    template <class Count, class Number>
    Ply& list(const std::vector<int>& numbers) {
        value(static_cast<Count>(numbers.size()));
        for (const int n : numbers) value(static_cast<Number>(n));
        return end_row();
    }
    std::string bytes() const { return head + "end_header\n" + rows; }
};

Mesh mesh_of(const Result<Corners>& corners) {
    EXPECT_TRUE(corners.ok()) << corners.error();
    if (!corners) return {};
    Corners copy = *corners;
    return joined_model(std::move(copy), "house.ply").mesh;
}

Mesh read(const Ply& ply) {
    return mesh_of(read_ply(ply.bytes(), "house.ply"));
}

std::string error_of(const std::string& bytes) {
    const auto corners = read_ply(bytes, "house.ply");
    EXPECT_FALSE(corners.ok());
    if (corners) return "";
    EXPECT_TRUE(test::is_a_sentence(corners.error(), "house.ply")) << corners.error();
    return corners.error();
}

template <class Count, class Number>
Ply strips(Form form, const std::string& count, const std::string& number, const std::vector<int>& numbers,
           const std::string& element = "tristrips") {
    Ply ply(form);
    ply.house_vertices().element(element, 1).property("list " + count + " " + number + " vertex_indices");
    return ply.list<Count, Number>(numbers);
}

TEST(Ply, StripsAreReadInEveryFormAndTypeOfNumber) {
    const auto& numbers = test::house_strips();
    for (const Form form : kForms) {
        const std::string what = std::to_string(static_cast<int>(form));
        test::expect_house(read(strips<int32_t, int32_t>(form, "int", "int", numbers)), what + " int");
        test::expect_house(read(strips<uint8_t, int16_t>(form, "uchar", "short", numbers)), what + " short");
        test::expect_house(read(strips<uint16_t, int8_t>(form, "ushort", "char", numbers)), what + " char");
        test::expect_house(read(strips<uint32_t, uint32_t>(form, "uint32", "uint32", numbers)), what + " uint");
        test::expect_house(read(strips<int8_t, uint16_t>(form, "int8", "uint16", numbers)), what + " ushort");
        test::expect_house(read(strips<int16_t, uint8_t>(form, "int16", "uint8", numbers)), what + " uchar");
    }
}

TEST(Ply, StripsMayBeRowsOfTheirOwnAndRestartAnywhere) {
    std::vector<std::vector<int>> rows(1);
    for (const int n : test::house_strips())
        if (n < 0)
            rows.emplace_back();
        else
            rows.back().push_back(n);
    for (const Form form : kForms) {
        Ply ply(form);
        ply.house_vertices().element("tristrips", rows.size()).property("list uchar int vertex_index");
        for (const auto& row : rows) ply.list<uint8_t, int32_t>(row);
        test::expect_house(read(ply), "a row each");
    }
    std::vector<int> odd{-1, -1};
    for (const int n : test::house_strips()) {
        odd.push_back(n);
        if (n < 0) odd.push_back(-1);
    }
    odd.push_back(-1);
    test::expect_house(read(strips<int32_t, int32_t>(Form::Text, "int", "int", odd)), "-1 twice");
}

TEST(Ply, StripsJoinedByRepeatedNumbersAreOneStrip) {
    // From strip to strip the last number and the next one are repeated, once more where the turn must change.
    std::vector<int> joined;
    size_t begin = 0;
    const auto& all = test::house_strips();
    for (size_t i = 0; i <= all.size(); ++i) {
        if (i < all.size() && all[i] >= 0) continue;
        if (!joined.empty()) {
            joined.push_back(joined.back());
            joined.push_back(all[begin]);
            if (joined.size() % 2 == 1) joined.push_back(all[begin]);
        }
        joined.insert(joined.end(), all.begin() + static_cast<std::ptrdiff_t>(begin),
                      all.begin() + static_cast<std::ptrdiff_t>(i));
        begin = i + 1;
    }
    const auto corners = read_ply(strips<int32_t, int32_t>(Form::Little, "int", "int", joined).bytes(), "house.ply");
    test::expect_house(mesh_of(corners), "joined");
    EXPECT_EQ(corners->collapsed, 0u);
}

TEST(Ply, FansAreReadBesideStripsAndFaces) {
    for (const Form form : kForms) {
        Ply ply(form);
        ply.house_vertices();
        ply.element("face", 2).property("list uchar int vertex_indices");
        ply.list<uint8_t, int32_t>({0, 1, 2, 3}).list<uint8_t, int32_t>({0, 4, 5, 1});
        ply.element("tristrips", 1).property("list uchar int vertex_indices");
        ply.list<uint8_t, int32_t>({1, 5, 2, 6, 3, 7, 0, 4});
        ply.element("trifans", 1).property("list uchar int vertex_indices");
        ply.list<uint8_t, int32_t>({8, 4, 7, 6, -1, 8, 6, 5, 4});
        test::expect_house(read(ply), "mixed");
    }
}

TEST(Ply, PolygonsOfAnyShapeAreCut) {
    Ply quads(Form::Big);
    quads.house_vertices().element("face", 9).property("list uint ushort vertex_index");
    for (const auto& face : std::vector<std::vector<int>>{{0, 1, 2, 3},
                                                          {0, 4, 5, 1},
                                                          {1, 5, 6, 2},
                                                          {2, 6, 7, 3},
                                                          {3, 7, 4, 0},
                                                          {4, 7, 8},
                                                          {7, 6, 8},
                                                          {6, 5, 8},
                                                          {5, 4, 8}})
        quads.list<uint32_t, uint16_t>(face);
    test::expect_house(read(quads), "quads");

    // A star of five teeth, in a plane of its own.
    Ply star(Form::Text);
    star.element("vertex", 10).property("double y").property("double x").property("double z");
    std::vector<int> ring;
    double wanted = 0;
    for (int i = 0; i < 10; ++i) {
        const double radius = i % 2 == 0 ? 1 : 0.3, angle = 0.62831853 * i;
        star.value(radius * std::sin(angle)).value(radius * std::cos(angle)).value(radius * std::cos(angle)).end_row();
        ring.push_back(i);
        wanted += 0.5 * 0.3 * std::sin(0.62831853) * std::sqrt(2.0);
    }
    star.element("face", 1).property("list uchar int vertex_indices").list<uint8_t, int>(ring);
    const Mesh mesh = read(star);
    EXPECT_EQ(mesh.triangles.size(), 8u);
    double area = 0;
    for (const auto& t : mesh.triangles)
        area += 0.5 * length(cross(Vec3d(mesh.positions[t[1]] - mesh.positions[t[0]]),
                                   Vec3d(mesh.positions[t[2]] - mesh.positions[t[0]])));
    EXPECT_NEAR(area, wanted, 1e-5);
}

TEST(Ply, NormalsAndTextureCoordinatesAreRead) {
    for (const Form form : kForms) {
        Ply ply(form);
        ply.element("vertex", 3).property("uchar red").property("double x").property("short y").property("float z");
        ply.property("list uchar int others").property("float nx").property("float ny").property("float nz");
        ply.property("float s").property("float t");
        for (int i = 0; i < 3; ++i) {
            ply.value(uint8_t{200}).value(i == 1 ? 2.0 : 0.0).value(int16_t(i == 2 ? 3 : 0)).value(0.0f);
            ply.value(uint8_t{1})
                .value(int32_t{7})
                .value(0.0f)
                .value(0.0f)
                .value(2.0f)
                .value(0.25f * static_cast<float>(i))
                .value(1.0f);
            ply.end_row();
        }
        ply.element("face", 1).property("uchar flags").property("list uchar int vertex_indices");
        ply.property("list uchar float texcoord").value(uint8_t{1}).value(uint8_t{3});
        for (const int v : {0, 1, 2}) ply.value(int32_t{v});
        ply.value(uint8_t{0}).end_row();
        const Mesh mesh = read(ply);
        ASSERT_EQ(mesh.corner_normals.size(), 3u);
        for (const Vec3 n : mesh.corner_normals) EXPECT_EQ(n, (Vec3{0, 0, 1}));
        ASSERT_EQ(mesh.corner_uvs.size(), 3u);
        EXPECT_EQ(mesh.corner_uvs[2].x, 0.5f);
        EXPECT_EQ(mesh.positions[2], (Vec3{0, 3, 0}));
    }
}

TEST(Ply, WhatIsNotReadIsNamed) {
    Ply ply = strips<int32_t, int32_t>(Form::Little, "int", "int", test::house_strips());
    ply.element("edge", 1).property("int vertex1").property("int vertex2").value(int32_t{0}).value(int32_t{1});
    ply.element("camera", 2).property("float view").property("list uchar float more");
    ply.value(1.0f).value(uint8_t{1}).value(2.0f).value(1.0f).value(uint8_t{0});
    ply.rows += "left";
    const auto corners = read_ply(ply.bytes(), "house.ply");
    test::expect_house(mesh_of(corners), "more");
    EXPECT_EQ(corners->left_out, 1u);
    ASSERT_EQ(corners->notes.size(), 2u);
    EXPECT_EQ(corners->notes[0], "2 rows of the element \"camera\" went unread.");
    EXPECT_EQ(corners->notes[1], "4 bytes behind the last row went unread.");
}

/// 255 and 65535 begin a strip only where -1 becomes them; in wider types they are vertices that are not there.
TEST(Ply, AStripBeginsAnewByTheNumberOfItsOwnTypeAlone) {
    for (const int number : {255, 65535}) {
        std::vector<int> numbers;
        for (const int n : test::house_strips()) numbers.push_back(n < 0 ? number : n);
        const std::string named = "names vertex " + std::to_string(number) + ", but there are 9";
        for (const Form form : kForms) {
            EXPECT_NE(error_of(strips<int32_t, int32_t>(form, "int", "int", numbers).bytes()).find(named),
                      std::string::npos);
            EXPECT_NE(error_of(strips<int32_t, uint32_t>(form, "int", "uint", numbers).bytes()).find(named),
                      std::string::npos);
        }
    }
    std::vector<int> numbers;
    for (const int n : test::house_strips()) numbers.push_back(n < 0 ? 255 : n);
    test::expect_house(read(strips<int32_t, uint8_t>(Form::Little, "int", "uchar", numbers)), "uchar");
    error_of(strips<int32_t, uint16_t>(Form::Little, "int", "ushort", numbers).bytes());
    error_of(strips<int32_t, int16_t>(Form::Little, "int", "short", numbers).bytes());
}

TEST(Ply, ValuesBeyondTheHeadInALineAreSaid) {
    Ply ply = strips<int32_t, int32_t>(Form::Text, "int", "int", test::house_strips());
    std::string rows;
    for (const char c : ply.rows) rows += c == '\n' ? std::string(" 0.5 7\n") : std::string(1, c);
    ply.rows = rows;
    const auto corners = read_ply(ply.bytes(), "house.ply");
    test::expect_house(mesh_of(corners), "two more columns");
    ASSERT_EQ(corners->notes.size(), 2u);
    EXPECT_EQ(corners->notes[0],
              "9 lines of \"vertex\" hold more values than the head names; the last ones went unread.");
    EXPECT_EQ(corners->notes[1],
              "1 line of \"tristrips\" holds more values than the head names; the last ones went unread.");
}

TEST(Ply, VerticesMayBeNamedByFloatsThatAreWhole) {
    for (const Form form : kForms) {
        const auto corners =
            read_ply(strips<int32_t, float>(form, "int", "float", test::house_strips()).bytes(), "house.ply");
        test::expect_house(mesh_of(corners), "floats");
        ASSERT_EQ(corners->notes.size(), 1u);
        EXPECT_NE(corners->notes[0].find("of a type with fractions"), std::string::npos) << corners->notes[0];
    }
    Ply ply(Form::Text);
    ply.house_vertices().element("face", 1).property("list uchar float vertex_indices");
    ply.rows += "3 0 1.5 2\n";
    EXPECT_NE(error_of(ply.bytes()).find("names vertex 1.5"), std::string::npos);
}

TEST(Ply, PropertiesThatAreNotReadAreNamedAndColoursAreNot) {
    Ply ply(Form::Text);
    ply.element("vertex", 3).property("float x").property("float y").property("float z").property("float quality");
    ply.property("float nx").property("uchar red").property("uchar diffuse_green").property("uchar alpha");
    ply.rows += "0 0 0 1 1 9 9 9\n1 0 0 1 1 9 9 9\n0 1 0 1 1 9 9 9\n";
    ply.element("face", 1).property("list uchar int vertex_indices").property("float nx").property("int texnumber");
    ply.property("list uchar float texcoord").property("uchar blue");
    ply.rows += "3 0 1 2 0 4 2 0.5 0.5 9\n";
    const auto corners = read_ply(ply.bytes(), "house.ply");
    ASSERT_TRUE(corners.ok()) << corners.error();
    ASSERT_EQ(corners->notes.size(), 3u);
    EXPECT_EQ(corners->notes[0], "Of \"vertex\" the properties \"quality\", \"nx\" went unread.");
    EXPECT_EQ(corners->notes[1], "Of \"face\" the properties \"nx\", \"texnumber\" went unread.");
    EXPECT_EQ(corners->notes[2], "The texture coordinates of 1 face are not as many as the corners and went unread.");
}

TEST(Ply, MaterialsOfFacesAreTheirNumbersAndNoneIsTheNumberAfterTheLast) {
    for (const Form form : kForms) {
        Ply ply(form);
        ply.house_vertices().element("face", 3).property("list uchar int vertex_indices");
        ply.property("int material_index");
        for (const int material : {4, -1, 0}) {
            for (const int n : {0, 1, 2}) {
                if (n == 0) ply.value(uint8_t{3});
                ply.value(int32_t{n});
            }
            ply.value(int32_t{material}).end_row();
        }
        EXPECT_EQ(read(ply).materials, (std::vector<uint16_t>{4, 5, 0}));
    }
    Ply ply(Form::Text);
    ply.house_vertices().element("face", 1).property("list uchar int vertex_indices").property("int material_index");
    ply.rows += "3 0 1 2 65535\n";
    EXPECT_NE(error_of(ply.bytes()).find("has material 65535"), std::string::npos);
}

TEST(Ply, LinesOfTheHeadEndWithAnyOfThree) {
    for (const Form form : kForms)
        for (const std::string end : {"\n", "\r\n", "\r"}) {
            const Ply ply = strips<int32_t, int32_t>(form, "int", "int", test::house_strips());
            std::string head;
            for (const char c : ply.head + "end_header\n") head += c == '\n' ? end : std::string(1, c);
            test::expect_house(mesh_of(read_ply(head + ply.rows, "house.ply")), end);
            test::expect_house(mesh_of(read_ply("\xEF\xBB\xBF" + head + ply.rows, "house.ply")), "mark");
        }
}

TEST(Ply, WhatDoesNotFitItsHeadIsRefused) {
    const auto with = [](const std::vector<int>& numbers, const std::string& element) {
        return error_of(strips<int32_t, int32_t>(Form::Big, "int", "int", numbers, element).bytes());
    };
    EXPECT_NE(with({0, 1, 9}, "tristrips").find("names vertex 9, but there are 9"), std::string::npos);
    EXPECT_NE(with({0, 1, -2, 3}, "tristrips").find("names vertex -2"), std::string::npos);
    EXPECT_NE(with({0, 1, 2, -1}, "face").find("names vertex -1"), std::string::npos);
    Ply cut = strips<int32_t, int32_t>(Form::Big, "int", "int", test::house_strips());
    cut.rows.resize(cut.rows.size() - 1);
    error_of(cut.bytes());
    for (const std::string row : {"0 0\n", "0\n0 0 5\n", "0 0 x\n"}) {
        Ply text = strips<int32_t, int32_t>(Form::Text, "int", "int", test::house_strips());
        text.rows.replace(0, text.rows.find('\n') + 1, row);
        EXPECT_NE(error_of(text.bytes()).find("row 0 of \"vertex\" is not as its head says"), std::string::npos) << row;
    }
    for (const char* head :
         {"", "ply\n", "ply\nformat ascii 1.0\n", "ply\nend_header\n", "ply\nformat utf8 1.0\nend_header\n",
          "ply\nformat ascii 1.0\nelement vertex -1\nend_header\n",
          "ply\nformat ascii 1.0\nproperty float x\nend_header\n",
          "ply\nformat ascii 1.0\nelement vertex 1\nproperty word x\nend_header\n",
          "ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\nend_header\n1 1\n",
          "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n1\n",
          "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"})
        error_of(head);
}

TEST(Ply, DamagedFilesEndInAMeshOrASentence) {
    for (const Form form : kForms)
        test::expect_meshes_or_sentences(strips<int32_t, int32_t>(form, "int", "int", test::house_strips()).bytes(),
                                         "house.ply", 4000,
                                         [](const std::string& bytes) { return read_ply(bytes, "house.ply"); });
}

}  // namespace
}  // namespace cullet
