#include <algorithm>

#include "engine/table.hpp"
#include "systems/structures/tetrahedra/cook/cut_work.hpp"

namespace cullet {
namespace {

using Found = List<Winding>;

// What is true at one end of an edge, with all that pierces it on the way to the other: the same, or `sign` reversed.
Found across(const CutRequest& request, const Cut& cut, const Found& from, uint32_t edge, int32_t way) {
    Found to = from;
    for (uint32_t i = cut.first_piercing[edge]; i < cut.first_piercing[edge + 1]; ++i) {
        const Piercing& p = cut.piercings[i];
        const uint32_t part = request.mesh.part_of[p.triangle];
        const auto place =
            std::lower_bound(to.begin(), to.end(), part, [](const Winding& w, uint32_t q) { return w.part < q; });
        if (place != to.end() && place->part == part)
            place->count += way * p.sign;
        else
            to.insert(place, {part, way * p.sign});
    }
    std::erase_if(to, [](const Winding& w) { return w.count == 0; });
    return to;
}

/// Edges at every point.
struct EdgesAt {
    List<uint32_t> first, edge;
    EdgesAt(size_t point_count, const std::vector<std::array<uint32_t, 2>>& edges, const List<uint8_t>& is_used)
        : first(point_count + 1) {
        for (uint32_t e = 0; e < edges.size(); ++e)
            if (is_used[e]) ++first[edges[e][0] + 1], ++first[edges[e][1] + 1];
        for (size_t p = 0; p < point_count; ++p) first[p + 1] += first[p];
        edge.resize(first.back());
        List<uint32_t> next(first.begin(), first.end() - 1);
        for (uint32_t e = 0; e < edges.size(); ++e)
            if (is_used[e]) edge[next[edges[e][0]]++] = e, edge[next[edges[e][1]]++] = e;
    }
};

List<uint8_t> used_edges(const CutRequest& request) {
    List<uint8_t> is_used(request.faces.edges.size(), request.wanted_faces.empty());
    for (const uint32_t f : request.wanted_faces)
        for (const uint32_t e : request.faces.faces[f].edge) is_used[e] = 1;
    return is_used;
}

}  // namespace

bool find_windings(const CutRequest& request, const List<uint8_t>& is_known, Cut& cut) {
    const size_t count = request.lattice.points.size();
    const auto& edges = request.faces.edges;
    const List<uint8_t> is_used = used_edges(request);
    const EdgesAt at(count, edges, is_used);
    List<Found> windings(count);
    List<uint8_t> is_found(count);
    List<uint32_t> queue;
    for (uint32_t p = 0; p < count; ++p)
        if (is_known[p]) {
            if (request.known) windings[p].assign(request.known->of(p).begin(), request.known->of(p).end());
            is_found[p] = 1;
            queue.push_back(p);
        }
    for (size_t head = 0; head < queue.size(); ++head) {
        const uint32_t p = queue[head];
        for (uint32_t i = at.first[p]; i < at.first[p + 1]; ++i) {
            const uint32_t e = at.edge[i];
            const bool is_low = edges[e][0] == p;
            const uint32_t other = edges[e][is_low ? 1 : 0];
            if (is_found[other]) continue;
            is_found[other] = 1;
            windings[other] = across(request, cut, windings[p], e, is_low ? 1 : -1);
            queue.push_back(other);
        }
    }
    cut.windings.first.assign(1, 0);
    for (const Found& list : windings) {
        cut.windings.list.insert(cut.windings.list.end(), list.begin(), list.end());
        cut.windings.first.push_back(static_cast<uint32_t>(cut.windings.list.size()));
    }
    for (uint32_t e = 0; e < edges.size(); ++e)
        if (is_used[e] && (!is_found[edges[e][0]] || !is_found[edges[e][1]])) return false;
    return true;
}

bool are_consistent(const CutRequest& request, const Cut& cut) {
    const List<uint8_t> is_used = used_edges(request);
    for (uint32_t e = 0; e < request.faces.edges.size(); ++e) {
        if (!is_used[e]) continue;
        const auto from = cut.windings.of(request.faces.edges[e][0]), to = cut.windings.of(request.faces.edges[e][1]);
        const Found other = across(request, cut, Found(from.begin(), from.end()), e, 1);
        const auto is_same = [](const Winding& a, const Winding& b) { return a.part == b.part && a.count == b.count; };
        if (!std::equal(other.begin(), other.end(), to.begin(), to.end(), is_same)) return false;
    }
    return true;
}

void sort_piercings(const CutRequest& request, const GridPoints& points, Cut& cut) {
    struct Placed {
        double ratio;
        Piercing piercing;
    };
    List<uint32_t>& first = cut.first_piercing;
    first.assign(request.faces.edges.size() + 1, 0);
    for (const Piercing& p : cut.piercings) ++first[p.edge + 1];
    for (size_t e = 0; e + 1 < first.size(); ++e) first[e + 1] += first[e];
    List<Placed> sorted(cut.piercings.size());
    List<uint32_t> next(first.begin(), first.end() - 1);
    for (const Piercing& p : cut.piercings) {
        const auto [u, w] = request.faces.edges[p.edge];
        const Triangle& t = request.mesh.triangles[p.triangle];
        const GridPoint &a = points.mesh[t[0]], &b = points.mesh[t[1]], &c = points.mesh[t[2]];
        const double low = determinant(a, b, c, points.lattice[u]), high = determinant(a, b, c, points.lattice[w]);
        sorted[next[p.edge]++] = {low / (low - high), p};
    }
    for (size_t e = 0; e + 1 < first.size(); ++e)
        if (first[e + 1] - first[e] > 1)
            std::sort(sorted.begin() + first[e], sorted.begin() + first[e + 1], [](const Placed& a, const Placed& b) {
                return a.ratio != b.ratio ? a.ratio < b.ratio : a.piercing.triangle < b.piercing.triangle;
            });
    for (size_t i = 0; i < sorted.size(); ++i) cut.piercings[i] = sorted[i].piercing;
}

}  // namespace cullet
