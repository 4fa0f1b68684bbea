// The house in every format, unit, axis and encoding, through the real import program.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <tuple>

#include "engine/mesh_file.hpp"
#include "tests/support/damage.hpp"
#include "tests/support/encodings.hpp"
#include "tests/support/house.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/small_zip.hpp"

namespace cullet {
namespace {

namespace fs = std::filesystem;

class ImportSiblings : public testing::Test {
 protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("import_siblings_test." + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string write(const std::string& name, const std::string& bytes) {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return folder_ / name;
    }
    /// The line that the program says; the house is expected.
    std::string import_house(const std::string& path, const std::string& what) {
        const std::string out = folder_ / "out.cmesh";
        const test::ProgramRun run = test::run_program({build_folder() + "/cullet_import", path, out});
        EXPECT_EQ(run.exit_code, 0) << what << ": " << run.error;
        const auto mesh = read_mesh_file(out);
        EXPECT_TRUE(mesh.ok()) << mesh.error();
        if (mesh) test::expect_house(*mesh, what);
        fs::remove(out);
        return run.output;
    }
    std::string import_refused(const std::string& path) {
        const test::ProgramRun run =
            test::run_program({build_folder() + "/cullet_import", path, folder_ / "out.cmesh"});
        EXPECT_EQ(run.exit_code, 2) << run.output;
        EXPECT_TRUE(!run.error.empty() && run.error.back() == '\n' &&
                    test::is_a_sentence(run.error.substr(0, run.error.size() - 1), path))
            << run.error;
        return run.error;
    }

    fs::path folder_;
};

/// Where the corners of the house stand in a file.
using Points = std::vector<Vec3d>;

std::string text_of(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", x);
    return text;
}

std::string list_of(const Points& points, const char* between) {
    std::string text;
    for (const Vec3d p : points)
        for (const double x : {p.x, p.y, p.z}) text += (text.empty() ? "" : between) + text_of(x);
    return text;
}

template <class Move>
Points moved(const Move& move) {
    Points points;
    for (const Vec3d p : test::house_points()) points.push_back(move(p));
    return points;
}

std::string obj() {
    std::string text;
    for (const Vec3d p : test::house_points())
        text += "v " + text_of(p.x) + " " + text_of(p.y) + " " + text_of(p.z) + "\n";
    for (const auto& t : test::house_triangles())
        text +=
            "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
    return text;
}

struct FbxSettings {
    int up = 1, up_sign = 1, front = 2, front_sign = 1, coord = 0, coord_sign = 1;
    double unit = 1;          // cm
    std::string models = "";  // of the node that holds the mesh
    std::string parents = "C: \"OO\",2001,0\n";
};

std::string fbx(const Points& points, const FbxSettings& s) {
    const auto setting = [](const char* name, const char* type, double value) {
        return std::string("P: \"") + name + "\", " + type + ", \"\"," + text_of(value) + "\n";
    };
    const char* const whole = "\"int\", \"Integer\"";
    std::string indices;
    for (const auto& t : test::house_triangles())
        indices += (indices.empty() ? "" : ",") + std::to_string(t[0]) + "," + std::to_string(t[1]) + "," +
                   std::to_string(-1 - t[2]);
    const std::string model =
        s.models.empty() ? "Model: 2001, \"Model::House\", \"Mesh\" {\nVersion: 232\n}\n" : s.models;
    return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\nFBXHeaderVersion: 1003\nFBXVersion: 7400\n}\n"
           "GlobalSettings:  {\nVersion: 1000\nProperties70:  {\n" +
           setting("UpAxis", whole, s.up) + setting("UpAxisSign", whole, s.up_sign) +
           setting("FrontAxis", whole, s.front) + setting("FrontAxisSign", whole, s.front_sign) +
           setting("CoordAxis", whole, s.coord) + setting("CoordAxisSign", whole, s.coord_sign) +
           setting("UnitScaleFactor", "\"double\", \"Number\"", s.unit) +
           "}\n}\nObjects:  {\nGeometry: 1001, \"Geometry::House\", \"Mesh\" {\nVertices: *27 {\na: " +
           list_of(points, ",") + "\n}\nPolygonVertexIndex: *42 {\na: " + indices + "\n}\nGeometryVersion: 124\n}\n" +
           model + "}\nConnections:  {\n" + s.parents + "C: \"OO\",1001,2001\n}\n";
}

Points in_fbx_axes(const FbxSettings& s) {
    return moved([&s](Vec3d p) {
        double q[3] = {};
        q[s.coord] = s.coord_sign * p.x, q[s.up] = s.up_sign * p.y, q[s.front] = s.front_sign * p.z;
        return (100 / s.unit) * Vec3d{q[0], q[1], q[2]};
    });
}

TEST_F(ImportSiblings, TheCasesThatWereMendedStayMended) {
    size_t count = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(source_folder()) / "tests/cases/import")) {
        const std::string name = entry.path().filename();
        if (name.rfind("gltf", 0) == 0 || name.rfind(".", 0) == 0) continue;
        import_house(entry.path(), name);
        ++count;
    }
    EXPECT_EQ(count, 10u);
}

