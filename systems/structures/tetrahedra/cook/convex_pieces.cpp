#include "systems/structures/tetrahedra/cook/convex_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "engine/principal_axes.hpp"
#include "engine/table.hpp"
#include "systems/hulls/extreme_points.hpp"
#include "systems/structures/tetrahedra/cook/cut_cells.hpp"
#include "systems/structures/tetrahedra/cook/ray_crossings.hpp"

namespace cullet {
namespace {

constexpr uint32_t kDirections = 98;   // to the places of a cube's surface in steps of half its half
constexpr uint32_t kSlabs = 4;         // of the extent along an axis: three planes are tried between them
constexpr double kLeastVolume = 1e-6;  // of the whole: a scrap is not halved
constexpr float kEnough = 2e-4f;       // of the extent: a point that near to a hull adds nothing

struct Plane {
    Vec3d normal;
    double height = 0;
    double above(Vec3d p) const { return dot(normal, p) - height; }
};

using Side = std::array<uint32_t, 2>;  // of triangles: its two ends

/// A part of the solid between planes. What closes it there is kept for its volume alone: fans of triangles that stand
/// for more and for less, whose corners may lie outside.
struct Part {
    List<Vec3d> places;
    List<Triangle> surface;
    List<std::array<Vec3d, 3>> caps;
    List<Plane> planes;  // it is below them
    List<Vec3d> inner;   // places within the solid where three planes meet: corners that no triangle has
    VolumeSums sums;     // about the origin
    SolidHull hull;
    uint32_t depth = 0;
};

const std::array<Vec3, kDirections>& directions() {
    static const std::array<Vec3, kDirections> all = [] {
        std::array<Vec3, kDirections> made;
        uint32_t n = 0;
        for (int x = -2; x <= 2; ++x)
            for (int y = -2; y <= 2; ++y)
                for (int z = -2; z <= 2; ++z)
                    if (std::max({std::abs(x), std::abs(y), std::abs(z)}) == 2)
                        made[n++] = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
        return made;
    }();
    return all;
}

/// The farthest point in every direction. Nobody is at -infinity.
struct Farthest {
    std::array<float, kDirections> most;
    std::array<Vec3, kDirections> point;
    Farthest() { most.fill(-1e30f); }
    void take(uint32_t direction, float along, Vec3 p) {
        if (along > most[direction]) most[direction] = along, point[direction] = p;
    }
    void add(Vec3 p) {
        for (uint32_t d = 0; d < kDirections; ++d) take(d, dot(directions()[d], p), p);
    }
    void add(const Farthest& other) {
        for (uint32_t d = 0; d < kDirections; ++d) take(d, other.most[d], other.point[d]);
    }
};

}  // namespace

class ConvexHalving::Halver {
 public:
    Halver(std::span<const Vec3d> places, std::span<const Triangle> triangles, const HalvingSettings& settings)
        : triangles_(triangles.begin(), triangles.end()), settings_(settings) {
        // About the middle of its box, so that far from the origin nothing is lost.
        Vec3d low = places[triangles[0][0]], high = low;
        for (const Triangle& t : triangles)
            for (const uint32_t v : t) {
                const Vec3d p = places[v];
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            }
        centre_ = 0.5 * (low + high);
        places_.reserve(places.size());
        for (const Vec3d& p : places) places_.push_back(p - centre_);
    }

    bool advance(ScratchMemory& scratch) {
        scratch_ = &scratch;
        if (!has_begun_) {
            begin();
            has_begun_ = true;
        } else if (!waiting_.empty()) {
            Part part = std::move(waiting_.back());
            waiting_.pop_back();
            halve(std::move(part));
        }
        return waiting_.empty();
    }
    size_t next_rows() const {
        if (!has_begun_) return triangles_.size();
        return waiting_.empty() ? 0 : waiting_.back().surface.size();
    }
    List<SolidHull> take() {
        for (SolidHull& piece : pieces_)
            for (Vec3& p : piece.points) p = (Vec3d(p) + centre_).to_float();
        return std::move(pieces_);
    }

 private:
    void begin() {
        Part whole;
        // Points that no triangle names are none of the solid's.
        List<uint32_t> number(places_.size(), kNone);
        for (const Triangle& t : triangles_) {
            for (const uint32_t v : t)
                if (number[v] == kNone) {
                    number[v] = static_cast<uint32_t>(whole.places.size());
                    whole.places.push_back(places_[v]);
                }
            whole.surface.push_back({number[t[0]], number[t[1]], number[t[2]]});
        }
        measure(whole);
        whole_volume_ = whole.sums.volume;
        Farthest farthest;
        for (const Vec3d& p : whole.places) farthest.add(p.to_float());
        whole.hull = wrap(farthest);
        waiting_.push_back(std::move(whole));
    }

