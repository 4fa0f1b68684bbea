#include "systems/structures/tetrahedra/cook/cut_pieces.hpp"

#include <algorithm>

#include "engine/polygon.hpp"
#include "engine/table.hpp"
#include "systems/structures/tetrahedra/cook/cut_cells.hpp"

namespace cullet {
namespace {

/// A corner of something that is to be cut into triangles.
struct Corner {
    CutKey key;
    Vec3d place;
};
using Way = List<Corner>;
struct Edge {
    Corner from, to;
};
struct KeyTriangle {
    std::array<Corner, 3> corners;
    uint32_t source;
};

Vec3d area_of(const Way& way) {
    Vec3d sum;
    for (size_t k = 1; k + 1 < way.size(); ++k)
        sum += cross(way[k].place - way[0].place, way[k + 1].place - way[0].place);
    return sum;
}

// The two ends that are nearest to each other: the hole is entered and left there.
void bridge(Way& outer, const Way& hole) {
    size_t a = 0, b = 0;
    double least = 1e300;
    for (size_t i = 0; i < outer.size(); ++i)
        for (size_t j = 0; j < hole.size(); ++j) {
            const Vec3d way = outer[i].place - hole[j].place;
            if (dot(way, way) < least) least = dot(way, way), a = i, b = j;
        }
    Way joined(outer.begin(), outer.begin() + static_cast<std::ptrdiff_t>(a) + 1);
    for (size_t j = 0; j <= hole.size(); ++j) joined.push_back(hole[(b + j) % hole.size()]);
    joined.insert(joined.end(), outer.begin() + static_cast<std::ptrdiff_t>(a), outer.end());
    outer = std::move(joined);
}

double distance(const Way& a, const Way& b) {
    double least = 1e300;
    for (const Corner& p : a)
        for (const Corner& q : b) least = std::min(least, dot(p.place - q.place, p.place - q.place));
    return least;
}

/// Ways round one flat part, seen along a normal. Whatever their shape, every edge of theirs is one of a triangle.
void cut_ways(List<Way>& ways, Vec3d normal, uint32_t source, List<KeyTriangle>& triangles) {
    List<Way> outer, holes;
    for (Way& way : ways) (dot(area_of(way), normal) >= 0 ? outer : holes).push_back(std::move(way));
    if (outer.empty()) outer = std::move(holes), holes.clear();
    for (const Way& hole : holes) {
        size_t nearest = 0;
        for (size_t o = 1; o < outer.size(); ++o)
            if (distance(outer[o], hole) < distance(outer[nearest], hole)) nearest = o;
        bridge(outer[nearest], hole);
    }
    List<Vec3d> places;
    for (const Way& way : outer) {
        if (way.size() < 3) continue;  // there and back
        places.clear();
        for (const Corner& corner : way) places.push_back(corner.place);
        for (const auto& c : cut_polygon(places)) {
            const Corner &p = way[c[0]], &q = way[c[1]], &r = way[c[2]];
            if (p.key == q.key || q.key == r.key || r.key == p.key) continue;
            triangles.push_back({{p, q, r}, source});
        }
    }
}

bool before(const Edge& a, const Edge& b) {
    return a.from.key == b.from.key ? a.to.key < b.to.key : a.from.key < b.from.key;
}

/// Edges that run back inside the same piece go; what is left closes to ways round.
List<Way> chain(List<Edge>& edges) {
    std::sort(edges.begin(), edges.end(), before);
    List<uint8_t> is_gone(edges.size());
    const auto find = [&](CutKey from) {
        return static_cast<size_t>(std::lower_bound(edges.begin(), edges.end(), from,
                                                    [](const Edge& e, CutKey key) { return e.from.key < key; }) -
                                   edges.begin());
    };
    for (size_t i = 0; i < edges.size(); ++i) {
        for (size_t j = is_gone[i] ? edges.size() : find(edges[i].to.key);
             j < edges.size() && edges[j].from.key == edges[i].to.key; ++j) {
            if (is_gone[j] || j == i || !(edges[j].to.key == edges[i].from.key)) continue;
            is_gone[i] = is_gone[j] = 1;
            break;
        }
    }
    List<Way> ways;
    for (size_t start = 0; start < edges.size(); ++start) {
        if (is_gone[start]) continue;
        Way way;
        for (size_t at = start;;) {
            is_gone[at] = 1;
            way.push_back(edges[at].from);
            if (edges[at].to.key == edges[start].from.key) break;
            size_t next = find(edges[at].to.key);
            while (next < edges.size() && edges[next].from.key == edges[at].to.key && is_gone[next]) ++next;
            CULLET_ASSERT(next < edges.size() && edges[next].from.key == edges[at].to.key,
                          "a piece's part of a triangle is open");
            at = next;
        }
        ways.push_back(std::move(way));
    }
    return ways;
}

class PieceCutter {
 public:
    PieceCutter(const CookedSolid& solid, const Cut& cut, List<uint32_t> of_polygon,
                List<std::array<uint32_t, 2>> of_loop, uint32_t count)
        : solid_(solid), cut_(cut), of_polygon_(std::move(of_polygon)), of_loop_(std::move(of_loop)), made_(count) {}

