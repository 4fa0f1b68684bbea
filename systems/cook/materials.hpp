// Materials as rows of a state.
#pragma once
#include "components/shell_rows.hpp"
#include "cullet/material.hpp"

namespace cullet {

/// The compiled table (thick shell note, section 8). Its first four rows, glass, porcelain, brick and concrete, stand
/// in every world and model; the others come with the models that are made of them.
const std::vector<MaterialSettings>& compiled_materials();
inline constexpr uint32_t kFirstMaterials = 4;

/// Appends the first four to an empty table.
void fill_materials(Materials& materials);

/// Where rows of materials are written, and the structures that are made of them.
struct MaterialTables {
    Materials& materials;
    MaterialTraits& material_traits;
    const Structures& structures;
};
/// The row that has these values and this grain (zero: the material has none), appended where there is none; rows that
/// nothing is made of give way when the table is full. kNone: kMostMaterials are in use.
Row<Materials> material_row(MaterialTables state, const MaterialSettings& material, Vec3 grain);
/// The row's values, without a name.
MaterialSettings material_settings(const MaterialRows& state, Row<Materials> row);

/// The part of a row that stands in MaterialTraits, or that the compiled table has for it.
struct TraitsRow {
    MaterialKind kind = MaterialKind::Brittle;
    FractureKind fracture = FractureKind::Large;
    float branching = 0, run_out = 0;
    float across_young_modulus = 0, shear_modulus = 0, across_strength = 0, across_fracture_energy = 0;
    Vec3 grain;
    bool has_grain() const { return across_young_modulus > 0; }
};
TraitsRow material_traits(const MaterialRows& state, Row<Materials> row);

/// Whether a row that was read is one that a table can have: check_material, and what decides nothing in its kind is 0.
Result<void> check_row(const MaterialSettings& material);
/// Whether rows that were read may be followed: values in their ranges, kinds that there are, grains of unit length.
Result<void> check_material_rows(const MaterialRows& state);

}  // namespace cullet
