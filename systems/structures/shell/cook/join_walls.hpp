// Meshes that model both of their walls, as a cup does: found, and turned into their outer wall alone with the inner
// one as what its depth is measured to. Extruded as they are, they would become two sheets that break apart from each
// other.
#pragma once
#include <optional>

#include "systems/structures/shell/cook/extrude.hpp"

namespace cullet {

struct JoinedWalls {
    Mesh outer;                        // all parts, without the inner walls and lips of those joined
    InnerSkin skin;                    // but for is_of_component
    std::vector<uint8_t> is_joined;    // triangles of `outer`
    std::vector<Vec3d> into_the_wall;  // unit, one a triangle of `outer`; 0 of parts that are not joined
    uint32_t parts = 0;                // joined
    double volume = 0;                 // m3 between the skins of these
};

/// Nothing when no closed part has its opposite wall within two thicknesses (m) over more than half of its area, or
/// when what lies opposite is no second skin (a rod) or the part no sheet (a brick). `mesh` is what the surface was
/// made of.
std::optional<JoinedWalls> join_walls(const Surface& surface, const Mesh& mesh, double thickness);

/// One sentence: how many parts, how thick on average, and how much of the volume between the skins the sheets hold.
std::string describe(const JoinedWalls& joined, const Surface& outer, const Extrusion& extrusion);

/// The skin for a surface that was prepared from `outer`, whose parts have numbers and triangles an order of their own.
InnerSkin skin_for(const JoinedWalls& joined, const Surface& outer);

}  // namespace cullet