TEST_F(ImportSiblings, AnFbxStandsUprightWhateverItsAxes) {
    double unit = 0.1;
    for (int up = 0; up < 3; ++up)
        for (int signs = 0; signs < 4; ++signs)
            for (int turn = 1; turn < 3; ++turn) {
                FbxSettings s;
                s.up = up, s.coord = (up + turn) % 3, s.front = 3 - s.up - s.coord;
                s.up_sign = (signs & 1) != 0 ? -1 : 1, s.coord_sign = (signs & 2) != 0 ? -1 : 1;
                // right x up = front: one way round for x, y, z in turn, the other way otherwise.
                s.front_sign = s.up_sign * s.coord_sign * (turn == 2 ? 1 : -1);
                s.unit = unit = unit > 1000 ? 0.1 : unit * 2.54;
                const std::string said = import_house(
                    write("house.fbx", fbx(in_fbx_axes(s), s)),
                    "up " + std::to_string(up) + " signs " + std::to_string(signs) + " turn " + std::to_string(turn));
                EXPECT_EQ(said.find("axis"), said.npos) << said;
            }
}

TEST_F(ImportSiblings, NodesInNodesOfAnFbxKeepUnitAndAxes) {
    FbxSettings s;
    s.up = 2, s.front = 1, s.front_sign = -1, s.unit = 2.54;
    s.models =
        "Model: 2002, \"Model::Outer\", \"Null\" {\nVersion: 232\nProperties70:  {\n"
        "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",10,20,30\n"
        "P: \"Lcl Rotation\", \"Lcl Rotation\", \"\", \"A\",0,0,90\n}\n}\n"
        "Model: 2001, \"Model::House\", \"Mesh\" {\nVersion: 232\nProperties70:  {\n"
        "P: \"Lcl Scaling\", \"Lcl Scaling\", \"\", \"A\",2,2,2\n}\n}\n";
    s.parents = "C: \"OO\",2002,0\nC: \"OO\",2001,2002\n";
    Points points = in_fbx_axes(s);
    for (Vec3d& p : points) {
        const Vec3d q = 0.5 * (p - Vec3d{10, 20, 30});
        p = {q.y, -q.x, q.z};  // a quarter turn back about z
    }
    import_house(write("house.fbx", fbx(points, s)), "nested");
}

TEST_F(ImportSiblings, AnFbxWhoseAxesOrUnitAreNoneSaysSo) {
    FbxSettings s;
    s.front = 1;
    EXPECT_NE(import_house(write("a.fbx", fbx(in_fbx_axes(FbxSettings{}), s)), "axes").find("not three different"),
              std::string::npos);
    s = {};
    s.unit = -1;
    EXPECT_NE(import_house(write("b.fbx", fbx(in_fbx_axes(FbxSettings{}), s)), "unit").find("is no length"),
              std::string::npos);
}

struct DaeSettings {
    double metre = 1;
    std::string up = "Y_UP", primitives, node_before, node_after, geometries, libraries;
    std::string unit;  // instead of metre, as it stands there
    int inputs = 1;    // 2: a texture coordinate beside each point
};

std::string dae(const Points& points, const DaeSettings& s) {
    std::string uvs;
    for (int i = 0; i < 9; ++i) uvs += "0." + std::to_string(i) + " 0.5 ";
    const auto source = [](const std::string& id, const std::string& values, int count, const std::string& names) {
        const int stride = static_cast<int>(names.size());
        std::string parameters;
        for (const char n : names) parameters += std::string("<param name=\"") + n + "\" type=\"float\"/>";
        return "<source id=\"" + id + "\"><float_array id=\"" + id + "-a\" count=\"" + std::to_string(count * stride) +
               "\">" + values + "</float_array><technique_common><accessor source=\"#" + id + "-a\" count=\"" +
               std::to_string(count) + "\" stride=\"" + std::to_string(stride) + "\">" + parameters +
               "</accessor></technique_common></source>";
    };
    return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<COLLADA "
           "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\"><asset><unit name=\"u\" meter=\"" +
           (s.unit.empty() ? text_of(s.metre) : s.unit) + "\"/><up_axis>" + s.up +
           "</up_axis></asset><library_geometries><geometry id=\"g\"><mesh>" +
           source("g-p", list_of(points, " "), 9, "XYZ") + source("g-t", uvs, 9, "ST") +
           "<vertices id=\"g-v\"><input semantic=\"POSITION\" source=\"#g-p\"/></vertices>" + s.primitives +
           "</mesh></geometry>" + s.geometries + "</library_geometries>" + s.libraries +
           "<library_visual_scenes><visual_scene id=\"s\">" + s.node_before +
           "<node id=\"n\"><instance_geometry url=\"#g\"/></node>" + s.node_after +
           "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
}

