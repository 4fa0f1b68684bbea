// Houses and towers to be knocked down: the outer sheet alone, open at the foot, with holes for doors and windows. A
// plan of square cells whose outline may be bent to a circle; over it a gable roof, a cone, or a flat one.
#include <algorithm>
#include <cmath>
#include <map>

#include "sample_game/block_meshes.hpp"
#include "sample_game/meshes.hpp"

namespace cullet {
namespace {

constexpr double kDoorWidth = 1.0, kDoorHeight = 2.0, kSill = 0.9, kLintel = 2.1, kWindowGap = 1.3;  // m
constexpr double kStorey = 2.8;                                                                      // m

int cells_in(double length, double edge) {
    return std::max(1, static_cast<int>(length / edge + 0.5));
}

class Building {
 public:
    Building(const BuildingShape& shape, uint64_t seed) : shape_(shape), seed_(seed) {
        const double edge = usable_edge(static_cast<double>(shape.edge), 0.25 * static_cast<double>(shape.width));
        edge_ = edge;
        cells_ = {std::max(4, cells_in(static_cast<double>(shape.width), edge)),
                  std::max(3, cells_in(static_cast<double>(shape.height), edge)),
                  2 * std::max(2, cells_in(0.5 * static_cast<double>(shape.depth), edge))};
        if (shape.is_round) cells_[0] = cells_[2];  // even: the cone has its tip
    }

    MeshDraft make() {
        for (const int side : {0, 1}) {
            add_wall(0, side);
            add_wall(2, side);
        }
        for (int k = 0; k < cells_[2]; ++k)
            for (int i = 0; i < cells_[0]; ++i) add_square({i, cells_[1], k}, 1, true);
        return surface_;
    }

    /// The gable's and the cone's triangles are longer than the cells below.
    size_t wanted_vertices() const {
        double area = 0;
        for (const Triangle& t : surface_.triangles) area += 0.5 * length(area_of(t));
        return static_cast<size_t>(area / (0.78 * edge_ * edge_));
    }

 private:
    Vec3d area_of(const Triangle& t) const {
        const auto& p = surface_.points;
        return cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    }

    // Walls across `axis`: 0 looks to -x and +x, 2 to -z and +z.
    void add_wall(size_t axis, int side) {
        const size_t along = 2 - axis;
        for (int j = 0; j < cells_[1]; ++j)
            for (int c = 0; c < cells_[along]; ++c) {
                if (is_open(axis, side, c, j)) continue;
                GridNode cell{};
                cell[axis] = side ? cells_[axis] : 0;
                cell[1] = j;
                cell[along] = c;
                add_square(cell, axis, side == 1);
            }
    }

    /// A door in the middle of the front, windows in every storey, two cells of wall beside each at least.
    bool is_open(size_t axis, int side, int cell, int level) const {
        const size_t along = 2 - axis;
        const int count = cells_[along], storey = cells_in(kStorey, edge_);
        const int above = level % storey;
        if (level / storey > 0 && level / storey * storey + cells_in(kLintel, edge_) >= cells_[1]) return false;
        const int door = std::max(1, cells_in(kDoorWidth, edge_)), from = (count - door) / 2;
        if (axis == 2 && side == 1 && level < cells_in(kDoorHeight, edge_) && cell >= from - 1 && cell <= from + door)
            return cell >= from && cell < from + door;
        if (shape_.is_windowless) return false;
        const int sill = cells_in(kSill, edge_), lintel = std::max(sill + 1, cells_in(kLintel, edge_));
        if (above < sill || above >= std::min(lintel, cells_[1] - 1)) return false;
        const int wide = std::max(1, cells_in(0.9, edge_)), period = wide + std::max(2, cells_in(kWindowGap, edge_));
        const int windows = std::max(0, (count - 2) / period), first = (count - windows * period + period - wide) / 2;
        const int place = cell - first;
        if (place < 0 || place >= windows * period || cell >= count - 1) return false;
        // Some are bricked up.
        const auto number = static_cast<uint64_t>(place / period);
        const auto wall = static_cast<uint64_t>(2 * static_cast<int>(axis) + side);
        if (jitter(seed_, 16 * wall + number, static_cast<uint64_t>(level / storey), 7) > 0.55) return false;
        return place % period < wide;
    }

    void add_square(const GridNode& cell, size_t axis, bool is_upper) {
        const size_t u = (axis + 1) % 3, w = (axis + 2) % 3;
        std::array<uint32_t, 4> corners{};
        for (size_t c = 0; c < 4; ++c) {
            GridNode node = cell;
            node[u] += c == 1 || c == 2;
            node[w] += c >= 2;
            corners[c] = vertex(node);
        }
        if (!is_upper) std::swap(corners[1], corners[3]);
        const auto& p = surface_.points;
        const auto [a, b, c, d] = corners;
        const Vec3d ac = p[a] - p[c], bd = p[b] - p[d];
        if (dot(ac, ac) <= dot(bd, bd)) {
            surface_.triangles.push_back({a, b, c});
            surface_.triangles.push_back({a, c, d});
        } else {
            surface_.triangles.push_back({a, b, d});
            surface_.triangles.push_back({b, c, d});
        }
    }

    uint32_t vertex(const GridNode& node) {
        const auto [place, is_new] = vertices_.try_emplace(node, static_cast<uint32_t>(surface_.points.size()));
        if (is_new) surface_.points.push_back(place_of(node));
        return place->second;
    }

    Vec3d place_of(const GridNode& node) const {
        const auto share = [&](size_t axis) { return static_cast<double>(node[axis]) / cells_[axis]; };
        const double u = 2 * share(0) - 1, w = 2 * share(2) - 1, square = std::max(std::fabs(u), std::fabs(w));
        double x = 0.5 * static_cast<double>(shape_.width) * u, z = 0.5 * static_cast<double>(shape_.depth) * w;
        if (shape_.is_round && square > 0) {
            const double scale = square / std::sqrt(u * u + w * w);
            x *= scale, z *= scale;
        }
        double y = static_cast<double>(shape_.height) * share(1);
        const double slope = shape_.is_round ? 1 - square : 1 - std::fabs(w);
        if (node[1] == cells_[1]) y += static_cast<double>(shape_.roof) * slope;
        return {x, y, z};
    }

    BuildingShape shape_;
    uint64_t seed_;
    double edge_ = 1;
    GridNode cells_{};
    std::map<GridNode, uint32_t> vertices_;
    MeshDraft surface_;
};

}  // namespace

Mesh make_building(const BuildingShape& shape, uint64_t seed) {
    Building building(shape, seed);
    MeshDraft surface = building.make();
    split_longest(surface, std::max(surface.points.size(), building.wanted_vertices()));
    flip_to_delaunay(surface, 1 - 1e-7);
    return to_mesh(surface, shape.is_round ? "tower" : "house");
}

}  // namespace cullet
