#include "systems/structures/tetrahedra/cook/cut_pieces.hpp"

#include <algorithm>

#include "engine/polygon.hpp"
#include "engine/table.hpp"
#include "systems/structures/tetrahedra/cook/crack_region.hpp"
#include "systems/structures/tetrahedra/cook/cut_cells.hpp"
#include "systems/structures/tetrahedra/cook/mesh_cutter.hpp"

namespace cullet {
namespace {

// What steps take, ns. A tetrahedron and a triangle looked at for the region, a point laid on the grid, a polygon cut
// and joined with all others, a loop. A triangle divided, a polygon of it, a triangle that keeps whole, one numbered.
constexpr double kNsRegion = 120, kNsGrid = 40, kNsPolygon = 700, kNsJoin = 300, kNsLoop = 300, kNsDividing = 700,
                 kNsWhole = 40, kNsNumber = 350;
constexpr double kMostNs = 5e5;  // of a step
constexpr size_t kPolygonsAStep = 700;

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
    PieceCutter(const CookedSolid& solid, const Cut& cut, const List<uint32_t>& of_triangle, List<uint32_t> of_polygon,
                List<std::array<uint32_t, 2>> of_loop, uint32_t count)
        : solid_(solid),
          cut_(cut),
          of_triangle_(of_triangle),
          of_polygon_(std::move(of_polygon)),
          of_loop_(std::move(of_loop)),
          made_(count) {}

    /// Some triangles more, those that are cut and those that are whole. True: all are done.
    bool divide(double most_ns) {
        const auto count = static_cast<uint32_t>(of_triangle_.size());
        for (ns = 0; next_ < count && ns < most_ns; ++next_) {
            size_t last = polygon_;
            while (last < cut_.polygons.size() && cut_.polygons[last].triangle == next_) ++last;
            ns += last > polygon_ ? kNsDividing * static_cast<double>(last - polygon_) : kNsWhole;
            if (last > polygon_)
                cut_triangle(polygon_, last);
            else if (of_triangle_[next_] != kNone && of_triangle_[next_] != kManyPieces)
                add_whole(next_, of_triangle_[next_]);
            polygon_ = last;
        }
        return next_ == count;
    }
    void divide_faces() {
        ns = kNsLoop * static_cast<double>(cut_.loops.size()) + kNsWhole * static_cast<double>(of_triangle_.size());
        for (size_t first = 0; first < cut_.loops.size();) {
            size_t end = first;
            while (end < cut_.loops.size() && cut_.loops[end].face == cut_.loops[first].face) ++end;
            cut_face(first, end);
            first = end;
        }
        has_number_.assign(solid_.mesh.positions.size(), kNone);
        number_of_.resize(solid_.mesh.positions.size());
    }
    /// After all others.
    PieceSkin skin_of(uint32_t piece) {
        ns = kNsNumber * static_cast<double>(made_[piece].size());
        return number(made_[piece], piece);
    }

    double ns = 0;  // that the last call took, by what it looked at

 private:
    Corner corner(uint32_t i) const { return {cut_.keys[i], cut_.places[i]}; }

    void add_whole(uint32_t triangle, uint32_t label) {
        const Triangle& c = solid_.mesh.triangles[triangle];
        KeyTriangle whole{{}, triangle};
        for (size_t k = 0; k < 3; ++k)
            whole.corners[k] = {CutKey(CutKeyKind::MeshVertex, c[k]), solid_.mesh.positions[c[k]]};
        made_[label].push_back(whole);
    }

    void cut_triangle(size_t first, size_t end) {
        const uint32_t triangle = cut_.polygons[first].triangle;
        labels_.clear();
        for (size_t i = first; i < end; ++i) labels_.push_back(of_polygon_[i]);
        std::sort(labels_.begin(), labels_.end());
        labels_.erase(std::unique(labels_.begin(), labels_.end()), labels_.end());
        const Triangle& c = solid_.mesh.triangles[triangle];
        const auto& at = solid_.mesh.positions;
        if (labels_.size() == 1) {
            if (labels_[0] != kNone) add_whole(triangle, labels_[0]);
            return;
        }
        const Vec3d normal = cross(at[c[1]] - at[c[0]], at[c[2]] - at[c[0]]);
        list_sides(first, end);
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
            for (Way& way : ways) drop_points(way);
            cut_ways(ways, normal, triangle, made_[label]);
        }
    }

