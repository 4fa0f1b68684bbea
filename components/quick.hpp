// The quick mode: how bodies break that do not wait for a hidden run. All of it is empty until the first such body
// comes.
#pragma once
#include "components/springs.hpp"
#include "components/tasks.hpp"

namespace cullet {

/// How something breaks: settings of the game's, each under its name (QuickSettings, LayerSettings).
template <class Own>
struct QuickRules : Table<Own> {
    using Table<Own>::Table;
    Column<uint8_t> is_quick{*this, "is_quick"};
    Column<uint8_t> layers{*this, "layers"};                     // 1 or 2
    Column<uint16_t> steps{*this, "steps"};                      // of a run
    Column<uint16_t> crack_frequency{*this, "crack_frequency"};  // vertices split in a step; 0: by the kind of fracture
    Column<float> strain_limit{*this, "strain_limit"};           // 0: the material's
    Column<float> compression_limit{*this, "compression_limit"};  // in strain limits; 0: none
    Column<float> crack_length{*this, "crack_length"};            // of the body's diagonal
    Column<float> bump_angle{*this, "bump_angle", "rad"};
    Column<uint8_t> layout{*this, "layout"};              // LayerLayout of two layers
    Column<float> length_factor{*this, "length_factor"};  // gamma; 0: mean edge over thickness
    Column<float> area_energy{*this, "area_energy"};      // over E h A
    Column<float> volume_energy{*this, "volume_energy"};
};

/// Row b is how body b breaks. Pieces inherit it.
struct QuickBodies : QuickRules<QuickBodies> {
    using QuickRules::QuickRules;
    CULLET_TABLE(quick_bodies);
};

/// Row t is the run of task t, by the rules that its body had when it opened. All motion is seen from the body as it
/// moved at the touch. So a vertex at rest in it has velocity 0 until the run ends.
struct QuickRuns : QuickRules<QuickRuns> {
    using QuickRules::QuickRules;
    CULLET_TABLE(quick_runs);
    // Of the run.
    Column<Row<ShellSprings>> springs{*this, "springs"};      // of the task's shell; kNone before the region is awake
    Column<uint32_t> awake_count{*this, "awake_count"};       // vertices that the region had when it woke
    Column<float> softening{*this, "softening"};              // s >= 1: stiffness E / s, time stretched by its root
    Column<float> split_strain{*this, "split_strain"};        // of a vertex of median strength, as the run sees it
    Column<double> energy_scale{*this, "energy_scale", "J"};  // that body and strikers meet with: what 5 % are of
    Column<float> diagonal{*this, "diagonal", "m"};           // of the body's bounds
};

}  // namespace cullet
