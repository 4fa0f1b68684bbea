#include "engine/bullet/body_ways.hpp"

#include <algorithm>

#include "engine/bullet/closest_points.hpp"

namespace cullet::bullet {
namespace {

// Pieces of one body are made to touch with their margins. Up to twice that far apart they count as joined.
constexpr double kJoined = 2;
constexpr int kProjections = 4;
constexpr size_t kWaysAPiece = 16;  // of a dense body; a shell has half as many

Vec3d world_point(const Points& of, Vec3d from_centre) {
    return Vec3d(of.centre) + from_centre;
}

// The place of a hull's core that is nearest.
Vec3d project(const Points& points, Vec3d place) {
    Points single{};
    single.centre = place.to_float();
    single.count = 8;
    const Closest closest = closest_points(points, single, {}, kFar);
    return closest.is_apart ? world_point(points, closest.on_a) : place;
}

// Cores that overlap: by turns to the nearest place of each, from the middle of what their boxes share.
Vec3d shared_place(const Hull& a, const Hull& b) {
    const Box &p = a.world_box, &q = b.world_box;
    const Vec3 low{std::max(p.low.x, q.low.x), std::max(p.low.y, q.low.y), std::max(p.low.z, q.low.z)},
        high{std::min(p.high.x, q.high.x), std::min(p.high.y, q.high.y), std::min(p.high.z, q.high.z)};
    Vec3d place(0.5f * (low + high));
    for (int k = 0; k < kProjections; ++k) place = project(b.world, project(a.world, place));
    return place;
}

bool find_joint(const Hull& a, const Hull& b, Vec3& over) {
    const double enough = kJoined * static_cast<double>(a.margin + b.margin);
    const Closest closest = closest_points(a.world, b.world, {}, enough);
    if (closest.is_apart && !(closest.distance <= enough)) return false;
    const Vec3d place =
        closest.is_apart ? world_point(a.world, 0.5 * (closest.on_a + closest.on_b)) : shared_place(a, b);
    over = place.to_float();
    return true;
}

}  // namespace

void BodyWays::reserve(size_t pieces) {
    points_.reserve(pieces), pieces_.reserve(pieces);
    ways_.reserve(kWaysAPiece * pieces), next_.reserve(kWaysAPiece * pieces);
}

void BodyWays::list(const Body& body) {
    points_.clear(), ways_.clear();
    for (const Hull* a = body.hulls; a; a = a->next) {
        const auto number = static_cast<uint32_t>(points_.size());
        uint32_t other = number;
        points_.push_back(inner_point(*a, body.fresh_at));
        for (const Hull* b = a->next; b; b = b->next) {
            Vec3 over;
            ++other;
            if (!overlap(a->world_box, b->world_box, a->margin + b->margin) || !find_joint(*a, *b, over)) continue;
            ways_.push_back({number, other, over, false, {}});
        }
    }
    pieces_.resize(points_.size());
}

void BodyWays::shift(Vec3 by) {
    for (Vec3& point : points_) point += by;
    for (Way& way : ways_) way.over += by;
}

void BodyWays::reach(const Way& way, bool from_b) {
    const Piece& from = pieces_[from_b ? way.b : way.a];
    Piece& to = pieces_[from_b ? way.a : way.b];
    to = from;
    to.is_reached = true;
    if (from.is_cut_off || !way.is_cut || !(from_b ? way.cut.bears_back : way.cut.bears)) return;
    to.is_cut_off = true;
    to.cut = way.cut;
    if (from_b) to.cut.normal = -way.cut.normal;
}

// All that is reached without another cut.
void BodyWays::flood() {
    for (bool is_more = true; is_more;) {
        is_more = false;
        for (const Way& way : ways_) {
            const bool is_a = pieces_[way.a].is_reached;
            if (way.is_cut || is_a == pieces_[way.b].is_reached) continue;
            reach(way, !is_a);
            is_more = true;
        }
    }
}

// Through one cut more, from where has been reached so far.
bool BodyWays::pass_cuts() {
    next_.clear();
    for (size_t k = 0; k < ways_.size(); ++k)
        if (pieces_[ways_[k].a].is_reached != pieces_[ways_[k].b].is_reached) next_.push_back(k);
    for (const size_t k : next_) {
        const bool is_a = pieces_[ways_[k].a].is_reached;
        if (is_a != pieces_[ways_[k].b].is_reached) reach(ways_[k], !is_a);
    }
    return !next_.empty();
}

}  // namespace cullet::bullet
