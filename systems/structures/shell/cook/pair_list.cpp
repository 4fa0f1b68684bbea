#include "systems/structures/shell/cook/pair_list.hpp"

#include "systems/structures/shell/cook/certificates.hpp"
#include "systems/structures/shell/cook/tetrahedra.hpp"

namespace cullet {
namespace {

// Outer faces whose normals are closer than this (20 degrees) cannot fold their inner faces onto each other: an inner
// face leans at most acos(0.2) = 78.5 degrees, and 20 + 2 * 78.5 < 178.2.
constexpr double kTooFlatToFold = 0.94;

class Lister {
 public:
    Lister(const ExtrusionWork& work, const ShellFaces& faces) : work_(work), faces_(faces) {
        has_split_ = work.surface.repairs.split_vertices > 0;
        for (uint32_t t = 0; t < work.triangle_count(); ++t) units_.push_back(make_element(work, t));
        for (const BorderEdge& border : work.surface.border_edges) units_.push_back(make_rim(work, border));
    }

    std::vector<FacePair> list() {
        std::vector<TreeBox> boxes(units_.size());
        for (size_t u = 0; u < units_.size(); ++u)
            for (size_t k = 0; k < 2u * units_[u].vertex_count; ++k)
                boxes[u].grow(Vec3d(units_[u].x[k], units_[u].y[k], units_[u].z[k]));
        const BoxTree tree(boxes);
        tree.for_each_overlap([this](uint32_t a, uint32_t b) {
            consider(std::min(a, b), std::max(a, b));
            return true;
        });
        // The order of the tree has no ties, but a list in order of faces is kinder to the caches.
        std::sort(pairs_.begin(), pairs_.end(),
                  [](const FacePair& p, const FacePair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
        return std::move(pairs_);
    }

 private:
    bool is_element(uint32_t unit) const { return unit < work_.triangle_count(); }

    bool are_strangers(uint32_t i, uint32_t j) const {
        const Surface& s = work_.surface;
        const uint32_t t = units_[i].triangle, u = units_[j].triangle;
        if (s.are_independent(s.component_of[t], s.component_of[u])) return true;
        return !s.crossings.empty() && std::binary_search(s.crossings.begin(), s.crossings.end(),
                                                          std::array<uint32_t, 2>{std::min(t, u), std::max(t, u)});
    }

    // Sheets that share a position but not the vertex are not tested against each other there.
    bool meet_at_split_vertex(const Unit& a, const Unit& b) const {
        for (size_t k = 0; k < a.vertex_count; ++k)
            for (size_t l = 0; l < b.vertex_count; ++l)
                if (a.vertex[k] != b.vertex[l] &&
                    work_.surface.position_ids[a.vertex[k]] == work_.surface.position_ids[b.vertex[l]])
                    return true;
        return false;
    }

    void consider(uint32_t i, uint32_t j) {
        const Unit &a = units_[i], &b = units_[j];
        int shared_count = 0;
        uint32_t shared = kNone;
        for (size_t k = 0; k < a.vertex_count; ++k)
            for (size_t l = 0; l < b.vertex_count; ++l)
                if (a.vertex[k] == b.vertex[l]) ++shared_count, shared = a.vertex[k];
        // Units side by side touch from the start: without certificates all of those would count as folded.
        const bool may_drop = work_.settings.has_certificates || shared_count > 0;
        if (may_drop && shared_count == 0 && are_hulls_apart(a, b)) return;
        if (shared_count == 1 && are_split_at(work_, a, b, shared)) return;
        if (has_split_ && meet_at_split_vertex(a, b)) return;
        if (are_strangers(i, j)) return;
        if (is_element(i) && is_element(j)) {
            if (!may_drop || !stays_below(work_, i, j)) add(faces_.inner(i), faces_.outer(j));
            if (!may_drop || !stays_below(work_, j, i)) add(faces_.outer(i), faces_.inner(j));
            if (shared_count != 2 || dot(work_.normals[i], work_.normals[j]) <= kTooFlatToFold)
                add(faces_.inner(i), faces_.inner(j));
            return;
        }
        for (const uint32_t f : faces_of(i))
            for (const uint32_t g : faces_of(j)) add(f, g);
    }

    std::array<uint32_t, 2> faces_of(uint32_t unit) const {
        if (is_element(unit)) return {faces_.outer(unit), faces_.inner(unit)};
        const uint32_t border = unit - work_.triangle_count();
        return {faces_.rim(border, 0), faces_.rim(border, 1)};
    }

    void add(uint32_t f, uint32_t g) { pairs_.push_back({f, g, {}}); }

    const ExtrusionWork& work_;
    const ShellFaces& faces_;
    std::vector<Unit> units_;
    std::vector<FacePair> pairs_;
    bool has_split_ = false;
};

}  // namespace

ShellFaces::ShellFaces(const Surface& surface)
    : vertex_count(static_cast<uint32_t>(surface.positions.size())),
      triangle_count(static_cast<uint32_t>(surface.triangles.size())),
      corners(surface.triangles) {
    for (const Triangle& t : surface.triangles)
        corners.push_back({t[0] + vertex_count, t[1] + vertex_count, t[2] + vertex_count});
    for (const BorderEdge& border : surface.border_edges) {
        const Triangle& c = surface.triangles[border.triangle];
        for (const auto& half : rim_triangles(c[border.edge], c[(border.edge + 1) % 3])) {
            Triangle t;
            for (size_t k = 0; k < 3; ++k) t[k] = half[k].vertex + (half[k].is_inner ? vertex_count : 0);
            corners.push_back(t);
        }
    }
}

std::vector<FacePair> list_pairs(const ExtrusionWork& work, const ShellFaces& faces) {
    return Lister(work, faces).list();
}

}  // namespace cullet
