#include "systems/cook/materials.hpp"

namespace cullet {
namespace {

struct Entry {
    const char* name;
    float density, young_modulus, poisson_ratio, tensile_strength, fracture_energy, crush_strength, restitution,
        friction, heading_power;
};
// kg/m3, Pa, 1, Pa, J/m2, Pa, 1, 1, 1. Typical handbook values; grades spread by a third and more. Crush strength: of
// the dense ones the indentation (Vickers) hardness, of brick and concrete, whose pores collapse, two to three times
// the compressive strength of a cube (15 to 20 and 35 to 45 MPa), because the material around confines what is crushed.
constexpr Entry kMaterials[] = {
    {"glass", 2500, 70e9f, 0.22f, 45e6f, 8, 5.5e9f, 0.65f, 0.4f, 30},
    {"porcelain", 2400, 70e9f, 0.20f, 50e6f, 20, 6e9f, 0.6f, 0.45f, 6},
    {"brick", 1900, 12e9f, 0.20f, 3e6f, 50, 40e6f, 0.3f, 0.65f, 6},
    {"concrete", 2400, 30e9f, 0.20f, 3e6f, 100, 100e6f, 0.2f, 0.6f, 6},
};
constexpr float kTipFactor = 0.6f;    // on Griffith's limit at mesh resolution; at 1 most panes stay whole
constexpr float kRunSeconds = 1e-3f;  // half of it leaves a vase too whole

}  // namespace

void fill_materials(Materials& materials) {
    for (const Entry& e : kMaterials) {
        const uint32_t row = materials.append(1);
        materials.density[row] = e.density;
        materials.young_modulus[row] = e.young_modulus;
        materials.poisson_ratio[row] = e.poisson_ratio;
        materials.tensile_strength[row] = e.tensile_strength;
        materials.fracture_energy[row] = e.fracture_energy;
        materials.crush_strength[row] = e.crush_strength;
        materials.restitution[row] = e.restitution;
        materials.friction[row] = e.friction;
        materials.heading_power[row] = e.heading_power;
        materials.tip_factor[row] = kTipFactor;
        materials.run_seconds[row] = kRunSeconds;
    }
}

Result<Row<Materials>> find_material(const std::string& name) {
    std::string known;
    for (uint32_t i = 0; i < std::size(kMaterials); ++i) {
        if (name == kMaterials[i].name) return Row<Materials>(i);
        known += (i ? ", " : "") + std::string(kMaterials[i].name);
    }
    return Error{"material \"" + name + "\" is not known; use one of " + known + "."};
}

}  // namespace cullet
