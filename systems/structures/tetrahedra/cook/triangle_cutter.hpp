// Cuts triangles by the tetrahedra of a lattice, one after the other (solid cooking note, 4.3).
#pragma once
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "engine/assert.hpp"
#include "engine/table.hpp"
#include "systems/structures/tetrahedra/cook/cut_work.hpp"

namespace cullet {

/// One triangle after the other. What is asked of a face, an edge or a point for a triangle is kept until the next one:
/// most are asked twice or more.
class TriangleCutter {
 public:
    TriangleCutter(const CutRequest& request, const GridPoints& points, CutTriangles& out)
        : request_(request),
          mesh_(request.mesh),
          lattice_(request.faces),
          points_(points),
          out_(out),
          of_face_(lattice_.faces.size()),
          of_edge_(lattice_.edges.size()),
          of_point_(points.lattice.size()),
          seen_(lattice_.of.size(), 0) {}

    /// The one before it is done.
    void begin(uint32_t triangle) {
        now_ = triangle + 1;
        triangle_ = triangle;
        is_undecided_ = false;
        stack_.clear();
        for (uint32_t i = 0; i < 3; ++i) corner_[i] = points_.mesh[mesh_.triangles[triangle][i]];
        if (is_flat()) {
            out_.undecided.flat_triangles.push_back(triangle);
            return;
        }
        const uint32_t start = locate_first();
        if (start == kNone) {
            if (!is_undecided_) out_.uncovered = triangle;
            return;
        }
        stack_.push_back(start);
        seen_[start] = now_;
    }
    bool is_done() const { return stack_.empty() || is_undecided_; }
    /// In one tetrahedron more.
    void go_on() {
        const uint32_t tetrahedron = stack_.back();
        stack_.pop_back();
        cut_in(tetrahedron);
    }

 private:
    static constexpr uint32_t kMostSteps = 1000;  // of a walk, before all tetrahedra are asked
    struct OfFace {
        uint32_t asked = 0;
        int8_t side[3];   // of the corners: 1 outside of the face's first tetrahedron
        int8_t cross[3];  // side k of the triangle through the face: 1 into that tetrahedron, -1 out of it
        bool is_crossed;
        CutKey start, end;  // of the polygon's piece along the face, seen from there
    };
    struct OfEdge {
        uint32_t asked = 0;
        int8_t sign[3];  // of the sides of the triangle about the edge
        int8_t piercing;
    };
    struct OfPoint {
        uint32_t asked = 0;
        int8_t side = 0;
    };

    // Without area on the grid: then nothing can be decided.
    bool is_flat() const {
        const auto minor = [&](double GridPoint::*u, double GridPoint::*v) {
            return (corner_[1].*u - corner_[0].*u) * (corner_[2].*v - corner_[0].*v) -
                   (corner_[1].*v - corner_[0].*v) * (corner_[2].*u - corner_[0].*u);
        };
        return minor(&GridPoint::x, &GridPoint::y) == 0 && minor(&GridPoint::y, &GridPoint::z) == 0 &&
               minor(&GridPoint::z, &GridPoint::x) == 0;
    }

    int8_t decided(double value, std::initializer_list<uint32_t> mesh_points,
                   std::initializer_list<uint32_t> lattice_points) {
        if (value != 0) return static_cast<int8_t>(sign_of(value));
        Undecided& undecided = out_.undecided;
        undecided.mesh_points.insert(undecided.mesh_points.end(), mesh_points);
        undecided.lattice_points.insert(undecided.lattice_points.end(), lattice_points);
        undecided.triangle = triangle_;
        is_undecided_ = true;
        return 1;
    }
    uint32_t vertex(uint32_t k) const { return mesh_.triangles[triangle_][k % 3]; }

