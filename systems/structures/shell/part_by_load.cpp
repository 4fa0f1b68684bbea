#include "systems/structures/shell/part_by_load.hpp"

#include <algorithm>
#include <cmath>

#include "engine/principal_axes.hpp"
#include "engine/random.hpp"

namespace cullet {
namespace {

// Of the width along which the crack runs: how far it strays, and how far the line goes on beyond the body.
constexpr float kStray = 0.04f, kPast = 0.25f;
constexpr uint32_t kFewestPoints = 2, kMostPoints = 12;

SectionExtent extent_along(const Vertices& vertices, Range rows, Vec3 direction) {
    SectionExtent e;
    for (uint32_t v = rows.first; v < rows.first + rows.count; ++v) {
        if (vertices.element[v] == kNone) continue;
        e.add(dot(direction, vertices.rest[v]));
    }
    return e;
}

}  // namespace

bool part_shell_by_load(const BodyRows& rows, Blows& blows, Row<Bodies> body, const LoadedSection& section) {
    if (!has_row_for_cut(blows)) return false;
    const Bodies& bodies = rows.bodies;
    const Vec3 place = section.place, normal = section.normal;
    const Row<Shells> shell = rows.shell_of(bodies.structure[body]);
    const Range range = rows.shells.vertices[shell];
    // The crack goes straight through the thinnest side.
    const Vec3 sweep = axis_across(bodies.inertia[body], Vec3d(normal), Inertia::Most).to_float();
    const Vec3 line = cross(sweep, normal);
    const SectionExtent along = extent_along(rows.vertices, range, normal),
                        wide = extent_along(rows.vertices, range, line);
    if (!(along.size() > 0 && wide.size() > 0)) return false;
    const uint32_t row = append_cut(blows, body);
    if (row == kNone) return false;
    blows.direction.set(row, sweep);
    const float edge = std::max(rows.shells.mean_edge[shell], 1e-3f * wide.size());
    const uint32_t points =
        std::clamp(static_cast<uint32_t>(std::ceil(wide.size() / edge)), kFewestPoints, kMostPoints);
    const float at = kept_between(along, dot(normal, place));
    const float stray = std::min(kStray * wide.size(), 0.5f * kKeptOfCut * along.size());
    const Random random{section.seed};
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

}  // namespace cullet
