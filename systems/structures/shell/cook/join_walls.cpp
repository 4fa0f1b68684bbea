#include "systems/structures/shell/cook/join_walls.hpp"

#include <algorithm>
#include <cstdio>

#include "systems/structures/shell/cook/tetrahedra.hpp"
#include "systems/structures/shell/cook/wall_sides.hpp"

namespace cullet {
namespace {

constexpr double kReach = 2;          // thicknesses
constexpr double kMostOfIt = 0.5;     // of the area, matched
constexpr double kTwoSkins = 0.8;     // of the matched area, whose opposite is on the other side; a rod has none
constexpr double kLeastExtent = 150;  // of half the area, in squares of the mean thickness; a brick has 40, a mug 400
constexpr double kLipFacing = 0.5;    // n . into the wall of lip triangles that stay with the outer wall

/// Of a closed part with the cavities inside.
struct Part {
    double area = 0, matched = 0, across = 0, volume = 0;
    double of_side[3] = {};
    uint32_t first_side = 0;
    WallSide outer = WallSide::None;
    bool is_joined = false;
};

double area_of(const Surface& s, uint32_t t) {
    const Triangle& c = s.triangles[t];
    return length(cross(s.positions[c[1]] - s.positions[c[0]], s.positions[c[2]] - s.positions[c[0]])) / 2;
}

Vec3d normal_of(const Surface& s, uint32_t t) {
    const Triangle& c = s.triangles[t];
    return normalised(cross(s.positions[c[1]] - s.positions[c[0]], s.positions[c[2]] - s.positions[c[0]]));
}

// A cavity belongs to the part that most of it lies across from.
std::vector<uint32_t> whole_of_component(const Surface& s, const WallSides& sides) {
    const size_t count = s.components.size();
    std::vector<uint32_t> whole(count);
    for (uint32_t c = 0; c < count; ++c) whole[c] = c;
    for (uint32_t c = 0; c < count; ++c) {
        if (!s.components[c].is_cavity) continue;
        std::vector<double> votes(count);
        for (uint32_t t = 0; t < s.triangles.size(); ++t)
            if (s.component_of[t] == c && sides.opposite[t] != kNone)
                votes[s.component_of[sides.opposite[t]]] += area_of(s, t);
        const auto most = std::max_element(votes.begin(), votes.end());
        if (*most > 0) whole[c] = static_cast<uint32_t>(most - votes.begin());
    }
    return whole;
}

std::vector<Part> judge_parts(const Surface& s, const WallSides& sides, const std::vector<uint32_t>& whole) {
    std::vector<Part> parts(s.components.size());
    for (uint32_t c = 0; c < parts.size(); ++c) parts[whole[c]].volume += s.components[c].volume;
    for (uint32_t t = 0; t < s.triangles.size(); ++t) {
        Part& part = parts[whole[s.component_of[t]]];
        const double area = area_of(s, t);
        const auto side = static_cast<size_t>(sides.side[t]);
        part.area += area;
        part.of_side[side] += area;
        if (part.first_side == 0) part.first_side = static_cast<uint32_t>(side);
        if (sides.opposite[t] == kNone) continue;
        part.matched += area;
        if (sides.side[sides.opposite[t]] != sides.side[t]) part.across += area;
    }
    for (uint32_t c = 0; c < parts.size(); ++c) {
        Part& part = parts[c];
        const double half = part.area / 2, mean = part.volume / half;
        part.is_joined = whole[c] == c && s.components[c].is_closed && part.volume > 0 &&
                         part.matched > kMostOfIt * part.area && part.across > kTwoSkins * part.matched &&
                         half > kLeastExtent * mean * mean;
        // The outer wall is the larger one; of two alike, that of the lowest triangle.
        const double one = part.of_side[1], other = part.of_side[2];
        const bool are_alike = std::fabs(one - other) < 1e-9 * part.area;
        part.outer = are_alike ? static_cast<WallSide>(part.first_side) : one > other ? WallSide::One : WallSide::Other;
    }
    return parts;
}

// Half way between the normals of both walls: across the wall, also where one of them already bends into its lip.
Vec3d across_wall(const Surface& s, const WallSides& sides, uint32_t t) {
    const uint32_t from = sides.opposite[t] != kNone ? t : sides.nearest[t];
    return normalised(normal_of(s, sides.opposite[from]) - normal_of(s, from));
}

}  // namespace

std::optional<JoinedWalls> join_walls(const Surface& s, const Mesh& mesh, double thickness) {
    const WallSides sides = find_wall_sides(s, kReach * thickness);
    const std::vector<uint32_t> whole = whole_of_component(s, sides);
    const std::vector<Part> parts = judge_parts(s, sides, whole);
    JoinedWalls joined;
    for (const Part& part : parts)
        if (part.is_joined) ++joined.parts, joined.volume += part.volume;
    if (joined.parts == 0) return {};

    joined.outer.name = mesh.name;
    for (const Vec3d p : s.positions) joined.outer.positions.push_back(p.to_float());
    joined.skin.positions = s.positions;
    for (uint32_t t = 0; t < s.triangles.size(); ++t) {
        const Part& part = parts[whole[s.component_of[t]]];
        Vec3d into;
        if (part.is_joined) {
            const bool has_own_depth = sides.opposite[t] == kNone && !sides.is_lip[t];  // a handle, a thick foot
            if (sides.side[t] != part.outer) {
                if (!sides.is_lip[t]) joined.skin.triangles.push_back(s.triangles[t]);
                continue;
            }
            if (!has_own_depth) into = across_wall(s, sides, t);
            if (sides.is_lip[t] && -dot(normal_of(s, t), into) < kLipFacing) continue;
        }
        joined.outer.triangles.push_back(s.triangles[t]);
        joined.is_joined.push_back(part.is_joined);
        joined.into_the_wall.push_back(into);
        const uint32_t source = s.source_triangles[t];
        for (size_t k = 0; k < 3; ++k) {
            const size_t corner = 3 * size_t{source} + s.source_corners[t][k];
            if (!mesh.corner_normals.empty()) joined.outer.corner_normals.push_back(mesh.corner_normals[corner]);
            if (!mesh.corner_uvs.empty()) joined.outer.corner_uvs.push_back(mesh.corner_uvs[corner]);
        }
        if (!mesh.materials.empty()) joined.outer.materials.push_back(mesh.materials[source]);
    }
    return joined;
}

std::string describe(const JoinedWalls& joined, const Surface& outer, const Extrusion& extrusion) {
    double volume = 0, area = 0;
    for (uint32_t t = 0; t < outer.triangles.size(); ++t) {
        if (!joined.is_joined[outer.source_triangles[t]]) continue;
        std::array<Vec3d, 3> out, in;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t v = outer.triangles[t][k];
            out[k] = outer.positions[v];
            in[k] = out[k] + extrusion.depth[v] * extrusion.direction[v];
        }
        volume += prism_tetrahedra(out, in, outer.triangles[t]).total();
        area += (area_of(outer, t) + length(cross(in[1] - in[0], in[2] - in[0])) / 2) / 2;
    }
    char text[256];
    std::snprintf(text, sizeof text,
                  "Both walls of %u %s are modelled: the outer one became one sheet, %.4g mm thick as measured, with "
                  "%.1f %% of the volume between them.",
                  joined.parts, joined.parts == 1 ? "part" : "parts", 1e3 * volume / area,
                  100 * volume / joined.volume);
    return text;
}

InnerSkin skin_for(const JoinedWalls& joined, const Surface& outer) {
    InnerSkin skin = joined.skin;
    skin.is_of_component.assign(outer.components.size(), 0);
    for (uint32_t t = 0; t < outer.triangles.size(); ++t) {
        const uint32_t source = outer.source_triangles[t];
        skin.is_of_component[outer.component_of[t]] |= joined.is_joined[source];
        skin.into_the_wall.push_back(joined.into_the_wall[source]);
    }
    return skin;
}

}  // namespace cullet