/// A primitive of that name: `lists` are its `p`, each corner as many numbers as there are inputs.
std::string primitive(const std::string& name, size_t count, const std::vector<std::vector<int>>& lists, int inputs = 1,
                      const std::string& counts = "") {
    std::string text = "<" + name + " count=\"" + std::to_string(count) +
                       "\"><input semantic=\"VERTEX\" source=\"#g-v\" offset=\"" + std::to_string(inputs - 1) + "\"/>";
    if (inputs == 2) text += "<input semantic=\"TEXCOORD\" source=\"#g-t\" offset=\"0\" set=\"0\"/>";
    text += counts;
    for (const auto& list : lists) {
        text += "<p>";
        for (const int v : list)
            text +=
                inputs == 2 ? std::to_string(v < 0 ? 0 : v) + " " + std::to_string(v) + " " : std::to_string(v) + " ";
        text += "</p>";
    }
    return text + "</" + name + ">";
}

std::vector<std::vector<int>> strips_apart() {
    std::vector<std::vector<int>> lists(1);
    for (const int n : test::house_strips())
        if (n < 0)
            lists.emplace_back();
        else
            lists.back().push_back(n);
    return lists;
}

const std::vector<std::vector<int>> kWalls{{0, 1, 2, 3}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
const std::vector<int> kRoof{8, 4, 7, 6, 5, 4};

TEST_F(ImportSiblings, StripsFansAndPolygonsOfColladaAreAllRead) {
    std::vector<int> walls;
    for (const auto& wall : kWalls) walls.insert(walls.end(), wall.begin(), wall.end());
    for (const int inputs : {1, 2}) {
        const std::string roof = primitive("trifans", 1, {kRoof}, inputs);
        const std::string all[] = {
            primitive("tristrips", 9, strips_apart(), inputs),
            primitive("tristrips", 1, {test::house_strips()}, inputs),  // -1 between
            primitive("polylist", 5, {walls}, inputs, "<vcount>4 4 4 4 4</vcount>") + roof,
            primitive("polygons", 5, kWalls, inputs) + roof,
            primitive("trifans", 5, kWalls, inputs) + roof,
            primitive("polygons", 5, kWalls, inputs) + primitive("trifans", 1, {{8, 4, 7, 6, -1, 8, 6, 5, 4}}, inputs),
            "<trifans count=\"0\"/>" + primitive("tristrips", 9, strips_apart(), inputs) + "<tristrips/>"};
        for (const std::string& primitives : all) {
            DaeSettings s;
            s.primitives = primitives;
            import_house(write("house.dae", dae(test::house_points(), s)), primitives);
        }
    }
}

TEST_F(ImportSiblings, ColladaComesInMetresAndUprightWithNodesInNodes) {
    DaeSettings s;
    s.primitives = primitive("trifans", 5, kWalls) + primitive("trifans", 1, {kRoof});
    s.node_before = "<node><translate>10 20 30</translate><rotate>0 0 1 90</rotate><node><scale>2 2 2</scale>";
    s.node_after = "</node></node>";
    for (const double metre : {0.01, 0.0254, 1.0})
        for (const std::string up : {"X_UP", "Y_UP", "Z_UP"}) {
            s.metre = metre, s.up = up;
            const Points points = moved([&](Vec3d p) {
                const Vec3d turned = up == "X_UP" ? Vec3d{p.y, -p.x, p.z} : up == "Z_UP" ? Vec3d{p.x, -p.z, p.y} : p;
                const Vec3d q = 0.5 * ((1 / metre) * turned - Vec3d{10, 20, 30});
                return Vec3d{q.y, -q.x, q.z};
            });
            import_house(write("house.dae", dae(points, s)), up + " " + text_of(metre));
        }
}

// assimp takes what it does not know for y.
TEST_F(ImportSiblings, TheUpAxisOfColladaIsOneOfThreeHoweverItIsSpelled) {
    DaeSettings s;
    s.primitives = primitive("trifans", 5, kWalls) + primitive("trifans", 1, {kRoof});
    for (const std::string up : {"z_up", " Z_UP ", "Z_up"}) {
        s.up = up;
        const Points points = moved([](Vec3d p) { return Vec3d{p.x, -p.z, p.y}; });
        import_house(write("house.dae", dae(points, s)), up);
    }
    for (const std::string up : {"W_UP", "up", ""}) {
        s.up = up;
        EXPECT_NE(
            import_refused(write("house.dae", dae(test::house_points(), s))).find("its up axis is \"" + up + "\""),
            std::string::npos)
            << up;
    }
}

TEST_F(ImportSiblings, WhatAnFbxOrObjHoldsAndNoMeshWillIsSaid) {
    const FbxSettings s;
    std::string text = fbx(in_fbx_axes(s), s);
    const size_t unit = text.find("P: \"UnitScaleFactor\"");
    text.erase(unit, text.find('\n', unit) - unit);
    EXPECT_NE(import_house(write("a.fbx", text), "unit").find("names no unit"), std::string::npos);
    text = fbx(in_fbx_axes(s), s);
    text.insert(text.find("Geometry: 1001"), "Geometry: 1002, \"Geometry::Bent\", \"NurbsSurface\" {\nVersion: 1\n}\n");
    EXPECT_NE(import_house(write("b.fbx", text), "NURBS").find("curved surfaces were left out"), std::string::npos);
    for (const char* name : {"NurbsCurve", "Patch", "TrimNurbsSurface", "Boundary"}) {
        text = fbx(in_fbx_axes(s), s);
        text.insert(text.find("Geometry: 1001"),
                    std::string("Geometry: 1002, \"Geometry::Bent\", \"") + name + "\" {\nVersion: 1\n}\n");
        EXPECT_NE(import_house(write("b.fbx", text), name).find("curved surfaces were left out"), std::string::npos);
    }
    EXPECT_NE(import_house(write("c.obj", obj() + "cstype bspline\nsurf 0 1 0 1 1 2 3 4\nend\n"), "surf")
                  .find("1 curve or curved surface was left out"),
              std::string::npos);
}

TEST_F(ImportSiblings, WhatColladaHoldsAndNoMeshWillIsSaid) {
    DaeSettings s;
    std::string walls = primitive("polygons", 5, {kWalls.begin(), kWalls.end() - 1});
    walls.insert(walls.rfind("</polygons>"), "<ph><p>3 7 4 0</p><h>0 1 2</h></ph>");
    s.primitives = walls + primitive("trifans", 1, {kRoof});
    EXPECT_NE(
        import_house(write("h.dae", dae(test::house_points(), s)), "hole").find("1 polygon came without the holes"),
        std::string::npos);
    s.primitives = primitive("trifans", 5, kWalls) + primitive("trifans", 1, {kRoof});
    s.node_before = "<node><instance_node url=\"other.dae#x\"/></node>";
    EXPECT_NE(import_house(write("u.dae", dae(test::house_points(), s)), "url").find("1 mesh or node of other files"),
              std::string::npos);
    s.primitives = primitive("trifans", 1, {{8, 4, 99, 6}});
    import_refused(write("w.dae", dae(test::house_points(), s)));
    s.primitives = primitive("tristrips", 1, {{8, 4, -7, 6}});
    EXPECT_NE(import_refused(write("n.dae", dae(test::house_points(), s))).find("names vertex \"-7\""),
              std::string::npos);
}

DaeSettings fan_house() {
    DaeSettings s;
    s.primitives = primitive("trifans", 5, kWalls) + primitive("trifans", 1, {kRoof});
    return s;
}

TEST_F(ImportSiblings, SkewsOfColladaAreLeftOutAndSaidWhereverTheyStand) {
    const std::string skew = "<skew sid=\"s\">45 0 1 0 1 0 0</skew>";
    const std::tuple<std::string, std::string, std::string> all[] = {
        {"<node>" + skew, "</node>", "1 skew of nodes was left out"},
        {"<node>" + skew + "</node>", "", "1 skew of nodes was left out"},
        {"<node><skew/><translate>0 0 0</translate><skew></skew>", "</node>", "2 skews of nodes were left out"},
        {"<node><node>" + skew + "<scale>1 1 1</scale></node></node>", "<node>" + skew + "</node>", "2 skews"}};
    for (const auto& [before, after, note] : all) {
        DaeSettings s = fan_house();
        s.node_before = before, s.node_after = after;
        EXPECT_NE(import_house(write("house.dae", dae(test::house_points(), s)), before).find(note), std::string::npos)
            << before;
    }
    DaeSettings s = fan_house();
    s.libraries = "<library_nodes><node id=\"unused\">" + skew + "</node></library_nodes>";
    EXPECT_NE(import_house(write("house.dae", dae(test::house_points(), s)), "library").find("1 skew"),
              std::string::npos);
}

TEST_F(ImportSiblings, WhatAColladaNamesInOtherFilesOrNowhereIsSaid) {
    for (const char* kind : {"geometry", "controller", "node"})
        for (const auto& [url, note] : std::vector<std::pair<std::string, std::string>>{
                 {"other.dae#x", "1 mesh or node of other files was left out"},
                 {"file:///x.dae#g", "1 mesh or node of other files was left out"},
                 {"#nope", "1 mesh or node that is named but not in the file was left out"}}) {
            DaeSettings s = fan_house();
            const std::string tag = std::string("instance_") + kind;
            s.node_before = "<node><" + tag + " url=\"" + url + "\"><bind_material/></" + tag + "></node>";
            EXPECT_NE(import_house(write("house.dae", dae(test::house_points(), s)), tag + url).find(note),
                      std::string::npos)
                << tag << url;
            s.node_before = "<node><" + tag + " url=\"" + url + "\"/></node>";
            import_house(write("house.dae", dae(test::house_points(), s)), tag + url);
        }
}

TEST_F(ImportSiblings, GeometriesOfColladaThatAreNoMeshAreSaid) {
    for (const auto& [body, note] : std::vector<std::pair<std::string, std::string>>{
             {"<spline closed=\"1\"/>", "1 spline was left out"},
             {"<convex_mesh convex_hull_of=\"#g\"/>", "1 convex_mesh was left out"},
             {"<brep/>", "1 brep was left out"}}) {
        DaeSettings s = fan_house();
        s.geometries = "<geometry id=\"o\">" + body + "</geometry>";
        EXPECT_NE(import_house(write("house.dae", dae(test::house_points(), s)), body).find(note), std::string::npos)
            << body;
    }
}

TEST_F(ImportSiblings, AUnitOfColladaThatIsNoLengthIsRefused) {
    for (const std::string unit : {"0", "-1", "nan", "inf", "1e300", "metre"}) {
        DaeSettings s = fan_house();
        s.unit = unit;
        EXPECT_NE(import_refused(write("house.dae", dae(test::house_points(), s)))
                      .find("its unit is \"" + unit + "\" m, which is no length"),
                  std::string::npos);
    }
}

/// Two joints in nodes of their own, every point on both; the mesh is bound a hundred times as large, and its own node
/// stands elsewhere.
DaeSettings skinned_house(const std::string& joint_places, bool has_uvs) {
    DaeSettings s;
    const auto floats = [](const std::string& id, const std::string& values, int count, int stride,
                           const std::string& type) {
        return "<source id=\"" + id + "\"><float_array id=\"" + id + "-a\" count=\"" + std::to_string(count * stride) +
               "\">" + values + "</float_array><technique_common><accessor source=\"#" + id + "-a\" count=\"" +
               std::to_string(count) + "\" stride=\"" + std::to_string(stride) + "\"><param name=\"P\" type=\"" + type +
               "\"/></accessor></technique_common></source>";
    };
    s.primitives = primitive("trifans", 5, kWalls, has_uvs ? 2 : 1) + primitive("trifans", 1, {kRoof}, has_uvs ? 2 : 1);
    std::string counts, influences;
    for (int p = 0; p < 9; ++p) counts += "2 ", influences += "0 0 1 1 ";
    // The inverse places of joints at (10, 0, 0) and (0, -5, 2).
    s.libraries =
        "<library_controllers><controller id=\"c\"><skin source=\"#g\"><bind_shape_matrix>0.01 0 0 0 0 0.01 0 0 0 0 "
        "0.01 0 0 0 0 1</bind_shape_matrix><source id=\"c-j\"><Name_array id=\"c-j-a\" count=\"2\">first "
        "second</Name_array><technique_common><accessor source=\"#c-j-a\" count=\"2\" stride=\"1\"><param "
        "name=\"JOINT\" type=\"name\"/></accessor></technique_common></source>" +
        floats("c-b", "1 0 0 -10 0 1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 0 1 0 5 0 0 1 -2 0 0 0 1", 2, 16, "float4x4") +
        floats("c-w", "0.25 0.75", 2, 1, "float") +
        "<joints><input semantic=\"JOINT\" source=\"#c-j\"/><input semantic=\"INV_BIND_MATRIX\" "
        "source=\"#c-b\"/></joints><vertex_weights count=\"9\"><input semantic=\"JOINT\" source=\"#c-j\" "
        "offset=\"0\"/><input semantic=\"WEIGHT\" source=\"#c-w\" offset=\"1\"/><vcount>" +
        counts + "</vcount><v>" + influences + "</v></vertex_weights></skin></controller></library_controllers>";
    s.node_before = joint_places;
    return s;
}

std::string joint(const std::string& name, const std::string& move) {
    return "<node id=\"" + name + "\" sid=\"" + name + "\" name=\"" + name + "\" type=\"JOINT\"><translate>" + move +
           "</translate></node>";
}

TEST_F(ImportSiblings, SkinsOfColladaStandAsTheirJointsRest) {
    std::string text = dae(moved([](Vec3d p) { return 100 * p; }),
                           skinned_house(joint("first", "10 0 0") + joint("second", "0 -5 2"), false));
    const std::string instance = "<instance_geometry url=\"#g\"/>";
    text.replace(text.find(instance), instance.size(), "<translate>7 7 7</translate><instance_controller url=\"#c\"/>");
    EXPECT_EQ(import_house(write("bound.dae", text), "as bound").find("stand"), std::string::npos);

    // The first joint has moved by (4, 0, 0): a quarter of that is the house's.
    std::string posed = text;
    posed.replace(posed.find("10 0 0</translate>"), 6, "14 0 0");
    posed.replace(posed.find("0.01 0 0 0 0 0.01"), 10, "0.01 0 0 -1");
    import_house(write("posed.dae", posed), "posed");

    std::string lost = text;
    lost.replace(lost.find("second</Name_array>"), 6, "gone");
    const test::ProgramRun run =
        test::run_program({build_folder() + "/cullet_import", write("lost.dae", lost), folder_ / "lost.cmesh"});
    EXPECT_NE(run.output.find("2 meshes with bones stand as modelled"), run.output.npos)  // one a primitive
        << run.output << run.error;
}

TEST_F(ImportSiblings, SkinsOfFbxStandAsTheirBonesRest) {
    FbxSettings s;
    s.models =
        "Model: 2001, \"Model::House\", \"Mesh\" {\nVersion: 232\nProperties70:  {\n"
        "P: \"Lcl Scaling\", \"Lcl Scaling\", \"\", \"A\",2,2,2\n}\n}\n"
        "Model: 2002, \"Model::Bone\", \"LimbNode\" {\nVersion: 232\nProperties70:  {\n"
        "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",10,20,30\n}\n}\n"
        "Deformer: 3001, \"Deformer::\", \"Skin\" {\nVersion: 101\n}\n"
        "Deformer: 3002, \"SubDeformer::\", \"Cluster\" {\nVersion: 100\nIndexes: *9 {\na: 0,1,2,3,4,5,6,7,8\n}\n"
        "Weights: *9 {\na: 1,1,1,1,1,1,1,1,1\n}\nTransform: *16 {\na: 2,0,0,0,0,2,0,0,0,0,2,0,-60,-20,-30,1\n}\n"
        "TransformLink: *16 {\na: 1,0,0,0,0,1,0,0,0,0,1,0,60,20,30,1\n}\n}\n";
    s.parents = "C: \"OO\",2001,0\nC: \"OO\",2002,0\nC: \"OO\",3001,1001\nC: \"OO\",3002,3001\nC: \"OO\",2002,3002\n";
    // Bound with the bone at x = 60 cm, which rests at 10: all points have moved by -50.
    const Points points = moved([](Vec3d p) { return 0.5 * (100 * p + Vec3d{50, 0, 0}); });
    EXPECT_EQ(import_house(write("skin.fbx", fbx(points, s)), "posed").find("stand"), std::string::npos);
}

