#include <algorithm>
#include <cmath>
#include <map>

#include "sample_game/spring_bench.hpp"

namespace cullet {

BenchMesh bench_strip(uint32_t half_edges, uint32_t rows, double edge) {
    BenchMesh mesh;
    const double height = edge * std::sqrt(3.0) / 2, n = half_edges;
    std::vector<std::vector<uint32_t>> row(rows + 1);
    for (uint32_t r = 0; r <= rows; ++r) {
        const uint32_t points = 2 * half_edges + 1 + r % 2;
        for (uint32_t i = 0; i < points; ++i) {
            row[r].push_back(static_cast<uint32_t>(mesh.points.size()));
            mesh.points.push_back({edge * (i - n - (r % 2 ? 0.5 : 0)), height * r, 0});
        }
    }
    for (uint32_t r = 0; r < rows; ++r) {
        const bool is_up = r % 2 == 0;  // the longer row is the upper one
        const auto &shorter = is_up ? row[r] : row[r + 1], &longer = is_up ? row[r + 1] : row[r];
        const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
            if (is_up)
                mesh.triangles.push_back({a, b, c});
            else
                mesh.triangles.push_back({a, c, b});
        };
        for (uint32_t i = 0; i + 1 < longer.size(); ++i) {
            add(longer[i], shorter[i], longer[i + 1]);
            if (i + 1 < shorter.size()) add(shorter[i], shorter[i + 1], longer[i + 1]);
        }
    }
    return mesh;
}

BenchMesh bench_disc(uint32_t rings, double edge) {
    BenchMesh mesh;
    const int n = static_cast<int>(std::ceil(rings / std::sqrt(0.75))) + 2;  // rows are nearer to each other than edges
    const auto point = [&](int i, int j) { return Vec3d(edge * (i + 0.5 * j), edge * std::sqrt(0.75) * j, 0); };
    const auto is_in = [&](int i, int j) { return length(point(i, j)) <= edge * (rings - 0.5); };
    std::map<std::pair<int, int>, uint32_t> known;
    const auto vertex = [&](int i, int j) {
        const auto [at, is_new] = known.try_emplace({i, j}, static_cast<uint32_t>(mesh.points.size()));
        if (is_new) mesh.points.push_back(point(i, j));
        return at->second;
    };
    vertex(0, 0);
    const auto add = [&](std::array<std::pair<int, int>, 3> t) {
        if (std::none_of(t.begin(), t.end(), [&](auto p) { return is_in(p.first, p.second); })) return;
        mesh.triangles.push_back(
            {vertex(t[0].first, t[0].second), vertex(t[1].first, t[1].second), vertex(t[2].first, t[2].second)});
    };
    for (int j = -n; j < n; ++j)
        for (int i = -2 * n; i < 2 * n; ++i) {
            add({{{i, j}, {i + 1, j}, {i, j + 1}}});
            add({{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
        }
    return mesh;
}

BenchMesh bench_sphere(double radius, int rounds) {
    const double g = 0.5 * (1 + std::sqrt(5.0));
    BenchMesh mesh;
    mesh.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int round = 0; round < rounds; ++round) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        const auto middle = [&](uint32_t a, uint32_t b) {
            const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(mesh.points.size()));
            if (is_new) mesh.points.push_back(normalised(mesh.points[a]) + normalised(mesh.points[b]));
            return at->second;
        };
        std::vector<std::array<uint32_t, 3>> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        mesh.triangles = finer;
    }
    for (Vec3d& p : mesh.points) p = radius * normalised(p);
    return mesh;
}

}  // namespace cullet
