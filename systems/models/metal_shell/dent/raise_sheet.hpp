// The field of a dent in a sheet: how far each vertex goes along the push (metal shell note D1).
#pragma once
#include "systems/models/metal_shell/dent/sheet_plan.hpp"
#include "systems/models/metal_shell/shared/metal_view.hpp"
#include "systems/models/metal_shell/shared/striker.hpp"

namespace cullet {

/// Where the sheet is touched, and what holds it there.
struct SheetPlace {
    uint32_t vertex = 0;      // nearest to the touch
    double support = 0;       // R_b, m: to the nearest pin or fold, or half of the box diagonal
    double dent_depth = 0;    // m along the push, of dents that are there already
    bool is_clamped = false;  // by pins
};
SheetPlace find_sheet_place(const MetalView& metal, const Striker& striker);
inline SheetBlow blow_at(const SheetPlace& place, const Striker& ball, double energy) {
    return {ball.radius, place.support, energy, place.dent_depth, place.is_clamped};
}

/// Fills MetalVertices.field. Dents are the envelope of all that came, not their sum.
void raise_sheet(const MetalView& metal, const Striker& striker, const SheetPlace& place, const SheetPlan& plan);

}  // namespace cullet
