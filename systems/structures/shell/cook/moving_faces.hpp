// The faces of the growing shell at the depths it has now, and the pairs of them that can meet. What the ways of
// pushing the inner surface inward share.
#pragma once
#include "systems/structures/shell/cook/pair_list.hpp"

namespace cullet {

class MovingFaces {
 public:
    /// All inner points on the surface. Lists the pairs for depths up to work.caps.
    explicit MovingFaces(ExtrusionWork& work);

    uint32_t pair_count() const { return static_cast<uint32_t>(pairs_.size()); }
    std::span<const uint32_t> pairs_of(uint32_t v) const { return pairs_of_[v]; }
    Vec3d inner(uint32_t v) const { return place_[count_ + v]; }

    /// An inner point at depth 0 is the outer point.
    void place(uint32_t v, double depth) {
        place_[count_ + v] = depth > 0 ? work_.inner(v, depth) : work_.points[v];
        id_[count_ + v] = depth > 0 ? work_.surface.position_count + v : work_.surface.position_ids[v];
    }

    bool is_touching(uint32_t pair) {
        FacePair& p = pairs_[pair];
        return are_touching(corners(p.a), corners(p.b), p.hint);
    }

    /// The same, asking first whether the axis that kept the pair apart last time still does: a third of the cost where
    /// a pair is asked often. Keeps `axes`, one a pair, zero at first.
    bool is_touching(uint32_t pair, std::vector<Vec3d>& axes) {
        const FacePair& p = pairs_[pair];
        const Vec3d axis = axes[pair];
        const Triangle &i = faces_.corners[p.a], &j = faces_.corners[p.b];
        const double a0 = dot(axis, place_[i[0]]), a1 = dot(axis, place_[i[1]]), a2 = dot(axis, place_[i[2]]);
        const double b0 = dot(axis, place_[j[0]]), b1 = dot(axis, place_[j[1]]), b2 = dot(axis, place_[j[2]]);
        const double a_low = std::min(std::min(a0, a1), a2), a_high = std::max(std::max(a0, a1), a2);
        const double b_low = std::min(std::min(b0, b1), b2), b_high = std::max(std::max(b0, b1), b2);
        if (std::max(b_low - a_high, a_low - b_high) > kLeastGap) return false;
        if (is_touching(pair)) return true;
        axes[pair] = separating_axis(corners(p.a), corners(p.b), p.hint);
        return false;
    }

    /// visit(v) for every inner corner of the pair's two faces; a vertex of both is visited twice.
    template <class Visit>
    void for_each_inner(uint32_t pair, Visit visit) const {
        for (const uint32_t face : {pairs_[pair].a, pairs_[pair].b})
            for (const uint32_t corner : faces_.corners[face])
                if (corner >= count_) visit(corner - count_);
    }

    /// Pairs that meet at these places, but for neighbours folded onto each other along their edge: those only touch.
    uint32_t count_crossings();

 private:
    Corner3 corners(uint32_t face) const {
        const Triangle& c = faces_.corners[face];
        return {{place_[c[0]], place_[c[1]], place_[c[2]]}, {id_[c[0]], id_[c[1]], id_[c[2]]}};
    }

    const ExtrusionWork& work_;
    ShellFaces faces_;
    std::vector<FacePair> pairs_;
    uint32_t count_;
    std::vector<Vec3d> place_;  // outer, then inner points
    std::vector<uint32_t> id_;  // of those places
    VertexRows pairs_of_;
};

}  // namespace cullet
