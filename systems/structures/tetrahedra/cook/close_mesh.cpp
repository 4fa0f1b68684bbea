#include <algorithm>
#include <cstdio>

#include "engine/polygon.hpp"
#include "engine/table.hpp"
#include "systems/cook/disjoint_sets.hpp"
#include "systems/cook/surface.hpp"
#include "systems/structures/tetrahedra/cook/closed_mesh.hpp"
#include "systems/structures/tetrahedra/cook/ray_crossings.hpp"

namespace cullet {
namespace {

constexpr double kLeastVolume = 1e-9;      // of the box's cube of the diagonal: a sheet, whatever rounding says
constexpr double kLeastFilledArea = 1e-9;  // of the surface: a slit that a dropped triangle of no area left is no hole

/// One side of a triangle, from its lower to its higher end or back.
struct Side {
    uint32_t low, high;
    uint32_t number;  // 3 triangle + corner
    bool is_forward;
};

std::vector<Side> sorted_sides(const std::vector<Triangle>& triangles) {
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (uint32_t t = 0; t < triangles.size(); ++t)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), 3 * t + k, a < b});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        if (a.low != b.low) return a.low < b.low;
        if (a.high != b.high) return a.high < b.high;
        return a.is_forward != b.is_forward ? a.is_forward : a.number < b.number;
    });
    return sides;
}

// The i-th that runs forward goes with the i-th that runs back: `pair(forward, back)`, or `alone(side)`.
template <class Pair, class Alone>
void match(const std::vector<Side>& sides, Pair pair, Alone alone) {
    for (size_t first = 0, end; first < sides.size(); first = end) {
        size_t back = first;
        end = first;
        while (end < sides.size() && sides[end].low == sides[first].low && sides[end].high == sides[first].high)
            back += sides[end].is_forward, ++end;
        const size_t both = std::min(back - first, end - back);
        for (size_t i = 0; i < both; ++i) pair(sides[first + i], sides[back + i]);
        for (size_t i = first + both; i < back; ++i) alone(sides[i]);
        for (size_t i = back + both; i < end; ++i) alone(sides[i]);
    }
}

/// The way round a hole, so that its triangles run counter-clockwise from outside.
using Loop = std::vector<uint32_t>;

// Every vertex has as many lone sides that come as go. A walk that meets itself gives up the loop that it has closed,
// so that loops are simple.
std::vector<Loop> border_loops(const std::vector<Triangle>& triangles, size_t vertex_count) {
    std::vector<std::vector<uint32_t>> ways(vertex_count);
    uint32_t left = 0;
    match(
        sorted_sides(triangles), [](const auto&, const auto&) {},
        [&](const Side& side) {
            // The triangle that is missing runs the other way.
            ways[side.is_forward ? side.high : side.low].push_back(side.is_forward ? side.low : side.high);
            ++left;
        });
    std::vector<Loop> loops;
    std::vector<uint32_t> place(vertex_count, kNone);  // in the walk
    for (uint32_t start = 0; start < vertex_count && left > 0; ++start)
        while (!ways[start].empty()) {
            Loop walk;
            for (uint32_t at = start;;) {
                if (place[at] != kNone) {
                    loops.emplace_back(walk.begin() + place[at], walk.end());
                    for (const uint32_t v : loops.back()) place[v] = kNone;
                    walk.resize(walk.size() - loops.back().size());
                }
                if (walk.empty() && ways[at].empty()) break;
                place[at] = static_cast<uint32_t>(walk.size());
                walk.push_back(at);
                const uint32_t next = ways[at].back();
                ways[at].pop_back(), --left;
                at = next;
            }
        }
    return loops;
}

