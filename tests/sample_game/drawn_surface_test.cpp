// What a game draws is closed in every frame of quick breaks and of random ones, and its crack faces carry metres;
// scenes_test looks at the scenes.
#include <gtest/gtest.h>

#include "engine/random.hpp"
#include "sample_game/drawn_meshes.hpp"
#include "sample_game/game_world.hpp"
#include "sample_game/run_scene.hpp"
#include "tests/support/closed_view.hpp"
#include "tests/support/drawn_look.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

/// Plays a scene and looks at every frame.
void expect_closed(const Scene& scene, const RunOptions& options, uint32_t frames) {
    Result<GameWorld> game = GameWorld::create(plan_scene(scene, options));
    ASSERT_TRUE(game.ok()) << game.error();
    DrawnLook look;
    for (uint32_t frame = 0; frame < frames; ++frame) {
        ASSERT_EQ(look.at(game->world()), "") << "before frame " << frame;
        game->before_step();
        game->step();
        game->after_step();
    }
    ASSERT_EQ(look.at(game->world()), "") << "at the end";
    EXPECT_GT(look.with_cracks(), 0u);
    EXPECT_GE(look.looked_at(), game->sums().born);
}

TEST(DrawnSurface, OfQuickBodiesOfEachKindAndBothLayersIsClosedInEveryFrame) {
    for (const char* scene : {"wall", "vase"})
        for (const char* cracks : {"fine", "coarse", "large"})
            for (const char* layers : {"1", "2"}) {
                RunOptions options;
                options.scene = scene;
                options.threads = 2;
                options.set = {"scene.fracture=quick", std::string("scene.cracks=") + cracks,
                               std::string("scene.layers=") + layers};
                SCOPED_TRACE(options.scene + " " + cracks + " " + layers);
                expect_closed(*find_scene(scene), options, 70);
            }
}

// The drawn mesh of what is left is changed near the cracks alone there: each triangle is one that an element has,
// once, and none is of an element that left.
TEST(DrawnSurface, OfACastleHitOnCutOutsHasWhatIsLeftAndNothingElse) {
    for (const char* fracture : {"hidden", "quick"}) {
        RunOptions options;
        options.scene = "castle";
        options.threads = 2;
        options.set = {std::string("scene.fracture=") + fracture, "scene.cracks=coarse"};
        Result<GameWorld> game = GameWorld::create(plan_scene(*find_scene("castle"), options));
        ASSERT_TRUE(game.ok()) << game.error();
        DrawnMeshes drawn;
        for (uint32_t frame = 0; frame < 60; ++frame) {
            game->before_step();
            game->step();
            game->after_step();
            ASSERT_EQ(drawn.check_changed(game->world()), "") << fracture << ", frame " << frame;
        }
        EXPECT_GT(game->sums().born, 2u) << fracture;
    }
}

TEST(DrawnSurface, IsClosedThroughRandomBreaks) {
    const Random random{77};
    DrawnLook look;
    for (uint32_t run = 0; run < few_or_all(18u, 45u); ++run) {
        const auto speed = static_cast<float>(4 + 20 * random.uniform(run, 0));
        Settings settings = small_settings();
        settings.gravity = {0, -9.81f, 0};
        settings.units_a_frame = 20'000'000;
        Breakage b = run % 3 == 0   ? vase_and_ball(settings, speed)
                     : run % 3 == 1 ? wall_and_ball(settings, speed)
                                    : pane_and_ball(settings, speed);
        (void)add_floor(b.world);
        for (uint32_t frame = 0; frame < 50; ++frame) {
            b.world.step();
            ASSERT_EQ(look.at(b.world), "") << "run " << run << ", frame " << frame;
        }
    }
    EXPECT_GT(look.with_cracks(),
              few_or_all(15u, 40u));  // enough to have looked at; how many there are hangs on every bit
}

TEST(DrawnSurface, AMissingTriangleAndAMovedCornerAreFound) {
    World world = make_world(small_settings());
    const BodyId body = world.spawn(world.add_model(small_vase()).value()).value();
    BodyView view = world.view(body).value();
    EXPECT_EQ(find_open_edge(view), "");
    view.index_count -= 3;
    EXPECT_NE(find_open_edge(view).find("one way"), std::string::npos);
    view = world.view(body).value();
    std::vector<ViewVertex> vertices(view.vertices, view.vertices + view.vertex_count);
    vertices[view.indices[0]].position.x += 1e-6f;
    view.vertices = vertices.data();
    EXPECT_NE(find_open_edge(view).find("one way"), std::string::npos);
}

}  // namespace
}  // namespace cullet::test
