// A vase falls on a rising lift, in a host with its own memory, jobs and clock.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "cullet/query.hpp"

using namespace cullet;

int main() {
    Host host;
    host.allocator.allocate = [](void*, size_t size, size_t alignment) {
        return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    };
    host.allocator.release = [](void*, void* memory, size_t) { std::free(memory); };
    host.jobs.worker_count = [](void*) { return 1u; };
    host.jobs.parallel_for = [](void*, uint32_t count, void (*job)(void*, uint32_t), void* context) {
        for (uint32_t i = 0; i < count; ++i) job(context, i);  // any order, any threads
    };

    std::vector<Vec3> points{{0, 0, 0}};  // the vase: 30 rings of 40 points about the y axis, the first three its foot
    std::vector<std::array<uint32_t, 3>> faces;
    for (uint32_t i = 0; i < 30 * 40; ++i) {
        const float ring = static_cast<float>(i / 40), angle = 6.2831853f / 40 * static_cast<float>(i % 40);
        const float radius = ring < 3 ? 0.02f + 0.015f * ring : 0.06f + 0.025f * std::sin(0.22f * ring - 0.9f);
        points.push_back({radius * std::cos(angle), ring < 3 ? 0 : 0.01f * (ring - 2), radius * std::sin(angle)});
        const uint32_t a = i + 1, b = i % 40 == 39 ? a - 39 : a + 1;  // this point and the next one of its ring
        if (i < 40) faces.push_back({0, a, b});
        if (i >= 40) faces.insert(faces.end(), {{a - 40, a, b - 40}, {b - 40, a, b}});
    }
    const Result<Model> model = cook({points.data(), points.size(), faces[0].data(), faces.size()}, {});
    Result<World> made = World::create({.units_a_frame = 20'000'000}, host);
    if (!model.ok() || !made.ok())
        return std::fprintf(stderr, "%s%s\n", model.error().c_str(), made.error().c_str()), 1;
    World& world = *made;

    const Vec3 corners[] = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    (void)world.add_static({corners, 4, quad, 2});
    const BodyId lift =
        world.add_kinematic_box({.motion = {{0, 0.5f, 0}, {}}, .half_extents = {0.3f, 0.1f, 0.3f}}).value();
    const ModelId vase = world.add_model(model.value()).value();
    (void)world.spawn(vase, {.pose = {{0, 2.5f, 0}, {0.2f, 0, 0, 0.98f}}, .user_data = 42});

    uint32_t fragments = 0;
    double unsimulated = 0;  // s; the game draws between pose_before and pose of a view by this share of a step
    for (int frame = 0; frame < 240; ++frame) {  // frames of the game, drawn 90 times a second
        for (unsimulated += 1.0 / 90; unsimulated >= 1.0 / 60; unsimulated -= 1.0 / 60) {
            world.step();
            for (const FragmentBornEvent& f : world.events().fragments_born)
                std::printf("fragment %2u of %zu: %6.1f g, %u triangles drawn\n", ++fragments, size_t{f.body_user_data},
                            1000 * f.mass, world.view(f.fragment).value().index_count / 3);
        }
        if (frame == 90) (void)world.set_motion(lift, {});  // it has come up by half a metre
    }
    const SurfaceHit below = ray(world, {0, 3, 0}, {0, -1, 0}, 5);  // between steps, from any thread
    std::printf("the eye at 3 m looks down on %zu, %.2f m away\n", size_t{below.user_data}, below.distance);
    const bool is_saved = world.save("vase.csnap").ok() && world.load("vase.csnap").ok();  // in mid-fracture, too
    std::remove("vase.csnap");
    return fragments > 0 && below && is_saved ? 0 : 1;
}
