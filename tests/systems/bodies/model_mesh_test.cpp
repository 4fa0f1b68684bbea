// Intact bodies show the mesh of their model; what cracks gets one of its own.
#include "systems/bodies/model_mesh.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

struct Shelf {
    World world;
    ModelId model;
    std::vector<BodyId> vases;
};

/// Vases in mid-air, a metre from each other; a ball flies at the first.
Shelf shelf_of(uint32_t count) {
    Settings settings = small_settings();
    settings.units_a_frame = 100'000'000;
    Shelf shelf{make_world(settings), {}, {}};
    shelf.model = shelf.world.add_model(small_vase()).value();
    for (uint32_t k = 0; k < count; ++k) {
        SpawnSettings vase;
        vase.pose.position = {static_cast<float>(k), 0, 0};
        shelf.vases.push_back(shelf.world.spawn(shelf.model, vase).value());
    }
    (void)shelf.world.add_sphere(ball_at({0.01f, 0.13f, 0}, 0.3f, 8)).value();
    return shelf;
}

uint32_t rows_taken(World& world) {
    const RangePool& pool = state_of(world).view_vertices.pool;
    uint32_t rows = 0;
    for (uint32_t row = 0; row < pool.end(); ++row) rows += pool.is_taken(row, 1);
    return rows;
}

TEST(ModelMesh, OfAHundredIntactBodiesThereIsOneMesh) {
    Shelf shelf = shelf_of(1);
    const uint32_t of_one = rows_taken(shelf.world);
    EXPECT_GT(of_one, 1000u);
    shelf = shelf_of(100);
    EXPECT_EQ(rows_taken(shelf.world), of_one);
    const BodyView first = shelf.world.view(shelf.vases[0]).value();
    for (const BodyId id : shelf.vases) {
        const BodyView view = shelf.world.view(id).value();
        EXPECT_EQ(view.vertices, first.vertices);
        EXPECT_EQ(view.indices, first.indices);
        EXPECT_EQ(view.vertex_count, first.vertex_count);
        EXPECT_EQ(view.run_count, first.run_count);
        EXPECT_EQ(view.model, shelf.model);
    }
}

TEST(ModelMesh, WhatBreaksGetsRowsOfItsOwnAndTheOthersShowWhatTheyShowed) {
    Shelf shelf = shelf_of(3);
    const BodyView before = shelf.world.view(shelf.vases[1]).value();
    const std::vector<ViewVertex> shown(before.vertices, before.vertices + before.vertex_count);
    ASSERT_GT(step_until_born(shelf.world, 60), 0u);
    const BodyView broken = shelf.world.view(shelf.vases[0]).value();
    EXPECT_FALSE(broken.model);
    EXPECT_NE(broken.vertices, before.vertices);
    for (uint32_t k = 1; k < 3; ++k) {
        const BodyView after = shelf.world.view(shelf.vases[k]).value();
        EXPECT_EQ(after.model, shelf.model);
        EXPECT_EQ(after.stamp, before.stamp);
        ASSERT_EQ(after.vertices, before.vertices);
        for (uint32_t v = 0; v < after.vertex_count; ++v)
            ASSERT_EQ(length(after.vertices[v].position - shown[v].position), 0) << v;
    }
}

TEST(ModelMesh, ItStaysUntilItsModelAndItsLastBodyAreGone) {
    Shelf shelf = shelf_of(2);
    EXPECT_TRUE(shelf.world.remove_model(shelf.model).ok());
    const BodyView view = shelf.world.view(shelf.vases[0]).value();
    EXPECT_FALSE(view.model);  // nothing names it any more
    EXPECT_GT(view.index_count, 0u);
    const ModelId again = shelf.world.add_model(small_vase()).value();
    const BodyId third = shelf.world.spawn(again, {}).value();
    EXPECT_EQ(shelf.world.view(third).value().model, again);
    EXPECT_FALSE(shelf.world.view(shelf.vases[0]).value().model);
    for (const BodyId id : shelf.vases) EXPECT_TRUE(shelf.world.remove(id).ok());
    EXPECT_TRUE(shelf.world.remove(third).ok());
    EXPECT_GT(rows_taken(shelf.world), 0u);
    EXPECT_TRUE(shelf.world.remove_model(again).ok());
    EXPECT_EQ(rows_taken(shelf.world), 0u);
}

TEST(ModelMesh, ASnapshotHoldsItOnce) {
    Shelf few = shelf_of(2), many = shelf_of(102);
    const std::filesystem::path folder = testing::TempDir();
    const std::string of_few = folder / "model_mesh_few.csnap", of_many = folder / "model_mesh_many.csnap";
    ASSERT_TRUE(few.world.save(of_few).ok());
    ASSERT_TRUE(many.world.save(of_many).ok());
    // The rigid world has hulls of its own for every body, 190 KB each: they are alike, and a packed file has them once.
    EXPECT_LT(std::filesystem::file_size(of_many) - std::filesystem::file_size(of_few), 100 * 2'000u);
    EXPECT_LT(std::filesystem::file_size(of_many), many.world.snapshot()->size() / 10);
    World loaded = make_world(small_settings());
    ASSERT_TRUE(loaded.load(of_many).ok());
    EXPECT_EQ(loaded.hash(), many.world.hash());
    EXPECT_EQ(rows_taken(loaded), rows_taken(many.world));
    EXPECT_EQ(loaded.view(many.vases[7]).value().model, many.model);
    for (int frame = 0; frame < 30; ++frame) {
        loaded.step();
        many.world.step();
        ASSERT_EQ(loaded.hash(), many.world.hash()) << frame;
    }
}

}  // namespace
}  // namespace cullet::test