/// Sets of texture coordinates beyond the first, with the same numbers.
TEST_F(ImportSiblings, FurtherTextureCoordinatesAreSaid) {
    DaeSettings s;
    s.primitives = primitive("trifans", 5, kWalls, 2) + primitive("trifans", 1, {kRoof}, 2);
    EXPECT_EQ(import_house(write("one.dae", dae(test::house_points(), s)), "one").find("texture"), std::string::npos);
    const std::string input = "<input semantic=\"TEXCOORD\" source=\"#g-t\" offset=\"0\" set=\"0\"/>";
    for (size_t at = s.primitives.find(input); at != s.primitives.npos; at = s.primitives.find(input, at + 200))
        s.primitives.insert(at, "<input semantic=\"TEXCOORD\" source=\"#g-t\" offset=\"0\" set=\"1\"/>");
    EXPECT_NE(import_house(write("two.dae", dae(test::house_points(), s)), "two")
                  .find("1 further set of texture coordinates was left out"),
              std::string::npos);
}

std::string amf(double scale, const std::string& unit) {
    std::string text = "<?xml version=\"1.0\"?><amf" + unit + "><object id=\"0\"><mesh><vertices>";
    for (const Vec3d p : test::house_points())
        text += "<vertex><coordinates><x>" + text_of(scale * p.x) + "</x><y>" + text_of(scale * p.y) + "</y><z>" +
                text_of(scale * p.z) + "</z></coordinates></vertex>";
    text += "</vertices><volume>";
    for (const auto& t : test::house_triangles())
        text += "<triangle><v1>" + std::to_string(t[0]) + "</v1><v2>" + std::to_string(t[1]) + "</v2><v3>" +
                std::to_string(t[2]) + "</v3></triangle>";
    return text + "</volume></mesh></object></amf>";
}

