// What holds for every break, of any shape and by any blow, in both modes (T10, T11 of the thick shell note).
#include <gtest/gtest.h>

#include "components/state.hpp"
#include "tests/support/break_checks.hpp"
#include "tests/support/expect_always.hpp"
#include "tests/support/random_hits.hpp"
#include "tests/support/real_meshes.hpp"

namespace cullet::test {
namespace {

std::vector<Shape> random_shapes() {
    std::vector<Shape> shapes;
    for (uint32_t s = 0; s < 16; ++s) shapes.push_back(random_shape(200 + s));
    return shapes;
}

float radius_of(const Mesh& mesh) {
    Vec3 low = mesh.positions[0], high = low;
    for (const Vec3 p : mesh.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return length(high - low) / 2;
}

/// Of porcelain, 2 % of their size thick.
std::vector<Shape> real_shapes() {
    std::vector<Shape> shapes;
    for (const char* name : {"bowl.ply", "plate.glb", "vase.glb", "spot_control_mesh.obj"}) {
        const Mesh mesh = read_real_mesh(std::string("thick_shell/") + name);
        const float radius = radius_of(mesh);
        CookSettings settings{.material = "porcelain", .thickness = 0.04f * radius, .longest_edge = 100};
        settings.thick_shell.measures_threshold = false;
        Result<Model> model = cook(view_of(mesh), settings);
        EXPECT_TRUE(model.ok()) << name << ": " << model.error();
        if (model.ok()) shapes.push_back({std::move(model).value(), radius});
    }
    return shapes;
}

/// Breaks that the checks looked at.
uint32_t expect_sound_breaks(FractureMode mode, std::span<const Shape> shapes, int cases) {
    World world = make_world(small_settings());
    uint32_t breaks = 0;
    std::string flaw;
    after_each_system(world, [&](const std::string& system) {
        if (system != "find_parts") return;
        State& state = state_of(world);
        for (uint32_t t = 0; t < state.tasks.size(); ++t) {
            if (static_cast<TaskState>(state.tasks.state[t]) != TaskState::Broke) continue;
            ++breaks;
            if (flaw.empty()) flaw = flaw_of_partition(state, t);
            if (flaw.empty()) flaw = flaw_of_handoff(state, t);
        }
    });
    expect_always(cases, [&](uint32_t shape, uint32_t hit) {
        SpawnSettings spawn;
        spawn.thick_shell.fracture = mode;
        spawn.thick_shell.quick.strain_limit = 0.005f;
        flaw.clear();
        hit_once(world, shapes[shape % shapes.size()], {{11}, hit}, spawn);
        RC_ASSERT(flaw == "");
    });
    std::printf("%u breaks of %d hits\n", breaks, cases);
    return breaks;
}

TEST(BreakProperties, HiddenPartsHoldEachElementOnceAndKeepTheMomenta) {
    EXPECT_GT(expect_sound_breaks(FractureMode::Hidden, random_shapes(), 80), 20u);
}

TEST(BreakProperties, QuickPartsHoldEachElementOnceAndKeepTheMomenta) {
    EXPECT_GT(expect_sound_breaks(FractureMode::Quick, random_shapes(), 80), 20u);
}

TEST(BreakProperties, HoldOnRealMeshesInBothModes) {
    CULLET_SKIP_WITHOUT_DATA();
    const std::vector<Shape> shapes = real_shapes();
    ASSERT_EQ(shapes.size(), 4u);
    for (const FractureMode mode : {FractureMode::Hidden, FractureMode::Quick})
        EXPECT_GT(expect_sound_breaks(mode, shapes, 16), 3u);
}

}  // namespace
}  // namespace cullet::test
