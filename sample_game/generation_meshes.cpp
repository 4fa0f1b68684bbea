// The made meshes of the generation's table: smooth and sharp, open and closed, thin and thick.
#include <algorithm>

#include "sample_game/generation_figures.hpp"
#include "sample_game/mesh_tools.hpp"
#include "sample_game/meshes.hpp"

namespace cullet {
namespace {

constexpr double kTurn = 6.283185307179586477;

double sine(double x) {
    double s, c;
    sine_cosine(x, s, c);
    return s;
}

double cosine(double x) {
    return sine(x + kTurn / 4);
}

/// Triangles of a grid of points at(i, j); a wrapped direction joins its last row to its first. Outside is along
/// d/di x d/dj.
template <class At>
Mesh grid(const char* name, uint32_t columns, uint32_t rows, bool wraps_i, bool wraps_j, At at) {
    MeshDraft draft;
    for (uint32_t j = 0; j < rows; ++j)
        for (uint32_t i = 0; i < columns; ++i) draft.points.push_back(at(i, j));
    const auto id = [&](uint32_t i, uint32_t j) { return (i % columns) + columns * (j % rows); };
    for (uint32_t j = 0; j + (wraps_j ? 0 : 1) < rows; ++j)
        for (uint32_t i = 0; i + (wraps_i ? 0 : 1) < columns; ++i) {
            draft.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
            draft.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
        }
    return to_mesh(draft, name);
}

/// 20 cm across with a wall of 4 mm, both sides modelled, round holes of 2 cm in the bottom and at the lip closed by
/// rings across the wall, so that no pole is needed. About 19,000 triangles.
Mesh make_bowl() {
    constexpr uint32_t kAround = 96, kAcross = 48, kLip = 2;
    constexpr double kRadius = 0.1, kWall = 0.004, kFrom = 0.1;  // rad, from the axis
    return grid("bowl", kAround, 2 * kAcross + kLip, true, true, [](uint32_t i, uint32_t j) {
        const bool is_outside = j <= kAcross;
        const uint32_t step = is_outside ? j : j <= kAcross + kLip ? kAcross : 2 * kAcross + kLip - j;
        double radius = is_outside ? kRadius : kRadius - kWall;
        if (j > kAcross && j < kAcross + kLip) radius = kRadius - kWall * (j - kAcross) / kLip;
        const double polar = kFrom + (kTurn / 4 - kFrom) * step / kAcross, round = kTurn * i / kAround;
        return Vec3d(radius * sine(polar) * cosine(round), -radius * cosine(polar),
                     -radius * sine(polar) * sine(round));
    });
}

/// An open sheet of 2.4 m by 2.6 m in nine pleats, 9,216 triangles.
Mesh make_pleats() {
    return grid("pleated sheet", 65, 73, false, false, [](uint32_t i, uint32_t j) {
        return Vec3d(2.4 * i / 64, 2.6 * j / 72, 0.06 * sine(9 * kTurn * i / 64));
    });
}

/// A ring of 1 m with a bore of 10 cm, 7,680 triangles.
Mesh make_ring() {
    return grid("ring", 160, 24, true, true, [](uint32_t i, uint32_t j) {
        const double round = kTurn * i / 160, across = kTurn * j / 24, r = 1 + 0.05 * cosine(across);
        return Vec3d(r * cosine(round), r * sine(round), 0.05 * sine(across));
    });
}

/// A tower of square cells with battlements round its top: right angles of both kinds. 10,000 triangles.
Mesh make_tower() {
    constexpr int kSide = 26, kHeight = 28;
    const auto is_solid = [](int x, int y, int z) {
        if (x < 0 || y < 0 || z < 0 || x >= kSide || z >= kSide || y >= kHeight) return false;
        const int to_side = std::min(std::min(x, z), std::min(kSide - 1 - x, kSide - 1 - z));
        const bool is_battlement = y >= kHeight - 3;
        return !is_battlement ? y < kHeight - 8 || to_side < 3 : to_side < 3 && (x / 3 + z / 3) % 2 == 0;
    };
    MeshDraft draft;
    const auto side = [&](Vec3d corner, Vec3d along, Vec3d across) {
        const auto first = static_cast<uint32_t>(draft.points.size());
        for (const Vec3d p : {corner, corner + along, corner + along + across, corner + across})
            draft.points.push_back(0.1 * p);
        draft.triangles.push_back({first, first + 1, first + 2});
        draft.triangles.push_back({first, first + 2, first + 3});
    };
    for (int x = 0; x < kSide; ++x)
        for (int y = 0; y < kHeight; ++y)
            for (int z = 0; z < kSide; ++z) {
                if (!is_solid(x, y, z)) continue;
                const Vec3d at(x, y, z), i(1, 0, 0), j(0, 1, 0), k(0, 0, 1);
                if (!is_solid(x + 1, y, z)) side(at + i, j, k);
                if (!is_solid(x - 1, y, z)) side(at, k, j);
                if (!is_solid(x, y + 1, z)) side(at + j, k, i);
                if (!is_solid(x, y - 1, z)) side(at, i, k);
                if (!is_solid(x, y, z + 1)) side(at + k, i, j);
                if (!is_solid(x, y, z - 1)) side(at, j, i);
            }
    return to_mesh(draft, "tower of square cells");
}

}  // namespace

std::vector<Mesh> generation_meshes() {
    std::vector<Mesh> meshes{make_vase(0.30f, 0.0055f),
                             make_piggy_bank(0.40f, 0.0075f),
                             make_bowl(),
                             make_pleats(),
                             make_ring(),
                             make_tower()};
    meshes[0].name = "vase", meshes[1].name = "piggy bank";
    return meshes;
}

}  // namespace cullet