std::string x3d(double metres) {
    std::string indices;
    for (const auto& t : test::house_triangles())
        for (const int v : {t[0], t[1], t[2], -1}) indices += std::to_string(v) + " ";
    const std::string unit = metres == 1 ? "" : "<unit category=\"length\" name=\"u\" conversionFactor=\"0.01\"/>";
    return "<?xml version=\"1.0\"?><X3D version=\"3.3\"><head>" + unit +
           "</head><Scene><Shape><IndexedFaceSet coordIndex=\"" + indices + "\"><Coordinate point=\"" +
           list_of(moved([&](Vec3d p) { return (1 / metres) * p; }), " ") +
           "\"/></IndexedFaceSet></Shape></Scene></X3D>";
}

TEST_F(ImportSiblings, BlanksBeforeXmlAndZerosBehindItDoNoHarm) {
    DaeSettings s;
    s.primitives = primitive("tristrips", 9, strips_apart());
    const std::string all[] = {"house.dae", "house.amf", "house.x3d"};
    const std::string texts[] = {dae(test::house_points(), s), amf(1000, ""), x3d(1)};
    for (size_t i = 0; i < 3; ++i)
        for (const auto& [front, behind] :
             std::vector<std::pair<std::string, std::string>>{{"\n", ""},
                                                              {" \r\n\t", "\n\n"},
                                                              {"", std::string(5, '\0')},
                                                              {"\xEF\xBB\xBF\n", std::string("\n\0\x1a", 3)}})
            import_house(write(all[i], front + texts[i] + behind), all[i]);
    const std::string wide = test::coded("\n" + texts[0] + "\n\n", test::Encoding::Utf16Little);
    import_house(write("house.dae", wide + std::string(4, '\0')), "UTF-16");
}

