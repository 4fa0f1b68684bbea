// Meshes that model both of their walls become one sheet as thick as measured.
#include "systems/structures/shell/cook/join_walls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "sample_game/props.hpp"
#include "systems/cook/model_contents.hpp"
#include "tests/support/plain_reader.hpp"
#include "tests/support/shell_checks.hpp"
#include "tests/support/simple_meshes.hpp"
#include "tests/support/test_data.hpp"

namespace cullet {
namespace {

/// A cup of radius 1, 1.2 high, with this wall; its lip is flat.
Mesh cup(double wall) {
    const auto inside = static_cast<float>(1 - wall), floor = static_cast<float>(wall);
    std::vector<Vec2> profile{{0, 0}};
    for (int k = 1; k <= 10; ++k) profile.push_back({0.1f * static_cast<float>(k), 0});
    for (int k = 1; k <= 12; ++k) profile.push_back({1, 0.1f * static_cast<float>(k)});
    for (int k = 12; k >= 1; --k) profile.push_back({inside, floor + (1.2f - floor) * static_cast<float>(k) / 12});
    for (int k = 10; k >= 1; --k) profile.push_back({inside * 0.1f * static_cast<float>(k), floor});
    profile.push_back({0, floor});
    return test::lathe_mesh(profile, 40);
}

struct Joined {
    Surface surface;
    Extrusion shell;
    JoinedWalls walls;
    double volume = 0;  // m3, of all elements
};

std::optional<Joined> joined(const Mesh& mesh, double thickness) {
    const Result<Surface> whole = prepare_surface(mesh);
    EXPECT_TRUE(whole) << whole.error();
    std::optional<JoinedWalls> walls = join_walls(*whole, mesh, thickness);
    if (!walls) return {};
    const Result<Surface> outer = prepare_surface(walls->outer);
    EXPECT_TRUE(outer) << outer.error();
    const InnerSkin skin = skin_for(*walls, *outer);
    const Result<Extrusion> shell = extrude(*outer, thickness, {}, &skin);
    EXPECT_TRUE(shell) << shell.error();
    Joined result{*outer, *shell, std::move(*walls)};
    for (const Triangle& c : outer->triangles) {
        std::array<Vec3d, 3> out, in;
        for (size_t k = 0; k < 3; ++k)
            out[k] = outer->positions[c[k]], in[k] = out[k] + shell->depth[c[k]] * shell->direction[c[k]];
        result.volume += prism_tetrahedra(out, in, c).total();
    }
    return result;
}

double volume_of(const Mesh& mesh) {
    double volume = 0;
    for (const auto& t : mesh.triangles)
        volume += dot(Vec3d(mesh.positions[t[0]]), cross(Vec3d(mesh.positions[t[1]]), Vec3d(mesh.positions[t[2]]))) / 6;
    return volume;
}

TEST(JoinWalls, ACupBecomesASoundSheetWithTheVolumeBetweenItsSkinsWhateverThicknessWasAskedFor) {
    for (const double wall : {0.03, 0.06, 0.1}) {
        const Mesh mesh = cup(wall);
        for (const double asked : {0.55 * wall, wall, 1.7 * wall}) {
            SCOPED_TRACE(std::to_string(wall) + " m, asked for " + std::to_string(asked));
            const std::optional<Joined> one = joined(mesh, asked);
            ASSERT_TRUE(one);
            const test::ShellReport report = test::check_shell(one->surface, one->shell, 4 * wall);
            EXPECT_TRUE(report.is_sound()) << report;
            EXPECT_NEAR(one->walls.volume, volume_of(mesh), 1e-6);
            EXPECT_NEAR(one->volume / volume_of(mesh), 1, 0.02);
            EXPECT_EQ(one->surface.border_loops.size(), 2u);  // the lip
            EXPECT_EQ(one->surface.components.size(), 1u);
        }
    }
}

TEST(JoinWalls, TheInnerPointsOfACupLieOnItsInnerWall) {
    const double wall = 0.06;
    const std::optional<Joined> one = joined(cup(wall), wall);
    ASSERT_TRUE(one);
    for (uint32_t v = 0; v < one->surface.positions.size(); ++v) {
        const Vec3d p = one->surface.positions[v] + one->shell.depth[v] * one->shell.direction[v];
        const double to_axis = std::sqrt(p.x * p.x + p.z * p.z);
        // 40 sides: the wall lies up to 0.3 % of the radius inside the circle.
        const double off = std::min(std::fabs(to_axis - (1 - wall)), std::fabs(p.y - wall));
        EXPECT_LT(off, 0.004) << "vertex " << v;
    }
}

TEST(JoinWalls, AHollowBallWhoseInsideIsAPartOfItsOwnBecomesOneSheet) {
    Mesh mesh = test::sphere_mesh(1, 3);
    test::append(mesh, test::turned_inside_out(test::sphere_mesh(0.95, 3)));
    const std::optional<Joined> one = joined(mesh, 0.05);
    ASSERT_TRUE(one);
    EXPECT_EQ(one->walls.parts, 1u);
    EXPECT_EQ(one->surface.triangles.size(), mesh.triangles.size() / 2);
    EXPECT_NEAR(one->volume / volume_of(mesh), 1, 0.01);
    for (const double d : one->shell.depth) EXPECT_NEAR(d, 0.05, 0.001);
}

TEST(JoinWalls, ASlabBecomesOneOfItsFacesAsThickAsItIs) {
    const Mesh mesh = test::box_mesh({1, 1, 0.04}, 20);
    const std::optional<Joined> one = joined(mesh, 0.03);
    ASSERT_TRUE(one);
    EXPECT_EQ(one->surface.triangles.size(), 2u * 20 * 20);
    for (const double d : one->shell.depth) EXPECT_NEAR(d, 0.04, 1e-6);
}

TEST(JoinWalls, SheetsFiguresRodsAndBricksStayAsTheyAre) {
    EXPECT_FALSE(joined(cup(0.1), 0.045));  // its walls are more than two thicknesses apart
    EXPECT_FALSE(joined(test::sheet_mesh(1, 1, 10, 10), 0.05));
    EXPECT_FALSE(joined(test::sphere_mesh(1, 3), 0.05));
    EXPECT_FALSE(joined(test::torus_mesh(1, 0.05, 120, 12), 0.05));  // a rod's opposite is itself
    EXPECT_FALSE(joined(test::box_mesh({0.24, 0.071, 0.115}, 6), 0.1));
    EXPECT_FALSE(joined(test::box_mesh({1, 1, 1}, 4), 0.05));
}

TEST(JoinWalls, AnyNumberingGivesTheSameSheet) {
    const Mesh mesh = cup(0.06);
    const std::optional<Joined> one = joined(mesh, 0.05);
    ASSERT_TRUE(one);
    for (const uint64_t seed : {1ull, 2ull}) {
        const std::optional<Joined> other = joined(test::shuffled(mesh, seed), 0.05);
        ASSERT_TRUE(other);
        EXPECT_EQ(other->surface.triangles, one->surface.triangles);
        EXPECT_EQ(other->shell.depth, one->shell.depth);
    }
}

Model cooked(const Mesh& mesh, float thickness, bool joins) {
    CookSettings settings;
    settings.thickness = thickness;
    settings.thick_shell.joins_walls = joins;
    settings.thick_shell.measures_threshold = false;
    Result<Model> model = cook(view_of(mesh), settings);
    EXPECT_TRUE(model.ok()) << model.error();
    return model.ok() ? *model : Model{};
}

double density_of(const Model& model) {
    const Workbench& state = model.contents->state;
    return double{state.materials.density[state.structures.material[model.contents->shell]]};
}

TEST(JoinWalls, ACookedCupWeighsWhatTheSolidBetweenItsSkinsDoesAndSaysSo) {
    const Mesh mesh = test::scaled(cup(0.06), 0.1);
    const Model model = cooked(mesh, 0.005f, true);
    ASSERT_TRUE(model.contents);
    EXPECT_NEAR(model.report().mass / (density_of(model) * volume_of(mesh)), 1, 0.03);
    EXPECT_NEAR(model.report().mean_thickness, 0.006, 0.0003);
    EXPECT_NE(model.report().walls.find("Both walls of 1 part"), std::string::npos) << model.report().walls;
}

TEST(JoinWalls, SwitchedOffEachWallOfTheCupIsASheetOfItsOwnOfHalfTheThickness) {
    const Mesh mesh = test::scaled(cup(0.06), 0.1);
    const Model model = cooked(mesh, 0.005f, false);
    ASSERT_TRUE(model.contents);
    EXPECT_TRUE(model.report().walls.empty());
    EXPECT_NEAR(model.report().mean_thickness, 0.003, 0.0003);
}

TEST(JoinWalls, TheVaseAndTheBowlOfTheDataWeighWhatTheirSolidsDo) {
    CULLET_SKIP_WITHOUT_DATA();
    for (const auto& [name, thickness] : {std::pair("vase_thick.ply", 0.005f), std::pair("bowl.ply", 0.004f)}) {
        const Mesh mesh = test::read_plain(test::test_data() / "thick_shell" / name);
        const Model model = cooked(mesh, thickness, true);
        ASSERT_TRUE(model.contents);
        EXPECT_NEAR(model.report().mass / (density_of(model) * volume_of(mesh)), 1, 0.03) << name;
        EXPECT_NEAR(model.report().mean_thickness, double{thickness}, 0.1 * double{thickness}) << name;
        EXPECT_NE(model.report().walls.find("Both walls of 1 part"), std::string::npos) << name;
    }
}

}  // namespace
}  // namespace cullet
