#include "systems/models/lattice/solve/stiffness.hpp"

#include <algorithm>

namespace cullet {
namespace {

constexpr double kLeastSolid = 1e-12;  // of an element: less of it is none
constexpr double kLeastWeight = 0.5;   // of the median: pins stand where there is solid around

struct Block {
    double at[3][3];
};

// The gradient of a node's shape is a sum of l_k times vectors.
using NodeGradients = std::array<std::array<Vec3d, 4>, 10>;

NodeGradients node_gradients(const SolidElement& element) {
    NodeGradients c;
    for (uint32_t i = 0; i < 4; ++i)
        for (uint32_t k = 0; k < 4; ++k) c[i][k] = (i == k ? 3.0 : -1.0) * element.gradient[i];
    for (uint32_t m = 0; m < 6; ++m) {
        c[4 + m][kMiddleEnds[m][0]] = 4.0 * element.gradient[kMiddleEnds[m][1]];
        c[4 + m][kMiddleEnds[m][1]] = 4.0 * element.gradient[kMiddleEnds[m][0]];
    }
    return c;
}

// Integral of D over the strains of two nodes: lambda a b^T + mu b a^T + mu (a . b) 1.
Block coupling(const std::array<Vec3d, 4>& a, const std::array<Vec3d, 4>& b, double lambda, double mu) {
    double s[3][3] = {};
    for (uint32_t k = 0; k < 4; ++k) {
        const double p[3] = {a[k].x, a[k].y, a[k].z}, q[3] = {b[k].x, b[k].y, b[k].z};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) s[i][j] += p[i] * q[j];
    }
    const double turn = mu * (s[0][0] + s[1][1] + s[2][2]);
    Block block;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) block.at[i][j] = lambda * s[i][j] + mu * s[j][i] + (i == j ? turn : 0.0);
    return block;
}

}  // namespace

void sum_moments(const SolidElements& solid, std::span<const uint32_t> cells, std::span<Moments> sums) {
    std::fill(sums.begin(), sums.end(), Moments{});
    for (const uint32_t cell : cells)
        for (uint32_t p = solid.first_part[cell]; p < solid.first_part[cell + 1]; ++p) {
            const SolidPart& part = solid.parts[p];
            for (size_t k = 0; k < 10; ++k) sums[part.element][k] += part.moments[k];
        }
    for (size_t e = 0; e < sums.size(); ++e)
        if (!(volume_of(sums[e]) > kLeastSolid * solid.elements[e].volume)) sums[e] = {};
}

void add_stiffness(const SolidElements& solid, std::span<const Moments> sums, const ElasticSolid& elastic,
                   uint32_t first, uint32_t end, Factor& factor) {
    const double lambda = elastic.first_lame(), mu = elastic.shear();
    for (uint32_t e = first; e < end; ++e) {
        if (!(volume_of(sums[e]) > 0)) continue;
        const SolidElement& element = solid.elements[e];
        const NodeGradients c = node_gradients(element);
        const double whole = kStiffnessFloor * element.volume / 20;
        double m[4][4];
        for (uint32_t i = 0; i < 4; ++i)
            for (uint32_t k = 0; k < 4; ++k) m[i][k] = sums[e][kMomentPlace[i][k]] + (i == k ? 2 * whole : whole);
        for (uint32_t b = 0; b < 10; ++b) {
            std::array<Vec3d, 4> weighted;
            for (uint32_t k = 0; k < 4; ++k)
                weighted[k] = m[k][0] * c[b][0] + m[k][1] * c[b][1] + m[k][2] * c[b][2] + m[k][3] * c[b][3];
            const uint32_t rank_b = solid.plan.rank[element.node[b]];
            factor.is_used[rank_b] = 1;
            for (uint32_t a = b; a < 10; ++a) {
                const Block block = coupling(c[a], weighted, lambda, mu);
                double* to = factor.entries.data() + size_t{solid.entries[e][pair_of(a, b)]} * 9;
                const bool is_turned = solid.plan.rank[element.node[a]] < rank_b;
                for (int i = 0; i < 3; ++i)
                    for (int k = 0; k < 3; ++k) to[i * 3 + k] += is_turned ? block.at[k][i] : block.at[i][k];
            }
        }
    }
}

