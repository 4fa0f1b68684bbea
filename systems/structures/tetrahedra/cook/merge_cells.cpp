#include "systems/structures/tetrahedra/cook/merge_cells.hpp"

#include <algorithm>
#include <queue>

#include "engine/table.hpp"
#include "systems/cook/disjoint_sets.hpp"

namespace cullet {
namespace {

/// The inside part of a face, between two raw cells.
struct RawBond {
    uint32_t a, b, face;  // a: in the face's first tetrahedron
    double area;          // of the loops along the face's normal
    Vec3d first;          // of x over it
    Vec3d normal;         // of the face, from a to b
};

// Loops of a face between the same two cells are one: a hole takes its area away.
std::vector<RawBond> find_bonds(const CutRequest& request, const Cut& cut, const CutCells& raw) {
    const std::span<const Vec3d> points =
        request.points.empty() ? std::span<const Vec3d>(request.lattice.points) : request.points;
    std::vector<RawBond> bonds;
    for (uint32_t i = 0; i < cut.loops.size(); ++i) {
        const CutLoop& loop = cut.loops[i];
        const auto [a, b] = raw.of_loop[i];
        if (a == kNone || b == kNone) continue;
        const auto& c = request.faces.faces[loop.face].corner;
        const Vec3d normal = normalised(cross(points[c[1]] - points[c[0]], points[c[2]] - points[c[0]]));
        const FlatSums sums = flat_sums({cut.places.data() + loop.first, loop.count}, normal);
        const double area = dot(sums.area, normal);
        size_t same = bonds.size();
        while (same > 0 && bonds[same - 1].face == loop.face && !(bonds[same - 1].a == a && bonds[same - 1].b == b))
            --same;
        if (same > 0 && bonds[same - 1].face == loop.face) {
            bonds[same - 1].area += area;
            bonds[same - 1].first += sums.first;
        } else {
            bonds.push_back({a, b, loop.face, area, sums.first, normal});
        }
    }
    return bonds;
}

double reference_volume(const CutRequest& request, const CutCells& raw) {
    const double edge = request.lattice.edge;
    double sum = 0;
    uint32_t count = 0;
    for (const CutCell& cell : raw.cells)
        if (cell.sums.volume > 0) sum += cell.sums.volume, ++count;
    return std::min(edge * edge * edge / 12, 2 * sum / std::max(1u, count));
}

// The smallest first, each into the neighbour with which it shares most area. The lowest raw cell stands for all that
// joined.
class Merger {
 public:
    Merger(const CutCells& raw, const std::vector<RawBond>& bonds, double least)
        : bonds_(bonds),
          least_(least),
          sets_(raw.cells.size()),
          volume_(raw.cells.size()),
          bonds_at_(raw.cells.size()),
          area_(raw.cells.size(), -1) {
        for (uint32_t c = 0; c < volume_.size(); ++c) volume_[c] = raw.cells[c].sums.volume;
        for (uint32_t i = 0; i < bonds.size(); ++i)
            bonds_at_[bonds[i].a].push_back(i), bonds_at_[bonds[i].b].push_back(i);
        for (uint32_t c = 0; c < volume_.size(); ++c) ask(c);
        while (!queue_.empty()) {
            const Small small = queue_.top();
            queue_.pop();
            if (sets_.find(small.cell) != small.cell || small.volume != volume_[small.cell]) continue;
            if (const uint32_t into = widest_neighbour(small.cell); into != kNone) join(small.cell, into);
        }
    }
    uint32_t find(uint32_t cell) { return sets_.find(cell); }

