#include "systems/models/lattice/cook/order_nodes.hpp"

#include <algorithm>
#include <bit>

namespace cullet {
namespace {

constexpr size_t kLeaf = 40;  // nodes that are not halved any more
constexpr size_t kTried = 2;  // of the directions, those whose cut has fewest nodes beside it

Vec3d direction(size_t k) {
    static constexpr double kWays[13][3] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {1, 1, 0},  {1, -1, 0},
                                            {1, 0, 1},  {1, 0, -1}, {0, 1, 1},  {0, 1, -1}, {1, 1, 1},
                                            {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
    return {kWays[k][0], kWays[k][1], kWays[k][2]};
}
constexpr size_t kDirections = 13;

enum Side : uint8_t { Elsewhere, Low, High };

class Dissection {
 public:
    Dissection(const NodeGraph& graph, std::span<const Vec3d> places)
        : graph_(graph),
          places_(places),
          side_(graph.count(), Elsewhere),
          match_(graph.count(), graph.count()),
          seen_(graph.count(), 0),
          local_(graph.count(), graph.count()),
          is_done_(graph.count(), 0) {}

    std::vector<uint32_t> run() {
        std::vector<uint32_t> all(graph_.count());
        for (uint32_t n = 0; n < graph_.count(); ++n) all[n] = n;
        divide(all);
        return order_;
    }

 private:
    void divide(const std::vector<uint32_t>& nodes) {
        if (nodes.size() <= kLeaf) return fewest_neighbours_first(nodes);
        std::vector<uint32_t> between = best_separator(nodes), low, high;
        if (between.size() * 2 > nodes.size()) return fewest_neighbours_first(nodes);
        for (const uint32_t n : nodes) {
            if (std::binary_search(between.begin(), between.end(), n)) continue;
            (side_[n] == Low ? low : high).push_back(n);
        }
        for (const uint32_t n : nodes) side_[n] = Elsewhere;
        divide(low);
        divide(high);
        fewest_neighbours_first(between);
    }

    // Sides are marked by halves along the direction; the nodes of each side that have a neighbour on the other.
    void mark(std::vector<uint32_t>& nodes, size_t k) {
        const Vec3d along = direction(k);
        const auto is_before = [&](uint32_t p, uint32_t q) {
            const double a = dot(along, places_[p]), b = dot(along, places_[q]);
            return a != b ? a < b : p < q;
        };
        const auto middle = nodes.begin() + static_cast<ptrdiff_t>(nodes.size() / 2);
        std::nth_element(nodes.begin(), middle, nodes.end(), is_before);
        for (auto n = nodes.begin(); n != nodes.end(); ++n) side_[*n] = n < middle ? Low : High;
    }
    void collect(const std::vector<uint32_t>& nodes, std::vector<uint32_t>& low, std::vector<uint32_t>& high) const {
        low.clear(), high.clear();
        for (const uint32_t n : nodes) {
            const Side other = side_[n] == Low ? High : Low;
            const auto near = graph_.of(n);
            if (std::any_of(near.begin(), near.end(), [&](uint32_t m) { return side_[m] == other; }))
                (side_[n] == Low ? low : high).push_back(n);
        }
    }

    // Ascending. Leaves the sides marked.
    std::vector<uint32_t> best_separator(const std::vector<uint32_t>& given) {
        std::vector<uint32_t> nodes = given, low, high;
        std::vector<std::pair<size_t, size_t>> ways;
        for (size_t k = 0; k < kDirections; ++k) {
            mark(nodes, k);
            collect(given, low, high);
            ways.push_back({std::min(low.size(), high.size()), k});
        }
        std::sort(ways.begin(), ways.end());
        std::vector<uint32_t> best;
        size_t best_way = kDirections;
        for (size_t t = 0; t < kTried; ++t) {
            mark(nodes, ways[t].second);
            collect(given, low, high);
            std::vector<uint32_t> found = fewest_between(low, high);
            if (best_way == kDirections || found.size() < best.size())
                best = std::move(found), best_way = ways[t].second;
        }
        mark(nodes, best_way);
        return best;
    }

    // Koenig: as many nodes as the largest matching has pairs touch every edge between the sides.
    std::vector<uint32_t> fewest_between(const std::vector<uint32_t>& low, const std::vector<uint32_t>& high) {
        const uint32_t none = graph_.count();
        for (const uint32_t n : low) match_[n] = none;
        for (const uint32_t n : high) match_[n] = none;
        for (const uint32_t n : low) {
            ++round_;
            pair_up(n);
        }
        ++round_;
        for (const uint32_t n : low)
            if (match_[n] == none) reach(n);
        std::vector<uint32_t> cover;
        for (const uint32_t n : low)
            if (seen_[n] != round_) cover.push_back(n);
        for (const uint32_t n : high)
            if (seen_[n] == round_) cover.push_back(n);
        std::sort(cover.begin(), cover.end());
        return cover;
    }
    bool pair_up(uint32_t n) {
        for (const uint32_t m : graph_.of(n)) {
            if (side_[m] != High || seen_[m] == round_) continue;
            seen_[m] = round_;
            if (match_[m] != graph_.count() && !pair_up(match_[m])) continue;
            match_[m] = n, match_[n] = m;
            return true;
        }
        return false;
    }
    void reach(uint32_t n) {
        if (seen_[n] == round_) return;
        seen_[n] = round_;
        for (const uint32_t m : graph_.of(n)) {
            if (side_[m] != High || seen_[m] == round_) continue;
            seen_[m] = round_;
            if (match_[m] != graph_.count()) reach(match_[m]);
        }
    }

    // The elimination is gone through in full: rows of bits over these nodes and what they touch.
    void fewest_neighbours_first(const std::vector<uint32_t>& nodes) {
        std::vector<uint32_t> around = nodes;
        const auto give = [&](uint32_t n, size_t place) { local_[n] = static_cast<uint32_t>(place); };
        for (size_t i = 0; i < nodes.size(); ++i) give(nodes[i], i);
        for (const uint32_t n : nodes)
            for (const uint32_t m : graph_.of(n))
                if (local_[m] == graph_.count() && !is_done_[m]) give(m, around.size()), around.push_back(m);
        const size_t words = (around.size() + 63) / 64;
        std::vector<uint64_t> bits(nodes.size() * words, 0);
        for (size_t i = 0; i < nodes.size(); ++i)
            for (const uint32_t m : graph_.of(nodes[i]))
                if (!is_done_[m]) bits[i * words + local_[m] / 64] |= uint64_t{1} << (local_[m] % 64);
        std::vector<uint8_t> is_out(nodes.size(), 0);
        for (size_t step = 0; step < nodes.size(); ++step) {
            size_t best = nodes.size();
            int fewest = 0;
            for (size_t i = 0; i < nodes.size(); ++i) {
                if (is_out[i]) continue;
                int degree = 0;
                for (size_t w = 0; w < words; ++w) degree += std::popcount(bits[i * words + w]);
                if (best == nodes.size() || degree < fewest) best = i, fewest = degree;
            }
            is_out[best] = 1;
            order_.push_back(nodes[best]);
            for (size_t i = 0; i < nodes.size(); ++i) {
                if (is_out[i] || !(bits[best * words + i / 64] >> (i % 64) & 1)) continue;
                for (size_t w = 0; w < words; ++w) bits[i * words + w] |= bits[best * words + w];
                bits[i * words + i / 64] &= ~(uint64_t{1} << (i % 64));
                bits[i * words + best / 64] &= ~(uint64_t{1} << (best % 64));
            }
        }
        for (const uint32_t n : around) local_[n] = graph_.count();
        for (const uint32_t n : nodes) is_done_[n] = 1;
    }

    const NodeGraph& graph_;
    std::span<const Vec3d> places_;
    std::vector<Side> side_;
    std::vector<uint32_t> match_, seen_, local_;
    std::vector<uint8_t> is_done_;
    std::vector<uint32_t> order_;
    uint32_t round_ = 0;
};

}  // namespace

NodeGraph graph_of(uint32_t count, std::span<const uint32_t> nodes, uint32_t per_element) {
    std::vector<std::vector<uint32_t>> near(count);
    for (size_t e = 0; e < nodes.size(); e += per_element)
        for (uint32_t i = 0; i < per_element; ++i)
            for (uint32_t k = 0; k < per_element; ++k)
                if (i != k) near[nodes[e + i]].push_back(nodes[e + k]);
    NodeGraph graph;
    graph.first.push_back(0);
    for (auto& list : near) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
        graph.to.insert(graph.to.end(), list.begin(), list.end());
        graph.first.push_back(static_cast<uint32_t>(graph.to.size()));
    }
    return graph;
}

std::vector<uint32_t> dissect(const NodeGraph& graph, std::span<const Vec3d> places) {
    return Dissection(graph, places).run();
}

}  // namespace cullet
