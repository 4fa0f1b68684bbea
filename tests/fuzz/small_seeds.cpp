#include "tests/fuzz/small_seeds.hpp"

#include <cstdio>
#include <cstdlib>
#include <map>

#include "tests/support/simple_meshes.hpp"

namespace cullet::fuzz {

void give_up(const std::string& sentence) {
    std::fprintf(stderr, "%s\n", sentence.c_str());
    std::abort();
}

Mesh globe(bool has_corners) {
    Mesh mesh = test::sphere_mesh(0.1, 1);
    mesh.name = "globe";
    if (!has_corners) return mesh;
    for (const auto& triangle : mesh.triangles) {
        for (const uint32_t v : triangle) {
            mesh.corner_normals.push_back(normalised(mesh.positions[v]));
            mesh.corner_uvs.push_back({mesh.positions[v].x, mesh.positions[v].y});
        }
        mesh.materials.push_back(mesh.positions[triangle[0]].z > 0 ? 9 : 2);
    }
    return mesh;
}

namespace {

Model cook_globe(const char* material, float thickness) {
    const Mesh mesh = globe(false);
    CookSettings settings;
    settings.material = material;
    settings.thickness = thickness;
    settings.longest_edge = 1;
    return value_of(cook(
        {mesh.positions.data(), mesh.positions.size(), mesh.triangles[0].data(), mesh.triangles.size()}, settings));
}

}  // namespace

const Model& glass_globe() {
    static const Model model = cook_globe("glass", 0.004f);
    return model;
}

const Model& steel_globe() {
    static const Model model = cook_globe("steel", 0.001f);
    return model;
}

namespace {

struct Kept {
    std::multimap<size_t, void*> by_size;
    ~Kept() {
        for (const auto& [size, memory] : by_size) std::free(memory);
    }
};

}  // namespace

const Host& frugal_host() {
    static Kept kept;  // programs of one thread
    static const Host host = [] {
        Host made;
        made.allocator.allocate = [](void*, size_t size, size_t alignment) {
            const auto found = kept.by_size.find(size);
            if (found == kept.by_size.end())
                return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
            void* const memory = found->second;
            kept.by_size.erase(found);
            return memory;
        };
        made.allocator.release = [](void*, void* memory, size_t size) {
            if (kept.by_size.size() < 4096)
                kept.by_size.emplace(size, memory);
            else
                std::free(memory);
        };
        return made;
    }();
    return host;
}

Settings small_settings() {
    Settings settings;
    settings.units_a_frame = 50'000;  // a hit takes some frames
    settings.limits = {.bodies = 16,
                       .models = 2,
                       .vertices = 4096,
                       .elements = 4096,
                       .open_hits = 1,
                       .view_vertices = 4096,
                       .debris = 16,
                       .queued_hits = 4};
    return settings;
}

namespace {

void add_globes(World& world, const Model& of) {
    const ModelId model = value_of(world.add_model(of));
    SpawnSettings globe;
    globe.pose.position = {0, 0.101f, 0};
    globe.user_data = 7;
    (void)value_of(world.spawn(model, globe));
    globe.pose.position = {0.5f, 1, 0};
    (void)value_of(world.spawn(model, globe));
}

}  // namespace

World globes_and_ball(const Model& of) {
    World world = value_of(World::create(small_settings()));
    const Vec3 corners[] = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    (void)value_of(world.add_static({corners, 4, quad, 2}));
    add_globes(world, of);
    SphereSettings ball;
    ball.radius = 0.03f;
    ball.mass = 0.3f;
    ball.pose.position = {0.51f, 1.01f, 0.4f};
    ball.motion.velocity = {0, 0, -20};
    (void)value_of(world.add_sphere(ball));
    return world;
}

World hosted_globes() {
    World world = value_of(World::create_hosted(small_settings()));
    add_globes(world, glass_globe());
    return world;
}

}  // namespace cullet::fuzz
