// A host with its own physics links cullet::core: a plate of glass is struck by the host's contact, and breaks.
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "cullet/version.hpp"
#include "cullet/world.hpp"

using namespace cullet;

int main() {
    if (std::strcmp(version(), "0.1.0") != 0) return std::fprintf(stderr, "library %s, header 0.1.0\n", version()), 1;
    const Vec3 corners[] = {{0, 0, 0}, {0.3f, 0, 0}, {0.3f, 0, 0.3f}, {0, 0, 0.3f}};
    const uint32_t quad[] = {0, 2, 1, 0, 3, 2};
    const Result<Model> glass =
        cook({corners, 4, quad, 2}, {.material = "glass", .thickness = 0.004f, .longest_edge = 0.02f});
    Result<World> made = World::create_hosted({.units_a_frame = 50'000'000});
    if (!glass.ok() || !made.ok())
        return std::fprintf(stderr, "%s%s\n", glass.error().c_str(), made.error().c_str()), 1;
    World& world = *made;
    const BodyId ball = world.add_sphere({.radius = 0.1f, .mass = 5}).value();
    const BodyId plate = world.spawn(world.add_model(*glass).value()).value();
    world.step({}).ok();
    std::printf("the plate has %zu convex pieces\n", size_t{world.host_changes().born[0].piece_count});

    uint32_t pieces = 0;
    for (int frame = 0; frame < 20; ++frame) {
        const Pose above{{0.15f, 0.1f, 0.15f}, {}};
        const HostBody bodies[] = {{ball, above, {{0, -20, 0}, {}}}};
        const HostContact blow{.a = ball, .b = plate, .point = {0.15f, 0, 0.15f}, .normal = {0, 1, 0}};
        if (!world.step({bodies, 1, &blow, frame == 0 ? 1u : 0u}).ok()) return 1;
        for (const HostShape& piece : world.host_changes().born) pieces += piece.mass > 0;
    }
    std::printf("%u pieces came off\n", pieces);
    return pieces > 0 ? 0 : 1;
}
