// What is woven into a cloth stays where it was while the cloth moves.
#include "sample_game/unmoved.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sample_game/model_shelf.hpp"

namespace cullet {
namespace {

std::vector<BodyId> bodies_of(const World& world) {
    std::vector<BodyId> ids(world.bodies(nullptr, 0));
    world.bodies(ids.data(), static_cast<uint32_t>(ids.size()));
    return ids;
}

TEST(Unmoved, ClothThatFellHasThePlacesOfTheClothThatWasHung) {
    ScenePlan plan;
    plan.scene = {"cloth", "cloth.lua",
                  "local cloth = game.cook{mesh = game.mesh.pane{side = 0.6, edge = 0.05}, material = 'cloth', "
                  "thickness = 0.001}\n"
                  "game.spawn{cooked = cloth, at = {0, 1, 0}, turn = {axis = {1, 0, 0}, angle = 1.57}, "
                  "pins = {{low = {-1, -0.1, -1}, high = {1, 0.03, 1}}}}\n"
                  "game.throw{radius = 0.1, mass = 1, at = {0, 1.4, 0.3}, velocity = {0, -4, 0}}"};
    plan.shelf = std::make_shared<ModelShelf>();
    plan.threads = 1;
    Result<GameWorld> made = GameWorld::create(plan);
    ASSERT_TRUE(made.ok()) << made.error();
    GameWorld& game = *made;
    BodyId cloth;
    for (const BodyId id : bodies_of(game.world()))
        if (const Result<BodyView> view = game.world().view(id); view.ok() && view->index_count > 0) cloth = id;
    ASSERT_TRUE(cloth);
    Unmoved unmoved;
    unmoved.remember(game);
    const std::vector<Vec3> before = unmoved.of(cloth, *game.world().view(cloth));
    ASSERT_FALSE(before.empty());
    for (int frame = 0; frame < 40; ++frame) {
        unmoved.remember(game);
        game.before_step(), game.step(), game.after_step();
    }
    const BodyView view = *game.world().view(cloth);
    float most = 0;
    const std::vector<Vec3> after = unmoved.of(cloth, view);
    ASSERT_EQ(after.size(), before.size());
    for (uint32_t v = 0; v < view.vertex_count; ++v)
        most = std::max(most, length(view.vertices[v].position - after[v]));
    EXPECT_GT(most, 0.02f);  // it did move
    for (const uint32_t r : {0u, 1u})
        for (uint32_t i = view.runs[r].first_index; i < view.runs[r].first_index + view.runs[r].index_count; ++i)
            ASSERT_EQ(after[view.indices[i]], before[view.indices[i]]);
}

TEST(Unmoved, OfOtherThingsNothingIsRemembered) {
    EXPECT_TRUE(Unmoved().of(BodyId{3, 1}, BodyView()).empty());
}

}  // namespace
}  // namespace cullet
