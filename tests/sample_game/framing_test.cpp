// The camera of scenes that name none.
#include "sample_game/framing.hpp"

#include <gtest/gtest.h>

#include "sample_game/model_shelf.hpp"

namespace cullet {
namespace {

GameWorld world_of(const std::string& lua) {
    ScenePlan plan;
    plan.scene = {"framing", "framing.lua", lua};
    plan.shelf = std::make_shared<ModelShelf>();
    plan.threads = 1;
    Result<GameWorld> made = GameWorld::create(plan);
    EXPECT_TRUE(made.ok()) << made.error();
    return std::move(made).value();
}

/// Cosine between the middle ray and the way from the eye to the place.
float towards(const Camera& camera, Vec3 place) {
    return dot(normalised(camera.target - camera.eye), normalised(place - camera.eye));
}

Vec3 place_of_the_ball(const World& world) {
    std::vector<BodyId> ids(world.bodies(nullptr, 0));
    world.bodies(ids.data(), static_cast<uint32_t>(ids.size()));
    for (const BodyId id : ids)
        if (world.mass(id).value_or(0) == 1) return world.pose(id)->position;
    ADD_FAILURE() << "no ball";
    return {};
}

TEST(Framing, ABallInFlightStaysInThePicture) {
    GameWorld game = world_of("game.floor() game.throw{radius = 0.1, mass = 1, at = {0, 2, 0}, velocity = {3, 2, 0}}");
    Framing framing;
    for (int frame = 0; frame < 60; ++frame) {
        framing.follow(game);
        EXPECT_GT(towards(framing.camera(), place_of_the_ball(game.world())), 0.9f) << frame;
        EXPECT_GT(framing.camera().eye.y, 0);
        game.before_step(), game.step(), game.after_step();
    }
}

TEST(Framing, WhatABallIsAboutToMeetIsInThePicture) {
    GameWorld game = world_of(
        "game.floor() game.throw{radius = 0.1, mass = 1, at = {-2, 0.4, 0}, velocity = {8, 0, 0}}\n"
        "game.throw{radius = 0.2, mass = 1, at = {2, 0.2, 0}}");
    Framing framing;
    for (int frame = 0; frame < 10; ++frame) {
        framing.follow(game);
        game.before_step(), game.step(), game.after_step();
    }
    EXPECT_GT(towards(framing.camera(), {2, 0.2f, 0}), 0.9f);
}

TEST(Framing, AnEmptyWorldHasACameraToo) {
    GameWorld game = world_of("game.floor()");
    Framing framing;
    framing.follow(game);
    EXPECT_TRUE(framing.camera().eye.y > 0 && framing.camera().eye.y < 100);
}

}  // namespace
}  // namespace cullet