    List<PieceSkin> run() {
        for (size_t first = 0; first < cut_.polygons.size();) {
            size_t end = first;
            while (end < cut_.polygons.size() && cut_.polygons[end].triangle == cut_.polygons[first].triangle) ++end;
            cut_triangle(first, end);
            first = end;
        }
        for (size_t first = 0; first < cut_.loops.size();) {
            size_t end = first;
            while (end < cut_.loops.size() && cut_.loops[end].face == cut_.loops[first].face) ++end;
            cut_face(first, end);
            first = end;
        }
        List<PieceSkin> skins;
        for (const auto& triangles : made_) skins.push_back(number(triangles));
        return skins;
    }

 private:
    Corner corner(uint32_t i) const { return {cut_.keys[i], cut_.places[i]}; }

    void cut_triangle(size_t first, size_t end) {
        const uint32_t triangle = cut_.polygons[first].triangle;
        labels_.clear();
        for (size_t i = first; i < end; ++i) labels_.push_back(of_polygon_[i]);
        std::sort(labels_.begin(), labels_.end());
        labels_.erase(std::unique(labels_.begin(), labels_.end()), labels_.end());
        const Triangle& c = solid_.mesh.triangles[triangle];
        const auto& at = solid_.mesh.positions;
        if (labels_.size() == 1) {
            if (labels_[0] == kNone) return;
            KeyTriangle whole{{}, triangle};
            for (size_t k = 0; k < 3; ++k) whole.corners[k] = {CutKey(CutKeyKind::MeshVertex, c[k]), at[c[k]]};
            made_[labels_[0]].push_back(whole);
            return;
        }
        const Vec3d normal = cross(at[c[1]] - at[c[0]], at[c[2]] - at[c[0]]);
        for (const uint32_t label : labels_) {
            if (label == kNone) continue;
            edges_.clear();
            for (size_t i = first; i < end; ++i) {
                if (of_polygon_[i] != label) continue;
                const CutPolygon& p = cut_.polygons[i];
                for (uint32_t k = 0; k < p.count; ++k)
                    edges_.push_back({corner(p.first + k), corner(p.first + (k + 1) % p.count)});
            }
            List<Way> ways = chain(edges_);
            for (Way& way : ways) drop_points(way, first, end);
            cut_ways(ways, normal, triangle, made_[label]);
        }
    }

    // A point on a side of the triangle where only one piece comes to that side: the triangle beyond drops it, too.
    void drop_points(Way& way, size_t first, size_t end) const {
        std::erase_if(way, [&](const Corner& c) {
            if (c.key.kind() != CutKeyKind::OnPair) return false;
            uint32_t label = kNone;
            bool is_one = true, is_any = false;
            for (size_t i = first; i < end; ++i) {
                const CutPolygon& p = cut_.polygons[i];
                for (uint32_t k = 0; k < p.count; ++k) {
                    if (!(cut_.keys[p.first + k] == c.key)) continue;
                    is_one = is_one && (!is_any || of_polygon_[i] == label);
                    label = of_polygon_[i], is_any = true;
                }
            }
            return is_any && is_one;
        });
    }

    void cut_face(size_t first, size_t end) {
        sides_.clear();
        for (size_t i = first; i < end; ++i)
            if (of_loop_[i][0] != of_loop_[i][1]) sides_.push_back(of_loop_[i]);
        std::sort(sides_.begin(), sides_.end());
        sides_.erase(std::unique(sides_.begin(), sides_.end()), sides_.end());
        for (const auto& [a, b] : sides_) {
            List<Way> ways;
            Vec3d normal;
            double most = 0;
            for (size_t i = first; i < end; ++i) {
                if (of_loop_[i] != std::array<uint32_t, 2>{a, b}) continue;
                const CutLoop& loop = cut_.loops[i];
                Way way;
                for (uint32_t k = 0; k < loop.count; ++k) way.push_back(corner(loop.first + k));
                if (const Vec3d area = area_of(way); dot(area, area) > most) most = dot(area, area), normal = area;
                ways.push_back(std::move(way));
            }
            crack_.clear();
            cut_ways(ways, normal, kNone, crack_);  // the largest is no hole
            for (KeyTriangle t : crack_) {
                if (a != kNone) made_[a].push_back(t);
                std::swap(t.corners[1], t.corners[2]);
                if (b != kNone) made_[b].push_back(t);
            }
        }
    }

