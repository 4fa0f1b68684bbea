#include "systems/models/metal_shell/dent/turn_normals.hpp"

#include <algorithm>

#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

constexpr float kOneNormal = 0.9986f;  // cosine of 3 degrees: corners that were drawn as one surface
constexpr float kSharp = 0.64f;        // of 50: from there on a fold is drawn as an edge
constexpr float kHalfSharp = 0.906f;   // of 25: two that are so near a third are no sharp fold

bool has_moved(const MetalView& metal, uint32_t element) {
    const MetalVertices& own = metal.vertices();
    const auto& c = metal.corners(element);
    return std::any_of(c.begin(), c.end(),
                       [&](uint32_t v) { return !(own.place[metal.vertex(v)] == own.start[metal.vertex(v)]); });
}

/// Twice the area, along the normal.
Vec3 across(const MetalView& metal, const Column<Vec3>& places, uint32_t element) {
    const auto& c = metal.corners(element);
    const Vec3 p = places[metal.vertex(c[0])];
    return cross(places[metal.vertex(c[1])] - p, places[metal.vertex(c[2])] - p);
}

// By the rotation that takes one unit vector to another.
Vec3 turned_along(Vec3 from, Vec3 to, Vec3 vector) {
    const Vec3 axis = cross(from, to);
    const float cosine = dot(from, to);
    if (cosine < -0.999f) return vector - 2 * dot(vector, from) * from;
    return vector + cross(axis, vector) + (1 / (1 + cosine)) * cross(axis, cross(axis, vector));
}

/// An element of a ring: its normal at the vertex before, and as it turned.
struct Turned {
    Vec3 before, after, across;
    float area;
    bool has_moved;
};
Turned turned_corner(const MetalView& metal, uint32_t element, uint32_t corner) {
    const auto& all = metal.shell.state.elements.normal[metal.shell.element(element)];
    const Vec3 normal{all[3 * corner], all[3 * corner + 1], all[3 * corner + 2]};
    const Vec3 then = across(metal, metal.vertices().start, element);
    if (!has_moved(metal, element)) return {normal, normal, then, length(then), false};
    const Vec3 now = across(metal, metal.vertices().place, element);
    const float was = length(then), is = length(now);
    if (!(was > 0) || !(is > 0)) return {normal, normal, now, is, true};
    return {normal, turned_along((1 / was) * then, (1 / is) * now, normal), now, is, true};
}

/// The elements of a ring, with what they mean to each other.
class TurnedRing {
 public:
    TurnedRing(const MetalView& metal, const Ring& ring) : count_(ring.count) {
        for (uint32_t i = 0; i < count_; ++i) all_[i] = turned_corner(metal, ring.element[i], ring.corner[i]);
        // Most rings are one smooth surface still.
        for (uint32_t i = 0; i < count_; ++i) {
            sum_ += all_[i].area * all_[i].after;
            across_ += all_[i].across;
            is_one_ = is_one_ && dot(all_[0].before, all_[i].before) > kOneNormal;
        }
        mean_ = normalised(sum_);
        for (uint32_t i = 0; i < count_ && is_one_; ++i) is_one_ = dot(mean_, all_[i].after) > kHalfSharp;
    }
    bool has_moved(uint32_t i) const { return all_[i].has_moved; }
    /// Of the shape as it is now; zero where areas cancel.
    Vec3 flat_normal() const { return normalised(across_); }
    Vec3 normal_at(uint32_t i) const {
        if (is_one_) return mean_;
        Vec3 sum;
        for (uint32_t j = 0; j < count_; ++j)
            if (dot(all_[i].before, all_[j].before) > kOneNormal && dot(all_[i].after, all_[j].after) > kSharp)
                sum += all_[j].area * all_[j].after;
        return dot(sum, sum) > 0 ? normalised(sum) : all_[i].after;
    }

 private:
    uint32_t count_;
    Turned all_[kMostRing];
    Vec3 sum_, mean_, across_;
    bool is_one_ = true;
};

void turn_corners(const MetalView& metal, const Ring& ring, const TurnedRing& turned) {
    for (uint32_t i = 0; i < ring.count; ++i) {
        if (!turned.has_moved(i)) continue;
        const Vec3 n = turned.normal_at(i);
        auto& all = metal.shell.state.elements.normal[metal.shell.element(ring.element[i])];
        const size_t k = 3 * size_t{ring.corner[i]};
        all[k] = n.x, all[k + 1] = n.y, all[k + 2] = n.z;
    }
}

}  // namespace

// Corners at one vertex hang on each other, and on no others.
void turn_normals(const MetalView& metal) {
    MetalVertices& own = metal.vertices();
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) own.is_queued[metal.vertex(v)] = 0;
    Cells& cells = metal.shell.state.cells;
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        if (metal.is_dead(e) || !has_moved(metal, e)) continue;
        cells.is_stale[metal.shell.cells().first + metal.shell.state.elements.cell[metal.shell.element(e)]] = 1;
        for (const uint32_t v : metal.corners(e)) own.is_queued[metal.vertex(v)] = 1;
    }
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.vertex(v);
        if (!own.is_queued[row]) continue;
        Ring ring;
        collect_ring(metal.shell, v, ring);
        const TurnedRing turned(metal, ring);
        turn_corners(metal, ring, turned);
        if (own.place[row] == own.start[row]) continue;
        const Vec3 normal = turned.flat_normal();
        if (dot(normal, normal) > 0.5f) metal.shell.state.vertices.inward.set(metal.shell.vertex(v), -normal);
    }
}

}  // namespace cullet