    void measure(Part& part) {
        part.sums = {};
        for (const Triangle& t : part.surface) {
            const Vec3d corners[] = {part.places[t[0]], part.places[t[1]], part.places[t[2]]};
            add_fan(corners, {}, 1, part.sums);
        }
        for (const auto& cap : part.caps) add_fan(cap, {}, 1, part.sums);
    }

    SolidHull wrap(const Farthest& farthest) {
        List<Vec3> points;
        Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
        for (uint32_t d = 0; d < kDirections; ++d) {
            if (!(farthest.most[d] > -1e30f)) continue;
            const Vec3 p = farthest.point[d];
            if (std::find(points.begin(), points.end(), p) != points.end()) continue;
            points.push_back(p);
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        SolidHull piece;
        if (points.empty()) return piece;
        ExtremePoints chosen;
        choose_extremes(*scratch_, points, kMostHullPoints, kEnough * length(high - low), chosen);
        for (uint32_t i = 0; i < chosen.count; ++i) piece.points.push_back(points[chosen.index[i]]);
        for (uint32_t f = 0; f < chosen.face_count; ++f) {
            const auto& face = chosen.face[f];
            const Vec3d a(piece.points[face[0]] - piece.points[0]), b(piece.points[face[1]] - piece.points[0]),
                c(piece.points[face[2]] - piece.points[0]);
            piece.hull_volume += dot(a, cross(b, c)) / 6;
        }
        return piece;
    }

    void halve(Part part) {
        const double volume = part.sums.volume;
        part.hull.volume = volume;
        const bool is_good = part.hull.hull_volume <= settings_.most_excess * volume;
        if (is_good || part.depth == settings_.depth || !(volume > kLeastVolume * whole_volume_)) {
            if (part.hull.points.size() > 3) pieces_.push_back(std::move(part.hull));
            return;
        }
        Choice best = choose(part);
        if (!best.is_any) {
            pieces_.push_back(std::move(part.hull));
            return;
        }
        Part sides[2];
        split(part, best.plane, sides);
        for (uint32_t s = 0; s < 2; ++s) {
            sides[s].inner = part.inner;
            sides[s].inner.insert(sides[s].inner.end(), best.inner.begin(), best.inner.end());
            std::erase_if(sides[s].inner, [&](Vec3d p) {
                const double above = best.plane.above(p);
                return s == 0 ? above > best.slack : above < -best.slack;
            });
            sides[s].hull = std::move(best.hull[s]);
            measure(sides[s]);
        }
        waiting_.push_back(std::move(sides[1]));
        waiting_.push_back(std::move(sides[0]));
    }

    struct Choice {
        bool is_any = false;
        Plane plane;
        double slack = 0;
        SolidHull hull[2];
        List<Vec3d> inner;  // new corners, on the plane
    };

    Choice choose(const Part& part) {
        const Vec3d centre = (1 / part.sums.volume) * part.sums.first;
        const PrincipalAxes principal = principal_axes(inertia_of(part.sums.second - part.sums.volume * outer(centre)));
        const Vec3 units[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        Plane planes[3][kSlabs - 1];
        double extent = 0;
        for (uint32_t k = 0; k < 3; ++k) {
            const Vec3d axis = normalised(Vec3d(rotate(principal.axes, units[k])));
            double low = 1e300, high = -1e300;
            for (const Triangle& t : part.surface)
                for (const uint32_t v : t) {
                    const double along = dot(axis, part.places[v]);
                    low = std::min(low, along), high = std::max(high, along);
                }
            for (uint32_t j = 0; j + 1 < kSlabs; ++j) planes[k][j] = {axis, low + (j + 1) * (high - low) / kSlabs};
            extent = std::max(extent, high - low);
        }
        const double slack = 1e-9 * extent;

        // Of every point the slab along each axis; of every slab the farthest points.
        List<std::array<uint8_t, 3>> slabs(part.places.size());
        List<Farthest> of_slab(3 * kSlabs);
        for (uint32_t v = 0; v < part.places.size(); ++v)
            for (uint32_t k = 0; k < 3; ++k)
                for (uint32_t j = 0; j + 1 < kSlabs; ++j) slabs[v][k] += planes[k][j].above(part.places[v]) > 0;
        const auto& way = directions();
        const auto add = [&](Vec3 p, const std::array<uint8_t, 3>& slab) {
            Farthest* const of[3] = {&of_slab[slab[0]], &of_slab[kSlabs + slab[1]], &of_slab[2 * kSlabs + slab[2]]};
            for (uint32_t d = 0; d < kDirections; ++d) {
                const float along = dot(way[d], p);
                of[0]->take(d, along, p), of[1]->take(d, along, p), of[2]->take(d, along, p);
            }
        };
        for (uint32_t v = 0; v < part.places.size(); ++v) add(part.places[v].to_float(), slabs[v]);
        for (const Vec3d& p : part.inner) {
            std::array<uint8_t, 3> slab{};
            for (uint32_t k = 0; k < 3; ++k)
                for (uint32_t j = 0; j + 1 < kSlabs; ++j) slab[k] += planes[k][j].above(p) > 0;
            add(p.to_float(), slab);
        }

        Choice best;
        double least = 1e300;
        for (uint32_t k = 0; k < 3; ++k)
            for (uint32_t j = 0; j + 1 < kSlabs; ++j) {
                Farthest on_plane, sides[2];
                for (const Triangle& t : part.surface)
                    for (uint32_t i = 0; i < 3; ++i) {
                        const uint32_t a = t[i], b = t[(i + 1) % 3];
                        if ((slabs[a][k] > j) != (slabs[b][k] > j))
                            on_plane.add(crossing(planes[k][j], part.places[a], part.places[b]).to_float());
                    }
                List<Vec3d> inner = inner_corners(part, planes[k][j], slack);
                for (const Vec3d& p : inner) on_plane.add(p.to_float());
                for (uint32_t s = 0; s < kSlabs; ++s) sides[s > j].add(of_slab[kSlabs * k + s]);
                SolidHull hulls[2];
                for (uint32_t s = 0; s < 2; ++s) {
                    sides[s].add(on_plane);
                    hulls[s] = wrap(sides[s]);
                }
                const double sum = hulls[0].hull_volume * spread(hulls[0]) + hulls[1].hull_volume * spread(hulls[1]);
                if (!(sum < least)) continue;
                least = sum;
                best.is_any = true;
                best.plane = planes[k][j];
                best.slack = slack;
                best.hull[0] = std::move(hulls[0]), best.hull[1] = std::move(hulls[1]);
                best.inner = std::move(inner);
            }
        return best;
    }

    // Root of the mean distance of the corners from their middle. A bowl's rings would else be sliced for ever: each
    // slice wins a little, while a cut across the ring wins nothing before the next. The distance itself cuts too much
    // that is good across.
    static double spread(const SolidHull& piece) {
        Vec3d first;
        double second = 0;
        for (const Vec3& p : piece.points) first += Vec3d(p), second += dot(Vec3d(p), Vec3d(p));
        const double share = 1.0 / static_cast<double>(std::max<size_t>(1, piece.points.size()));
        const double square = share * second - share * share * dot(first, first);
        return square > 0 ? std::sqrt(std::sqrt(square)) : 0;
    }

    static Vec3d crossing(const Plane& plane, Vec3d a, Vec3d b) {
        const double low = plane.above(a), high = plane.above(b);
        return a + low / (low - high) * (b - a);
    }

    // Where the plane meets two others within the solid.
    List<Vec3d> inner_corners(const Part& part, const Plane& plane, double slack) const {
        List<Vec3d> corners;
        for (size_t i = 0; i < part.planes.size(); ++i)
            for (size_t j = i + 1; j < part.planes.size(); ++j) {
                const Plane &a = part.planes[i], &b = part.planes[j];
                const double volume = dot(plane.normal, cross(a.normal, b.normal));
                if (!(std::fabs(volume) > 1e-6)) continue;
                const Vec3d p = (1 / volume) *
                                (plane.height * cross(a.normal, b.normal) + a.height * cross(b.normal, plane.normal) +
                                 b.height * cross(plane.normal, a.normal));
                const bool is_below = std::all_of(part.planes.begin(), part.planes.end(),
                                                  [&](const Plane& q) { return q.above(p) <= slack; });
                if (is_below && is_inside(p, places_, triangles_)) corners.push_back(p);
            }
        return corners;
    }

    static void split(const Part& part, const Plane& plane, Part (&sides)[2]) {
        List<uint8_t> is_above(part.places.size());
        for (uint32_t v = 0; v < part.places.size(); ++v) is_above[v] = plane.above(part.places[v]) > 0;
        List<uint32_t> number[2];
        std::map<Side, std::array<uint32_t, 2>, std::less<Side>,
                 RoomAllocator<std::pair<const Side, std::array<uint32_t, 2>>>>
            crossings;
        for (uint32_t s = 0; s < 2; ++s) {
            number[s].assign(part.places.size(), kNone);
            sides[s].depth = part.depth + 1;
            sides[s].planes = part.planes;
        }
        sides[0].planes.push_back(plane);
        sides[1].planes.push_back({-plane.normal, -plane.height});
        const auto vertex = [&](uint32_t s, uint32_t v) {
            if (number[s][v] == kNone) {
                number[s][v] = static_cast<uint32_t>(sides[s].places.size());
                sides[s].places.push_back(part.places[v]);
            }
            return number[s][v];
        };
        const auto between = [&](uint32_t a, uint32_t b) {
            const auto [at, is_new] = crossings.try_emplace({std::min(a, b), std::max(a, b)});
            if (is_new) {
                const Vec3d p = crossing(plane, part.places[at->first[0]], part.places[at->first[1]]);
                for (uint32_t s = 0; s < 2; ++s) {
                    at->second[s] = static_cast<uint32_t>(sides[s].places.size());
                    sides[s].places.push_back(p);
                }
            }
            return at->second;
        };
        bool has_tip = false;
        Vec3d tip;
        // What closes both sides along a piece of the plane's way through the surface.
        const auto close = [&](Vec3d from, Vec3d to) {
            if (!has_tip) tip = from, has_tip = true;
            sides[0].caps.push_back({tip, to, from});
            sides[1].caps.push_back({tip, from, to});
        };
        for (const Triangle& t : part.surface) {
            const uint32_t first = is_above[t[0]], second = is_above[t[1]], third = is_above[t[2]];
            if (first == second && second == third) {
                sides[first].surface.push_back({vertex(first, t[0]), vertex(first, t[1]), vertex(first, t[2])});
                continue;
            }
            // One corner stands alone; the triangle is turned so that it is the first.
            const uint32_t alone = first == second ? 2 : first == third ? 1 : 0;
            const uint32_t a = t[alone], b = t[(alone + 1) % 3], c = t[(alone + 2) % 3];
            const uint32_t s = is_above[a], o = 1 - s;
            const auto ab = between(a, b), ca = between(c, a);
            sides[s].surface.push_back({vertex(s, a), ab[s], ca[s]});
            sides[o].surface.push_back({ab[o], vertex(o, b), vertex(o, c)});
            sides[o].surface.push_back({ab[o], vertex(o, c), ca[o]});
            // On the side below the way runs from ab to ca if the lone corner is there, else back.
            const Vec3d p = sides[0].places[ab[0]], q = sides[0].places[ca[0]];
            s == 0 ? close(p, q) : close(q, p);
        }
        for (const auto& cap : part.caps) {
            const bool above[3] = {plane.above(cap[0]) > 0, plane.above(cap[1]) > 0, plane.above(cap[2]) > 0};
            if (above[0] == above[1] && above[1] == above[2]) {
                sides[above[0]].caps.push_back(cap);
                continue;
            }
            const uint32_t alone = above[0] == above[1] ? 2 : above[0] == above[2] ? 1 : 0;
            const Vec3d a = cap[alone], b = cap[(alone + 1) % 3], c = cap[(alone + 2) % 3];
            const Vec3d p = crossing(plane, a, b), q = crossing(plane, c, a);
            const uint32_t s = above[alone];
            sides[s].caps.push_back({a, p, q});
            sides[1 - s].caps.push_back({p, b, c});
            sides[1 - s].caps.push_back({p, c, q});
            s == 0 ? close(p, q) : close(q, p);
        }
    }

    ScratchMemory* scratch_ = nullptr;
    List<Vec3d> places_;
    List<Triangle> triangles_;
    HalvingSettings settings_;
    Vec3d centre_;
    bool has_begun_ = false;
    double whole_volume_ = 0;
    List<Part> waiting_;  // the last is next
    List<SolidHull> pieces_;
};

ConvexHalving::ConvexHalving(std::span<const Vec3d> places, std::span<const Triangle> triangles,
                             const HalvingSettings& settings)
    : halver_(1) {
    halver_[0].emplace(places, triangles, settings);
}
ConvexHalving::~ConvexHalving() = default;

bool ConvexHalving::advance(ScratchMemory& scratch) {
    return halver_[0]->advance(scratch);
}
size_t ConvexHalving::next_rows() const {
    return halver_[0]->next_rows();
}
List<SolidHull> ConvexHalving::take() {
    return halver_[0]->take();
}

List<SolidHull> convex_pieces(ScratchMemory& scratch, std::span<const Vec3d> places,
                              std::span<const Triangle> triangles, const HalvingSettings& settings) {
    ConvexHalving halving(places, triangles, settings);
    while (!halving.advance(scratch)) {
    }
    return halving.take();
}

}  // namespace cullet