    static PieceSkin number(const List<KeyTriangle>& triangles) {
        List<Corner> all;
        for (const KeyTriangle& t : triangles) all.insert(all.end(), t.corners.begin(), t.corners.end());
        std::sort(all.begin(), all.end(), [](const Corner& a, const Corner& b) { return a.key < b.key; });
        all.erase(std::unique(all.begin(), all.end(), [](const Corner& a, const Corner& b) { return a.key == b.key; }),
                  all.end());
        PieceSkin skin;
        for (const Corner& c : all) skin.places.push_back(c.place);
        for (const KeyTriangle& t : triangles) {
            PieceTriangle made;
            made.source = t.source;
            for (size_t k = 0; k < 3; ++k)
                made.corners[k] =
                    static_cast<uint32_t>(std::lower_bound(all.begin(), all.end(), t.corners[k].key,
                                                           [](const Corner& c, CutKey key) { return c.key < key; }) -
                                          all.begin());
            skin.triangles.push_back(made);
        }
        return skin;
    }

    const CookedSolid& solid_;
    const Cut& cut_;
    List<uint32_t> of_polygon_;              // piece
    List<std::array<uint32_t, 2>> of_loop_;  // pieces
    List<List<KeyTriangle>> made_;
    List<uint32_t> labels_;
    List<std::array<uint32_t, 2>> sides_;
    List<Edge> edges_;
    List<KeyTriangle> crack_;
};

/// Of each part of a tetrahedron: that of the nearest part that it had when cooked; of one that was empty then, that of
/// the largest neighbour; of one that had none, that of the nearest part there is. The choice knows no pieces, so that
/// what breaks again is labelled as it was.
List<uint32_t> label_parts(const CookedSolid& solid, const CutCells& parts, std::span<const uint32_t> piece_of) {
    const CoverLattice& lattice = solid.solid.lattice;
    List<uint32_t> first(lattice.fine.size() + 1), labels(parts.cells.size(), kNone);
    for (const RawCell& raw : solid.raw) ++first[raw.tetrahedron + 1];
    for (size_t t = 0; t < lattice.fine.size(); ++t) first[t + 1] += first[t];
    const auto nearest = [&](uint32_t tetrahedron, Vec3d place) {
        uint32_t best = kNone;
        double least = 1e300;
        for (uint32_t r = first[tetrahedron]; r < first[tetrahedron + 1]; ++r) {
            const Vec3d away = solid.raw[r].centroid - place;
            if (dot(away, away) < least) least = dot(away, away), best = piece_of[solid.raw[r].cell];
        }
        return best;
    };
    for (size_t c = 0; c < labels.size(); ++c) {
        const CutCell& part = parts.cells[c];
        const double volume = part.sums.volume > 0 ? part.sums.volume : 1;
        const Vec3d place = parts.middles[part.tetrahedron] + (1 / volume) * part.sums.first;
        labels[c] = nearest(part.tetrahedron, place);
        double most = -1;
        if (first[part.tetrahedron] != first[part.tetrahedron + 1]) continue;
        for (const uint32_t other : lattice.neighbours[part.tetrahedron]) {
            if (other == kNone || first[other] == first[other + 1]) continue;
            const double size = solid.solid.cells[solid.raw[first[other]].cell].volume;
            if (size > most) most = size, labels[c] = nearest(other, place);
        }
        if (most >= 0) continue;
        double least = 1e300;
        for (const RawCell& raw : solid.raw) {
            const Vec3d away = raw.centroid - place;
            if (dot(away, away) < least) least = dot(away, away), labels[c] = piece_of[raw.cell];
        }
    }
    return labels;
}

}  // namespace

Result<List<PieceSkin>> cut_pieces(const CookedSolid& solid, std::span<const Vec3d> points,
                                   std::span<const uint32_t> piece_of, uint32_t count) {
    CutRequest request{solid.mesh, solid.solid.lattice, solid.faces};
    request.points = points;
    request.tetrahedron_of = solid.tetrahedron_of;
    const Result<Cut> cut = cut_mesh(request);
    if (!cut) return Error{cut.error()};
    const CutCells parts = find_cells(request, *cut);
    const List<uint32_t> labels = label_parts(solid, parts, piece_of);
    const auto label = [&](uint32_t part) { return part == kNone ? kNone : labels[part]; };
    List<uint32_t> of_polygon;
    for (const uint32_t part : parts.of_polygon) of_polygon.push_back(label(part));
    List<std::array<uint32_t, 2>> of_loop;
    for (const auto& [a, b] : parts.of_loop) of_loop.push_back({label(a), label(b)});
    return PieceCutter(solid, *cut, std::move(of_polygon), std::move(of_loop), count).run();
}

}  // namespace cullet
