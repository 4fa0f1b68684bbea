// A castle in one closed piece: four round towers with galleries, merlons and cone roofs, walls between them, a keep in
// the back wall and a gatehouse with an arch in the front. A ring of walls is a torus: 11,000 vertices are 22,000
// triangles exactly.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "sample_game/block_meshes.hpp"
#include "sample_game/meshes.hpp"

namespace cullet {
namespace {

// Plan in cells: nodes from -kReach to kReach; the gate looks to +z. Nodes are (z, x, level), so that the third axis
// goes up.
constexpr int kReach = 18, kTower = 13, kKeep = -13;
constexpr double kLevels[] = {0,    1.5,  3,    4.5,  6,    7.5,  9,    10.4, 12,   13.4,
                              14.5, 16.2, 17.5, 18.7, 19.2, 20.5, 22.2, 23.5, 24.7, 25.2};
enum Level : int { Arch = 4, Walk = 6, GateRoof = 8 };

/// A round tower: radii in cells, levels by number. The gallery overhangs by one cell and carries the merlons; the roof
/// stands on a drum one cell within the tower.
struct Tower {
    int z = 0, x = 0, radius = 0;
    int gallery = 0;  // level of its underside; floor, merlons' top, roof's underside and rim follow
    double roof = 0;  // height of the cone, cells
    int window = 0;   // level of the windows' sills
};
constexpr std::array<Tower, 5> kTowers{Tower{kTower, kTower, 3, 10, 7.0, 7}, Tower{kTower, -kTower, 3, 10, 7.0, 7},
                                       Tower{-kTower, kTower, 3, 10, 7.0, 7}, Tower{-kTower, -kTower, 3, 10, 7.0, 7},
                                       Tower{kKeep, 0, 4, 15, 9.5, 12}};

/// Which square ring round a node a cell lies in: 0 for the four that touch it.
int ring_of(int i, int centre) {
    return i >= centre ? i - centre : centre - 1 - i;
}

/// A cell's number along its square ring, from 0 to 8 * ring + 3; cells next to each other have neighbouring numbers.
int place_on_ring(int u, int w, int ring) {  // u, w: cells seen from the centre, -ring - 1 to ring
    const int last = ring, first = -ring - 1, side = 2 * ring + 1;
    if (w == first) return u - first;
    if (u == last) return side + (w - first);
    if (w == last) return 2 * side + (last - u);
    return 3 * side + (last - w);
}

bool is_merlon(int place) {
    return place % 4 < 2;
}

bool in_tower(const Tower& t, int i, int j, int k) {
    const int ring = std::max(ring_of(i, t.z), ring_of(j, t.x)), floor = t.gallery + 1;
    if (k < t.gallery && ring == t.radius - 1 && (k == t.window || k == t.window + 1)) {
        const int across = std::min(ring_of(i, t.z), ring_of(j, t.x));
        return across > 0;  // a recess two cells wide in the middle of each side
    }
    if (k < t.gallery) return ring < t.radius;
    if (k < floor) return ring < t.radius + 1;
    if (k == floor && ring == t.radius) return is_merlon(place_on_ring(j - t.x, i - t.z, ring));
    if (k < floor + 2) return ring < t.radius - 1;
    return k == floor + 2 && ring < t.radius;
}

bool in_walls(int i, int j, int k) {
    const auto in_wall = [k](int across, int along) {
        const int from_middle = across >= 0 ? across - kTower : -kTower - 1 - across;  // -1 inside, 0 outside
        if (from_middle != 0 && from_middle != -1) return false;
        if (along < -kTower || along >= kTower) return false;
        return k < Walk || (k == Walk && from_middle == 0 && is_merlon(along + kTower + 3));
    };
    return in_wall(i, j) || in_wall(j, i);
}

bool in_gatehouse(int i, int j, int k) {
    if (i < kTower - 2 || i >= kTower + 2 || j < -4 || j >= 4) return false;
    if (k < GateRoof) return true;
    const int first = kTower - 2, last = kTower + 1;
    if (k > GateRoof || (i != first && i != last && j != -4 && j != 3)) return false;
    const int place = i == first ? j + 4 : j == 3 ? 7 + (i - first) : i == last ? 10 + (3 - j) : 17 + (last - i);
    return is_merlon(place + 1);
}

bool is_full(int i, int j, int k) {
    if (i >= kTower - 2 && i < kTower + 2 && j >= -2 && j < 2 && k < Arch) return false;  // the gate
    for (const Tower& t : kTowers)
        if (in_tower(t, i, j, k)) return true;
    return in_walls(i, j, k) || in_gatehouse(i, j, k);
}

/// Square rings round a tower's middle become circles, and squares again two cells outside of its gallery.
void make_round(const Tower& t, double& z, double& x) {
    const double u = z - t.z, w = x - t.x, square = std::max(std::fabs(u), std::fabs(w));
    if (square == 0) return;
    const double share = std::clamp((t.radius + 3 - square) / 2, 0.0, 1.0);
    const double scale = 1 + share * (square / std::sqrt(u * u + w * w) - 1);
    z = t.z + scale * u, x = t.x + scale * w;
}

Vec3d place_of(const GridNode& node) {
    const auto [i, j, k] = node;
    double y = kLevels[k];
    for (const Tower& t : kTowers) {
        const int ring = std::max(std::abs(i - t.z), std::abs(j - t.x));
        if (k == t.gallery + 4 && ring <= t.radius) y += t.roof * (1 - static_cast<double>(ring) / t.radius);
    }
    if (k == Arch && i >= kTower - 2 && i <= kTower + 2 && std::abs(j) <= 2) y -= 0.28 * j * j;
    double z = i, x = j;
    for (const Tower& t : kTowers) make_round(t, z, x);
    return {x, y, z};
}

}  // namespace

Mesh make_castle(float width, uint32_t vertices, uint64_t seed) {
    Blocks blocks;
    blocks.low = {-kReach, -kReach, 0};
    blocks.high = {kReach, kReach, static_cast<int>(std::size(kLevels)) - 1};
    blocks.is_full = is_full;
    blocks.place = place_of;
    MeshDraft surface = surface_of(blocks);
    double widest = 0;
    for (const Vec3d p : surface.points) widest = std::max(widest, std::fabs(p.x));
    for (Vec3d& p : surface.points) p = (0.5 * static_cast<double>(width) / widest) * p;
    split_longest(surface, vertices);
    shake_flat_faces(surface, seed);
    flip_to_delaunay(surface, 1 - 1e-7);
    return to_mesh(surface, "castle");
}

Mesh make_slab(Vec3 size, uint32_t vertices, uint64_t seed) {
    constexpr int columns = 20, rows = 13;
    const Vec3d extent(size);
    Blocks blocks;
    blocks.low = {0, 0, 0};
    blocks.high = {columns, rows, 1};
    blocks.is_full = [](int, int, int) { return true; };
    blocks.place = [extent](const GridNode& node) {
        return Vec3d{extent.x * (static_cast<double>(node[0]) / columns - 0.5),
                     extent.y * static_cast<double>(node[1]) / rows, extent.z * (node[2] - 0.5)};
    };
    MeshDraft surface = surface_of(blocks);
    split_longest(surface, vertices);
    shake_flat_faces(surface, seed);
    flip_to_delaunay(surface, 1 - 1e-7);
    return to_mesh(surface, "slab");
}

}  // namespace cullet
