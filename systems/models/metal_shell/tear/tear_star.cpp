#include "systems/models/metal_shell/tear/tear_star.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kWorkALength = 5;  // yield stress times thickness squared, that a crack and the bending beside it take
constexpr double kClears = 1.05;    // of the striker's radius, that its hole has
constexpr double kBend = 0.25, kLeastBend = 2;        // of the striker's radius, and of a mean edge
constexpr double kLeastArm = 2;                       // mean edges
constexpr double kMostOfSupport = 0.9;                // that arms run to
constexpr double kUnevenArms = 0.12, kTurned = 0.15;  // of their length, and of the angle between two
constexpr double kSlit = 0.35, kWideSlit = 0.1;       // of the work of a hole, below which it is a slit; of its length
constexpr double kMostOfStar = 0.95;                  // of it, where nothing may go through
constexpr double kPlugWork = 3, kPlug = 0.55;         // of that work, and of the striker's radius
constexpr double kLeastPlug = 1.4, kMostPlug = 0.7;   // mean edges, and of the way to the petals' roots
constexpr double kPartlyOpen = 0.9, kOpen = 1.45;     // rad

// The same on a body that is turned: along an edge of the mesh.
void lay_axes(const MetalView& metal, uint32_t vertex, TearStar& star) {
    const Vertices& vertices = metal.shell.state.vertices;
    const uint32_t element = vertices.element[metal.shell.vertex(vertex)];
    for (const uint32_t v : metal.corners(element)) {
        if (v == vertex) continue;
        const Vec3d way = Vec3d(vertices.rest[metal.shell.vertex(v)]) - star.middle;
        const Vec3d flat = way - cullet::dot(way, star.push) * star.push;
        if (!(cullet::length(flat) > 0.1 * cullet::length(way))) continue;
        star.x = (1 / cullet::length(flat)) * flat;
        star.y = cross(star.push, star.x);
        return;
    }
}

void lay_arms(TearStar& star, double length) {
    const double first = 2 * kPi * scatter(star.seed, 0);
    for (uint32_t k = 0; k < star.arms; ++k) {
        const double uneven = 2 * scatter(star.seed, 2 * k + 1) - 1, longer = scatter(star.seed, 2 * k + 2);
        const double angle = first + 2 * kPi / star.arms * (k + kTurned * uneven);
        double sine = 0, cosine = 1;
        sine_cosine(angle, sine, cosine);
        const double own = length * (1 + kUnevenArms * longer);
        star.tip[k] = {own * cosine, own * sine};
        star.length = std::max(star.length, own);
    }
}

// Of the widest petal, how far its root is from the axis, of the length of its arms.
double nearest_root(uint32_t arms) {
    double sine = 0, cosine = 1;
    sine_cosine(kPi / arms * (1 + 2 * kTurned), sine, cosine);
    return cosine;
}

double work_of(const MetalView& metal, uint32_t arms, double length) {
    const SheetMetal sheet = sheet_metal(metal);
    return kWorkALength * sheet.yield_stress * sheet.thickness * sheet.thickness * arms * length;
}

}  // namespace

double scatter(uint32_t seed, uint32_t number) {
    uint32_t h = seed * 0x9e3779b9u + number * 0x85ebca6bu + 0x27d4eb2fu;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return (h ^ (h >> 15)) * (1.0 / 4294967296.0);
}

TearStar plan_star(const MetalView& metal, const Dent& dent, bool may_pass) {
    TearStar star;
    if (!(dent.tearing > 0)) return star;
    const Vertices& vertices = metal.shell.state.vertices;
    if (vertices.element[metal.shell.vertex(dent.vertex)] == kNone) return star;
    star.middle = Vec3d(vertices.rest[metal.shell.vertex(dent.vertex)]);
    star.push = dent.striker.push;
    star.seed = dent.vertex;
    lay_axes(metal, dent.vertex, star);
    if (!(cullet::length(star.x) > 0)) return star;
    const double edge = double{metal.shells().mean_edge[metal.row]}, r = dent.striker.radius;
    const double most = kMostOfSupport * dent.support, least = kLeastArm * edge;
    star.bend = std::max(kBend * r, kLeastBend * edge);
    const double root = kClears * r + 0.6 * star.bend;
    const auto arm = [&](uint32_t arms) { return std::clamp(root / nearest_root(arms), least, std::max(most, least)); };
    const double hole = work_of(metal, kMostPetals, arm(kMostPetals));
    const double share = may_pass ? dent.tearing / hole : std::min(dent.tearing / hole, kMostOfStar);
    star.is_through = share >= 1;
    if (star.is_through) {
        star.arms = kMostPetals;
        lay_arms(star, arm(star.arms));
        star.work = hole;
        star.most_turn = kOpen;
        const double plug = std::max(kPlug * r, kLeastPlug * edge);
        if (share >= kPlugWork && plug < kMostPlug * root && plug < kMostPlug * most) star.plug = plug;
    } else {
        star.arms = share < kSlit ? 2 : 4;
        lay_arms(star, std::clamp(dent.contact * (0.6 + share), least, std::max(most, least)));
        star.work = dent.tearing;
        star.most_turn = kPartlyOpen * share;
        star.gap = kWideSlit * star.length;
    }
    return star;
}

}  // namespace cullet
