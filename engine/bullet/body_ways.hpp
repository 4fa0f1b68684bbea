// Ways through a body from piece to piece, where they touch. A sheet has cut a piece off when every way to it goes
// through a sheet. A sheet that the body merely reaches around lies beside all of its ways: a straight line to the
// piece may cross it, no way through the body does.
#pragma once
#include <vector>

#include "engine/bullet/sides.hpp"

namespace cullet::bullet {

class BodyWays {
 public:
    /// So that a body of so many pieces needs no more memory.
    void reserve(size_t pieces);
    /// Of a body whose world points are fresh. Pieces of it that touch nothing are reached from the first one reached.
    void list(const Body& body);
    /// The body has been moved.
    void shift(Vec3 by);
    std::span<const Vec3> points() const { return points_; }

    /// How far the sheets have cut off each piece that they have: call(piece's inner point, cut), in the pieces' order.
    /// Ways start at `start`, straight to piece `root`; find(from, over, to, cut) says whether one is cut.
    template <class Find, class Call>
    void visit_cut_off(Vec3 start, uint32_t root, Find find, Call call) {
        for (Piece& piece : pieces_) piece = {};
        for (Way& way : ways_) way.is_cut = find(points_[way.a], way.over, points_[way.b], way.cut);
        pieces_[root].is_reached = true;
        Piece& first = pieces_[root];
        first.is_cut_off = find(start, start, points_[root], first.cut) && first.cut.bears;
        do flood();
        while (pass_cuts() || leap(root, find));
        for (size_t k = 0; k < pieces_.size(); ++k)
            if (pieces_[k].is_cut_off) call(points_[k], pieces_[k].cut);
    }

 private:
    struct Piece {
        bool is_reached = false, is_cut_off = false;
        Cut cut;  // the first one on the way to it
    };
    struct Way {
        uint32_t a, b;
        Vec3 over;
        bool is_cut = false;
        Cut cut;  // seen from a
    };
    void flood();
    bool pass_cuts();
    void reach(const Way& way, bool from_b);
    template <class Find>
    bool leap(uint32_t root, Find find) {
        for (uint32_t k = 0; k < pieces_.size(); ++k) {
            if (pieces_[k].is_reached) continue;
            Way way{root, k, points_[root], false, {}};
            way.is_cut = find(points_[root], way.over, points_[k], way.cut);
            reach(way, false);
            return true;
        }
        return false;
    }

    std::vector<Vec3> points_;
    std::vector<Piece> pieces_;
    std::vector<Way> ways_;
    std::vector<size_t> next_;  // ways that are passed in this round
};

}  // namespace cullet::bullet
