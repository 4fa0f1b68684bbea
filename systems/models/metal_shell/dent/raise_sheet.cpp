#include "systems/models/metal_shell/dent/raise_sheet.hpp"

#include <algorithm>

#include "systems/models/metal_shell/dent/ways.hpp"

namespace cullet {
namespace {

constexpr double kFold = 0.766;         // cosine of 40 degrees: a sheet that turns by more holds what lies beside it
constexpr double kReaches = 2;          // the field ends there
constexpr double kStraightShare = 0.8;  // of a way along edges, the least that the straight line is in a flat mesh
constexpr double kPinShare = 0.25;      // of the reach, beside a pin
constexpr double kSag = 22;             // of contact times thickness over support
constexpr double kSagRims = 2;          // thicknesses: of a dent whose rim is so deep half of it
constexpr double kSagFrom = 1.5, kSagTo = 2;  // supports, between which it fades

Vec3d original_normal(const MetalView& metal, uint32_t element) {
    const auto& c = metal.corners(element);
    const MetalVertices& v = metal.vertices();
    const Vec3d p(v.original[metal.vertex(c[0])]), q(v.original[metal.vertex(c[1])]), r(v.original[metal.vertex(c[2])]);
    return normalised(cross(q - p, r - p));
}

Vec3d start_of(const MetalView& metal, uint32_t v) {
    return Vec3d(metal.vertices().start[metal.vertex(v)]);
}

}  // namespace

SheetPlace find_sheet_place(const MetalView& metal, const Striker& striker) {
    const MetalVertices& vertices = metal.vertices();
    SheetPlace place;
    double nearest = 1e30;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const Vec3d from = start_of(metal, v) - striker.point;
        const double square = dot(from, from);
        if (square < nearest && metal.shell.state.vertices.element[metal.shell.vertex(v)] != kNone)
            nearest = square, place.vertex = v;
    }
    const uint32_t row = metal.vertex(place.vertex);
    const Vec3d middle(vertices.original[row]);
    place.dent_depth = std::max(0.0, dot(Vec3d(vertices.start[row]) - middle, striker.push));
    place.support = std::min(double{metal.shells().half_diagonal[metal.row]}, double{vertices.pin_distance[row]});
    const uint32_t own = metal.shell.state.vertices.element[metal.shell.vertex(place.vertex)];
    const Vec3d normal = original_normal(metal, own);
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        if (metal.is_dead(e) || dot(original_normal(metal, e), normal) >= kFold) continue;
        for (const uint32_t c : metal.corners(e))
            place.support = std::min(place.support, length(Vec3d(vertices.original[metal.vertex(c)]) - middle));
    }
    place.support = std::max(place.support, double{metal.shells().mean_edge[metal.row]});
    place.is_clamped = double{vertices.pin_distance[row]} <= place.support && place.support > 0;
    return place;
}

namespace {

/// What stays of a held sheet's sag beyond the dent, down to what holds it: less than the dent is deep, and over a
/// wider area. Fitted to thirteen runs of a shell FEM, of sheets clamped all around; of others it is not known.
class Sag {
 public:
    Sag(const MetalView& metal, const SheetPlace& place, const SheetPlan& plan)
        : from_(kSagFrom * place.support), to_(kSagTo * place.support) {
        const double h = double{metal.shell.shells().thickness[metal.shell.row]};
        if (place.is_clamped) most_ = kSag * plan.contact * h / place.support * plan.rim / (plan.rim + kSagRims * h);
    }
    /// Where it ends, m.
    double end() const { return most_ > 0 ? to_ : 0; }
    double at(double away, double pin_distance) const {
        if (!(away < end())) return 0;
        const double fade = away > from_ ? (to_ - away) / (to_ - from_) : 1;
        return most_ * fade * pin_distance / (pin_distance + away);
    }

 private:
    double most_ = 0, from_, to_;  // m
};

}  // namespace

// Past a fold the way along the sheet counts: walls beside the dent would go down with it, and the far side as well.
void raise_sheet(const MetalView& metal, const Striker& striker, const SheetPlace& place, const SheetPlan& plan) {
    MetalVertices& vertices = metal.vertices();
    const uint32_t count = metal.vertex_count();
    for (uint32_t v = 0; v < count; ++v) vertices.way[metal.vertex(v)] = v == place.vertex ? 0 : kNoWay;
    const Sag sag(metal, place, plan);
    const double end = std::max(kReaches * plan.reach, sag.end());
    spread_ways(metal, static_cast<float>(end / kStraightShare));
    for (uint32_t v = 0; v < count; ++v) {
        const uint32_t row = metal.vertex(v);
        vertices.field[row] = 0;
        const Vec3d start = start_of(metal, v);
        const double away = std::max(striker.aside_of(start), kStraightShare * double{vertices.way[row]});
        if (!(away < end) || metal.is_pinned(v)) continue;
        const double pin = double{vertices.pin_distance[row]}, dent = profile(plan, striker.radius, away);
        const double full = std::min(1.0, pin / (kPinShare * plan.reach)) * dent +
                            (dent < plan.rim ? 1 - dent / plan.rim : 0) * sag.at(away, pin);
        const double there = dot(start - Vec3d(vertices.original[row]), striker.push);
        vertices.field[row] = static_cast<float>(std::max(0.0, full - std::max(there, 0.0)));
    }
}

}  // namespace cullet