void weigh_nodes(const SolidElements& solid, std::span<const Moments> sums, std::span<double> weights) {
    std::fill(weights.begin(), weights.end(), 0.0);
    for (size_t e = 0; e < sums.size(); ++e)
        for (const uint32_t n : solid.elements[e].node) weights[n] += volume_of(sums[e]);
}

bool choose_pins(const SolidElements& solid, const Factor& factor, std::span<const double> weights, Vec3d centre,
                 std::span<double> sorted, Pins& pins) {
    const uint32_t count = static_cast<uint32_t>(solid.places.size());
    uint32_t used = 0;
    for (uint32_t n = 0; n < count; ++n)
        if (factor.is_used[solid.plan.rank[n]]) sorted[used++] = weights[n];
    if (used < 3) return false;
    std::nth_element(sorted.begin(), sorted.begin() + used / 2, sorted.begin() + used);
    const double least = kLeastWeight * sorted[used / 2];
    const auto farthest = [&](auto distance) {
        uint32_t best = count;
        double most = 0;
        for (uint32_t n = 0; n < count; ++n) {
            if (!factor.is_used[solid.plan.rank[n]] || weights[n] < least) continue;
            const double d = distance(solid.places[n]);
            if (d > most) most = d, best = n;
        }
        return best;
    };
    const auto square = [](Vec3d v) { return dot(v, v); };
    const uint32_t first = farthest([&](Vec3d p) { return square(p - centre); });
    if (first == count) return false;
    const Vec3d origin = solid.places[first];
    const uint32_t second = farthest([&](Vec3d p) { return square(p - origin); });
    if (second == count) return false;
    const Vec3d along = solid.places[second] - origin;
    const uint32_t third = farthest([&](Vec3d p) { return square(cross(along, p - origin)); });
    if (third == count) return false;
    const Vec3d aside = solid.places[third] - origin;

    // Turns that are left move the second node by w x along and the third by w x aside: the two components of the one
    // and the component of the other that tell any turn best.
    const auto row = [](Vec3d d, int k) {
        return k == 0 ? Vec3d{0, d.z, -d.y} : k == 1 ? Vec3d{-d.z, 0, d.x} : Vec3d{d.y, -d.x, 0};
    };
    double best = 0;
    for (int k = 0; k < 3; ++k) {
        const Vec3d p = row(along, (k + 1) % 3), q = row(along, (k + 2) % 3);
        for (int j = 0; j < 3; ++j) {
            const double det = std::fabs(dot(cross(p, q), row(aside, j)));
            if (!(det > best)) continue;
            best = det;
            pins[1].components = static_cast<uint8_t>(7 & ~(1 << k));
            pins[2].components = static_cast<uint8_t>(1 << j);
        }
    }
    pins[0] = {solid.plan.rank[first], 7};
    pins[1].rank = solid.plan.rank[second], pins[2].rank = solid.plan.rank[third];
    return best > 0;
}

void hold(const EliminationPlan& plan, const Pins& pins, Factor& factor) {
    for (const Pin& pin : pins)
        for (uint32_t column = 0, e = 0; column <= pin.rank; ++column)
            for (; e < plan.first_entry[column + 1]; ++e) {
                if (column != pin.rank && plan.entry_row[e] != pin.rank) continue;
                double* block = factor.entries.data() + size_t{e} * 9;
                const bool is_diagonal = column == pin.rank && plan.entry_row[e] == pin.rank;
                for (uint32_t i = 0; i < 3; ++i) {
                    if (!(pin.components >> i & 1)) continue;
                    const double own = block[i * 3 + i];
                    if (plan.entry_row[e] == pin.rank)
                        for (uint32_t k = 0; k < 3; ++k) block[i * 3 + k] = 0;
                    if (column == pin.rank)
                        for (uint32_t k = 0; k < 3; ++k) block[k * 3 + i] = 0;
                    if (is_diagonal) block[i * 3 + i] = own;
                }
            }
}

void hold(const Pins& pins, std::span<double> loads) {
    for (const Pin& pin : pins)
        for (uint32_t i = 0; i < 3; ++i)
            if (pin.components >> i & 1) loads[size_t{pin.rank} * 3 + i] = 0;
}

}  // namespace cullet