double area_of(const ClosedMesh& mesh, const Triangle& t) {
    const Vec3d a = mesh.positions[t[0]];
    return 0.5 * length(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
}

struct Filled {
    uint32_t open_edges = 0;
    double area = 0;
};
Filled fill_holes(ClosedMesh& mesh, double own_area) {
    Filled filled;
    for (const Loop& loop : border_loops(mesh.triangles, mesh.positions.size())) {
        filled.open_edges += static_cast<uint32_t>(loop.size());
        std::vector<Vec3d> corners;
        for (const uint32_t v : loop) corners.push_back(mesh.positions[v]);
        double area = 0;
        for (const auto& t : cut_polygon(corners)) {
            mesh.triangles.push_back({loop[t[0]], loop[t[1]], loop[t[2]]});
            mesh.source.push_back(kNone);
            mesh.source_corners.push_back({0, 1, 2});
            area += area_of(mesh, mesh.triangles.back());
        }
        filled.area += area;
        mesh.holes += area > kLeastFilledArea * own_area;
    }
    return filled;
}

/// Triangles that hang together over pairs of sides.
struct Part {
    double volume = 0;
    Vec3d low, high, inner;  // a point just inside, if it is a cavity
    uint32_t first = kNone;  // triangle
    bool is_turned = false;
    bool is_one_sided = false;  // encloses nothing, whatever the sum over its triangles is
    uint32_t around = kNone;    // the part that a cavity is in
};

void pair_sides(ClosedMesh& mesh) {
    mesh.sides.assign(mesh.triangles.size(), {kNone, kNone, kNone});
    match(
        sorted_sides(mesh.triangles),
        [&](const Side& a, const Side& b) {
            mesh.sides[a.number / 3][a.number % 3] = mesh.sides[b.number / 3][b.number % 3] =
                static_cast<uint32_t>(mesh.pairs.size());
            mesh.pairs.push_back({a.low, a.high});
        },
        [](const auto&) {});
}

std::vector<Part> find_parts(ClosedMesh& mesh) {
    std::vector<uint32_t> beside(mesh.pairs.size(), kNone);
    DisjointSets sets(mesh.triangles.size());
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (const uint32_t pair : mesh.sides[t]) {
            if (beside[pair] != kNone) sets.unite(t, beside[pair]);
            beside[pair] = t;
        }
    std::vector<Part> parts;
    mesh.part_of.assign(mesh.triangles.size(), kNone);
    const Vec3d middle = 0.5 * (mesh.low + mesh.high);
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const uint32_t root = sets.find(t);
        const Triangle& c = mesh.triangles[t];
        if (root == t) {
            mesh.part_of[t] = static_cast<uint32_t>(parts.size());
            Part part;
            part.first = t;
            part.low = part.high = mesh.positions[c[0]];
            parts.push_back(part);
        }
        mesh.part_of[t] = mesh.part_of[root];
        Part& part = parts[mesh.part_of[t]];
        part.volume +=
            dot(mesh.positions[c[0]] - middle, cross(mesh.positions[c[1]] - middle, mesh.positions[c[2]] - middle)) / 6;
        for (const uint32_t v : c) {
            const Vec3d p = mesh.positions[v];
            part.low = {std::min(part.low.x, p.x), std::min(part.low.y, p.y), std::min(part.low.z, p.z)};
            part.high = {std::max(part.high.x, p.x), std::max(part.high.y, p.y), std::max(part.high.z, p.z)};
        }
    }
    return parts;
}

bool holds(const Part& part, Vec3d p) {
    return part.low.x < p.x && part.low.y < p.y && part.low.z < p.z && part.high.x > p.x && part.high.y > p.y &&
           part.high.z > p.z;
}

// The smallest part whose surface a ray from there leaves once more than it enters. In double: whichever part a cavity
// is counted to, the sums over all parts stay the same.
uint32_t part_around(const ClosedMesh& mesh, const std::vector<Part>& parts, Vec3d p) {
    std::vector<int32_t> count(parts.size());
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Part& part = parts[mesh.part_of[t]];
        if (!(part.volume > 0) || !holds(part, p)) continue;
        const Triangle& c = mesh.triangles[t];
        count[mesh.part_of[t]] += ray_crossing(p, mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]]);
    }
    uint32_t best = kNone;
    for (uint32_t c = 0; c < parts.size(); ++c)
        if (count[c] > 0 && (best == kNone || parts[c].volume < parts[best].volume)) best = c;
    return best;
}