    int8_t side_of_point(uint32_t p) {
        OfPoint& point = of_point_[p];
        if (point.asked != now_) {
            point.asked = now_;
            point.side = decided(determinant(corner_[0], corner_[1], corner_[2], points_.lattice[p]), {}, {p});
            if (is_undecided_) add_corners();
        }
        return point.side;
    }
    void add_corners() {
        for (uint32_t k = 0; k < 3; ++k) out_.undecided.mesh_points.push_back(vertex(k));
    }
    OfEdge& ask_edge(uint32_t e) {
        OfEdge& edge = of_edge_[e];
        if (edge.asked == now_) return edge;
        edge.asked = now_;
        const auto [u, w] = lattice_.edges[e];
        for (uint32_t k = 0; k < 3; ++k)
            edge.sign[k] =
                decided(determinant(corner_[k], corner_[(k + 1) % 3], points_.lattice[u], points_.lattice[w]),
                        {vertex(k), vertex(k + 1)}, {u, w});
        edge.piercing = 0;
        if (edge.sign[0] != edge.sign[1] || edge.sign[1] != edge.sign[2]) return edge;
        const int8_t from = side_of_point(u);
        if (from == side_of_point(w) || is_undecided_) return edge;
        edge.piercing = from;
        out_.piercings.push_back({e, triangle_, from});
        return edge;
    }
    OfFace& ask_face(uint32_t f) {
        OfFace& asked = of_face_[f];
        if (asked.asked == now_) return asked;
        asked.asked = now_;
        asked.is_crossed = false;
        const LatticeFace& face = lattice_.faces[f];
        for (uint32_t k = 0; k < 3; ++k) {
            asked.side[k] = side_of_face(f, vertex(k), corner_[k]);
            asked.cross[k] = 0;
        }
        if (asked.side[0] == asked.side[1] && asked.side[1] == asked.side[2]) return asked;
        bool has_start = false, has_end = false;
        const auto note = [&](bool is_start, CutKey key) {
            (is_start ? asked.start : asked.end) = key;
            (is_start ? has_start : has_end) = true;
        };
        const OfEdge* edges[3];
        for (uint32_t i = 0; i < 3; ++i) edges[i] = &ask_edge(face.edge[i]);
        if (is_undecided_) return asked;
        for (uint32_t k = 0; k < 3; ++k) {
            if (asked.side[k] == asked.side[(k + 1) % 3]) continue;
            int sum = 0;
            for (uint32_t i = 0; i < 3; ++i) sum += face.is_forward[i] ? edges[i]->sign[k] : -edges[i]->sign[k];
            if (sum != 3 && sum != -3) continue;
            asked.cross[k] = asked.side[k];
            note(asked.cross[k] < 0, CutKey(CutKeyKind::OnPair, mesh_.sides[triangle_][k], f));
        }
        for (uint32_t i = 0; i < 3; ++i) {
            const int piercing = face.is_forward[i] ? edges[i]->piercing : -edges[i]->piercing;
            if (piercing != 0) note(piercing > 0, CutKey(CutKeyKind::OnTriangle, triangle_, face.edge[i]));
        }
        CULLET_ASSERT(has_start == has_end, "triangle %u, face %u", triangle_, f);
        asked.is_crossed = has_start && has_end;
        if (asked.is_crossed) out_.segments.push_back({f, triangle_, asked.end, asked.start});
        return asked;
    }
    int8_t side_of_face(uint32_t f, uint32_t mesh_vertex, const GridPoint& p) {
        const auto& c = lattice_.faces[f].corner;
        return decided(determinant(points_.lattice[c[0]], points_.lattice[c[1]], points_.lattice[c[2]], p),
                       {mesh_vertex}, {c[0], c[1], c[2]});
    }

    // The part of the triangle in a tetrahedron that it meets; what it meets next goes on the stack.
    void cut_in(uint32_t tetrahedron) {
        struct Piece {
            CutKey from, to;
        } pieces[7];
        uint32_t count = 0;
        bool is_inside[3] = {true, true, true}, comes[3] = {}, goes[3] = {};
        CutKey coming[3], going[3];
        for (uint32_t k = 0; k < 4; ++k) {
            const uint32_t f = lattice_.of[tetrahedron][k];
            const OfFace& face = ask_face(f);
            if (is_undecided_) return;
            const int way = lattice_.faces[f].tetrahedron[0] == tetrahedron ? 1 : -1;
            for (uint32_t i = 0; i < 3; ++i) {
                if (face.side[i] * way > 0) is_inside[i] = false;
                const int cross = face.cross[i] * way;
                if (cross > 0) comes[i] = true, coming[i] = CutKey(CutKeyKind::OnPair, mesh_.sides[triangle_][i], f);
                if (cross < 0) goes[i] = true, going[i] = CutKey(CutKeyKind::OnPair, mesh_.sides[triangle_][i], f);
            }
            if (!face.is_crossed) continue;
            pieces[count++] = way > 0 ? Piece{face.start, face.end} : Piece{face.end, face.start};
            const uint32_t next = lattice_.faces[f].tetrahedron[way > 0 ? 1 : 0];
            if (next == kNone) {
                out_.uncovered = triangle_;
            } else if (seen_[next] != now_) {
                seen_[next] = now_;
                stack_.push_back(next);
            }
        }
        for (uint32_t i = 0; i < 3; ++i)
            if (is_inside[i]) out_.tetrahedron_of[vertex(i)] = last_ = tetrahedron;
        for (uint32_t i = 0; i < 3; ++i) {
            const bool has_end = is_inside[(i + 1) % 3];
            if (!is_inside[i] && !comes[i]) continue;
            CULLET_ASSERT(has_end || goes[i], "triangle %u, tetrahedron %u", triangle_, tetrahedron);
            pieces[count++] = {is_inside[i] ? CutKey(CutKeyKind::MeshVertex, vertex(i)) : coming[i],
                               has_end ? CutKey(CutKeyKind::MeshVertex, vertex(i + 1)) : going[i]};
        }
        CutPolygon polygon{triangle_, tetrahedron, static_cast<uint32_t>(out_.keys.size()), count};
        CutKey at = pieces[0].from;
        for (uint32_t n = 0; n < count; ++n) {
            uint32_t next = n;
            while (next < count && !(pieces[next].from == at)) ++next;
            CULLET_ASSERT(next < count, "triangle %u in tetrahedron %u: its polygon is open", triangle_, tetrahedron);
            std::swap(pieces[n], pieces[next]);
            out_.keys.push_back(at);
            at = pieces[n].to;
        }
        out_.polygons.push_back(polygon);
    }