    // A point on a side of the triangle where only one piece comes to that side: the triangle beyond drops it, too.
    void drop_points(Way& way) const {
        std::erase_if(way, [&](const Corner& c) {
            if (c.key.kind() != CutKeyKind::OnPair) return false;
            const auto at = std::lower_bound(on_sides_.begin(), on_sides_.end(), c.key,
                                             [](const OnSide& p, CutKey key) { return p.key < key; });
            return at != on_sides_.end() && at->key == c.key && at->is_one;
        });
    }
    // Points on sides of the triangle, and whether one piece alone comes to them.
    void list_sides(size_t first, size_t end) {
        on_sides_.clear();
        for (size_t i = first; i < end; ++i) {
            const CutPolygon& p = cut_.polygons[i];
            for (uint32_t k = 0; k < p.count; ++k)
                if (const CutKey key = cut_.keys[p.first + k]; key.kind() == CutKeyKind::OnPair)
                    on_sides_.push_back({key, of_polygon_[i], true});
        }
        std::sort(on_sides_.begin(), on_sides_.end(),
                  [](const OnSide& a, const OnSide& b) { return a.key == b.key ? a.piece < b.piece : a.key < b.key; });
        size_t kept = 0;
        for (size_t i = 0; i < on_sides_.size(); ++i) {
            if (kept > 0 && on_sides_[kept - 1].key == on_sides_[i].key)
                on_sides_[kept - 1].is_one &= on_sides_[kept - 1].piece == on_sides_[i].piece;
            else
                on_sides_[kept++] = on_sides_[i];
        }
        on_sides_.resize(kept);
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

    // In the order of keys: corners of the mesh first, which are most, then the others.
    PieceSkin number(const List<KeyTriangle>& triangles, uint32_t piece) {
        List<uint32_t> vertices;
        List<Corner> others;
        for (const KeyTriangle& t : triangles)
            for (const Corner& c : t.corners) {
                if (c.key.kind() != CutKeyKind::MeshVertex) {
                    others.push_back(c);
                } else if (has_number_[c.key.a()] != piece) {
                    has_number_[c.key.a()] = piece;
                    vertices.push_back(c.key.a());
                }
            }
        std::sort(vertices.begin(), vertices.end());
        std::sort(others.begin(), others.end(), [](const Corner& a, const Corner& b) { return a.key < b.key; });
        others.erase(
            std::unique(others.begin(), others.end(), [](const Corner& a, const Corner& b) { return a.key == b.key; }),
            others.end());
        PieceSkin skin;
        skin.places.reserve(vertices.size() + others.size());
        for (const uint32_t v : vertices) {
            number_of_[v] = static_cast<uint32_t>(skin.places.size());
            skin.places.push_back(solid_.mesh.positions[v]);
        }
        for (const Corner& c : others) skin.places.push_back(c.place);
        skin.triangles.reserve(triangles.size());
        for (const KeyTriangle& t : triangles) {
            PieceTriangle made;
            made.source = t.source;
            for (size_t k = 0; k < 3; ++k) {
                const CutKey key = t.corners[k].key;
                if (key.kind() == CutKeyKind::MeshVertex) {
                    made.corners[k] = number_of_[key.a()];
                    continue;
                }
                const auto at = std::lower_bound(others.begin(), others.end(), key,
                                                 [](const Corner& c, CutKey other) { return c.key < other; });
                made.corners[k] = static_cast<uint32_t>(vertices.size() + static_cast<size_t>(at - others.begin()));
            }
            skin.triangles.push_back(made);
        }
        return skin;
    }

    struct OnSide {
        CutKey key;
        uint32_t piece;
        bool is_one;
    };
    const CookedSolid& solid_;
    const Cut& cut_;
    const List<uint32_t>& of_triangle_;      // piece, where it has no polygons
    List<uint32_t> of_polygon_;              // piece
    List<std::array<uint32_t, 2>> of_loop_;  // pieces
    List<List<KeyTriangle>> made_;
    List<uint32_t> labels_;
    List<OnSide> on_sides_;
    List<std::array<uint32_t, 2>> sides_;
    List<Edge> edges_;
    List<KeyTriangle> crack_;
    uint32_t next_ = 0;                      // triangle
    size_t polygon_ = 0;                     // the first of the next one that is cut
    List<uint32_t> has_number_, number_of_;  // by vertex of the mesh: the piece that numbered it last, and the number
};

/// Of each part of a tetrahedron of many pieces: that of the nearest part that it had when cooked.
List<uint32_t> label_parts(const CookedSolid& solid, const CutCells& parts, std::span<const uint32_t> piece_of) {
    List<uint32_t> labels(parts.cells.size(), kNone);
    for (size_t c = 0; c < labels.size(); ++c) {
        const CutCell& part = parts.cells[c];
        const double volume = part.sums.volume > 0 ? part.sums.volume : 1;
        const Vec3d place = parts.middles[part.tetrahedron] + (1 / volume) * part.sums.first;
        auto raw = std::lower_bound(solid.raw.begin(), solid.raw.end(), part.tetrahedron,
                                    [](const RawCell& r, uint32_t tetrahedron) { return r.tetrahedron < tetrahedron; });
        double least = 1e300;
        for (; raw != solid.raw.end() && raw->tetrahedron == part.tetrahedron; ++raw) {
            const Vec3d away = raw->centroid - place;
            if (dot(away, away) < least) least = dot(away, away), labels[c] = piece_of[raw->cell];
        }
    }
    return labels;
}

}  // namespace

struct PieceCut::Work {
    Work(const CookedSolid& of, std::span<const Vec3d> moved, std::span<const uint32_t> pieces, uint32_t piece_count)
        : solid(of), points(moved), piece_of(pieces), count(piece_count), request{of.mesh, of.solid.lattice, of.faces} {
        request.points = moved;
        request.tetrahedron_of = of.tetrahedron_of;
    }
    const CookedSolid& solid;
    std::span<const Vec3d> points;
    std::span<const uint32_t> piece_of;
    uint32_t count;
    CutRequest request;
    CrackRegion region;
    std::optional<MeshCutter> cutter;
    Cut cut;
    std::optional<PieceCutter> divider;

