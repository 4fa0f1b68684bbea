// Meshes with known shapes, made from formulas.
#pragma once
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "engine/math.hpp"
#include "engine/mesh.hpp"

namespace cullet::test {

inline constexpr double kPi = 3.14159265358979323846;

/// Triangles of a grid of points at(i, j), i < columns, j < rows; a wrapped direction joins its last row to its first.
/// The normal is along d/di x d/dj.
inline Mesh grid_mesh(uint32_t columns, uint32_t rows, bool wraps_i, bool wraps_j,
                      const std::function<Vec3d(uint32_t, uint32_t)>& at) {
    Mesh mesh;
    for (uint32_t j = 0; j < rows; ++j)
        for (uint32_t i = 0; i < columns; ++i) mesh.positions.push_back(at(i, j).to_float());
    const auto id = [&](uint32_t i, uint32_t j) { return (i % columns) + columns * (j % rows); };
    for (uint32_t j = 0; j + (wraps_j ? 0 : 1) < rows; ++j)
        for (uint32_t i = 0; i + (wraps_i ? 0 : 1) < columns; ++i) {
            mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
            mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
        }
    return mesh;
}

/// Icosahedron with every triangle cut in four `levels` times: 20 * 4^levels triangles.
inline Mesh sphere_mesh(double radius, int levels) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    std::vector<Vec3d> points;
    for (const double s : {-1.0, 1.0})
        for (const double t : {-g, g}) points.insert(points.end(), {Vec3d(0, s, t), Vec3d(s, t, 0), Vec3d(t, 0, s)});
    std::vector<std::array<uint32_t, 3>> triangles;
    for (uint32_t a = 0; a < 12; ++a)
        for (uint32_t b = a + 1; b < 12; ++b)
            for (uint32_t c = b + 1; c < 12; ++c) {
                const auto near = [&](uint32_t p, uint32_t q) { return length(points[p] - points[q]) < 2.1; };
                if (!near(a, b) || !near(b, c) || !near(a, c)) continue;
                const bool is_outward = dot(points[a], cross(points[b], points[c])) > 0;
                triangles.push_back(is_outward ? std::array{a, b, c} : std::array{a, c, b});
            }
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        const auto middle = [&](uint32_t a, uint32_t b) {
            const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(points.size()));
            if (is_new) points.push_back(0.5 * (normalised(points[a]) + normalised(points[b])));
            return found->second;
        };
        std::vector<std::array<uint32_t, 3>> finer;
        for (const auto& [a, b, c] : triangles) {
            const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        triangles = finer;
    }
    Mesh mesh;
    mesh.name = "sphere";
    for (const Vec3d p : points) mesh.positions.push_back((radius * normalised(p)).to_float());
    mesh.triangles = triangles;
    return mesh;
}