// A part of negative volume is the wall of a cavity if it lies in another; else it is inside out.
void turn_parts(ClosedMesh& mesh, std::vector<Part>& parts) {
    for (Part& part : parts) {
        if (!(part.volume < 0)) continue;
        const Triangle& c = mesh.triangles[part.first];
        const Vec3d a = mesh.positions[c[0]], b = mesh.positions[c[1]], d = mesh.positions[c[2]];
        const Vec3d within =
            (1.0 / 3) * (a + b + d) + (1e-7 * length(mesh.high - mesh.low)) * normalised(cross(b - a, d - a));
        part.around = part_around(mesh, parts, within);
        part.is_turned = part.around == kNone;
    }
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!parts[mesh.part_of[t]].is_turned) continue;
        std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
        std::swap(mesh.source_corners[t][1], mesh.source_corners[t][2]);
        std::swap(mesh.sides[t][0], mesh.sides[t][2]);
    }
    std::vector<uint32_t> number(parts.size(), kNone);
    for (uint32_t p = 0; p < parts.size(); ++p) {
        if (parts[p].is_turned) parts[p].volume = -parts[p].volume;
        if (parts[p].around == kNone) number[p] = mesh.part_count++;
        mesh.volume += parts[p].volume;
    }
    for (uint32_t& part : mesh.part_of) part = number[parts[part].around == kNone ? part : parts[part].around];
}

std::string in_percent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, share < 0.0995 ? "%.1f" : "%.0f", 100 * share);
    return text;
}

}  // namespace

Result<ClosedMesh> close_mesh(const Mesh& given, const ClosingSettings& settings) {
    SurfaceSettings welding;
    welding.weld_tolerance = settings.weld_tolerance;
    welding.searches_crossings = false;
    Result<Surface> surface = prepare_surface(given, welding);
    if (!surface) return Error{surface.error()};
    const std::string name = given.name.empty() ? "mesh" : "\"" + given.name + "\"";
    ClosedMesh mesh;
    mesh.low = surface->low, mesh.high = surface->high;
    // Fans that meet in a point are one vertex again: what touches in a place is cut as one.
    mesh.positions.resize(surface->position_count);
    for (uint32_t v = 0; v < surface->positions.size(); ++v)
        mesh.positions[surface->position_ids[v]] = surface->positions[v];
    for (const Triangle& t : surface->triangles)
        mesh.triangles.push_back(
            {surface->position_ids[t[0]], surface->position_ids[t[1]], surface->position_ids[t[2]]});
    mesh.source = std::move(surface->source_triangles);
    mesh.source_corners = std::move(surface->source_corners);

    double own_area = 0;
    for (const Triangle& t : mesh.triangles) own_area += area_of(mesh, t);
    const Filled filled = fill_holes(mesh, own_area);
    mesh.area = own_area + filled.area;
    mesh.filled_share = filled.area / mesh.area;
    if (mesh.filled_share > settings.largest_filled)
        return Error{name + " is no solid: " + std::to_string(filled.open_edges) +
                     " open edges, closing them would add " + in_percent(mesh.filled_share) +
                     " % of new surface. Close it, or use the model thick_shell."};
    pair_sides(mesh);
    std::vector<Part> parts = find_parts(mesh);
    for (uint32_t t = 0; t < surface->triangles.size(); ++t)
        parts[mesh.part_of[t]].is_one_sided |= !surface->components[surface->component_of[t]].is_orientable;
    turn_parts(mesh, parts);
    const double diagonal = surface->diagonal;
    double sound = 0;
    for (const Part& part : parts)
        if (!part.is_one_sided) sound += part.volume;
    if (!(sound > kLeastVolume * diagonal * diagonal * diagonal)) return Error{name + " encloses no volume."};
    return mesh;
}

std::string describe(const ClosedMesh& mesh) {
    if (mesh.holes == 0) return "";
    return "filled " + std::to_string(mesh.holes) + (mesh.holes == 1 ? " hole (" : " holes (") +
           in_percent(mesh.filled_share) + " % of the surface)";
}

}  // namespace cullet
