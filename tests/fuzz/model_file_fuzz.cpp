// Reads anything as a model file; what is accepted is put into a world and hit.
#include "systems/cook/model_file.hpp"

#include "engine/memory.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/small_seeds.hpp"

namespace cullet::fuzz {
namespace {

std::vector<Bytes> make_seeds() {
    const Mesh mesh = globe(true);
    CookSettings settings;
    settings.material = "brick";
    settings.thickness = 0.01f;
    settings.longest_edge = 1;
    settings.thick_shell.measures_threshold = false;
    const Model brick = value_of(cook({mesh.positions.data(), mesh.positions.size(), mesh.triangles[0].data(),
                                       mesh.triangles.size(), nullptr, mesh.corner_uvs.data(), mesh.materials.data()},
                                      settings));
    return {encode_model_file(*glass_globe().contents), encode_model_file(*brick.contents),
            encode_model_file(*steel_globe().contents)};
}

bool read(std::span<const uint8_t> file) {
    const MemoryScope memory(frugal_host().allocator);
    const Result<Model> model = parse_model_file(file, "fuzz.cmodel", *damage_models());
    if (!model) return false;
    World world = value_of(World::create(small_settings(), frugal_host()));
    const Result<ModelId> id = world.add_model(*model);
    if (!id) return true;
    (void)world.spawn(*id);
    SphereSettings ball;
    ball.pose.position = {0.01f, 0.02f, 0.25f};
    ball.motion.velocity = {0, 0, -20};
    (void)world.add_sphere(ball);
    for (int frame = 0; frame < 3; ++frame) world.step();
    return true;
}

}  // namespace

const Format model_file{"model_file", make_seeds, seal_file, read};

}  // namespace cullet::fuzz