/// Box from the origin to `size`, each edge in `cuts` parts; corners shared between sides.
inline Mesh box_mesh(Vec3d size, uint32_t cuts) {
    Mesh mesh;
    mesh.name = "box";
    std::map<std::array<uint32_t, 3>, uint32_t> known;
    const auto vertex = [&](std::array<uint32_t, 3> at) {
        const auto [found, is_new] = known.try_emplace(at, static_cast<uint32_t>(mesh.positions.size()));
        if (is_new)
            mesh.positions.push_back(
                Vec3d(size.x * at[0] / cuts, size.y * at[1] / cuts, size.z * at[2] / cuts).to_float());
        return found->second;
    };
    for (size_t axis = 0; axis < 3; ++axis)
        for (const uint32_t side : {0u, cuts})
            for (uint32_t i = 0; i < cuts; ++i)
                for (uint32_t j = 0; j < cuts; ++j) {
                    const auto at = [&](uint32_t a, uint32_t b) {
                        std::array<uint32_t, 3> p{};
                        p[axis] = side, p[(axis + 1) % 3] = i + a, p[(axis + 2) % 3] = j + b;
                        return vertex(p);
                    };
                    const std::array<uint32_t, 4> q{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
                    if (side != 0) {
                        mesh.triangles.push_back({q[0], q[1], q[2]});
                        mesh.triangles.push_back({q[0], q[2], q[3]});
                    } else {
                        mesh.triangles.push_back({q[0], q[2], q[1]});
                        mesh.triangles.push_back({q[0], q[3], q[2]});
                    }
                }
    return mesh;
}

inline Mesh torus_mesh(double big, double small, uint32_t around, uint32_t across) {
    Mesh mesh = grid_mesh(around, across, true, true, [=](uint32_t i, uint32_t j) {
        const double u = 2 * kPi * i / around, v = 2 * kPi * j / across, r = big + small * std::cos(v);
        return Vec3d(r * std::cos(u), r * std::sin(u), small * std::sin(v));
    });
    mesh.name = "torus";
    return mesh;
}

/// Flat sheet in the plane z = 0 with normal +z, or bent by height(x, y).
inline Mesh sheet_mesh(double width, double depth, uint32_t columns, uint32_t rows,
                       const std::function<double(double, double)>& height = nullptr) {
    Mesh mesh = grid_mesh(columns + 1, rows + 1, false, false, [=](uint32_t i, uint32_t j) {
        const double x = width * i / columns, y = depth * j / rows;
        return Vec3d(x, y, height ? height(x, y) : 0.0);
    });
    mesh.name = "sheet";
    return mesh;
}

/// Closed surface of revolution about y through the profile (radius, height), bottom to top on the outside; ends with
/// radius 0.
inline Mesh lathe_mesh(const std::vector<Vec2>& profile, uint32_t around) {
    Mesh mesh;
    mesh.name = "lathe";
    const uint32_t rings = static_cast<uint32_t>(profile.size()) - 2;
    mesh.positions.push_back({0, profile.front().y, 0});
    for (uint32_t r = 1; r <= rings; ++r)
        for (uint32_t k = 0; k < around; ++k) {
            const double u = 2 * kPi * k / around;
            mesh.positions.push_back(
                Vec3d(profile[r].x * std::sin(u), profile[r].y, profile[r].x * std::cos(u)).to_float());
        }
    const uint32_t top = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.push_back({0, profile.back().y, 0});
    const auto id = [=](uint32_t r, uint32_t k) { return 1 + r * around + k % around; };
    for (uint32_t k = 0; k < around; ++k) {
        mesh.triangles.push_back({0, id(0, k + 1), id(0, k)});
        for (uint32_t r = 0; r + 1 < rings; ++r) {
            mesh.triangles.push_back({id(r, k), id(r, k + 1), id(r + 1, k + 1)});
            mesh.triangles.push_back({id(r, k), id(r + 1, k + 1), id(r + 1, k)});
        }
        mesh.triangles.push_back({id(rings - 1, k), id(rings - 1, k + 1), top});
    }
    return mesh;
}

inline void append(Mesh& mesh, const Mesh& other, Vec3d shift = {}) {
    const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
    for (const Vec3 p : other.positions) mesh.positions.push_back((Vec3d(p) + shift).to_float());
    for (const auto& t : other.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

inline Mesh turned_inside_out(Mesh mesh) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

inline Mesh scaled(Mesh mesh, double factor) {
    for (Vec3& p : mesh.positions) p = (factor * Vec3d(p)).to_float();
    return mesh;
}

/// Vertices and triangles in another order, triangles starting at another corner. The same shape.
inline Mesh shuffled(const Mesh& mesh, uint64_t seed) {
    const auto next = [&seed](uint64_t below) {
        seed = seed * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<size_t>((seed >> 33) % below);
    };
    Mesh result = mesh;
    std::vector<uint32_t> place(mesh.positions.size());
    for (uint32_t v = 0; v < place.size(); ++v) place[v] = v;
    for (size_t v = place.size(); v > 1; --v) std::swap(place[v - 1], place[next(v)]);
    for (size_t v = 0; v < place.size(); ++v) result.positions[place[v]] = mesh.positions[v];
    for (auto& t : result.triangles) {
        t = {place[t[0]], place[t[1]], place[t[2]]};
        for (size_t turns = next(3); turns > 0; --turns) t = {t[1], t[2], t[0]};
    }
    for (size_t t = result.triangles.size(); t > 1; --t) std::swap(result.triangles[t - 1], result.triangles[next(t)]);
    return result;
}

}  // namespace cullet::test
