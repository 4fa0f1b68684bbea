// The invariants of an extruded shell, checked with predicates of their own: an edge of one triangle meets the other
// triangle, by signs of determinants in double with an error bound and in quadruple precision below it. Shares no code
// with the generator's separating axes; only the box tree proposes pairs above 2,000 triangles.
#pragma once
#include <algorithm>
#include <ostream>

#include "systems/hulls/box_tree.hpp"
#include "systems/structures/shell/cook/extrude.hpp"
#include "systems/structures/shell/cook/tetrahedra.hpp"

namespace cullet::test {

using Quad = __float128;

/// Sign of det[b - a, c - a, d - a].
inline int side_of(Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
    const auto evaluate = [&]<class T>(T, double unit) {
        const T bx = T(b.x) - T(a.x), by = T(b.y) - T(a.y), bz = T(b.z) - T(a.z);
        const T cx = T(c.x) - T(a.x), cy = T(c.y) - T(a.y), cz = T(c.z) - T(a.z);
        const T dx = T(d.x) - T(a.x), dy = T(d.y) - T(a.y), dz = T(d.z) - T(a.z);
        const auto size = [](T v) { return v < 0 ? -v : v; };
        const T value = dx * (by * cz - bz * cy) + dy * (bz * cx - bx * cz) + dz * (bx * cy - by * cx);
        const T sum = size(dx) * (size(by * cz) + size(bz * cy)) + size(dy) * (size(bz * cx) + size(bx * cz)) +
                      size(dz) * (size(bx * cy) + size(by * cx));
        const T error = T(16 * unit) * sum;
        return value > error ? 1 : value < -error ? -1 : 0;
    };
    const int quick = evaluate(double{}, 1.2e-16);
    return quick != 0 ? quick : evaluate(Quad{}, 1e-33);
}

/// Sign of the turn a -> b -> c seen against axis `drop` (0 to 2). Exact: the products fit into quadruple precision.
inline int turn_of(Vec3d a, Vec3d b, Vec3d c, int drop) {
    const int x = (drop + 1) % 3, y = (drop + 2) % 3;
    const Quad bx = Quad(b[x]) - Quad(a[x]), by = Quad(b[y]) - Quad(a[y]), cx = Quad(c[x]) - Quad(a[x]),
               cy = Quad(c[y]) - Quad(a[y]);
    const Quad value = bx * cy - by * cx;
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// Whether segment p q meets triangle t, borders included.
inline bool segment_meets(Vec3d p, Vec3d q, const std::array<Vec3d, 3>& t) {
    const int sp = side_of(t[0], t[1], t[2], p), sq = side_of(t[0], t[1], t[2], q);
    if (sp * sq > 0) return false;
    if (sp != 0 || sq != 0) {
        const int a = side_of(p, q, t[0], t[1]), b = side_of(p, q, t[1], t[2]), c = side_of(p, q, t[2], t[0]);
        return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
    }
    // In one plane: an end inside, or an edge crossed.
    const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
    const int drop = std::fabs(n.x) >= std::fabs(n.y) ? (std::fabs(n.x) >= std::fabs(n.z) ? 0 : 2)
                                                      : (std::fabs(n.y) >= std::fabs(n.z) ? 1 : 2);
    const auto is_inside = [&](Vec3d r) {
        const int a = turn_of(t[0], t[1], r, drop), b = turn_of(t[1], t[2], r, drop), c = turn_of(t[2], t[0], r, drop);
        return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
    };
    if (is_inside(p) || is_inside(q)) return true;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3d a = t[k], b = t[(k + 1) % 3];
        const int pa = turn_of(p, q, a, drop), pb = turn_of(p, q, b, drop), ap = turn_of(a, b, p, drop),
                  aq = turn_of(a, b, q, drop);
        // On one line they meet only if an end of the edge lies on the segment (the other case is an end inside the
        // triangle).
        if (pa == 0 && pb == 0) {
            if (dot(a - p, a - q) <= 0 || dot(b - p, b - q) <= 0) return true;
        } else if (pa * pb <= 0 && ap * aq <= 0) {
            return true;
        }
    }
    return false;
}

/// Whether two triangles meet elsewhere than at corners of the same position.
inline bool triangles_meet(const std::array<Vec3d, 3>& a, const std::array<Vec3d, 3>& b) {
    std::array<bool, 3> a_shared{}, b_shared{};
    int shared = 0;
    for (size_t k = 0; k < 3; ++k)
        for (size_t l = 0; l < 3; ++l)
            if (a[k] == b[l]) a_shared[k] = b_shared[l] = true, ++shared;
    if (shared >= 3) return false;
    if (shared == 2) {
        // They meet in more than the edge only when they lie in one plane, on the same side of it.
        size_t p = 0, q = 0;
        while (a_shared[p]) ++p;
        while (b_shared[q]) ++q;
        if (side_of(a[0], a[1], a[2], b[q]) != 0) return false;
        const Vec3d from = a[(p + 1) % 3], along = a[(p + 2) % 3] - from;
        return dot(cross(along, a[p] - from), cross(along, b[q] - from)) > 0;
    }
    for (size_t k = 0; k < 3; ++k) {
        const size_t next = (k + 1) % 3;
        if (!a_shared[k] && !a_shared[next] && segment_meets(a[k], a[next], b)) return true;
        if (!b_shared[k] && !b_shared[next] && segment_meets(b[k], b[next], a)) return true;
    }
    return false;
}

struct ShellReport {
    size_t meeting = 0;     // pairs of faces of S', S and rims that meet, S with S left out
    size_t inverted = 0;    // tetrahedra not above 0 although their corner has depth
    size_t unflagged = 0;   // elements with a flat tetrahedron that are not flagged
    size_t beyond_cap = 0;  // vertices with depth outside [0, cap], or cap above twice the thickness
    size_t turned = 0;      // closed components whose inner volume has another sign
    size_t considered = 0;  // pairs looked at
    bool is_sound() const { return meeting + inverted + unflagged + beyond_cap + turned == 0; }
};
inline std::ostream& operator<<(std::ostream& out, const ShellReport& r) {
    return out << r.meeting << " meeting pairs, " << r.inverted << " inverted tetrahedra, " << r.unflagged
               << " unflagged elements, " << r.beyond_cap << " depths beyond their cap, " << r.turned
               << " components turned, of " << r.considered << " pairs";
}

struct CheckedFace {
    std::array<Vec3d, 3> point;
    std::array<uint32_t, 3> vertex;
    uint32_t triangle;
    bool is_outer;
};

inline std::vector<CheckedFace> faces_of(const Surface& s, const Extrusion& e) {
    std::vector<CheckedFace> faces;
    const auto inner = [&](uint32_t v) { return s.positions[v] + e.depth[v] * e.direction[v]; };
    for (uint32_t t = 0; t < s.triangles.size(); ++t) {
        const Triangle& c = s.triangles[t];
        faces.push_back({{s.positions[c[0]], s.positions[c[1]], s.positions[c[2]]}, c, t, true});
        faces.push_back({{inner(c[0]), inner(c[1]), inner(c[2])}, c, t, false});
    }
    for (const BorderEdge& border : s.border_edges) {
        const Triangle& c = s.triangles[border.triangle];
        const uint32_t a = c[border.edge], b = c[(border.edge + 1) % 3];
        // The diagonal runs from the outer corner of the smaller id to the inner corner of the other.
        const uint32_t low = std::min(a, b), high = std::max(a, b);
        if (e.depth[high] > 0)
            faces.push_back(
                {{s.positions[low], s.positions[high], inner(high)}, {low, high, high}, border.triangle, false});
        if (e.depth[low] > 0)
            faces.push_back({{s.positions[low], inner(high), inner(low)}, {low, high, low}, border.triangle, false});
    }
    return faces;
}

/// Pairs that are not tested by rule: of one element, of bodies that meet, of triangles that cross in S, of fans that
/// share only a position.
inline bool is_excused(const Surface& s, const CheckedFace& a, const CheckedFace& b) {
    if ((a.is_outer && b.is_outer) || a.triangle == b.triangle) return true;
    if (s.are_independent(s.component_of[a.triangle], s.component_of[b.triangle])) return true;
    const std::array<uint32_t, 2> pair{std::min(a.triangle, b.triangle), std::max(a.triangle, b.triangle)};
    if (std::binary_search(s.crossings.begin(), s.crossings.end(), pair)) return true;
    for (const uint32_t v : s.triangles[a.triangle])
        for (const uint32_t w : s.triangles[b.triangle])
            if (v != w && s.position_ids[v] == s.position_ids[w]) return true;
    return false;
}

inline void check_meetings(const Surface& s, const Extrusion& e, ShellReport& report) {
    const std::vector<CheckedFace> faces = faces_of(s, e);
    const auto consider = [&](uint32_t i, uint32_t j) {
        if (is_excused(s, faces[i], faces[j])) return;
        ++report.considered;
        report.meeting += triangles_meet(faces[i].point, faces[j].point);
    };
    const LocalFrame frame(s.low, s.diagonal);
    std::vector<TreeBox> boxes(faces.size());
    for (size_t f = 0; f < faces.size(); ++f)
        for (const Vec3d p : faces[f].point) boxes[f].grow(frame(p));
    if (s.triangles.size() <= 2000) {
        for (uint32_t i = 0; i < faces.size(); ++i)
            for (uint32_t j = i + 1; j < faces.size(); ++j)
                if (boxes[i].overlaps(boxes[j])) consider(i, j);
    } else {
        BoxTree(boxes).for_each_overlap([&](uint32_t a, uint32_t b) {
            consider(a, b);
            return true;
        });
    }
}

inline ShellReport check_shell(const Surface& s, const Extrusion& e, double thickness) {
    ShellReport report;
    check_meetings(s, e, report);
    for (uint32_t v = 0; v < s.positions.size(); ++v)
        report.beyond_cap +=
            !(e.depth[v] >= 0 && e.depth[v] <= e.cap[v] * (1 + 1e-12) && e.cap[v] <= 2 * thickness * (1 + 1e-12));
    std::vector<double> outer(s.components.size()), inner(s.components.size());
    const Vec3d middle = 0.5 * (s.low + s.high);
    for (uint32_t t = 0; t < s.triangles.size(); ++t) {
        std::array<Vec3d, 3> out, in;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t v = s.triangles[t][k];
            out[k] = s.positions[v] - middle;
            in[k] = s.positions[v] + e.depth[v] * e.direction[v] - middle;
        }
        outer[s.component_of[t]] += dot(out[0], cross(out[1], out[2]));
        inner[s.component_of[t]] += dot(in[0], cross(in[1], in[2]));
        const PrismTetrahedra tets = prism_tetrahedra(out, in, s.triangles[t]);
        bool is_flat = false;
        for (size_t k = 0; k < 3; ++k) {
            const bool has_depth = e.depth[s.triangles[t][tets.flattens[k]]] > 0;
            report.inverted += has_depth && !(tets.volume[k] > 0);
            is_flat = is_flat || !has_depth;
        }
        report.unflagged += is_flat != (e.is_degenerate_element[t] != 0);
    }
    for (size_t c = 0; c < outer.size(); ++c)
        report.turned += s.components[c].is_closed && !(outer[c] * inner[c] > 0 || outer[c] == inner[c]);
    return report;
}

}  // namespace cullet::test
