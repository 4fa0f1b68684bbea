// How deep a ductile sheet is dented by an impact, and how far that reaches (metal shell note D1): the energy of the
// impact is what stretching and bending it takes.
#pragma once

namespace cullet {

struct SheetMetal {
    double thickness = 1e-3;      // h, m
    double yield_stress = 250e6;  // Pa
    double yield_strain = 1.2e-3;
    double break_strain = 0.25;  // lambda_t: a steeper slope tears
};

/// Round striker on a sheet that is held `support` away.
struct SheetBlow {
    double striker_radius = 0;  // m
    double support = 0;         // R_b, m: to what holds the sheet
    double energy = 0;          // W, J
    double depth_before = 0;    // w_before, m: of the dent that is there already
    bool is_clamped = false;    // by pins, not by folds, and not by its own stiffness alone
};

/// All zero: the blow is elastic.
struct SheetPlan {
    double rim = 0;          // w, m: depth for good where the sheet leaves the striker
    double contact = 0;      // a, m: radius of the contact
    double reach = 0;        // R, m: how far it yields
    double depth = 0;        // d, m: at the middle
    double left = 0;         // J that a puncture leaves; 0: none
    double restitution = 0;  // of the sheet, at this blow
    bool is_puncture = false;
    bool is_dent() const { return depth > 0; }
};

/// Radii follow from the depth by fixed-point rounds, the depth from the energy by bisection.
SheetPlan plan_sheet(const SheetMetal& metal, const SheetBlow& blow);
/// J below which nothing stays: need(0+). Of the blow's energy and depth it takes no notice.
double elastic_energy(const SheetMetal& metal, const SheetBlow& blow);

/// How deep the planned dent is at a distance from its axis, m. Rounded where it ends, at twice the reach.
double profile(const SheetPlan& plan, double striker_radius, double distance);

}  // namespace cullet