    // Where any of its corners is; triangles before it have told where most are.
    uint32_t locate_first() {
        const auto& t = mesh_.triangles[triangle_];
        for (const uint32_t v : t)
            if (out_.tetrahedron_of[v] != kNone) return out_.tetrahedron_of[v];
        const bool has_guess = !request_.tetrahedron_of.empty() && request_.tetrahedron_of[t[0]] != kNone;
        const uint32_t found = locate(t[0], has_guess ? request_.tetrahedron_of[t[0]] : last_);
        if (found != kNone) last_ = found;
        return found;
    }
    // A face that the point is outside of, or none.
    uint32_t face_towards(uint32_t tetrahedron, uint32_t v, uint32_t first, uint32_t from) {
        bool is_within = true;
        for (uint32_t n = 0; n < 4; ++n) {
            const uint32_t f = lattice_.of[tetrahedron][(first + n) % 4];
            const LatticeFace& face = lattice_.faces[f];
            const bool is_first = face.tetrahedron[0] == tetrahedron;
            const uint32_t beside = face.tetrahedron[is_first ? 1 : 0];
            if (beside == from && beside != kNone) continue;  // it came from there
            if (side_of_face(f, v, points_.mesh[v]) * (is_first ? 1 : -1) < 0) continue;
            is_within = false;
            if (beside != kNone) return beside;
        }
        return is_within ? tetrahedron : kNone;
    }
    uint32_t locate(uint32_t v, uint32_t from) {
        uint32_t at = from, before = kNone;
        for (uint32_t step = 0; step < kMostSteps; ++step) {
            const uint32_t next = face_towards(at, v, step, before);
            if (is_undecided_) return kNone;
            if (next == at) return at;
            if (next == kNone) break;
            before = at, at = next;
        }
        // It came out at a bay of the lattice.
        if (by_place_.empty()) sort_by_place();
        const double x = points_.mesh[v].x;
        auto near = std::lower_bound(by_place_.begin(), by_place_.end(), x - widest_,
                                     [](const Placed& p, double bound) { return p.x < bound; });
        for (; near != by_place_.end() && near->x <= x + widest_; ++near) {
            if (face_towards(near->tetrahedron, v, 0, kNone) == near->tetrahedron) return near->tetrahedron;
            if (is_undecided_) return kNone;
        }
        return kNone;
    }
    void sort_by_place() {
        for (uint32_t t = 0; t < lattice_.of.size(); ++t) {
            const auto& c = request_.lattice.fine[t];
            double low = points_.lattice[c[0]].x, high = low;
            for (const uint32_t p : c)
                low = std::min(low, points_.lattice[p].x), high = std::max(high, points_.lattice[p].x);
            by_place_.push_back({0.5 * (low + high), t});
            widest_ = std::max(widest_, 0.5 * (high - low));
        }
        std::sort(by_place_.begin(), by_place_.end(), [](const Placed& a, const Placed& b) {
            return a.x != b.x ? a.x < b.x : a.tetrahedron < b.tetrahedron;
        });
    }

    struct Placed {
        double x;
        uint32_t tetrahedron;
    };
    const CutRequest& request_;
    const ClosedMesh& mesh_;
    const LatticeFaces& lattice_;
    const GridPoints& points_;
    CutTriangles& out_;
    uint32_t now_ = 0, triangle_ = 0, last_ = 0;
    bool is_undecided_ = false;
    GridPoint corner_[3];
    List<OfFace> of_face_;
    List<OfEdge> of_edge_;
    List<OfPoint> of_point_;
    List<uint32_t> seen_, stack_;
    List<Placed> by_place_;  // tetrahedra by the middle of what they span along x
    double widest_ = 0;      // half of the most that one spans
};

}  // namespace cullet
