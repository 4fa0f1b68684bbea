// What is made of sheet metal: a car's body, and a drum.
#include <algorithm>
#include <cmath>
#include <span>

#include "sample_game/figure_tools.hpp"
#include "sample_game/meshes.hpp"

namespace cullet {
namespace {

/// In the plane of a side view, m: x forward, y up.
struct Point2 {
    double x, y;
};

// Signed distance to a polygon, negative inside.
double polygon(Point2 p, std::span<const Point2> corners) {
    double square = 1e30, sign = 1;
    for (size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
        const Point2 a = corners[i], b = corners[j];
        const double ex = b.x - a.x, ey = b.y - a.y, wx = p.x - a.x, wy = p.y - a.y;
        const double along = std::clamp((wx * ex + wy * ey) / (ex * ex + ey * ey), 0.0, 1.0);
        const double dx = wx - along * ex, dy = wy - along * ey;
        square = std::min(square, dx * dx + dy * dy);
        const bool above = p.y >= a.y, below = p.y<b.y, left = ex * wy> ey * wx;
        if ((above && below && left) || (!above && !below && !left)) sign = -sign;
    }
    return sign * std::sqrt(square);
}

double both(double a, double b, double width) {
    return -blend(-a, -b, width);
}

constexpr double kLength = 4.4;  // m, of the car as it is described here
constexpr Point2 kBody[] = {{-2.06, 0.26}, {2.04, 0.26},  {2.14, 0.40},  {2.12, 0.60},  {1.98, 0.70},
                            {0.98, 0.84},  {-1.42, 0.88}, {-2.08, 0.84}, {-2.16, 0.62}, {-2.14, 0.38}};
constexpr Point2 kCabin[] = {{1.02, 0.78}, {0.30, 1.30}, {0.12, 1.35}, {-0.78, 1.36}, {-0.98, 1.31}, {-1.62, 0.80}};

double half_width(Point2 p) {
    const double ends = std::max(0.0, std::fabs(p.x) - 1.2) / 0.95;  // narrower to both ends
    const double sill = std::max(0.0, 0.5 - p.y) / 0.25;
    return 0.84 - 0.10 * ends * ends - 0.05 * sill * sill;
}
double cabin_half_width(double y) {
    return 0.80 - 0.30 * std::clamp((y - 0.80) / 0.56, 0.0, 1.0);
}

// In metres. The nose, the bonnet's crown and the flanks are bent a little, as sheet metal is: what is flat is soft.
double car(Vec3d p) {
    const double z = std::fabs(p.z);
    const Point2 at{p.x, p.y};
    const double crown = 0.035 * (1 - (z / 0.8) * (z / 0.8));
    const double lower =
        both(polygon({p.x, p.y - crown * std::clamp((p.y - 0.5) / 0.3, 0.0, 1.0)}, kBody), z - half_width(at), 0.16) -
        0.03;
    const double upper = both(polygon({p.x, p.y - crown}, kCabin), 0.9 * (z - cabin_half_width(p.y)), 0.12) - 0.03;
    double f = blend(lower, upper, 0.06);
    for (const double x : {1.34, -1.30}) {
        const double arch = std::max(std::sqrt((p.x - x) * (p.x - x) + (p.y - 0.30) * (p.y - 0.30)) - 0.36, 0.56 - z);
        f = both(f, -arch, 0.04);
    }
    return f;
}

// Regions of the surface, each below 0 inside.

constexpr double kSide = 0.42;  // m from the middle: what is farther out belongs to a side

constexpr Point2 kFrontWindow[] = {{0.70, 0.95}, {0.22, 1.27}, {0.00, 1.28}, {0.00, 0.95}};
constexpr Point2 kRearWindow[] = {{-0.12, 0.95}, {-0.12, 1.30}, {-0.76, 1.30}, {-1.02, 1.17}, {-1.24, 0.97}};
constexpr Point2 kFrontDoor[] = {{0.92, 0.34}, {0.92, 0.90}, {0.36, 1.335}, {-0.06, 1.335}, {-0.06, 0.34}};
constexpr Point2 kRearDoor[] = {{-0.06, 0.34}, {-0.06, 1.335}, {-0.86, 1.335},
                                {-1.14, 1.12}, {-1.00, 0.70},  {-0.92, 0.34}};

double on_a_side(Vec3d p, std::span<const Point2> shape) {
    return std::max(polygon({p.x, p.y}, shape), kSide - std::fabs(p.z));
}
double front_window(Vec3d p) {
    return on_a_side(p, kFrontWindow);
}
double rear_window(Vec3d p) {
    return on_a_side(p, kRearWindow);
}
// Across the car: y up, z aside, narrower above.
double across(Vec3d p, double low, double high, double wide) {
    return std::max({low - p.y, p.y - high, std::fabs(p.z) - (wide - 0.40 * (p.y - low))});
}
double windscreen(Vec3d p) {
    return std::max(across(p, 0.955, 1.27, 0.62), 0.2 - p.x);
}
double back_light(Vec3d p) {
    return std::max(across(p, 0.97, 1.26, 0.60), p.x + 0.9);
}
double bonnet(Vec3d p) {
    return std::max({0.99 - p.x, p.x - 1.98, std::fabs(p.z) - (0.70 - 0.06 * (p.x - 1)), 0.62 - p.y});
}
double boot_lid(Vec3d p) {
    return std::max({-2.04 - p.x, p.x + 1.60, std::fabs(p.z) - 0.66, 0.70 - p.y});
}
double front_door(Vec3d p) {
    return on_a_side(p, kFrontDoor);
}
double rear_door(Vec3d p) {
    return on_a_side(p, kRearDoor);
}

constexpr double (*kWindows[])(Vec3d) = {front_window, rear_window, windscreen, back_light};
constexpr double (*kParts[])(Vec3d) = {front_door, rear_door, bonnet, boot_lid};
constexpr double kGap = 0.004;  // m, that a part's border stands back from its seam

Vec3d gradient(double (*f)(Vec3d), Vec3d p) {
    constexpr double h = 1e-4;
    return {(f(p + Vec3d{h, 0, 0}) - f(p - Vec3d{h, 0, 0})) / (2 * h),
            (f(p + Vec3d{0, h, 0}) - f(p - Vec3d{0, h, 0})) / (2 * h),
            (f(p + Vec3d{0, 0, h}) - f(p - Vec3d{0, 0, h})) / (2 * h)};
}

// Vertices that are near the border of a region go onto it, along the surface.
void draw_border(MeshDraft& surface, double (*region)(Vec3d), double reach, const Figure& figure,
                 std::vector<uint8_t>& is_fixed) {
    for (size_t v = 0; v < surface.points.size(); ++v) {
        if (is_fixed[v] || !(std::fabs(region(surface.points[v])) < reach)) continue;
        Vec3d p = surface.points[v];
        for (int step = 0; step < 4; ++step) {
            const Vec3d slope = gradient(region, p);
            p = onto(figure, p - (region(p) / std::max(dot(slope, slope), 0.1)) * slope);
        }
        if (length(p - surface.points[v]) < 1.6 * reach) surface.points[v] = p, is_fixed[v] = 1;
    }
}

Vec3d middle_of(const MeshDraft& surface, const Triangle& t) {
    return (1.0 / 3) * (surface.points[t[0]] + surface.points[t[1]] + surface.points[t[2]]);
}

double area_of(const MeshDraft& surface, const Triangle& t) {
    return 0.5 *
           length(cross(surface.points[t[1]] - surface.points[t[0]], surface.points[t[2]] - surface.points[t[0]]));
}

/// Which part a triangle belongs to: 0 the shell, left and right doors apart.
uint32_t part_of(Vec3d p) {
    for (uint32_t k = 0; k < std::size(kParts); ++k)
        if (kParts[k](p) < 0) return 1 + 2 * k + (k < 2 && p.z < 0);
    return 0;
}

// Each part gets vertices of its own, and stands back from its seam.
MeshDraft apart(const MeshDraft& whole) {
    MeshDraft parts;
    constexpr uint32_t kNone32 = 0xffffffffu;
    std::vector<uint32_t> part(whole.triangles.size());
    std::vector<uint8_t> is_at_seam(whole.points.size(), 0);
    std::vector<uint32_t> first(whole.points.size(), kNone32);
    for (size_t t = 0; t < whole.triangles.size(); ++t) {
        part[t] = part_of(middle_of(whole, whole.triangles[t]));
        for (const uint32_t v : whole.triangles[t]) {
            if (first[v] != kNone32 && first[v] != part[t]) is_at_seam[v] = 1;
            if (first[v] == kNone32) first[v] = part[t];
        }
    }
    for (uint32_t of = 0; of <= 2 * std::size(kParts); ++of) {
        std::vector<uint32_t> copy(whole.points.size(), kNone32);
        std::vector<Vec3d> inward(whole.points.size());
        for (size_t t = 0; t < whole.triangles.size(); ++t)
            if (part[t] == of)
                for (const uint32_t v : whole.triangles[t])
                    inward[v] += normalised(middle_of(whole, whole.triangles[t]) - whole.points[v]);
        for (size_t t = 0; t < whole.triangles.size(); ++t) {
            if (part[t] != of) continue;
            Triangle made{};
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t v = whole.triangles[t][k];
                if (copy[v] == kNone32) {
                    copy[v] = static_cast<uint32_t>(parts.points.size());
                    const bool stands_back = of > 0 && is_at_seam[v] && length(inward[v]) > 0;
                    parts.points.push_back(whole.points[v] + (stands_back ? kGap : 0.0) * normalised(inward[v]));
                }
                made[k] = copy[v];
            }
            parts.triangles.push_back(made);
        }
    }
    return parts;
}

// A steel drum of 216 l: 0.58 m wide, 0.88 m high, two hoops, round rims.
double drum(Vec3d p) {
    constexpr double kRadius = 0.286, kHalf = 0.44;
    const double r = std::sqrt(p.x * p.x + p.z * p.z);
    const auto bulge = [&](double at, double high, double wide) {
        const double away = (p.y - at) / wide;
        return high * std::max(0.0, 1 - away * away);
    };
    const double wall = r - kRadius - bulge(0.147, 0.016, 0.04) - bulge(-0.147, 0.016, 0.04);
    return both(0.8 * wall, std::fabs(p.y) - kHalf, 0.06);
}

}  // namespace

