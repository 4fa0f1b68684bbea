// One impact on a metal shell, worked off: how deep, what shape, and the clean-up (metal shell note, sections 6 and 7).
#pragma once
#include "systems/models/metal_shell/dent/sheet_plan.hpp"
#include "systems/models/metal_shell/dent/striker.hpp"
#include "systems/models/metal_shell/shared/metal_view.hpp"

namespace cullet {

enum class DentKind : uint8_t { None, Sheet, Body };

struct Dent {
    DentKind kind = DentKind::None;
    double depth = 0;    // m, that the striker goes on by from where it touches the sheet now
    double contact = 0;  // m: radius of the contact
    double left = 0;     // J that found no room: the sheet would tear
    bool is_puncture = false;
};

/// Of the shell's material and mean thickness.
SheetMetal sheet_metal(const ShellView& shell);

/// Moves MetalVertices.place; the shell itself stays as it is. `energy`: kinetic, in the effective mass of both, J.
/// What neither dents nor crushes for good moves nothing.
Dent work_dent(const MetalView& metal, const Striker& striker, double energy);

/// Vertices of the shell go to MetalVertices.place, with their normals and the sheet's inner side. Marks cells whose
/// hulls are to be chosen anew, measures mass properties. False: nothing moved.
bool bake_dent(const MetalView& metal);

}  // namespace cullet
