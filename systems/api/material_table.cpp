// The public face of materials: ranges, sentences, tables of the game's own.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cullet/material.hpp"
#include "engine/fp_mode.hpp"
#include "systems/cook/materials.hpp"

namespace cullet {
namespace {

using S = MaterialSettings;
constexpr uint8_t kBrittle = 1, kDuctile = 2, kElastic = 4, kSoft = kDuctile | kElastic, kAll = kBrittle | kSoft;
// Ranges reach well beyond what exists: they keep a wrong unit (GPa for Pa) and numbers that no run can follow out.
constexpr MaterialValue kValues[] = {
    {"density", "kg/m3", &S::density, 1, 1e5, kAll},
    {"young_modulus", "Pa", &S::young_modulus, 1e3, 1e13, kAll},
    {"poisson_ratio", "1", &S::poisson_ratio, 0, 0.499, kAll},
    {"tensile_strength", "Pa", &S::tensile_strength, 1e2, 1e12, kBrittle},
    {"yield_strain", "1", &S::yield_strain, 1e-7, 10, kDuctile},
    {"break_strain", "1", &S::break_strain, 1e-7, 100, kSoft},
    {"fracture_energy", "J/m2", &S::fracture_energy, 1e-3, 1e9, kBrittle},
    {"crush_strength", "Pa", &S::crush_strength, 1e3, 1e13, kBrittle},
    {"restitution", "1", &S::restitution, 0, 1, kAll},
    {"friction", "1", &S::friction, 0, 10, kAll},
    {"heading_power", "1", &S::heading_power, 0, 100, kBrittle},
    {"tip_factor", "1", &S::tip_factor, 0.01, 10, kBrittle},
    {"run_seconds", "s", &S::run_seconds, 1e-4, 0.1, kBrittle},
    {"branching", "1", &S::branching, 0, 10, kBrittle},
    {"run_out", "1", &S::run_out, 0, 10, kBrittle},
    {"bending_stiffness", "N m", &S::bending_stiffness, 0, 1e9, kSoft},
    {"crush_pressure", "Pa", &S::crush_pressure, 0, 1e9, kDuctile},
    {"across_young_modulus", "Pa", &S::across_young_modulus, 0, 1e13, kBrittle},
    {"shear_modulus", "Pa", &S::shear_modulus, 0, 1e13, kBrittle},
    {"across_strength", "Pa", &S::across_strength, 0, 1e12, kBrittle},
    {"across_fracture_energy", "J/m2", &S::across_fracture_energy, 0, 1e9, kBrittle},
};
constexpr const char* kKindNames[] = {"brittle", "ductile", "elastic"};
constexpr const char* kFractureNames[] = {"large", "coarse", "fine"};

std::string shown(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

Error wrong(const S& m, const std::string& what) {
    return {"material \"" + m.name + "\": " + what};
}

std::string unit_of(const MaterialValue& value) {
    return std::string(value.unit) == "1" ? "" : std::string(" ") + value.unit;
}

bool is_name(const std::string& name) {
    return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
}

/// What is needed across a grain, each at least as large as its twin along it has to be.
struct AcrossValue {
    const char* name;
    float S::*member;
    float S::*along;
};
constexpr AcrossValue kAcross[] = {{"across_young_modulus", &S::across_young_modulus, &S::young_modulus},
                                   {"shear_modulus", &S::shear_modulus, &S::young_modulus},
                                   {"across_strength", &S::across_strength, &S::tensile_strength},
                                   {"across_fracture_energy", &S::across_fracture_energy, &S::fracture_energy}};

/// A material that is the same in all directions across its grain has positive energy in all planes when 2 nu^2
/// E_across < (1 - nu) E_along. That is its compliance's sign in the plane of equal tensions across. nu is used for
/// both kinds of contraction.
Result<void> check_grain(const S& m) {
    if (m.kind != MaterialKind::Brittle || m.across_young_modulus == 0) return {};
    for (const AcrossValue& across : kAcross) {
        const auto along = std::find_if(std::begin(kValues), std::end(kValues),
                                        [&](const MaterialValue& value) { return value.member == across.along; });
        const float is = m.*across.member, least = static_cast<float>(along->least);
        if (is == 0)
            return wrong(
                m, std::string(across.name) + " is 0, but a material with across_young_modulus needs it; give it.");
        if (!(is >= least))
            return wrong(m, std::string(across.name) + " is " + shown(static_cast<double>(is)) + " " + along->unit +
                                "; a material with a grain needs " + shown(along->least) + " at least.");
    }
    const double nu = static_cast<double>(m.poisson_ratio), across = static_cast<double>(m.across_young_modulus);
    const double most = static_cast<double>(m.young_modulus) * (1 - nu) / (2 * nu * nu);
    if (nu > 0 && !(across < most))
        return wrong(m, "across_young_modulus is " + shown(across) + " Pa, with poisson_ratio " + shown(nu) +
                            " and young_modulus " + shown(static_cast<double>(m.young_modulus)) +
                            " Pa; use less than " + shown(most) + " Pa, or a smaller poisson_ratio.");
    return {};
}

/// What decides nothing becomes 0, so that rows with the same effect are the same.
S without_idle_values(S m) {
    for (const MaterialValue& value : kValues)
        if (!value.is_of(m.kind)) m.*value.member = 0;
    return m;
}

}  // namespace

MaterialValues material_values() {
    return {kValues, std::size(kValues)};
}
const char* name_of(MaterialKind kind) {
    return kKindNames[static_cast<size_t>(kind) % std::size(kKindNames)];
}
const char* name_of(FractureKind kind) {
    return kFractureNames[static_cast<size_t>(kind) % std::size(kFractureNames)];
}

Result<void> check_material(const S& m) {
    if (!is_name(m.name))
        return Error{"a material's name is \"" + m.name + "\"; use 1 to 64 letters, digits, _ and -."};
    if (static_cast<size_t>(m.kind) >= std::size(kKindNames) ||
        static_cast<size_t>(m.fracture) >= std::size(kFractureNames))
        return wrong(m, "kind or fracture is none of those that there are.");
    if (!m.model.empty() && !is_name(m.model))
        return wrong(m, "model is \"" + m.model + "\"; use the name of a damage model, or none.");
    for (const MaterialValue& value : kValues) {
        if (!value.is_of(m.kind)) continue;
        const double is = static_cast<double>(m.*value.member);
        // The ends as floats: what is written as 0.499 is not refused.
        if (!(is >= static_cast<double>(static_cast<float>(value.least)) &&
              is <= static_cast<double>(static_cast<float>(value.most))))
            return wrong(m, std::string(value.name) + " is " + shown(is) + unit_of(value) + "; use " +
                                shown(value.least) + " to " + shown(value.most) + ".");
    }
    if (m.kind == MaterialKind::Ductile && !(m.yield_strain <= m.break_strain))
        return wrong(m, "yield_strain is " + shown(m.yield_strain) +
                            "; a ductile material flows before it tears, at its break_strain, " +
                            shown(m.break_strain) + ".");
    return check_grain(m);
}

MaterialTable::MaterialTable() : rows_(compiled_materials()) {}

S* MaterialTable::row_of(const std::string& name) {
    const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const S& row) { return row.name == name; });
    return found == rows_.end() ? nullptr : &*found;
}

Result<void> MaterialTable::add(const S& material) {
    const FpMode mode;
    if (const Result<void> valid = check_material(material); !valid) return valid;
    if (row_of(material.name)) return wrong(material, "is in the table already; change it, or use another name.");
    rows_.push_back(without_idle_values(material));
    return {};
}

Result<void> MaterialTable::change(const S& material) {
    const FpMode mode;
    if (const Result<void> valid = check_material(material); !valid) return valid;
    S* const row = row_of(material.name);
    if (!row) return wrong(material, "is not in the table, which has " + names() + "; add it.");
    *row = without_idle_values(material);
    return {};
}

Result<S> MaterialTable::find(const std::string& name) const {
    for (const S& row : rows_)
        if (row.name == name) return row;
    return Error{"material \"" + name + "\" is not known; use one of " + names() + "."};
}

std::string MaterialTable::names() const {
    std::string all;
    for (const S& row : rows_) all += (all.empty() ? "" : ", ") + row.name;
    return all;
}

}  // namespace cullet
