// What cooking has done when it asks a damage model for the rest: whatever a thing is made of, its mesh is looked at,
// cleaned, and its long edges are split.
#pragma once
#include <string>

#include "cullet/model.hpp"
#include "engine/mesh.hpp"
#include "systems/cook/surface.hpp"

namespace cullet {

/// What the settings say of the material, looked at.
struct CookedMaterial {
    MaterialSettings settings;
    Vec3 grain;  // unit, or zero
};

struct Cooking {
    const CookSettings& settings;
    CookedMaterial material;
    SurfaceSettings welding;
    Mesh mesh;                      // clean
    Mesh fine;                      // the same, long edges split
    bool has_made_normals = false;  // the mesh had none
    double longest_edge = 0;        // m, where this made the edges what they are, and did not cut a few long ones; or 0

    /// To the game; of the whole. What is done so far is a tenth.
    void tell(float share) const {
        if (settings.progress) settings.progress(settings.progress_user, share);
    }
};

}  // namespace cullet
