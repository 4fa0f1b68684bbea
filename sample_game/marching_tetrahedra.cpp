#include <cmath>
#include <map>

#include "sample_game/mesh_tools.hpp"

namespace cullet {
namespace {

/// The nodes of a grid and where f changes sign between two of them.
class Grid {
 public:
    Grid(const std::function<double(Vec3d)>& f, Vec3d low, Vec3d high, double cell) : low_(low), cell_(cell) {
        for (int k = 0; k < 3; ++k) nodes_[k] = static_cast<uint32_t>(std::floor((high[k] - low[k]) / cell)) + 2;
        for (uint32_t z = 0; z < nodes_[2]; ++z)
            for (uint32_t y = 0; y < nodes_[1]; ++y)
                for (uint32_t x = 0; x < nodes_[0]; ++x) {
                    const double value = f(place(x, y, z));
                    values_.push_back(value == 0 ? 1e-12 : value);  // no vertex falls on a node
                }
    }

    MeshDraft march() {
        constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
        for (uint32_t z = 0; z + 1 < nodes_[2]; ++z)
            for (uint32_t y = 0; y + 1 < nodes_[1]; ++y)
                for (uint32_t x = 0; x + 1 < nodes_[0]; ++x)
                    for (int o = 0; o < 6; ++o) {
                        // Kuhn's six: along the axes in one order, from the low corner to the high one. Odd orders are
                        // mirrored.
                        const uint32_t a = node(x, y, z), b = a + stride(orders[o][0]), c = b + stride(orders[o][1]),
                                       d = c + stride(orders[o][2]);
                        if (o < 3)
                            cut({a, b, c, d});
                        else
                            cut({a, c, b, d});
                    }
        return std::move(surface_);
    }

 private:
    Vec3d place(uint32_t x, uint32_t y, uint32_t z) const { return low_ + cell_ * Vec3d{1.0 * x, 1.0 * y, 1.0 * z}; }
    uint32_t node(uint32_t x, uint32_t y, uint32_t z) const { return (z * nodes_[1] + y) * nodes_[0] + x; }
    uint32_t stride(int axis) const { return axis == 0 ? 1 : axis == 1 ? nodes_[0] : nodes_[0] * nodes_[1]; }
    Vec3d place(uint32_t n) const { return place(n % nodes_[0], n / nodes_[0] % nodes_[1], n / nodes_[0] / nodes_[1]); }

    uint32_t crossing(uint32_t a, uint32_t b) {
        if (a > b) std::swap(a, b);
        const auto [found, is_new] = crossings_.try_emplace({a, b}, static_cast<uint32_t>(surface_.points.size()));
        if (is_new) {
            const double w = values_[a] / (values_[a] - values_[b]);
            surface_.points.push_back(place(a) + w * (place(b) - place(a)));
        }
        return found->second;
    }

    /// One tetrahedron of positive orientation. All reorderings below are even, so the orientation stays.
    void cut(std::array<uint32_t, 4> t) {
        constexpr int single[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
        constexpr int pairs[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                     {2, 3, 0, 1}, {3, 1, 0, 2}, {1, 2, 0, 3}};
        const auto is_inside = [&](int k) { return values_[t[k]] < 0; };
        const int inside = is_inside(0) + is_inside(1) + is_inside(2) + is_inside(3);
        const auto at = [&](int i, int k) { return crossing(t[i], t[k]); };
        if (inside == 1 || inside == 3) {
            for (const auto& o : single)
                if (is_inside(o[0]) == (inside == 1)) {
                    const uint32_t p = at(o[0], o[1]), q = at(o[0], o[2]), r = at(o[0], o[3]);
                    surface_.triangles.push_back(inside == 1 ? Triangle{p, q, r} : Triangle{p, r, q});
                    return;
                }
        } else if (inside == 2) {
            for (const auto& o : pairs)
                if (is_inside(o[0]) && is_inside(o[1])) {
                    const uint32_t ik = at(o[0], o[2]), il = at(o[0], o[3]), jl = at(o[1], o[3]), jk = at(o[1], o[2]);
                    surface_.triangles.push_back({ik, il, jl});
                    surface_.triangles.push_back({ik, jl, jk});
                    return;
                }
        }
    }

    Vec3d low_;
    double cell_;
    uint32_t nodes_[3] = {};
    std::vector<double> values_;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> crossings_;
    MeshDraft surface_;
};

}  // namespace

MeshDraft surface_of(const std::function<double(Vec3d)>& f, Vec3d low, Vec3d high, double cell) {
    return Grid(f, low, high, cell).march();
}

}  // namespace cullet
