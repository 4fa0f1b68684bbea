// What a game may set of the damage model thick_shell, beside what all models have. Their ranges:
// systems/models/thick_shell/shared/settings.cpp, a line each.
#pragma once
#include <cstdint>

#include "cullet/layers.hpp"
#include "cullet/quick.hpp"

namespace cullet {

/// How the inner surface is pushed to its depth. All but the default are there to compare with.
enum class Propagation : uint8_t {
    GuardedFront,      // all vertices together, what turns bad set back: nothing meets, no element is turned
    Front,             // the same as published: quicker, leaves crossings and turned elements
    SingleVertex,      // one vertex after the other, as published: nothing meets, elements are turned
    SingleVertexTets,  // the same, with the elements tested too: as sound as the default, slower
};

/// CookSettings::thick_shell.
struct ThickShellCookSettings {
    Propagation propagation = Propagation::GuardedFront;
    /// For a mesh that models both of its walls: a closed part whose opposite wall lies within two thicknesses over
    /// most of its area. True: its outer wall becomes one sheet as thick as measured, and both skins break together.
    /// False: each wall becomes a sheet of its own, at most half as thick.
    bool joins_walls = true;
    bool measures_threshold = true;  // finds the speed of the first crack (adds 10 to 50 hits' time)
};

/// SpawnSettings::thick_shell. Fragments inherit it.
struct ThickShellSpawnSettings {
    FractureMode fracture = FractureMode::Hidden;  // of brittle materials
    QuickSettings quick = {};                      // of FractureMode::Quick
    LayerSettings springs = {};                    // of quick bodies in a hit, and of ductile and elastic ones
};

}  // namespace cullet
