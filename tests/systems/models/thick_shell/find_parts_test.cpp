// A mesh of several parts is one body until a hit that is worth a task.
#include <gtest/gtest.h>

#include "cullet/world.hpp"
#include "engine/math.hpp"
#include "sample_game/game_world.hpp"
#include "sample_game/props.hpp"
#include "systems/world_contents.hpp"
#include "tests/support/simple_meshes.hpp"

namespace cullet {
namespace {

/// So many boxes in a row, 1 cm apart.
Model boxes(uint32_t count) {
    Mesh mesh;
    mesh.name = "boxes";
    for (uint32_t n = 0; n < count; ++n) {
        const Mesh box = test::box_mesh({0.1, 0.1, 0.1}, 4);
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (const Vec3 p : box.positions) mesh.positions.push_back(p + Vec3{0.11f * static_cast<float>(n), 0, 0});
        for (const auto& t : box.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    CookSettings settings;
    settings.thickness = 0.01f;
    settings.longest_edge = 1;
    settings.thick_shell.measures_threshold = false;
    return cook(view_of(mesh), settings).value();
}

struct Fall {
    uint64_t born = 0, cuts = 0, opened = 0;
    double mass_error = 0;
};

/// Flat on a floor.
Fall fall(uint32_t count, float speed) {
    Settings settings;
    settings.units_a_frame = 1'000'000'000;
    World world = World::create(settings).value();
    EXPECT_TRUE(world.add_static(view_of(floor_prop().mesh)).ok());
    SpawnSettings body;
    body.pose.position = {0, 0.16f, 0};
    body.motion.velocity = {0, -speed, 0};
    EXPECT_TRUE(world.spawn(world.add_model(boxes(count)).value(), body).ok());
    const double put_in = measure_matter(world).mass;
    Fall found;
    for (int frame = 0; frame < 40; ++frame) {
        world.step();
        found.born += world.events().fragments_born.count;
    }
    found.cuts = world.contents().data.counts.cuts;
    found.opened = world.contents().data.counts.opened;
    found.mass_error = measure_matter(world).mass / put_in - 1;
    return found;
}

TEST(FindParts, BoxesThatNothingJoinsComeApartWithoutACrack) {
    const Fall three = fall(3, 0.3f);
    EXPECT_EQ(three.cuts, 0u);
    EXPECT_EQ(three.born, 2u);  // the first keeps the handle
    EXPECT_NEAR(three.mass_error, 0, 1e-6);
}

TEST(FindParts, OneBoxStaysOneUnderTheSameHit) {
    const Fall one = fall(1, 0.3f);
    EXPECT_GT(one.opened, 0u);
    EXPECT_EQ(one.cuts, 0u);
    EXPECT_EQ(one.born, 0u);
}

}  // namespace
}  // namespace cullet
