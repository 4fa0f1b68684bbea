// One impact on a metal shell, worked off: how deep, what shape, and the clean-up (metal shell note, sections 6 and 7).
#pragma once
#include "systems/models/metal_shell/dent/sheet_plan.hpp"
#include "systems/models/metal_shell/shared/metal_view.hpp"
#include "systems/models/metal_shell/shared/striker.hpp"

namespace cullet {

enum class DentKind : uint8_t { None, Sheet, Body };

struct Dent {
    DentKind kind = DentKind::None;
    double depth = 0;        // m, that the striker goes on by from where it touches the sheet now
    double contact = 0;      // m: radius of the contact
    double left = 0;         // J that found no room: the sheet would tear
    double restitution = 0;  // of the sheet, at least; 0: what the bodies have
    bool is_puncture = false;
    double plastic = 0;  // J that stay in the metal: the energy, less what it gives back and what is left
    // Of a sheet.
    double tearing = 0;    // J that a dent as steep as the sheet bears before it tears does not take; 0: it holds
    double deep = 0;       // m, of the whole dent
    double support = 0;    // m, to what holds the sheet
    uint32_t vertex = 0;   // nearest to the touch
    Striker striker = {};  // as a ball
    SheetPlan plan = {};
};

/// Of the shell's material and mean thickness.
SheetMetal sheet_metal(const MetalView& metal);

/// What a sheet gives back, at most: of a blow that leaves no dent.
inline constexpr double kMostBounce = 0.83666;  // sqrt(0.7)
/// The blow leaves no dent: the sheet springs back from all of it. One that crushes a body always leaves one.
bool is_elastic(const MetalView& metal, const Striker& striker, double energy);

/// Moves MetalVertices.place; the shell itself stays as it is. `energy`: kinetic, in the effective mass of both, J.
/// What neither dents nor crushes for good moves nothing. `goes_on`: the whole energy of an impact that has begun to
/// dent already, from the shape that was before it (MetalVertices.before). Else that shape is kept there.
Dent work_dent(const MetalView& metal, const Striker& striker, double energy, bool goes_on = false);

/// What presses slowly has come `depth` m into the sheet, or is about to: the sheet lies before it then. `force`: N, of
/// who makes way itself, and comes only as far as that takes it; 0: nothing stops it.
Dent press_dent(const MetalView& metal, const Striker& striker, double depth, double force);

/// Vertices of the shell go to MetalVertices.place, with their normals and the sheet's inner side. Marks cells whose
/// hulls are to be chosen anew, measures mass properties. False: nothing moved.
bool bake_dent(const MetalView& metal);

}  // namespace cullet