    void request_near() {
        request.triangles = region.triangles;
        request.wanted_faces = region.faces;
        request.known = &solid.windings;
        request.is_known = region.is_known;
    }
    void request_all() {
        request.triangles = {}, request.wanted_faces = {};
        request.known = nullptr;
        region.of_triangle.assign(solid.mesh.triangles.size(), kManyPieces);
    }
    void label() {
        List<uint32_t> labels;
        CutCells parts;
        if (!region.tetrahedra.empty()) {
            parts = find_cells(request, cut, region.tetrahedra);
            labels = label_parts(solid, parts, piece_of);
        }
        const auto label_in = [&](uint32_t tetrahedron, uint32_t part) {
            if (tetrahedron == kNone) return kNone;
            const uint32_t piece = region.of_tetrahedron[tetrahedron];
            return piece != kManyPieces ? piece : part == kNone ? kNone : labels[part];
        };
        List<uint32_t> of_polygon(cut.polygons.size());
        for (size_t i = 0; i < of_polygon.size(); ++i)
            of_polygon[i] = label_in(cut.polygons[i].tetrahedron, labels.empty() ? kNone : parts.of_polygon[i]);
        List<std::array<uint32_t, 2>> of_loop(cut.loops.size());
        for (size_t i = 0; i < of_loop.size(); ++i)
            for (size_t s = 0; s < 2; ++s)
                of_loop[i][s] = label_in(request.faces.faces[cut.loops[i].face].tetrahedron[s],
                                         labels.empty() ? kNone : parts.of_loop[i][s]);
        divider.emplace(solid, cut, region.of_triangle, std::move(of_polygon), std::move(of_loop), count);
    }
};

PieceCut::PieceCut(const CookedSolid& solid, std::span<const Vec3d> points, std::span<const uint32_t> piece_of,
                   uint32_t count, CutExtent extent)
    : work_(1), extent_(extent) {
    work_[0].emplace(solid, points, piece_of, count);
}
PieceCut::~PieceCut() = default;

bool PieceCut::advance() {
    Work& work = *work_[0];
    const auto many = [](size_t count) { return static_cast<double>(count); };
    switch (stage_) {
        case Stage::Region:
            work.region = find_crack_region(work.solid, work.points, work.piece_of);
            extent_ == CutExtent::NearCracks ? work.request_near() : work.request_all();
            ns_ = kNsRegion * many(work.solid.solid.lattice.fine.size() + work.solid.mesh.triangles.size());
            stage_ = Stage::Begin;
            break;
        case Stage::Begin:
            work.cutter.emplace(work.request);
            ns_ = kNsGrid * many(work.solid.solid.lattice.fine.size() + work.solid.mesh.positions.size());
            stage_ = Stage::Cut;
            break;
        case Stage::Cut: {
            const bool is_joining = work.cutter->is_joining(), is_done = work.cutter->advance(kPolygonsAStep);
            ns_ = (is_joining ? kNsJoin : kNsPolygon) * many(work.cutter->polygons_made());
            if (!is_done) break;
            Result<Cut> cut = work.cutter->take();
            if (!cut && extent_ == CutExtent::NearCracks) {
                extent_ = CutExtent::All;
                stage_ = Stage::Region;
                break;
            }
            if (!cut) {
                error_ = cut.error();
                stage_ = Stage::Done;
                break;
            }
            work.cut = std::move(cut).value();
            stage_ = Stage::Label;
            break;
        }
        case Stage::Label:
            work.label();
            ns_ = kNsWhole * many(work.cut.polygons.size() + work.cut.loops.size());
            stage_ = Stage::Divide;
            break;
        case Stage::Divide:
            if (work.divider->divide(kMostNs)) stage_ = Stage::Faces;
            ns_ = work.divider->ns;
            break;
        case Stage::Faces:
            work.divider->divide_faces();
            ns_ = work.divider->ns;
            stage_ = Stage::Done;
            break;
        case Stage::Done:
            break;
    }
    return stage_ == Stage::Done;
}

PieceSkin PieceCut::skin_of(uint32_t piece) {
    PieceSkin skin = work_[0]->divider->skin_of(piece);
    ns_ = work_[0]->divider->ns;
    return skin;
}

size_t PieceCut::cut_triangles() const {
    return work_[0]->region.triangles.size();
}

Result<List<PieceSkin>> cut_pieces(const CookedSolid& solid, std::span<const Vec3d> points,
                                   std::span<const uint32_t> piece_of, uint32_t count, CutExtent extent) {
    PieceCut cut(solid, points, piece_of, count, extent);
    while (!cut.advance()) {
    }
    if (!cut.error().empty()) return Error{cut.error()};
    List<PieceSkin> skins;
    for (uint32_t p = 0; p < count; ++p) skins.push_back(cut.skin_of(p));
    return skins;
}

}  // namespace cullet