 private:
    struct Small {
        double volume;
        uint32_t cell;
        bool operator>(const Small& o) const { return volume != o.volume ? volume > o.volume : cell > o.cell; }
    };
    void ask(uint32_t cell) {
        if (volume_[cell] < least_) queue_.push({volume_[cell], cell});
    }
    // What turns itself inside out has cells of negative volume, which join until one has eaten its way out, and bonds
    // of negative area.
    uint32_t widest_neighbour(uint32_t cell) {
        touched_.clear();
        std::erase_if(bonds_at_[cell], [&](uint32_t i) {
            const uint32_t a = sets_.find(bonds_[i].a), b = sets_.find(bonds_[i].b);
            if (a == b) return true;
            const uint32_t other = a == cell ? b : a;
            if (area_[other] < 0) touched_.push_back(other), area_[other] = 0;
            area_[other] += std::fabs(bonds_[i].area);
            return false;
        });
        uint32_t best = kNone;
        double widest = -1;
        for (const uint32_t other : touched_) {
            if (area_[other] > widest || (area_[other] == widest && other < best)) best = other, widest = area_[other];
            area_[other] = -1;
        }
        return best;
    }
    void join(uint32_t a, uint32_t b) {
        sets_.unite(a, b);
        const uint32_t kept = sets_.find(a), gone = kept == a ? b : a;
        volume_[kept] += volume_[gone];
        bonds_at_[kept].insert(bonds_at_[kept].end(), bonds_at_[gone].begin(), bonds_at_[gone].end());
        bonds_at_[gone].clear();
        ask(kept);
    }
    const std::vector<RawBond>& bonds_;
    double least_;
    DisjointSets sets_;
    std::vector<double> volume_;
    std::vector<std::vector<uint32_t>> bonds_at_;
    std::vector<double> area_;       // towards a neighbour, or -1
    std::vector<uint32_t> touched_;  // of them
    std::priority_queue<Small, std::vector<Small>, std::greater<>> queue_;
};

// A scrap of no volume that hangs on nothing belongs to the nearest cell: its triangles must belong somewhere.
void adopt_scraps(const CutCells& raw, Merger& merger, std::vector<uint32_t>& root) {
    std::vector<double> volume(raw.cells.size());
    for (uint32_t c = 0; c < raw.cells.size(); ++c) volume[merger.find(c)] += raw.cells[c].sums.volume;
    for (uint32_t c = 0; c < raw.cells.size(); ++c) {
        root[c] = merger.find(c);
        if (volume[root[c]] > 0) continue;
        double nearest = 1e300;
        const Vec3d here = raw.middles[raw.cells[c].tetrahedron];
        for (uint32_t o = 0; o < raw.cells.size(); ++o) {
            if (!(volume[merger.find(o)] > 0)) continue;
            const double away = length(raw.middles[raw.cells[o].tetrahedron] - here);
            if (away < nearest) nearest = away, root[c] = merger.find(o);
        }
    }
}

/// Barycentric coordinates in a coarse tetrahedron: l = at_origin + slope . (x - origin).
struct Barycentric {
    double at_origin[4];
    Vec3d slope[4];
    Barycentric(const Vec3d (&p)[4], Vec3d origin) {
        const double six = dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]);
        constexpr uint32_t kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
        for (uint32_t i = 0; i < 4; ++i) {
            const auto& f = kFaces[i];
            // Faces are counter-clockwise from outside: inward is against their normal.
            slope[i] = (-1 / six) * cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]]);
            at_origin[i] = dot(slope[i], origin - p[f[0]]);
        }
    }
};

void add_moments(const Barycentric& l, const VolumeSums& sums, Moments& moments) {
    uint32_t n = 0;
    for (uint32_t i = 0; i < 4; ++i)
        for (uint32_t j = i; j < 4; ++j)
            moments[n++] += l.at_origin[i] * l.at_origin[j] * sums.volume +
                            dot(l.at_origin[i] * l.slope[j] + l.at_origin[j] * l.slope[i], sums.first) +
                            dot(l.slope[i], sums.second * l.slope[j]);
}

}  // namespace

