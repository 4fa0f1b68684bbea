#include <algorithm>
#include <cmath>

#include "sample_game/mesh_tools.hpp"
#include "sample_game/meshes.hpp"

namespace cullet {
namespace {

constexpr double kTurn = 6.283185307179586477;
constexpr double kRowHeight = 0.86602540378443865;  // of an equilateral triangle, in edges
// Of the edge length. Exact rows give ring cracks and a disc cut round the pole (thick shell note C7).
constexpr double kJitter = 0.18;
constexpr int kSamplesPerSpan = 256;

struct ProfilePoint {
    double radius = 0, y = 0;
};

/// A smooth meridian from the pole to the rim, by arc length. It is a uniform cubic B-spline over the control points,
/// mirrored at the pole and clamped at the rim. It is stored as a polyline fine enough (some 0.1 mm) to be taken for
/// the curve.
struct Profile {
    std::vector<ProfilePoint> points;
    std::vector<double> distance;

    Profile(const std::vector<ProfilePoint>& control, double scale) {
        const size_t n = control.size();
        const auto at = [&control, n](size_t i) -> ProfilePoint {  // i = 0 is the mirrored one
            if (i == 0) return {-control[1].radius, control[1].y};
            if (i <= n) return control[i - 1];
            return {2 * control[n - 1].radius - control[n - 2].radius, 2 * control[n - 1].y - control[n - 2].y};
        };
        for (size_t span = 0; span + 1 < n; ++span)
            for (int k = 0; k < kSamplesPerSpan + (span + 2 == n ? 1 : 0); ++k) {
                const double t = static_cast<double>(k) / kSamplesPerSpan, u = 1 - t;
                const double w[4] = {u * u * u / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
                                     (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6};
                ProfilePoint p;
                for (size_t i = 0; i < 4; ++i) {
                    p.radius += scale * w[i] * at(span + i).radius;
                    p.y += scale * w[i] * at(span + i).y;
                }
                append(p);
            }
    }

    void append(ProfilePoint p) {
        double s = 0;
        if (!points.empty()) {
            const double dr = p.radius - points.back().radius, dy = p.y - points.back().y;
            s = distance.back() + std::sqrt(dr * dr + dy * dy);
        }
        points.push_back(p);
        distance.push_back(s);
    }

    double total() const { return distance.back(); }

    ProfilePoint at(double s) const {
        const size_t above =
            static_cast<size_t>(std::lower_bound(distance.begin(), distance.end(), s) - distance.begin());
        if (above == 0) return points.front();
        if (above >= points.size()) return points.back();
        const double w = (s - distance[above - 1]) / (distance[above] - distance[above - 1]);
        const ProfilePoint p = points[above - 1], q = points[above];
        return {p.radius + w * (q.radius - p.radius), p.y + w * (q.y - p.y)};
    }
};

/// One row of points round the axis, as many as the circumference holds edges, from a random start, each moved along
/// the surface.
std::vector<uint32_t> add_row(MeshDraft& surface, const Profile& profile, double s, bool is_rim, double edge,
                              uint64_t seed, uint64_t row) {
    const double radius = profile.at(s).radius;
    const auto count = static_cast<uint64_t>(std::max(5.0, std::floor(kTurn * radius / edge + 0.5)));
    const double start = jitter(seed, row, 0, 0);
    std::vector<uint32_t> ids;
    for (uint64_t i = 0; i < count; ++i) {
        const double along = kJitter * edge * jitter(seed, row, i, 1);
        const ProfilePoint p = profile.at(is_rim ? s : s + kJitter * edge * jitter(seed, row, i, 2));
        const double angle = kTurn * (static_cast<double>(i) + start) / static_cast<double>(count) + along / radius;
        double sine = 0, cosine = 1;
        sine_cosine(angle, sine, cosine);
        ids.push_back(static_cast<uint32_t>(surface.points.size()));
        surface.points.push_back({p.radius * cosine, p.y, p.radius * sine});
    }
    return ids;
}

/// Rows one triangle height apart from the pole (one vertex) to the open rim.
MeshDraft lathe(const Profile& profile, double wanted_edge, uint64_t seed) {
    const double edge = usable_edge(wanted_edge, profile.total());
    const auto rows = static_cast<uint64_t>(std::max(3.0, std::floor(profile.total() / (kRowHeight * edge) + 0.5)));
    MeshDraft surface;
    surface.points.push_back({0, profile.points.front().y, 0});
    std::vector<uint32_t> before;
    for (uint64_t row = 1; row <= rows; ++row) {
        const double s = profile.total() * static_cast<double>(row) / static_cast<double>(rows);
        const std::vector<uint32_t> ids = add_row(surface, profile, s, row == rows, edge, seed, row);
        if (row == 1)
            for (size_t i = 0; i < ids.size(); ++i) surface.triangles.push_back({0, ids[i], ids[(i + 1) % ids.size()]});
        else
            stitch_rows(surface, before, ids, true);
        before = ids;
    }
    flip_to_delaunay(surface);
    return surface;
}

}  // namespace

Mesh make_vase(float height, float edge, uint64_t seed) {
    const std::vector<ProfilePoint> control{
        {0, 0},         {0.018, 0},     {0.036, 0},     {0.050, 0.002}, {0.060, 0.018}, {0.078, 0.055}, {0.096, 0.098},
        {0.101, 0.145}, {0.090, 0.190}, {0.062, 0.224}, {0.042, 0.248}, {0.041, 0.270}, {0.049, 0.289}, {0.057, 0.300}};
    return to_mesh(lathe(Profile(control, static_cast<double>(height) / 0.300), static_cast<double>(edge), seed),
                   "vase");
}

Mesh make_solid_bowl(float width, float wall, uint32_t around) {
    const double outer = 0.5 * static_cast<double>(width), thick = static_cast<double>(wall), inner = outer - thick,
                 foot = 0.32 * outer, depth = 0.62 * outer;
    const uint32_t count = std::clamp(around, 8u, 512u);
    // Up the outside from the edge of the foot to the rim, over it and down the inside: a quarter of an ellipse each.
    std::vector<ProfilePoint> rows;
    const auto rise = [&](double radius, double low, double from, bool is_up) {
        const uint32_t steps = std::max(4u, count / 6);
        for (uint32_t k = 0; k <= steps; ++k) {
            const double share = static_cast<double>(is_up ? k : steps - k) / steps;
            double sine = 0, cosine = 1;
            sine_cosine(kTurn / 4 * (from + (1 - from) * share), sine, cosine);
            rows.push_back({radius * sine, low + (depth - low) * (1 - cosine)});
        }
    };
    rise(outer, -0.1 * depth, 0.28, true);
    rows.push_back({0.5 * (outer + inner), depth + 0.4 * thick});
    rise(inner, thick, 0.1, false);
    const double lowest = rows.front().y;
    MeshDraft surface;
    const auto add_round = [&](ProfilePoint p, double turned) {
        std::vector<uint32_t> ids;
        for (uint32_t i = 0; i < count; ++i) {
            double sine = 0, cosine = 1;
            sine_cosine(kTurn * (i + turned) / count, sine, cosine);
            ids.push_back(static_cast<uint32_t>(surface.points.size()));
            surface.points.push_back({p.radius * cosine, p.y - lowest, p.radius * sine});
        }
        return ids;
    };
    const auto close = [&](double y, const std::vector<uint32_t>& round, bool is_first) {
        const auto pole = static_cast<uint32_t>(surface.points.size());
        surface.points.push_back({0, y - lowest, 0});
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t a = round[i], b = round[(i + 1) % count];
            surface.triangles.push_back(is_first ? Triangle{pole, a, b} : Triangle{pole, b, a});
        }
    };
    std::vector<uint32_t> before = add_round({foot, lowest}, 0);
    close(lowest, before, true);
    for (size_t r = 0; r < rows.size(); ++r) {
        if (r == 0 && !(rows[0].radius > foot)) continue;
        const std::vector<uint32_t> next = add_round(rows[r], 0.5 * static_cast<double>(r % 2 + 1));
        stitch_rows(surface, before, next, true);
        before = next;
    }
    close(rows.back().y, before, false);
    return to_mesh(surface, "bowl");
}

}  // namespace cullet