Mesh make_car(float length, uint32_t vertices, uint64_t seed) {
    const Figure figure{[](Vec3d p) { return car(kLength * p) / kLength; }, {-0.56, 0.02, -0.24}, {0.56, 0.36, 0.24}};
    // Glass takes a tenth of the skin; seams give some of it back.
    MeshDraft whole = figure_of(figure, std::max<size_t>(vertices, 2000) * 1026 / 1000, seed);
    for (Vec3d& p : whole.points) p = kLength * p;
    const Figure in_metres{car, {}, {}};
    double area = 0;
    for (const Triangle& t : whole.triangles) area += area_of(whole, t);
    const double edge = std::sqrt(2.3094 * area / static_cast<double>(whole.triangles.size()));
    std::vector<uint8_t> is_fixed(whole.points.size(), 0);
    for (const auto region : kWindows) draw_border(whole, region, 0.45 * edge, in_metres, is_fixed);
    for (const auto region : kParts) draw_border(whole, region, 0.45 * edge, in_metres, is_fixed);
    std::erase_if(whole.triangles, [&](const Triangle& t) {
        const Vec3d middle = middle_of(whole, t);
        const bool is_glass =
            std::any_of(std::begin(kWindows), std::end(kWindows), [&](auto window) { return window(middle) < 0; });
        return is_glass || area_of(whole, t) < 0.02 * edge * edge;
    });
    MeshDraft parts = apart(whole);
    stand(parts, static_cast<double>(length));
    return to_mesh(parts, "car");
}

Mesh make_drum(float height, uint32_t vertices, uint64_t seed) {
    MeshDraft surface = figure_of({drum, {-0.36, -0.50, -0.36}, {0.36, 0.50, 0.36}}, vertices, seed);
    for (Vec3d& p : surface.points) p = (static_cast<double>(height) / 0.88) * p;
    return to_mesh(surface, "drum");
}

}  // namespace cullet
