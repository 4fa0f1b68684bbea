// What a game draws is closed in every frame of every scene and of random breaks, and its crack faces carry metres.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "engine/random.hpp"
#include "sample_game/drawn_meshes.hpp"
#include "sample_game/game_world.hpp"
#include "sample_game/run_scene.hpp"
#include "tests/support/closed_view.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

/// Looks at each body whose drawn mesh is another than at the last call.
class Looking {
 public:
    uint32_t looked_at = 0, with_cracks = 0;

    void look(const World& world, const std::string& when) {
        for (const BodyId id : all_bodies(world)) {
            const Result<BodyView> view = world.view(id);
            if (!view.ok() || view->index_count == 0) continue;
            uint32_t& stamp = stamps_[{id.index, id.generation}];
            if (stamp == view->stamp + 1) continue;
            stamp = view->stamp + 1;
            ++looked_at;
            ASSERT_EQ(find_open_edge(*view), "") << when << ", body " << id.index;
            expect_metres_on_cracks(*view, when);
        }
    }

 private:
    /// u is the way along the crack and v the depth below the outer face, both in m, as the positions have them.
    void expect_metres_on_cracks(const BodyView& view, const std::string& when) {
        for (uint32_t r = 0; r < view.run_count; ++r) {
            if (view.runs[r].kind != SurfaceKind::Crack) continue;
            ++with_cracks;
            for (uint32_t i = view.runs[r].first_index; i < view.runs[r].first_index + view.runs[r].index_count; ++i) {
                const ViewVertex& a = view.vertices[view.indices[i]];
                const ViewVertex& b = view.vertices[view.indices[i % 3 == 2 ? i - 2 : i + 1]];
                ASSERT_GE(a.uv.x, 0) << when;
                ASSERT_GE(a.uv.y, 0) << when;
                const float way = length(b.position - a.position);
                if (a.uv.y == 0 && b.uv.y == 0) {
                    ASSERT_NEAR(std::fabs(b.uv.x - a.uv.x), way, 1e-5f * (1 + a.uv.x)) << when;
                }
                if (a.uv.x == b.uv.x) {
                    ASSERT_NEAR(std::fabs(b.uv.y - a.uv.y), way, 2e-6f) << when;
                }
            }
        }
    }

    std::map<std::pair<uint32_t, uint32_t>, uint32_t> stamps_;
};

/// The others dent, flow and tear: what shows cracks there is what tears.
bool is_brittle(const Scene& scene) {
    const std::string name = scene.name;
    return name != "rubber" && name != "steel" && name != "cloth" && name != "tear";
}

/// Plays a scene and looks at every frame.
void expect_closed(const Scene& scene, const RunOptions& options, uint32_t frames) {
    Result<GameWorld> game = GameWorld::create(plan_scene(scene, options));
    ASSERT_TRUE(game.ok()) << game.error();
    Looking looking;
    for (uint32_t frame = 0; frame < frames; ++frame) {
        looking.look(game->world(), "before frame " + std::to_string(frame));
        if (testing::Test::HasFatalFailure()) return;
        game->before_step();
        game->step();
        game->after_step();
    }
    looking.look(game->world(), "at the end");
    if (is_brittle(scene)) {
        EXPECT_GT(looking.with_cracks, 0u);
    }
    EXPECT_GE(looking.looked_at, game->sums().born);
}

class EachDrawnScene : public testing::TestWithParam<Scene> {};

TEST_P(EachDrawnScene, IsClosedInEveryFrame) {
    RunOptions options;
    options.scene = GetParam().name;
    options.threads = 2;
    expect_closed(GetParam(), options, 120);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EachDrawnScene, testing::ValuesIn(scenes().begin(), scenes().end()),
                         [](const auto& scene) { return scene.param.name; });

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
    Looking looking;
    for (uint32_t run = 0; run < 45; ++run) {
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
            looking.look(b.world, "run " + std::to_string(run) + ", frame " + std::to_string(frame));
            if (HasFatalFailure()) return;
        }
    }
    EXPECT_GT(looking.with_cracks, 40u);  // enough to have looked at; how many there are hangs on every bit
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
