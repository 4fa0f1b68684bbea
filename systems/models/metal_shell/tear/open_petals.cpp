#include "systems/models/metal_shell/tear/open_petals.hpp"

#include <algorithm>
#include <cmath>

#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

constexpr double kUnevenTurn = 0.35;  // rad, by which petals differ
constexpr double kLipReach = 0.7;     // of a slit's length, that its lips bend over

/// As it lies from the star's axis.
struct Place {
    Across across;
    double along = 0;
};
Place place_of(const MetalView& metal, const TearStar& star, uint32_t v) {
    const Vec3d rest(metal.shell.state.vertices.rest[metal.shell.vertex(v)]);
    return {star.across(rest), cullet::dot(rest - star.middle, star.push)};
}

double size(Across a) {
    return std::sqrt(dot(a, a));
}

// Vertices on a crack lie on both sides of it: their elements say which.
Across middle_of_fan(const MetalView& metal, const TearStar& star, uint32_t v) {
    Ring ring;
    walk_ring(metal.shell, v, ring);
    Across sum;
    for (uint32_t i = 0; i < ring.count; ++i)
        for (const uint32_t c : metal.corners(ring.element[i])) {
            const Across at = place_of(metal, star, c).across;
            sum.x += at.x / (3 * ring.count), sum.y += at.y / (3 * ring.count);
        }
    return sum;
}

/// Between two arms.
struct Petal {
    Across out, beside;  // unit: from the axis to the middle of the root, and along the root
    double root = 0;     // m, from the axis
    bool holds(Across a, Across b, Across at) const {
        return a.x * at.y - a.y * at.x >= 0 && at.x * b.y - at.y * b.x >= 0;
    }
};
Petal petal_between(Across a, Across b) {
    const double along = size({b.x - a.x, b.y - a.y});
    Petal petal;
    petal.beside = {(b.x - a.x) / along, (b.y - a.y) / along};
    petal.out = {petal.beside.y, -petal.beside.x};
    petal.root = dot(petal.out, a);
    return petal;
}

/// How far a strip has come along and across when it bends on from a slope, after so much of its length.
struct Bent {
    double run = 0, rise = 0;
};
Bent bent(double length, double slope, double most_turn, double radius) {
    double s0 = 0, c0 = 1, s1 = 0, c1 = 1;
    sine_cosine(slope, s0, c0);
    const double turning = std::max(0.0, (most_turn - slope) * radius), arc = std::min(length, turning);
    sine_cosine(slope + arc / radius, s1, c1);
    Bent at{radius * (s1 - s0), radius * (c0 - c1)};
    at.run += (length - arc) * c1, at.rise += (length - arc) * s1;
    return at;
}

struct Opening {
    const MetalView& metal;
    const Dent& dent;
    const TearStar& star;

    double height(double aside) const { return profile(dent.plan, dent.striker.radius, aside); }

    // In the striker's profile the petal would go on as far as the sheet did; it bends on from its root instead.
    Vec3d petal_place(const Petal& petal, uint32_t number, Place at) const {
        const double u = dot(petal.out, at.across), t = dot(petal.beside, at.across);
        const double aside = std::sqrt(petal.root * petal.root + t * t), step = 0.02 * petal.root;
        const double fall = (height(aside - step) - height(aside)) / step * petal.root / aside;
        const double slope = std::clamp(arc_tangent(fall), 0.0, 1.2);
        const double most = std::max(slope, star.most_turn + kUnevenTurn * (scatter(star.seed, 200 + number) - 0.5));
        const Bent moved = bent(petal.root - u, slope, most, star.bend);
        const double out = petal.root - moved.run;
        const double along = at.along - height(size(at.across)) + height(aside) + moved.rise;
        return star.middle + (out * petal.out.x + t * petal.beside.x) * star.x +
               (out * petal.out.y + t * petal.beside.y) * star.y + along * star.push;
    }
    static double arc_tangent(double x) { return arc_cosine(1 / std::sqrt(1 + x * x)); }
};

}  // namespace

void open_petals(const MetalView& metal, const Dent& dent, const TearStar& star) {
    MetalVertices& own = metal.vertices();
    const Vertices& vertices = metal.shell.state.vertices;
    const Opening opening{metal, dent, star};
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const Vec3 rest = vertices.rest[metal.shell.vertex(v)];
        own.place.set(metal.vertex(v), rest);
        if (vertices.element[metal.shell.vertex(v)] == kNone) continue;
        const Place at = place_of(metal, star, v);
        if (size(at.across) > star.length || at.along > 0.5 * star.length || at.along < -dent.deep - star.length)
            continue;
        if (own.is_queued[metal.vertex(v)] == kPunched) continue;
        const Across fan = middle_of_fan(metal, star, v);
        if (star.arms == 2) {
            const Across way{star.tip[0].x - star.tip[1].x, star.tip[0].y - star.tip[1].y};
            const double whole = size(way);
            const Across line{way.x / whole, way.y / whole}, side{-line.y, line.x};
            const double along = dot(line, at.across), off = dot(side, at.across),
                         half = size(star.tip[along > 0 ? 0 : 1]);
            const double share = std::max(0.0, 1 - (along / half) * (along / half)) *
                                 std::max(0.0, 1 - std::fabs(off) / (kLipReach * half));
            const double by = star.gap * share * (dot(side, fan) > 0 ? 1 : -1);
            own.place.set(
                metal.vertex(v),
                (Vec3d(rest) + by * (side.x * star.x + side.y * star.y) + std::fabs(by) * star.push).to_float());
            continue;
        }
        for (uint32_t k = 0; k < star.arms; ++k) {
            const Across a = star.tip[k], b = star.tip[(k + 1) % star.arms];
            const Petal petal = petal_between(a, b);
            if (!petal.holds(a, b, fan) || !(dot(petal.out, at.across) < petal.root)) continue;
            own.place.set(metal.vertex(v), opening.petal_place(petal, k, at).to_float());
            break;
        }
    }
    bake_dent(metal);
}

}  // namespace cullet
