#include "sample_game/reproduce/front_drawn.hpp"

#include <algorithm>
#include <cmath>

#include "engine/fp_mode.hpp"
#include "sample_game/mesh_tools.hpp"

namespace cullet::reproduce {
namespace {

constexpr uint32_t kMostRounds = 40;

std::vector<Vec3d> normals_of(const Surface& s) {
    std::vector<Vec3d> normals(s.positions.size());
    for (const Triangle& t : s.triangles) {
        const Vec3d area = cross(s.positions[t[1]] - s.positions[t[0]], s.positions[t[2]] - s.positions[t[0]]);
        for (const uint32_t v : t) normals[v] += area;
    }
    for (Vec3d& n : normals) n = normalised(n);
    return normals;
}

/// Triangles of the inner surface that meet each other, by number in `s`, in pairs.
std::vector<std::array<uint32_t, 2>> meetings(const Surface& s, const std::vector<Vec3d>& inner) {
    Mesh mesh;
    for (const Vec3d p : inner) mesh.positions.push_back(p.to_float());
    mesh.triangles.assign(s.triangles.begin(), s.triangles.end());
    std::vector<std::array<uint32_t, 2>> pairs;
    const Result<Surface> found = prepare_surface(mesh);
    if (!found.ok()) return pairs;
    for (const auto& [a, b] : found->crossings)
        pairs.push_back({found->source_triangles[a], found->source_triangles[b]});
    return pairs;
}

}  // namespace

FrontStates propagate_front(const Surface& surface, double thickness, uint32_t rounds) {
    const FpMode fp;
    const std::vector<Vec3d> normals = normals_of(surface);
    const size_t count = surface.positions.size();
    std::vector<double> depth(count), step(count, thickness / rounds);
    const auto inner = [&](const std::vector<double>& depths) {
        std::vector<Vec3d> places;
        for (size_t v = 0; v < count; ++v) places.push_back(surface.positions[v] - depths[v] * normals[v]);
        return places;
    };
    FrontStates states;
    states.has_met.resize(surface.triangles.size());
    for (; states.rounds < kMostRounds; ++states.rounds) {
        std::vector<double> moved = depth;
        bool moves = false;
        for (size_t v = 0; v < count; ++v) {
            const double way = std::min(step[v], thickness - depth[v]);
            moves = moves || way > 0.01 * thickness;
            moved[v] += way;
        }
        if (!moves) break;
        const auto pairs = meetings(surface, inner(moved));
        states.collisions += static_cast<uint32_t>(pairs.size());
        const bool is_first = !pairs.empty() && states.collided.empty();
        if (is_first) states.collided = inner(moved);
        std::vector<uint8_t> goes_back(count);
        for (const auto& pair : pairs)
            for (const uint32_t t : pair) {
                if (is_first) states.met += !states.has_met[t], states.has_met[t] = 1;
                for (const uint32_t v : surface.triangles[t]) goes_back[v] = 1;
            }
        for (size_t v = 0; v < count; ++v)
            if (goes_back[v]) moved[v] = depth[v], step[v] *= 0.5;
        depth = moved;
        if (is_first) states.set_back = inner(depth);
    }
    states.done = inner(depth);
    states.left = meetings(surface, states.done).size();
    if (states.collided.empty()) states.collided = states.set_back = states.done;
    return states;
}

Mesh make_ridge(double width, double height, double length, double edge, double pinch) {
    // The profile: up one side, half a circle, down the other.
    const double radius = 0.5 * width, side = height - radius, arc = 3.14159265358979 * radius;
    const double total = 2 * side + arc;
    const auto steps = static_cast<uint32_t>(std::max(8.0, std::floor(total / edge)));
    const auto rows = static_cast<uint32_t>(std::max(2.0, std::floor(length / edge)));
    MeshDraft ridge;
    std::vector<uint32_t> before;
    for (uint32_t row = 0; row <= rows; ++row) {
        std::vector<uint32_t> ids;
        for (uint32_t k = 0; k <= steps; ++k) {
            const double s = total * k / steps, z = length * (static_cast<double>(row) / rows - 0.5);
            double x = radius, y = s;
            if (s > side + arc) {
                x = -radius, y = total - s;
            } else if (s > side) {
                double sine = 0, cosine = 1;
                sine_cosine((s - side) / radius, sine, cosine);
                x = radius * cosine, y = side + radius * sine;
            }
            if (s <= side || s >= side + arc) {
                // Half a cosine each way: the least bend for its depth, so that the sides meet and not the bends.
                double sine = 0, cosine = 1;
                sine_cosine(3.14159265358979 * (2 * y / side - 1), sine, cosine);
                const double share = 0.5 * (1 + cosine);
                x -= (x > 0 ? pinch : -pinch) * share;
            }
            ids.push_back(static_cast<uint32_t>(ridge.points.size()));
            ridge.points.push_back({x, y, z});
        }
        if (row > 0) stitch_rows(ridge, ids, before, false);
        before = ids;
    }
    return to_mesh(ridge, "ridge");
}

}  // namespace cullet::reproduce
