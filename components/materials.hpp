// What bodies are made of. Values and ranges: thick shell note, section 8.
#pragma once
#include "engine/table.hpp"

namespace cullet {

/// One row is one material.
struct Materials : Table<Materials> {
    using Table::Table;
    static constexpr const char* kName = "materials";
    Column<float> density{*this, "density", "kg/m3"};
    Column<float> young_modulus{*this, "young_modulus", "Pa"};
    Column<float> poisson_ratio{*this, "poisson_ratio"};
    Column<float> tensile_strength{*this, "tensile_strength",
                                   "Pa"};  // for loads of seconds; the hidden run takes twice that
    Column<float> fracture_energy{*this, "fracture_energy", "J/m2"};  // G_c
    Column<float> crush_strength{*this, "crush_strength", "Pa"};      // H: pressure under which the struck face crushes
    Column<float> restitution{*this, "restitution"};
    Column<float> friction{*this, "friction"};
    Column<float> heading_power{*this, "heading_power"};   // q of C1: how straight cracks run; 6, glass 30
    Column<float> tip_factor{*this, "tip_factor"};         // on Griffith's limit at mesh resolution, 0.6
    Column<float> run_seconds{*this, "run_seconds", "s"};  // least elastic time of a hidden run: 1 ms, brick walls 3 ms
};

}  // namespace cullet
