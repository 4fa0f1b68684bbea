#include "systems/models/metal_shell/cook/dual_graph.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "systems/cook/disjoint_sets.hpp"

namespace cullet {
namespace {

constexpr double kLeastDistance = 1e-9;  // no way is free
constexpr double kOpposed = -0.5;        // cosine of normals of two sides of one sheet

/// Two faces at one edge.
struct FacePair {
    uint32_t a, b;
    Vec3d middle;  // of the edge
};

// By place and not by vertex: a surface splits vertices where several fans meet.
std::vector<FacePair> pairs_at_edges(const Surface& surface) {
    struct Side {
        uint32_t low, high, face;
        Vec3d middle;
    };
    std::vector<Side> sides;
    for (uint32_t f = 0; f < surface.triangles.size(); ++f)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t v = surface.triangles[f][k], w = surface.triangles[f][(k + 1) % 3];
            const uint32_t p = surface.position_ids[v], q = surface.position_ids[w];
            sides.push_back({std::min(p, q), std::max(p, q), f, 0.5 * (surface.positions[v] + surface.positions[w])});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        if (a.low != b.low) return a.low < b.low;
        return a.high != b.high ? a.high < b.high : a.face < b.face;
    });
    std::vector<FacePair> pairs;
    for (size_t i = 0, end; i < sides.size(); i = end) {
        end = i;
        while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
        for (size_t a = i; a < end; ++a)
            for (size_t b = a + 1; b < end; ++b)
                if (sides[a].face != sides[b].face) pairs.push_back({sides[a].face, sides[b].face, sides[i].middle});
    }
    return pairs;
}

std::vector<Vec3d> vertex_normals(const Surface& surface, std::span<const FaceShape> faces) {
    std::vector<Vec3d> normals(surface.positions.size());
    for (uint32_t f = 0; f < surface.triangles.size(); ++f)
        for (const uint32_t v : surface.triangles[f]) normals[v] += faces[f].area * faces[f].normal;
    for (Vec3d& n : normals)
        if (length(n) > 0) n = (1 / length(n)) * n;
    return normals;
}

/// Vertices by cells of a grid, sorted.
class Grid {
 public:
    Grid(const std::vector<Vec3d>& places, Vec3d low, double step) : low_(low), step_(step) {
        for (uint32_t v = 0; v < places.size(); ++v) list_.push_back({cell_of(places[v]), v});
        std::sort(list_.begin(), list_.end());
    }
    /// Calls visit(vertex) for all in the 27 cells about a place.
    template <class Visit>
    void for_each_near(Vec3d place, Visit visit) const {
        const std::array<int64_t, 3> c = cell_of(place);
        for (int64_t x = c[0] - 1; x <= c[0] + 1; ++x)
            for (int64_t y = c[1] - 1; y <= c[1] + 1; ++y) {
                auto entry = std::lower_bound(list_.begin(), list_.end(), Entry{{x, y, c[2] - 1}, 0});
                for (; entry != list_.end() && entry->first <= std::array{x, y, c[2] + 1}; ++entry)
                    visit(entry->second);
            }
    }

 private:
    using Cell = std::array<int64_t, 3>;
    using Entry = std::pair<Cell, uint32_t>;  // and vertex
    std::array<int64_t, 3> cell_of(Vec3d p) const {
        const Vec3d d = (1 / step_) * (p - low_);
        return {static_cast<int64_t>(std::floor(d.x)), static_cast<int64_t>(std::floor(d.y)),
                static_cast<int64_t>(std::floor(d.z))};
    }
    Vec3d low_;
    double step_;
    std::vector<Entry> list_;
};

