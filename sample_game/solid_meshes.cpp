#include <map>
#include <utility>

#include "sample_game/mesh_tools.hpp"
#include "sample_game/meshes.hpp"

namespace cullet {
namespace {

MeshDraft icosahedron() {
    const double g = (1 + std::sqrt(5.0)) / 2;
    MeshDraft s;
    s.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    s.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                   {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                   {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (Vec3d& p : s.points) p = normalised(p);
    return s;
}

void halve_edges(MeshDraft& s) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(s.points.size()));
        if (is_new) s.points.push_back(normalised(s.points[a] + s.points[b]));
        return place->second;
    };
    std::vector<Triangle> finer;
    for (const auto [a, b, c] : s.triangles) {
        const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    s.triangles = std::move(finer);
}

/// Corner k of a box has the signs of the bits of k: x, y, z.
void append_box(Mesh& mesh, Vec3 low, Vec3 high) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (unsigned k = 0; k < 8; ++k)
        mesh.positions.push_back({k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z});
    constexpr uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& q : quads) {
        mesh.triangles.push_back({first + q[0], first + q[1], first + q[2]});
        mesh.triangles.push_back({first + q[0], first + q[2], first + q[3]});
    }
}

}  // namespace

Mesh make_ball(float radius, int subdivisions) {
    MeshDraft s = icosahedron();
    for (int i = 0; i < subdivisions; ++i) halve_edges(s);
    for (Vec3d& p : s.points) p = static_cast<double>(radius) * p;
    return to_mesh(s, "ball");
}

Mesh make_box(Vec3 half_extents) {
    Mesh mesh;
    mesh.name = "box";
    append_box(mesh, -half_extents, half_extents);
    return mesh;
}

Mesh make_pole(float radius, float height, uint32_t sides) {
    constexpr double kTurn = 2 * 3.14159265358979;
    Mesh mesh;
    mesh.name = "pole";
    mesh.positions = {{0, 0, 0}, {0, height, 0}};
    for (uint32_t k = 0; k < sides; ++k) {
        double sine = 0, cosine = 1;
        sine_cosine(kTurn * k / sides, sine, cosine);
        const auto x = static_cast<float>(static_cast<double>(radius) * cosine),
                   z = static_cast<float>(static_cast<double>(radius) * sine);
        mesh.positions.push_back({x, 0, z});
        mesh.positions.push_back({x, height, z});
        const uint32_t a = 2 + 2 * k, b = 2 + 2 * ((k + 1) % sides);
        mesh.triangles.push_back({0, a, b});
        mesh.triangles.push_back({1, b + 1, a + 1});
        mesh.triangles.push_back({a, a + 1, b + 1});
        mesh.triangles.push_back({a, b + 1, b});
    }
    return mesh;
}

Mesh make_table(float width, float depth, float height) {
    constexpr float top = 0.04f, leg = 0.06f, inset = 0.03f;
    Mesh mesh;
    mesh.name = "table";
    append_box(mesh, {-width / 2, height - top, -depth / 2}, {width / 2, height, depth / 2});
    for (const float x : {-width / 2 + inset, width / 2 - inset - leg})
        for (const float z : {-depth / 2 + inset, depth / 2 - inset - leg})
            append_box(mesh, {x, 0, z}, {x + leg, height - top, z + leg});
    return mesh;
}

}  // namespace cullet