/// A mark makes a text three bytes longer, a zero before each ".5" one: three of them leave its length as it was.
TEST_F(ImportSiblings, AMarkedObjIsReadHoweverManyNumbersBeginWithTheirPoint) {
    const auto with_points = [](size_t count) {
        std::string text = obj();
        for (size_t i = 0; i < count; ++i) text += "vt .5 0.5\n";
        return text;
    };
    for (size_t count = 1; count < 6; ++count)
        for (const auto encoding : test::kEncodings)
            import_house(write("house.obj", test::coded(with_points(count), encoding)), std::to_string(count));
}

TEST_F(ImportSiblings, AnObjMayHaveCommentsBehindItsLines) {
    for (const std::string comment : {" # of the roof", " #1 2 3", "\t#", "   # .5 \xC3\xA4"})
        for (const std::string end : {"\n", "\r\n"}) {
            std::string text;
            for (const char c : obj()) text += c == '\n' ? comment + end : std::string(1, c);
            import_house(write("house.obj", text), comment);
        }
}

std::string off() {
    std::string text = "OFF\n9 14 0\n";
    for (const Vec3d p : test::house_points()) text += text_of(p.x) + " " + text_of(p.y) + " " + text_of(p.z) + "\n";
    for (const auto& t : test::house_triangles())
        text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
    return text;
}