void merge_cells(const CutRequest& request, const Cut& cut, const CutCells& raw, const MergeSettings& settings,
                 Solid& solid, std::vector<uint32_t>& merged) {
    const std::vector<RawBond> bonds = find_bonds(request, cut, raw);
    Merger merger(raw, bonds, settings.least_share * reference_volume(request, raw));
    std::vector<uint32_t> root(raw.cells.size());
    adopt_scraps(raw, merger, root);

    merged.assign(raw.cells.size(), kNone);
    solid.cells.clear();
    for (uint32_t c = 0; c < raw.cells.size(); ++c)
        if (root[c] == c) merged[c] = static_cast<uint32_t>(solid.cells.size()), solid.cells.push_back({});
    for (uint32_t c = 0; c < raw.cells.size(); ++c) merged[c] = merged[root[c]];

    std::vector<double> most(solid.cells.size(), -1e300);
    struct Part {
        uint32_t cell, coarse, raw;
    };
    std::vector<Part> parts;
    for (uint32_t c = 0; c < raw.cells.size(); ++c) {
        const CutCell& part = raw.cells[c];
        SolidCell& cell = solid.cells[merged[c]];
        cell.volume += part.sums.volume;
        cell.centroid += part.sums.first + part.sums.volume * raw.middles[part.tetrahedron];
        if (part.sums.volume > most[merged[c]]) most[merged[c]] = part.sums.volume, cell.tetrahedron = part.tetrahedron;
        parts.push_back({merged[c], request.lattice.coarse_of[part.tetrahedron], c});
    }
    for (SolidCell& cell : solid.cells) cell.centroid = (1 / cell.volume) * cell.centroid;

    std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
        if (a.cell != b.cell) return a.cell < b.cell;
        return a.coarse != b.coarse ? a.coarse < b.coarse : a.raw < b.raw;
    });
    solid.moments.clear();
    for (const Part& part : parts) {
        if (solid.moments.empty() || solid.moments.back().cell != part.cell ||
            solid.moments.back().coarse != part.coarse)
            solid.moments.push_back({part.cell, part.coarse, {}});
        const TenNodes& nodes = request.lattice.coarse[part.coarse];
        const auto& points = request.lattice.points;
        add_moments(Barycentric({points[nodes[0]], points[nodes[1]], points[nodes[2]], points[nodes[3]]},
                                raw.middles[raw.cells[part.raw].tetrahedron]),
                    raw.cells[part.raw].sums, solid.moments.back().moments);
    }

    solid.bonds.clear();
    for (const RawBond& bond : bonds) {
        const uint32_t a = merged[bond.a], b = merged[bond.b];
        if (a == b || !(bond.area > 0)) continue;
        const LatticeFace& face = request.faces.faces[bond.face];
        SolidBond made;
        made.a = std::min(a, b), made.b = std::max(a, b);
        made.tetrahedron = face.tetrahedron[0], made.face = face.place;
        made.area = bond.area;
        made.centroid = (1 / bond.area) * bond.first;
        made.normal = a < b ? bond.normal : -bond.normal;
        solid.bonds.push_back(made);
    }
    std::stable_sort(solid.bonds.begin(), solid.bonds.end(),
                     [](const SolidBond& p, const SolidBond& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });

    solid.patches.clear();
    for (size_t i = 0, end; i < cut.polygons.size(); i = end) {
        const uint32_t t = cut.polygons[i].triangle;
        const Triangle& c = request.mesh.triangles[t];
        const Vec3d p = request.mesh.positions[c[0]];
        const Vec3d normal = normalised(cross(request.mesh.positions[c[1]] - p, request.mesh.positions[c[2]] - p));
        const size_t begin = solid.patches.size();
        for (end = i; end < cut.polygons.size() && cut.polygons[end].triangle == t; ++end) {
            const CutPolygon& polygon = cut.polygons[end];
            const uint32_t cell = merged[raw.of_polygon[end]];
            size_t at = begin;
            while (at < solid.patches.size() && solid.patches[at].cell != cell) ++at;
            if (at == solid.patches.size()) solid.patches.push_back({t, cell, 0, {}});
            const FlatSums sums = flat_sums({cut.places.data() + polygon.first, polygon.count}, normal);
            solid.patches[at].area += dot(sums.area, normal);
            solid.patches[at].centroid += sums.first;
        }
        for (size_t at = begin; at < solid.patches.size(); ++at)
            if (solid.patches[at].area > 0)
                solid.patches[at].centroid = (1 / solid.patches[at].area) * solid.patches[at].centroid;
        const auto from = solid.patches.begin() + static_cast<ptrdiff_t>(begin);
        solid.patches.erase(
            std::remove_if(from, solid.patches.end(), [](const SurfacePatch& patch) { return !(patch.area > 0); }),
            solid.patches.end());
        std::sort(solid.patches.begin() + static_cast<ptrdiff_t>(begin), solid.patches.end(),
                  [](const SurfacePatch& x, const SurfacePatch& y) { return x.cell < y.cell; });
    }
}

}  // namespace cullet
