// What bodies are made of. Values: docs/materials.md. Ranges: cullet/material.hpp.
#pragma once
#include "engine/table.hpp"

namespace cullet {

inline constexpr uint32_t kMostMaterials = 64;  // rows of a world

/// One row is one material.
struct Materials : Table<Materials> {
    using Table::Table;
    CULLET_TABLE(materials);
    Column<float> density{*this, "density", "kg/m3"};
    Column<float> young_modulus{*this, "young_modulus", "Pa"};
    Column<float> poisson_ratio{*this, "poisson_ratio"};
    Column<float> tensile_strength{*this, "tensile_strength",
                                   "Pa"};  // for loads of seconds; the hidden run takes twice that
    Column<float> fracture_energy{*this, "fracture_energy", "J/m2"};  // G_c
    Column<float> crush_strength{*this, "crush_strength", "Pa"};      // H: pressure under which the struck face crushes
    Column<float> restitution{*this, "restitution"};
    Column<float> friction{*this, "friction"};
    Column<float> heading_power{*this, "heading_power"};   // q: how straight cracks run; 6, glass 30
    Column<float> tip_factor{*this, "tip_factor"};         // on Griffith's limit at mesh resolution, 0.6
    Column<float> run_seconds{*this, "run_seconds", "s"};  // least elastic time of a hidden run: 1 ms, brick walls 3 ms
};

/// What only some materials have. Row i is of row i of Materials. It is empty while a world has the compiled first four
/// alone; material_traits() then knows those by itself.
struct MaterialTraits : Table<MaterialTraits> {
    using Table::Table;
    CULLET_TABLE(material_traits);
    Column<uint8_t> kind{*this, "kind"};          // MaterialKind
    Column<uint8_t> fracture{*this, "fracture"};  // FractureKind
    Column<float> branching{*this, "branching"};  // tips above this share of sigma_d may fork; 0: none does
    Column<float> run_out{*this, "run_out"};  // what a crack goes on for at the end of a run that breaks, of its length
    Column<float> yield_strain{*this, "yield_strain"};
    Column<float> break_strain{*this, "break_strain"};
    Column<float> bending_stiffness{*this, "bending_stiffness", "N m"};  // of soft ones; 0: as E and the depth say
    Column<float> crush_pressure{*this, "crush_pressure", "Pa"};         // of ductile ones; 0: by a body's shape
    // Across the grain; across_young_modulus 0: the same in all directions.
    Column<float> across_young_modulus{*this, "across_young_modulus", "Pa"};
    Column<float> shear_modulus{*this, "shear_modulus", "Pa"};
    Column<float> across_strength{*this, "across_strength", "Pa"};
    Column<float> across_fracture_energy{*this, "across_fracture_energy", "J/m2"};
    Column<Vec3> grain{*this, "grain"};  // unit, body frame; models cooked with another one have another row
};

}  // namespace cullet
