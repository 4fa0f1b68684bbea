// Rows of a snapshot that no world would write are refused before a system follows them; those that one writes are not.
#include <gtest/gtest.h>

#include "systems/api/snapshot.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

/// The sentence that refuses the world's bytes, or an empty one.
std::string refusal(World& world) {
    const Result<std::vector<uint8_t>> bytes = world.snapshot();
    if (!bytes) return "no snapshot: " + bytes.error();
    World other = make_world(small_settings());
    const Result<void> loaded = other.restore(bytes->data(), bytes->size());
    return loaded.ok() ? "" : loaded.error();
}

TEST(CheckState, AWorldWhoseRoomForDrawnMeshesIsFullIsLoadedAgain) {
    Breakage probe = vase_and_ball(small_settings());
    const uint32_t drawn = probe.world.view(probe.body).value().vertex_count;
    Settings settings = small_settings();
    settings.limits.view_vertices = std::max(4096u, drawn + 16);
    Breakage hit = vase_and_ball(settings);
    const Bodies& bodies = state_of(hit.world).bodies;
    for (int frame = 0; frame < 60 && bodies.is_owed_births[hit.body.index] != kOwedDrawing; ++frame) hit.world.step();
    ASSERT_EQ(bodies.is_owed_births[hit.body.index], kOwedDrawing);
    EXPECT_EQ(refusal(hit.world), "");
}

}  // namespace
}  // namespace cullet::test
