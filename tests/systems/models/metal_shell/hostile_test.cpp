// Meshes that nobody would make, and meshes of strangers: each cooks or is refused in a sentence, is thrown at a wall,
// keeps its mass and makes no number that is none (metal shell note, section 10).
#include <gtest/gtest.h>

#include <cmath>

#include "components/body_id.hpp"
#include "sample_game/import_model.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/metal/metal_bench.hpp"
#include "sample_game/props.hpp"
#include "tests/support/test_data.hpp"
#include "tests/systems/models/metal_shell/panels.hpp"

namespace cullet {
namespace {

template <class T>
T value_of(Result<T> result) {
    if (!result) ADD_FAILURE() << result.error(), std::abort();
    return std::move(result).value();
}

/// At a wall, 12 m/s; how deep it is dented.
double thrown(const Mesh& mesh, const Model& model) {
    const MeshExtent extent = extent_of(mesh);
    Settings settings;
    settings.gravity = {};
    settings.threads = 2;
    settings.units_a_frame = 2'000'000'000;
    World world = test::make_world(settings);
    Mesh wall = make_box({0.5f, 100, 100});
    for (Vec3& p : wall.positions) p = p + Vec3{extent.high.x + 0.55f, 0, 0};
    EXPECT_TRUE(world.add_static(test::view_of_mesh(wall)).ok());
    SpawnSettings spawn;
    spawn.motion = {{12, 0, 0}, {0.1f, 0.2f, 0}};
    const BodyId body = value_of(world.spawn(value_of(world.add_model(model)), spawn));
    const double mass = value_of(world.mass(body));
    for (int frame = 0; frame < 12; ++frame) world.step();
    EXPECT_EQ(test::state_of(world).validate(), "") << mesh.name;
    EXPECT_NEAR(value_of(world.mass(body)), mass, 1e-6 * mass) << mesh.name;
    return test::deepest(world, body);
}

Mesh two_far_apart() {
    Mesh mesh = test::box_mesh({0.3, 0.3, 0.3}, 6);
    test::append(mesh, test::box_mesh({0.3, 0.3, 0.3}, 6), {2, 0, 0});
    mesh.name = "two boxes far apart";
    return mesh;
}
Mesh three_at_an_edge() {
    Mesh mesh = metal_sheet(0.6, 0.6, 8, 8);
    Mesh upright = metal_sheet(0.6, 0.6, 8, 8);
    for (Vec3& p : upright.positions) p = {p.x, 0, p.y + 0.3f};
    test::append(mesh, upright, {0, 0, 0});
    mesh.name = "three faces at an edge";
    return mesh;
}
Mesh with_a_needle() {
    Mesh mesh = test::box_mesh({0.4, 0.4, 0.4}, 6);
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{0, 0, 0.5f}, {0.4f, 0, 0.5f}, {0.2f, 1e-5f, 0.5f}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.name = "a box and a needle";
    return mesh;
}
Mesh wound_both_ways() {
    Mesh mesh = metal_sheet(0.6, 0.6, 8, 8);
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
    mesh.name = "wound both ways";
    return mesh;
}
Mesh doubled() {
    Mesh mesh = metal_sheet(0.6, 0.6, 8, 8);
    test::append(mesh, metal_sheet(0.6, 0.6, 8, 8), {0, 0, 0.002});
    mesh.name = "two sheets on each other";
    return mesh;
}
Mesh one_face() {
    Mesh mesh;
    mesh.name = "one face";
    mesh.positions = {{0, 0, 0}, {0.5f, 0, 0}, {0, 0.5f, 0}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

TEST(HostileMetal, MeshesThatNobodyWouldMakeCrashAndKeepTheirMass) {
    for (const Mesh& mesh :
         {two_far_apart(), three_at_an_edge(), with_a_needle(), wound_both_ways(), doubled(), one_face()}) {
        const Result<Model> model = cook_metal_mesh(mesh, "steel", 1e-3, 0.2);
        if (!model.ok()) {
            EXPECT_EQ(model.error().back(), '.') << mesh.name << ": " << model.error();
            continue;
        }
        EXPECT_LT(thrown(mesh, *model), 2) << mesh.name;
    }
}

TEST(HostileMetal, SubShellsMoreThanFacesAndFewerThanPartsAreMended) {
    for (const Mesh& mesh : {two_far_apart(), one_face()})
        for (const uint32_t wanted : {1u, 24u}) {
            const Result<Model> model = cook_metal_mesh(mesh, "steel", 1e-3);
            if (!model.ok()) continue;
            MetalCookSettings settings;
            settings.cells.count = wanted;
            MetalBench bench(*model, &settings);
            EXPECT_GE(bench.view().cell_count(), mesh.triangles.size() > 1 ? 2u : 1u);
            EXPECT_LE(bench.view().cell_count(), bench.view().element_count());
        }
}

TEST(HostileMetal, ABlowWithoutMeasureIsLimitedAndWhatIsLeftIsSaid) {
    const Model model = cook_metal_mesh(metal_sheet(1.2, 0.8, 48, 32), "steel", 1e-3).value();
    for (const double energy : {1e6, 1e12, 1e18}) {
        MetalBench bench(model);
        bench.clamp();
        const Dent dent = bench.hit(bench.ball_over(0, 0, 0.145), energy);
        EXPECT_TRUE(dent.is_puncture);
        EXPECT_GT(dent.left, 0.9 * energy);
        EXPECT_TRUE(bench.is_finite());
        EXPECT_LT(-bench.lowest(), 0.3);
    }
    MetalBench box(cook_metal_mesh(test::box_mesh({0.4, 0.4, 0.4}, 10), "steel", 1e-3).value());
    Striker floor;
    floor.push = {0, 1, 0};
    const Dent crush = box.hit(floor, 1e12);
    EXPECT_NEAR(crush.depth, 0.12, 1e-3);
    EXPECT_GT(crush.left, 0.9e12);
    EXPECT_TRUE(box.is_finite());
}

TEST(HostileMetal, WhatPassesBesideLeavesNoDent) {
    const Model model = cook_metal_mesh(test::box_mesh({0.4, 0.4, 0.4}, 10), "steel", 1e-3).value();
    MetalBench bench(model);
    Striker pole;
    pole.shape = StrikerShape::Cylinder;
    pole.point = {5, 0, 5}, pole.push = {0, 1, 0}, pole.axis = {1, 0, 0}, pole.radius = 0.1;
    bench.hit(pole, 500);
    for (uint32_t v = 0; v < bench.view().vertex_count(); ++v) EXPECT_TRUE(bench.place(v) == bench.original(v));
}

TEST(HostileMetal, StrangersMeshesAreDentedByAWallAndKeepTheirMass) {
    CULLET_SKIP_WITHOUT_DATA();
    for (const char* name : {"old_van.gltf", "plate_holes.stl", "rover_1.glb", "steel_drum.ply", "toycar_body_26k.ply",
                             "truck_yellow.glb"}) {
        const std::filesystem::path file = test::test_data() / "metal_shell" / name;
        if (!std::filesystem::exists(file)) continue;
        Result<Mesh> mesh = import_model(file.string());
        ASSERT_TRUE(mesh.ok()) << name << ": " << mesh.error();
        ASSERT_TRUE(fit(*mesh, 3)) << name;
        mesh->name = name;
        const MeshExtent extent = extent_of(*mesh);
        const Result<Model> model =
            cook_metal_mesh(*mesh, "steel", 1e-3, 0.05 * double{length(extent.high - extent.low)});
        ASSERT_TRUE(model.ok()) << name << ": " << model.error();
        const double deep = thrown(*mesh, *model);
        const Workbench& rows = model->contents->state;
        EXPECT_GT(rows.metal_shells.crush_pressure[metal_of(rows, model->contents->shell)], 0) << name;
        EXPECT_GT(deep, 0.01) << name;
        EXPECT_LT(deep, 3) << name;
    }
}

}  // namespace
}  // namespace cullet
