#include "systems/cook/materials.hpp"

#include <bit>

namespace cullet {
namespace {

/// Columns and the values that they hold, for both ways.
template <class M, class F>
void for_each_material_column(M& materials, F&& f) {
    using S = MaterialSettings;
    f(materials.density, &S::density), f(materials.young_modulus, &S::young_modulus);
    f(materials.poisson_ratio, &S::poisson_ratio), f(materials.tensile_strength, &S::tensile_strength);
    f(materials.fracture_energy, &S::fracture_energy), f(materials.crush_strength, &S::crush_strength);
    f(materials.restitution, &S::restitution), f(materials.friction, &S::friction);
    f(materials.heading_power, &S::heading_power), f(materials.tip_factor, &S::tip_factor);
    f(materials.run_seconds, &S::run_seconds);
}
template <class T, class F>
void for_each_traits_column(T& traits, F&& f) {
    using S = MaterialSettings;
    f(traits.yield_strain, &S::yield_strain), f(traits.branching, &S::branching), f(traits.run_out, &S::run_out);
    f(traits.break_strain, &S::break_strain), f(traits.bending_stiffness, &S::bending_stiffness);
    f(traits.crush_pressure, &S::crush_pressure);
    f(traits.across_young_modulus, &S::across_young_modulus), f(traits.shear_modulus, &S::shear_modulus);
    f(traits.across_strength, &S::across_strength), f(traits.across_fracture_energy, &S::across_fracture_energy);
}

void write_row(Materials& materials, uint32_t row, const MaterialSettings& from) {
    for_each_material_column(materials, [&](auto& column, auto member) { column[row] = from.*member; });
}
void write_row(MaterialTraits& traits, uint32_t row, const MaterialSettings& from, Vec3 grain) {
    traits.kind[row] = static_cast<uint8_t>(from.kind);
    traits.fracture[row] = static_cast<uint8_t>(from.fracture);
    for_each_traits_column(traits, [&](auto& column, auto member) { column[row] = from.*member; });
    traits.grain.set(row, grain);
}

bool is_compiled(uint32_t row) {
    return row < kFirstMaterials;
}

Vec3 grain_of(const MaterialRows& state, uint32_t row) {
    return row < state.material_traits.size() ? state.material_traits.grain[row] : Vec3{};
}

bool has_values(const MaterialRows& state, uint32_t row, const MaterialSettings& wanted, Vec3 grain) {
    const MaterialSettings found = material_settings(state, Row<Materials>(row));
    const Vec3 away = grain_of(state, row) - grain;
    bool is_same = found.kind == wanted.kind && found.fracture == wanted.fracture && dot(away, away) == 0;
    for (const MaterialValue& value : material_values()) is_same &= found.*value.member == wanted.*value.member;
    return is_same;
}

bool is_used(const Structures& structures, uint32_t row) {
    for (uint32_t s = 0; s < structures.size(); ++s)
        if (structures.users[s] > 0 && structures.material[s] == row) return true;
    return false;
}

/// A new row, or one that nothing is made of any more.
uint32_t take_row(MaterialTables state) {
    if (state.materials.size() < state.materials.limit()) return state.materials.append(1);
    for (uint32_t row = kFirstMaterials; row < state.materials.size(); ++row)
        if (!is_used(state.structures, row)) return row;
    return kNone;
}

}  // namespace

void fill_materials(Materials& materials) {
    for (uint32_t i = 0; i < kFirstMaterials; ++i) write_row(materials, materials.append(1), compiled_materials()[i]);
}

MaterialSettings material_settings(const MaterialRows& state, Row<Materials> row) {
    MaterialSettings found;
    const MaterialTraits& traits = state.material_traits;
    if (row < traits.size()) {
        found.kind = static_cast<MaterialKind>(traits.kind[row]);
        found.fracture = static_cast<FractureKind>(traits.fracture[row]);
        for_each_traits_column(traits, [&](const auto& column, auto member) { found.*member = column[row]; });
    } else if (is_compiled(row)) {
        found = compiled_materials()[row];
        found.name.clear();
    }
    for_each_material_column(state.materials, [&](const auto& column, auto member) { found.*member = column[row]; });
    return found;
}

Row<Materials> material_row(MaterialTables state, const MaterialSettings& material, Vec3 grain) {
    const MaterialRows rows{state.materials, state.material_traits};
    for (uint32_t row = 0; row < state.materials.size(); ++row)
        if (has_values(rows, row, material, grain)) return Row<Materials>(row);
    const uint32_t row = take_row(state);
    if (row == kNone) return {};
    MaterialTraits& traits = state.material_traits;
    while (traits.size() <= row) {
        const MaterialSettings found = material_settings(rows, Row<Materials>(traits.size()));
        write_row(traits, traits.append(1), found, {});
    }
    write_row(state.materials, row, material);
    write_row(traits, row, material, grain);
    return Row<Materials>(row);
}

TraitsRow material_traits(const MaterialRows& state, Row<Materials> row) {
    const MaterialTraits& t = state.material_traits;
    if (row < t.size())
        return {static_cast<MaterialKind>(t.kind[row]),
                static_cast<FractureKind>(t.fracture[row]),
                t.branching[row],
                t.run_out[row],
                t.across_young_modulus[row],
                t.shear_modulus[row],
                t.across_strength[row],
                t.across_fracture_energy[row],
                t.grain[row]};
    TraitsRow found;
    if (!is_compiled(row)) return found;
    const MaterialSettings& m = compiled_materials()[row];
    found.kind = m.kind, found.fracture = m.fracture, found.branching = m.branching, found.run_out = m.run_out;
    return found;
}

Result<void> check_row(const MaterialSettings& m) {
    if (const Result<void> valid = check_material(m); !valid) return valid;
    for (const MaterialValue& value : material_values())
        if (!value.is_of(m.kind) && std::bit_cast<uint32_t>(m.*value.member) != 0)  // -0 would be read as another row
            return Error{"material \"" + m.name + "\": " + value.name + " is " + std::to_string(m.*value.member) +
                         ", and decides nothing in " + name_of(m.kind) + " materials; it has to be 0."};
    return {};
}

Result<void> check_material_rows(const MaterialRows& state) {
    const MaterialTraits& traits = state.material_traits;
    const auto place = [](uint32_t row) { return "row " + std::to_string(row) + " of materials: "; };
    if (traits.size() > 0 && traits.size() != state.materials.size())
        return Error{"material_traits has " + std::to_string(traits.size()) + " rows for " +
                     std::to_string(state.materials.size()) + " materials."};
    if (traits.size() == 0 && state.materials.size() > kFirstMaterials)
        return Error{"material_traits has no rows for " + std::to_string(state.materials.size()) + " materials."};
    for (uint32_t row = 0; row < state.materials.size(); ++row) {
        if (row < traits.size() && (traits.kind[row] > static_cast<uint8_t>(MaterialKind::Elastic) ||
                                    traits.fracture[row] > static_cast<uint8_t>(FractureKind::Fine)))
            return Error{place(row) + "kind " + std::to_string(traits.kind[row]) + " or fracture " +
                         std::to_string(traits.fracture[row]) + " does not exist."};
        MaterialSettings found = material_settings(state, Row<Materials>(row));
        found.name = "row-" + std::to_string(row);
        if (const Result<void> valid = check_row(found); !valid) return valid;
        const float squared = dot(grain_of(state, row), grain_of(state, row));
        if (found.across_young_modulus > 0 ? std::abs(squared - 1) > 1e-5f : squared != 0)
            return Error{place(row) + "the grain's length squared is " + std::to_string(squared) + "."};
    }
    return {};
}

}  // namespace cullet
