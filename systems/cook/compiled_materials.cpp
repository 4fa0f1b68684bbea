// Typical handbook values; grades spread by a third and more. Crush strength of the dense ones is the indentation
// (Vickers) hardness. That of brick and concrete, whose pores collapse, is two to three times the compressive strength
// of a cube (15 to 20 and 35 to 45 MPa), because the material around confines what is crushed. That of wood is the side
// hardness (Brinell, softwoods 10 to 30 MPa). Wood's shear modulus is 0.06 of the modulus along the grain (Wood
// Handbook, table 5-1, softwoods 0.05 to 0.08). To break fibres rather than part them takes 12 kJ/m2 (Ashby and Jones,
// Engineering Materials 1, table 13.1: 8 to 20).
#include "systems/cook/materials.hpp"

namespace cullet {
namespace {

MaterialSettings brittle(const char* name, FractureKind fracture, float density, float young_modulus,
                         float poisson_ratio, float strength, float fracture_energy, float crush_strength,
                         float restitution, float friction, float heading_power) {
    MaterialSettings m;
    m.name = name, m.fracture = fracture, m.density = density, m.young_modulus = young_modulus;
    m.poisson_ratio = poisson_ratio, m.tensile_strength = strength, m.fracture_energy = fracture_energy;
    m.crush_strength = crush_strength, m.restitution = restitution, m.friction = friction;
    m.heading_power = heading_power;
    return m;
}

/// Strengths, G_c and crush strength of the note's table decide nothing in these: the strains do.
MaterialSettings soft(const char* name, MaterialKind kind, float density, float young_modulus, float poisson_ratio,
                      float yield_strain, float break_strain, float restitution, float friction) {
    MaterialSettings m;
    for (const MaterialValue& value : material_values()) m.*value.member = 0;
    m.name = name, m.kind = kind, m.density = density, m.young_modulus = young_modulus;
    m.poisson_ratio = poisson_ratio, m.yield_strain = yield_strain, m.break_strain = break_strain;
    m.restitution = restitution, m.friction = friction;
    return m;
}

std::vector<MaterialSettings> make_table() {
    using enum FractureKind;
    using enum MaterialKind;
    // kg/m3, Pa, 1, Pa, J/m2, Pa, 1, 1, 1
    std::vector<MaterialSettings> t{
        brittle("glass", Large, 2500, 70e9f, 0.22f, 45e6f, 8, 5.5e9f, 0.65f, 0.4f, 30),
        brittle("porcelain", Large, 2400, 70e9f, 0.20f, 50e6f, 20, 6e9f, 0.6f, 0.45f, 6),
        brittle("brick", Coarse, 1900, 12e9f, 0.20f, 3e6f, 50, 40e6f, 0.3f, 0.65f, 6),
        brittle("concrete", Coarse, 2400, 30e9f, 0.20f, 3e6f, 100, 100e6f, 0.2f, 0.6f, 6),
        // kg/m3, Pa, 1, yield 1, break 1, 1, 1. Yield is 250, 240 and 70 MPa over the modulus.
        soft("steel", Ductile, 7850, 205e9f, 0.29f, 1.2e-3f, 0.25f, 0.2f, 0.4f),
        soft("aluminium", Ductile, 2700, 69e9f, 0.33f, 3.5e-3f, 0.12f, 0.15f, 0.4f),
        soft("copper", Ductile, 8960, 117e9f, 0.34f, 6e-4f, 0.4f, 0.1f, 0.4f),
        soft("rubber", Elastic, 1100, 5e6f, 0.49f, 0, 5, 0.8f, 0.9f),
        soft("cloth", Elastic, 500, 0.1e9f, 0.3f, 0, 0.15f, 0, 0.5f),
        brittle("wood", Large, 500, 10e9f, 0.35f, 80e6f, 12e3f, 20e6f, 0.5f, 0.45f, 6),
    };
    for (const size_t metal : {4, 5, 6}) t[metal].model = "metal_shell";
    // Masonry breaks by many cracks at once. Without branching a ball leaves half as many pieces in a wall (12 for 27);
    // without running out three cracks a blow end in nothing. The note has both off; these were chosen from pictures.
    for (const size_t stone : {2, 3}) t[stone].branching = 0.3f, t[stone].run_out = 2;
    t[8].bending_stiffness = 1e-5f;  // the middle of 1e-6 to 1e-4, 0.4 mm thick
    MaterialSettings& wood = t[9];
    wood.across_young_modulus = 0.5e9f, wood.shear_modulus = 0.6e9f, wood.across_strength = 3e6f;
    wood.across_fracture_energy = 250;
    return t;
}

}  // namespace

const std::vector<MaterialSettings>& compiled_materials() {
    static const std::vector<MaterialSettings> table = make_table();
    return table;
}

}  // namespace cullet
