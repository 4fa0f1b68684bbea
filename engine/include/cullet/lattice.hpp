// What a game may set of the damage model lattice, beside what all models have. Their ranges:
// systems/models/lattice/shared/settings.cpp, a line each.
#pragma once
#include <cstdint>

namespace cullet {

/// CookSettings::lattice. The model keeps what follows from it: bodies of it, files and snapshots have it.
struct LatticeSettings {
    uint32_t cells = 1500;         // wanted: what the solid can come apart into
    uint32_t most_cells = 20000;   // of a thin body, whose cells are at most four thicknesses wide; else it is refused
    uint32_t element_edges = 4;    // a finite element's edge over that of a cell; 2 is more accurate and slower
    float jitter = 0.1f;           // of the lattice, of an element's edge
    float largest_filled = 0.25f;  // of the closed surface that may be new, where holes are closed
    float strength_modulus = 10;   // Weibull's, of the spread of strength: 6 glass, 10 ceramics and stone; 0: none
    float hull_excess = 1.2f;      // a convex piece's volume over that of the solid in it, before it is halved
};

}  // namespace cullet