std::string stl() {
    std::string text = "solid house\n";
    for (const auto& t : test::house_triangles()) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const int v : t) {
            const Vec3d p = test::house_points()[static_cast<size_t>(v)];
            text += "vertex " + text_of(p.x) + " " + text_of(p.y) + " " + text_of(p.z) + "\n";
        }
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid house\n";
}

std::string ply() {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\nproperty float "
        "z\nelement face 14\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Vec3d p : test::house_points()) text += text_of(p.x) + " " + text_of(p.y) + " " + text_of(p.z) + "\n";
    for (const auto& t : test::house_triangles())
        text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
    return text;
}

TEST_F(ImportSiblings, ColladaMayBePackedInAZip) {
    DaeSettings s;
    s.primitives = primitive("trifans", 5, kWalls) + primitive("trifans", 1, {kRoof});
    const std::string model = dae(test::house_points(), s);
    import_house(write("house.zae", test::small_zip({{"manifest.xml", "<x/>"}, {"a/house.DAE", model}})), "packed");
    EXPECT_NE(import_house(write("two.zae", test::small_zip({{"a.dae", model}, {"b.dae", model}})), "two")
                  .find("Of 2 models"),
              std::string::npos);
    import_refused(write("none.zae", test::small_zip({{"a.txt", model}})));
    import_refused(write("none.zae", "no zip"));
}

