#include "systems/impacts/snap.hpp"

#include <algorithm>
#include <cmath>

#include "engine/principal_axes.hpp"
#include "engine/random.hpp"
#include "systems/structures/tetrahedra/skin.hpp"

namespace cullet {
namespace {

// Of the width along which the crack runs: how far it strays, and how far the line goes on beyond the body.
constexpr float kStray = 0.04f, kPast = 0.25f;
// Of the body, along the normal, that is left on either side.
constexpr float kKept = 0.1f;
constexpr uint32_t kFewestPoints = 2, kMostPoints = 12;
constexpr float kAskew = 0.15f;  // of the plane through a solid, each way

/// How far the body goes along a direction, from the frame's origin, m.
struct Extent {
    float low = 1e30f, high = -1e30f;
    float size() const { return high - low; }
    void add(float at) { low = std::min(low, at), high = std::max(high, at); }
};
Extent extent_along(const Vertices& vertices, Range rows, Vec3 direction) {
    Extent e;
    for (uint32_t v = rows.first; v < rows.first + rows.count; ++v) {
        if (vertices.element[v] == kNone) continue;
        e.add(dot(direction, vertices.rest[v]));
    }
    return e;
}

// A row of a cut of the body, which nobody asks the game about.
uint32_t append_cut(Blows& blows, Row<Bodies> body) {
    const uint32_t row = blows.append(1);
    if (row == kNone) return kNone;
    blows.clear_rows(row, 1);
    blows.kind[row] = static_cast<uint8_t>(BlowKind::Cut);
    blows.body[row] = body;
    blows.task[row] = kNone;
    blows.is_taken[row] = 1;
    return row;
}
float kept_between(const Extent& along, float at) {
    return std::clamp(at, along.low + kKept * along.size(), along.high - kKept * along.size());
}

}  // namespace

bool snap(Blows& blows, const ShellRows& rows, const Bodies& bodies, Row<Bodies> body, Vec3 place, Vec3 normal,
          uint64_t seed) {
    if (blows.size() >= blows.limit() / 2) return false;
    const Row<Shells> shell = rows.shell_of(bodies.structure[body]);
    const Range range = rows.shells.vertices[shell];
    // The crack goes straight through the thinnest side.
    const Vec3 sweep = axis_across(bodies.inertia[body], Vec3d(normal), Inertia::Most).to_float();
    const Vec3 line = cross(sweep, normal);
    const Extent along = extent_along(rows.vertices, range, normal), wide = extent_along(rows.vertices, range, line);
    if (!(along.size() > 0 && wide.size() > 0)) return false;
    const uint32_t row = append_cut(blows, body);
    if (row == kNone) return false;
    blows.direction.set(row, sweep);
    const float edge = std::max(rows.shells.mean_edge[shell], 1e-3f * wide.size());
    const uint32_t points =
        std::clamp(static_cast<uint32_t>(std::ceil(wide.size() / edge)), kFewestPoints, kMostPoints);
    const float at = kept_between(along, dot(normal, place));
    const float stray = std::min(kStray * wide.size(), 0.5f * kKept * along.size());
    const Random random{seed};
    const auto aside = [&](uint32_t i) { return stray * static_cast<float>(2 * random.uniform(i) - 1); };
    // A jagged line through few elements, or one that has parted nothing, gives way to a plane.
    if (points < 3 || bodies.overload_runs[body] > 1) {
        blows.point.set(row, at * normal + (wide.low + 0.5f * wide.size()) * line + dot(sweep, place) * sweep);
        blows.direction.set(row, normalised(normal + (2 * aside(0) / wide.size()) * line));
        return true;
    }
    blows.point_count[row] = points;
    for (uint32_t i = 0; i < points; ++i) {
        const float share = -kPast + (1 + 2 * kPast) * static_cast<float>(i) / static_cast<float>(points - 1);
        set_cut_point(blows, row, i,
                      (at + aside(i)) * normal + (wide.low + share * wide.size()) * line + dot(sweep, place) * sweep);
    }
    return true;
}

bool snap_solid(Blows& blows, Read<SolidRows> rows, const Bodies& bodies, Row<Bodies> body, Vec3 place, Vec3 normal,
                uint64_t seed) {
    if (blows.size() >= blows.limit() / 2) return false;
    const Random random{seed};
    const auto aside = [&](uint32_t i) { return kAskew * static_cast<float>(2 * random.uniform(i) - 1); };
    const Vec3 across = normalised(normal + Vec3{aside(0), aside(1), aside(2)});
    Extent along;
    const Range points = skin_of(rows, bodies.structure[body]).points;
    for (uint32_t p = points.first; p < points.first + points.count; ++p)
        along.add(dot(across, rows.skin_points.place[p].to_float()));
    const uint32_t row = along.size() > 0 ? append_cut(blows, body) : kNone;
    if (row == kNone) return false;
    const float at = dot(across, place);
    blows.point.set(row, place + (kept_between(along, at) - at) * across);
    blows.direction.set(row, across);
    return true;
}

}  // namespace cullet