// Each vertex to the nearest one of another sheet: another component, or the other side of a folded one.
std::vector<SheetLink> find_links(const Surface& surface, std::span<const FaceShape> faces,
                                  std::span<const uint32_t> component_of_vertex, double reach) {
    std::vector<SheetLink> links;
    if (!(reach > 0)) return links;
    const std::vector<Vec3d> normals = vertex_normals(surface, faces);
    const Grid grid(surface.positions, surface.low, reach);
    for (uint32_t v = 0; v < surface.positions.size(); ++v) {
        double least = reach;
        uint32_t nearest = kNone;
        grid.for_each_near(surface.positions[v], [&](uint32_t w) {
            const bool is_other =
                component_of_vertex[w] != component_of_vertex[v] || dot(normals[v], normals[w]) < kOpposed;
            if (w == v || !is_other) return;
            const double gap = length(surface.positions[w] - surface.positions[v]);
            if (gap < least || (gap == least && w < nearest)) least = gap, nearest = w;
        });
        if (nearest != kNone) links.push_back({std::min(v, nearest), std::max(v, nearest), least});
    }
    std::sort(links.begin(), links.end(),
              [](const SheetLink& p, const SheetLink& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
    links.erase(std::unique(links.begin(), links.end(),
                            [](const SheetLink& p, const SheetLink& q) { return p.a == q.a && p.b == q.b; }),
                links.end());
    return links;
}

/// What two neighbours differ by, before both parts are weighed.
struct Difference {
    double angle = 0, way = 0;
};

Difference difference_of(const FacePair& pair, std::span<const FaceShape> faces, const DualSettings& settings) {
    const FaceShape &a = faces[pair.a], &b = faces[pair.b];
    Difference d;
    d.way = length(a.centroid - pair.middle) + length(pair.middle - b.centroid);
    if (!(a.area > 0) || !(b.area > 0)) return d;
    const double cosine = std::clamp(dot(a.normal, b.normal), -1.0, 1.0);
    if (settings.distance == FaceDistance::Paper) {
        d.angle = 1 - cosine * cosine;
        return d;
    }
    const bool is_convex = dot(b.centroid - pair.middle, a.normal) < 0;
    d.angle = (is_convex ? settings.convex_weight : 1) * (1 - cosine);
    return d;
}

std::vector<double> distances_of(std::span<const FacePair> pairs, std::span<const FaceShape> faces,
                                 const DualSettings& settings) {
    std::vector<Difference> differences;
    double angles = 0, ways = 0;
    for (const FacePair& pair : pairs) {
        differences.push_back(difference_of(pair, faces, settings));
        angles += differences.back().angle, ways += differences.back().way;
    }
    const auto count = static_cast<double>(pairs.size());
    const bool is_paper = settings.distance == FaceDistance::Paper;
    const double mean_angle = is_paper ? 1 : angles / count, mean_way = is_paper ? 1 : ways / count;
    std::vector<double> distances;
    for (const Difference& d : differences) {
        const double angle = mean_angle > 1e-12 ? d.angle / mean_angle : 0;
        const double way = mean_way > 0 ? d.way / mean_way : 0;
        distances.push_back((1 - settings.way_share) * angle + settings.way_share * way + kLeastDistance);
    }
    return distances;
}

/// Joins what the edges and links join; numbers components by their lowest face.
uint32_t number_components(DisjointSets& sets, std::vector<uint32_t>& component_of) {
    uint32_t count = 0;
    for (uint32_t f = 0; f < component_of.size(); ++f) {
        const uint32_t root = sets.find(f);
        component_of[f] = root == f ? count++ : component_of[root];
    }
    return count;
}

}  // namespace

FaceShape shape_of(const Surface& surface, uint32_t face) {
    const Triangle& c = surface.triangles[face];
    const Vec3d p = surface.positions[c[0]], q = surface.positions[c[1]], r = surface.positions[c[2]];
    const Vec3d across = cross(q - p, r - p);
    const double size = length(across);
    FaceShape shape;
    shape.centroid = (1.0 / 3) * (p + q + r);
    shape.area = 0.5 * size;
    if (size > 0) shape.normal = (1 / size) * across;
    return shape;
}

DualGraph build_dual_graph(const Surface& surface, const DualSettings& settings) {
    const auto count = static_cast<uint32_t>(surface.triangles.size());
    std::vector<FaceShape> faces;
    for (uint32_t f = 0; f < count; ++f) faces.push_back(shape_of(surface, f));
    const std::vector<FacePair> pairs = pairs_at_edges(surface);
    const std::vector<double> distances = distances_of(pairs, faces, settings);

    DisjointSets sets(count);
    for (const FacePair& pair : pairs) sets.unite(pair.a, pair.b);
    std::vector<uint32_t> face_of_vertex(surface.positions.size(), kNone),
        component_of_vertex(surface.positions.size());
    for (uint32_t f = 0; f < count; ++f)
        for (const uint32_t v : surface.triangles[f]) {
            face_of_vertex[v] = std::min(face_of_vertex[v], f);
            component_of_vertex[v] = sets.find(f);
        }
    DualGraph graph;
    graph.links = find_links(surface, faces, component_of_vertex, settings.link_distance * surface.diagonal);

    struct Directed {
        uint32_t from;
        DualEdge edge;
    };
    std::vector<Directed> all;
    const auto add = [&all](uint32_t a, uint32_t b, double distance) {
        all.push_back({a, {b, distance}});
        all.push_back({b, {a, distance}});
    };
    for (size_t p = 0; p < pairs.size(); ++p) add(pairs[p].a, pairs[p].b, distances[p]);
    for (const SheetLink& link : graph.links) {
        const uint32_t a = face_of_vertex[link.a], b = face_of_vertex[link.b];
        if (a == kNone || b == kNone || a == b) continue;
        add(a, b, link.gap + kLeastDistance);
        sets.unite(a, b);
    }
    std::sort(all.begin(), all.end(), [](const Directed& p, const Directed& q) {
        if (p.from != q.from) return p.from < q.from;
        return p.edge.face != q.edge.face ? p.edge.face < q.edge.face : p.edge.distance < q.edge.distance;
    });
    graph.first.assign(count + 1, 0);
    for (const Directed& d : all) {
        ++graph.first[d.from + 1];
        graph.edges.push_back(d.edge);
    }
    std::partial_sum(graph.first.begin(), graph.first.end(), graph.first.begin());
    graph.component_of.resize(count);
    graph.component_count = number_components(sets, graph.component_of);
    return graph;
}

}  // namespace cullet
