#include "sample_game/meshes.hpp"

namespace cullet {

Mesh make_mesh_named(const std::string& name, uint64_t seed) {
    if (name == "vase") return make_vase(0.30f, 0.0075f, seed);
    if (name == "bowl") return make_solid_bowl();
    if (name == "piggy_bank") return make_piggy_bank(0.40f, 0.0098f, seed);
    if (name == "wall") return make_wall(2.4f, 1.8f, 0.078f, seed);
    if (name == "pane") return make_pane(0.5f, 0.010f, seed);
    if (name == "pig") return make_pig(0.5f, 3500, seed);
    if (name == "cow") return make_cow(0.6f, 3000, seed);
    if (name == "car") return make_car(4.4f, 14'658, seed);
    if (name == "drum") return make_drum(0.88f, 5000, seed);
    if (name == "castle") return make_castle(3, 6500, seed);
    if (name == "castle_fine") return make_castle(3, 11'000, seed);
    if (name == "slab") return make_slab({2.4f, 1.8f, 0.1f}, 600, seed);
    return {};
}

}  // namespace cullet
