// How edge springs stand for the thickness of a shell.
#pragma once
#include <cstdint>

namespace cullet {

/// Sandwich: stretches and bends as the thickness says, whatever the length factor. Crossed: cross springs on each side
/// quad, as published. It bends 3 gamma^2 times too stiffly (gamma is LayerSettings::length_factor).
enum class LayerLayout : uint8_t { Sandwich = 0, Crossed };

/// For the springs of ductile and elastic bodies, and of quick ones (FractureMode::Quick) in a hit. A body with one
/// layer of springs (cloth, or QuickSettings::layers 1) has no layout, length factor or volume.
struct LayerSettings {
    LayerLayout layout = LayerLayout::Sandwich;
    /// gamma: distance of the layers in motion over the thickness, 0.577 to 5; 0: mean edge over thickness, within
    /// these. Drawn depth and mass stay those of the thickness.
    float length_factor = 0;
    /// Resists a change of area of each triangle, 0 to 100. The energy is kappa/2 ((A - A0) / A0)^2, and kappa is so
    /// many times E h A0. It is never so stiff that a step would blow up. Costs several times what the springs do.
    float area_energy = 0;
    float volume_energy = 0;  // the same of each prism's volume
};

}  // namespace cullet
