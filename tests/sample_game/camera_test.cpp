// The camera of each scene holds what is to be seen: nearly all of what breaks lies within the picture, and in sight.
// At the start it is large enough to be made out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "cullet/query.hpp"
#include "sample_game/game_world.hpp"
#include "sample_game/run_scene.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

// What breaks lies still by then, but for the pile and the street, which go on. CULLET_SCENE_FRAMES=1200 plays all of
// all.
constexpr uint32_t kFrames = 240, kPileFrames = 100;  // what comes later in the pile lies on what is there

/// Area on its way into the eye, m2.
struct Seen {
    double all = 0, inside = 0, hidden = 0;
    double lowest = 1, highest = -1;  // of what is inside, from the picture's lower side -1 to its upper side 1
    /// Of the picture's height that what is inside takes.
    double height() const { return std::max(0.0, 0.5 * (highest - lowest)); }
};

class View {
 public:
    explicit View(const Camera& camera) : eye_(camera.eye) {
        forward_ = normalised(camera.target - camera.eye);
        right_ = normalised(cross(forward_, Vec3{0, 1, 0}));
        up_ = cross(right_, forward_);
        height_ = std::tan(0.5f * camera.vertical_field_of_view);
    }
    /// Pictures are 16 to 9.
    bool holds(Vec3 place) const {
        const Vec3 away = place - eye_;
        const float depth = dot(away, forward_);
        return depth > 0 && std::fabs(dot(away, up_)) <= height_ * depth &&
               std::fabs(dot(away, right_)) <= height_ * depth * 16 / 9;
    }
    /// From -1 at the picture's lower side to 1 at its upper side.
    double height_of(Vec3 place) const {
        return static_cast<double>(dot(place - eye_, up_) / (height_ * dot(place - eye_, forward_)));
    }
    Vec3 eye() const { return eye_; }

 private:
    Vec3 eye_, forward_, right_, up_;
    float height_ = 0;
};

/// What is spawned of a model, whole or in pieces; balls, floors and walls are not.
bool is_of_model(const World& world, BodyId id) {
    return world.contents().data.state.bodies.shell[id.index].exists();
}

/// Something that does not break stands before the place.
bool is_hidden(const World& world, Vec3 eye, Vec3 place) {
    const float distance = length(place - eye);
    const SurfaceHit hit = ray(world, eye, place - eye, 0.99f * distance);
    return hit && !is_of_model(world, hit.body);
}

Seen seen_of(const GameWorld& game) {
    const World& world = game.world();
    const View view(game.stage().camera);
    std::vector<BodyId> ids(world.bodies(nullptr, 0));
    world.bodies(ids.data(), static_cast<uint32_t>(ids.size()));
    Seen seen;
    for (const BodyId id : ids) {
        const Result<BodyView> drawn = world.view(id);
        if (!is_of_model(world, id) || !drawn.ok()) continue;
        for (uint32_t i = 0; i + 2 < drawn->index_count; i += 3) {
            Vec3 p[3];
            for (uint32_t k = 0; k < 3; ++k)
                p[k] = to_world(drawn->pose, drawn->vertices[drawn->indices[i + k]].position);
            const double area = 0.5 * static_cast<double>(length(cross(p[1] - p[0], p[2] - p[0])));
            const Vec3 middle = (1.0f / 3) * (p[0] + p[1] + p[2]);
            seen.all += area;
            if (!view.holds(middle)) continue;
            seen.inside += area;
            seen.lowest = std::min(seen.lowest, view.height_of(middle));
            seen.highest = std::max(seen.highest, view.height_of(middle));
            if (i % 24 == 0 && is_hidden(world, view.eye(), middle)) seen.hidden += 8 * area;
        }
    }
    return seen;
}

class EveryCamera : public testing::TestWithParam<Scene> {};

TEST_P(EveryCamera, HoldsNearlyAllThatBreaksFromTheFirstPictureToTheEnd) {
    RunOptions options;
    options.scene = GetParam().name;
    const ScenePlan plan = plan_scene(GetParam(), options);
    const Story story = read_story(plan).value();
    const uint32_t most = GetParam().name == "pile" ? kPileFrames : kFrames;
    const char* wanted = std::getenv("CULLET_SCENE_FRAMES");
    const uint32_t frames = std::min(frame_count(story, options), wanted ? std::max(1, std::atoi(wanted)) : most);
    Result<GameWorld> game = GameWorld::create(plan);
    ASSERT_TRUE(game.ok()) << game.error();
    Seen seen;
    double first_height = 0;
    for (uint32_t frame = 0; frame < frames; ++frame) {
        game->before_step();
        game->step();
        game->after_step();
        const bool is_shown =
            std::find(story.sheet_frames.begin(), story.sheet_frames.end(), frame + 1) != story.sheet_frames.end();
        if (!is_shown && frame + 1 < frames) continue;
        seen = seen_of(*game);
        if (first_height == 0) first_height = seen.height();
        EXPECT_GE(seen.inside, 0.9 * seen.all) << "frame " << frame + 1;
    }
    std::printf(
        "%s, frame %u: %.4f of the area in the picture, %.4f of it behind what does not break; at first %.2f of the "
        "picture's height\n",
        GetParam().name.c_str(), frames, seen.inside / seen.all, seen.hidden / seen.inside, first_height);
    EXPECT_GE(first_height, 0.15);
    EXPECT_GE(seen.inside, 0.95 * seen.all);
    EXPECT_LE(seen.hidden, 0.1 * seen.inside);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryCamera, testing::ValuesIn(scenes().begin(), scenes().end()),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace cullet