TEST_F(ImportSiblings, NamesOfColladaMayBeOfAnyEncodingOrNoXmlAtAll) {
    DaeSettings s;
    s.primitives = primitive("trifans", 5, kWalls) + primitive("trifans", 1, {kRoof});
    s.node_before = "<node name=\"T\xfcr\"/>";
    import_house(write("house.dae", dae(test::house_points(), s)), "Latin-1 that calls itself UTF-8");
    std::string utf16 = dae(test::house_points(), s);
    utf16.replace(utf16.find("utf-8"), 5, "utf-16");
    import_house(write("house.dae", utf16), "declared to be UTF-16");
    std::vector<int> triangles;
    for (const auto& t : test::house_triangles()) triangles.insert(triangles.end(), t.begin(), t.end());
    s.primitives = primitive("triangles", 14, {triangles});
    s.node_before = "<node name=\"a & b\"/>";
    import_house(write("house.dae", dae(test::house_points(), s)), "a bare &");
}

TEST_F(ImportSiblings, AmfAndX3dComeInMetres) {
    for (const auto& [unit, metres] : std::vector<std::pair<std::string, double>>{
             {"micron", 1e-6}, {"millimeter", 1e-3}, {"inch", 0.0254}, {"feet", 0.3048}, {"meter", 1}})
        import_house(write("house.amf", amf(1 / metres, " unit=\"" + unit + "\"")), unit);
    import_house(write("house.amf", amf(1000, "")), "millimetres when it says nothing");
    EXPECT_NE(import_refused(write("house.amf", amf(1, " unit=\"ell\""))).find("its unit is \"ell\""),
              std::string::npos);
    EXPECT_NE(
        import_house(write("packed.amf", test::small_zip({{"packed.amf", amf(1000, "")}})), "packed").find("closed"),
        std::string::npos);
    EXPECT_NE(import_refused(write("packed.amf", test::small_zip({{"a.txt", "x"}}))).find("no .amf file is in it"),
              std::string::npos);
    // The house at the first place of a constellation: assimp 5.2 takes what turns an instance for a way.
    const auto instance = [](const std::string& what) { return "<instance objectid=\"0\">" + what + "</instance>"; };
    for (const auto& [inside, note] : std::vector<std::pair<std::string, std::string>>{
             {instance("<deltax>-5000</deltax><deltay>0</deltay>"), ""},
             {instance("<deltax>-5000</deltax><rx>0</rx><ry/><rz>0.0</rz>"), ""},
             {instance("<deltax>-5000</deltax><rz>90</rz>"), "1 instance of a constellation is turned"},
             {instance("<rx>-45</rx><deltax>-5000</deltax><ry> 1e1 </ry>"),
              "1 instance of a constellation is turned"}}) {
        std::string placed = amf(1000, "");
        for (size_t at = placed.find("<x>"); at != placed.npos; at = placed.find("<x>", at + 3)) {
            const size_t end = placed.find("</x>", at);
            placed.replace(at + 3, end - at - 3, text_of(5000 + std::stod(placed.substr(at + 3, end - at - 3))));
        }
        placed.insert(placed.rfind("</amf>"), "<constellation id=\"1\">" + inside + "</constellation>");
        const std::string said = import_house(write("house.amf", placed), inside);
        EXPECT_EQ(said.find("turned in the file") == said.npos, note.empty()) << said;
        EXPECT_NE(said.find(note), said.npos) << said;
    }
    for (const double metres : {1.0, 0.01}) import_house(write("house.x3d", x3d(metres)), "x3d");
}

TEST_F(ImportSiblings, TextOfEveryFormatMayBeInAnyEncoding) {
    DaeSettings d;
    d.primitives = primitive("trifans", 5, kWalls) + primitive("trifans", 1, {kRoof});
    FbxSettings f;
    const std::pair<std::string, std::string> all[] = {{"house.obj", "mtllib house.mtl\nusemtl a\n" + obj()},
                                                       {"house.off", off()},
                                                       {"house.stl", stl()},
                                                       {"house.ply", ply()},
                                                       {"house.dae", dae(test::house_points(), d)},
                                                       {"house.fbx", fbx(in_fbx_axes(f), f)}};
    for (const auto encoding : test::kEncodings) {
        write("house.mtl", test::coded("newmtl a\nKd 1 0 0\n", encoding));
        for (const auto& [name, text] : all)
            import_house(write(name, test::coded(text, encoding)),
                         name + " " + std::to_string(static_cast<int>(encoding)));
    }
    for (const auto& [name, text] : all)
        import_house(write(name, test::coded(text, test::Encoding::Utf16Big).substr(2)), name + " without a mark");
}

}  // namespace
}  // namespace cullet
