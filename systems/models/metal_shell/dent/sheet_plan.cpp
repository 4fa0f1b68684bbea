#include "systems/models/metal_shell/dent/sheet_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/math.hpp"

namespace cullet {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kRounds = 12, kBisections = 24, kReachRounds = 30;
constexpr double kSpringback = 1.3;  // fitted to eight runs of a shell FEM
// Of those runs: a ball of 145 mm and a sheet of 1 mm in 0.4 m.
constexpr double kOwnBall = 0.3625;             // of the support
constexpr double kOwnSheet = 0.0508;            // of the support times the slope at yield
constexpr double kStiffening = 9;               // how fast less springs back of thicker sheets
constexpr double kLeastContact = 10;            // thicknesses
constexpr double kMostOfStriker = 0.95;         // of its radius
constexpr double kMostOfSupport = 0.6;          // beyond it the blow is too wide for a sheet
constexpr double kFoot = 0.1;                   // how much the profile's foot is rounded
constexpr double kFadeFrom = 1.4, kFadeTo = 2;  // reaches
constexpr double kSheetLoss = 0.7;              // of a sheet's restitution

/// What a depth at the rim takes.
struct Need {
    double energy, contact, reach, loaded;  // J, m, m, m: T, the depth under load
};

// R ln(R / a) = share, R > a, by Newton's steps from above: the left side is convex and rises.
double reach_of(double share, double a) {
    double r = a + share + 1.8 * a;
    for (int k = 0; k < kReachRounds; ++k) {
        const double next = r - (r * logarithm(r / a) - share) / (logarithm(r / a) + 1);
        if (!(std::fabs(next - r) > 1e-12 * r)) break;
        r = next;
    }
    return std::max(r, a);
}

double slope_of(const SheetMetal& metal) {
    return std::sqrt(2 * metal.yield_strain);
}

// A clamped sheet springs back by what its whole span does at the slope at which it yields: hardly more under a wide
// contact than under a narrow one. The note's term grows with the contact, and holds for one ball only; the root takes
// that growth out of blunter and sharper ones. Of a thick sheet less springs back, since bending keeps more of its
// dome. Both are fitted to runs of a shell FEM: contacts of 28 to 113 mm, sheets of 0.7 to 3 mm, spans of 0.6 to 1.6 m,
// steels and aluminium.
double springback_of(const SheetMetal& metal, const SheetBlow& blow, double contact) {
    const double s_y = slope_of(metal);
    const double cup = kSpringback * s_y * contact * logarithm(blow.support / contact);
    if (!blow.is_clamped) return cup;
    const double blunt = std::sqrt(std::sqrt(kOwnBall * blow.support / blow.striker_radius));
    const double thick = std::min(metal.thickness / (s_y * blow.support), 5.0);
    return cup * blunt * exponential(kStiffening * (kOwnSheet - thick));
}

Need need_of(const SheetMetal& metal, const SheetBlow& blow, double w) {
    const double s_y = slope_of(metal), h = metal.thickness;
    const double striker_radius = blow.striker_radius, support = blow.support;
    const double most = std::min(kMostOfStriker * striker_radius, kMostOfSupport * support);
    const double least = std::min(kLeastContact * h, most);
    double a = std::clamp(0.3 * striker_radius, least, most), reach = support;
    for (int k = 0; k < kRounds; ++k) {
        reach = std::min(support, reach_of(w / s_y, a));
        const double slope = w / (a * logarithm(std::max(reach / a, 1.0001)));
        const double wanted = std::clamp(striker_radius * slope / std::sqrt(1 + slope * slope), least, most);
        a = 0.5 * (a + wanted);
    }
    const double way = logarithm(support / a);
    Need need{0, a, reach, w + springback_of(metal, blow, a)};
    const double bending = kPi * metal.yield_stress * h * h, stretch = kPi * metal.yield_stress * h / way;
    need.energy = bending * need.loaded + stretch * need.loaded * need.loaded +
                  metal.yield_stress * h * kPi * a * a * a * a / (4 * striker_radius * striker_radius);
    return need;
}

double slope_at(const Need& need, double w) {
    return w / (need.contact * logarithm(std::max(need.reach / need.contact, 1.0001)));
}

// Deeper the sheet would be steeper than it stretches.
double steepest_rim(const SheetMetal& metal, const SheetBlow& blow) {
    const double most = std::sqrt((1 + metal.break_strain) * (1 + metal.break_strain) - 1);
    double low = 0, high = 4 * blow.support;
    for (int k = 0; k < kBisections; ++k) {
        const double w = 0.5 * (low + high);
        (slope_at(need_of(metal, blow, w), w) <= most ? low : high) = w;
    }
    return low;
}

}  // namespace

double elastic_energy(const SheetMetal& metal, const SheetBlow& blow) {
    return need_of(metal, blow, 0).energy;
}

namespace {

double depth_of(const Need& need, double w, double striker_radius) {
    return w + striker_radius - std::sqrt(striker_radius * striker_radius - need.contact * need.contact);
}

// The rim of a dent that is so deep at the middle.
double rim_of(const SheetMetal& metal, const SheetBlow& blow) {
    double low = 0, high = blow.depth_before;
    for (int k = 0; k < kBisections; ++k) {
        const double w = 0.5 * (low + high);
        const Need need = need_of(metal, blow, w);
        (depth_of(need, w, blow.striker_radius) < blow.depth_before ? low : high) = w;
    }
    return low;
}

}  // namespace

SheetPlan plan_sheet(const SheetMetal& metal, const SheetBlow& blow) {
    SheetPlan plan;
    const double r = blow.striker_radius, b = blow.support;
    const auto need = [&](double w) { return need_of(metal, blow, w); };
    const double first = need(0).energy;
    const double wanted = blow.energy + (blow.depth_before > 0 ? need(rim_of(metal, blow)).energy : 0);
    if (!(wanted > first) || !(blow.energy > 0)) return plan;
    double low = 0, high = steepest_rim(metal, blow);
    const Need deepest = need(high);
    if (deepest.energy < wanted) {
        plan.is_puncture = true;
        plan.left = std::min(blow.energy, wanted - deepest.energy);
        low = high;
    }
    for (int k = 0; k < kBisections && !plan.is_puncture; ++k) {
        const double w = 0.5 * (low + high);
        (need(w).energy < wanted ? low : high) = w;
    }
    const Need found = need(low);
    plan.rim = low, plan.contact = found.contact, plan.reach = std::max(found.reach, found.contact * 1.0001);
    plan.depth = depth_of(found, low, r);
    const double q = std::min(1.0, slope_of(metal) * found.contact * logarithm(b / found.contact) / found.loaded);
    plan.restitution = std::sqrt(kSheetLoss * (1 - (1 - q) * (1 - q)));
    return plan;
}

double profile(const SheetPlan& plan, double striker_radius, double distance) {
    const double a = plan.contact, r = striker_radius;
    if (distance <= a) return plan.rim + std::sqrt(r * r - distance * distance) - std::sqrt(r * r - a * a);
    const double end = kFadeTo * plan.reach, fade = kFadeFrom * plan.reach;
    if (distance >= end) return 0;
    const double way = logarithm(plan.reach / distance) / logarithm(plan.reach / a);
    const double share = kFoot * logarithm(1 + exponential(std::max(way / kFoot, -50.0)));
    return plan.rim * share * (distance > fade ? (end - distance) / (end - fade) : 1);
}

}  // namespace cullet
