#include "systems/models/metal_shell/dent/limit_stretch.hpp"

#include <algorithm>

#include "systems/models/metal_shell/published/pull_edges.hpp"

namespace cullet {
namespace {

constexpr int kRounds = 6, kPullingRounds = 10, kTurnPasses = 3;
constexpr int kMends = 4, kMendRounds = 6;
constexpr int kMendRings = 3;            // around an edge out of limits
constexpr float kMostShortening = 0.3f;  // from there on an edge is out of limits: of the metals the least
constexpr float kMended = 0.75f;         // of the original length: of what is mended, so that it does not crinkle
constexpr double kMovedShare = 0.1;      // what the impact moved yields so much less to pulling edges
constexpr float kShortest = 0.92f, kPush = 0.7f;  // of the original length; how much of what is missing is asked for
constexpr double kEarly = 0.88;   // of the longest: what only just keeps to its limit is over it after the next dent
constexpr float kStep = 1.2f;     // of the mean that the springs of a vertex ask for; from 4/3 on rounds may diverge
constexpr float kTurned = -0.3f;  // cosine of a triangle's normals before and after

bool moves(const MetalView& metal, uint32_t v) {
    return metal.vertices().field[metal.vertex(v)] > 0 && !metal.is_pinned(v);
}

/// What a length may be, and what one that is not is to become.
struct Allowed {
    float longest, shortest;  // m

    Allowed(float original, float most_stretch, float least)
        : longest((1 + most_stretch) * original), shortest(least * original) {}
    bool hold(float square) const { return square <= longest * longest && square >= shortest * shortest; }
    /// How much too long (above 0) or too short (below), m.
    float excess(float length) const {
        if (const float over = length - longest; over > 0) return over;
        if (const float under = length - shortest; under < 0) return kPush * under;
        return 0;
    }
};

Vec3 across(const MetalView& metal, const Column<Vec3>& places, uint32_t element) {
    const auto& c = metal.corners(element);
    const Vec3 p = places[metal.vertex(c[0])], q = places[metal.vertex(c[1])], r = places[metal.vertex(c[2])];
    return cross(q - p, r - p);
}

bool is_turned(const MetalView& metal, uint32_t element) {
    const MetalVertices& v = metal.vertices();
    const auto& c = metal.corners(element);
    if (!std::any_of(c.begin(), c.end(), [&](uint32_t k) { return v.field[metal.vertex(k)] > 0; })) return false;
    const Vec3 before = across(metal, v.start, element), after = across(metal, v.place, element);
    const float both = dot(before, after);
    return both < 0 && dot(normalised(before), normalised(after)) < kTurned;
}

/// Fills MetalVertices.queued with what is to move so that edges come back to their limits: ends of such edges, and
/// rings around them. How many there are.
uint32_t collect_overdrawn(const MetalView& metal, float most_stretch) {
    MetalVertices& vertices = metal.vertices();
    const MetalSprings& springs = metal.springs();
    const uint32_t first = metal.vertex(0);
    uint32_t count = 0;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        vertices.is_queued[first + v] = 0;
        if (!moves(metal, v)) continue;
        bool is_out = false;
        metal.for_each_spring(v, [&](uint32_t other, uint32_t spring) {
            if (springs.is_tie[spring]) return;
            const Vec3 way = vertices.place[first + other] - vertices.place[first + v];
            const float longest = (1 + most_stretch) * springs.length[spring],
                        shortest = (1 - kMostShortening) * springs.length[spring];
            is_out = is_out || dot(way, way) > longest * longest || dot(way, way) < shortest * shortest;
        });
        if (!is_out) continue;
        vertices.is_queued[first + v] = 1;
        vertices.queued[first + count++] = v;
    }
    uint32_t begin = 0;
    for (int ring = 0; ring < kMendRings; ++ring)
        for (const uint32_t end = count; begin < end; ++begin)
            metal.for_each_spring(vertices.queued[first + begin], [&](uint32_t other, uint32_t spring) {
                if (springs.is_tie[spring] || vertices.is_queued[first + other] || !moves(metal, other)) return;
                vertices.is_queued[first + other] = 1;
                vertices.queued[first + count++] = other;
            });
    return count;
}

/// All vertices that move.
template <class Visit>
void for_each_moving(const MetalView& metal, Visit visit) {
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        if (moves(metal, v)) visit(v);
}

// Both ends of a spring take an equal share; one that stays where it is leaves all to the other. Ties between sheets
// are no edges. for_each(visit): the vertices that are moved.
//
// A step is over the sum of the shares, and not over the number of springs: among neighbours that stay, each of which
// leaves all, it would go past the mean by 1.4 times what is missing, round by round farther. Over the shares no round
// enlarges anything: of a mesh of triangles neighbours go against each other by half of their way at most, which is
// 1.5 kStep < 2.
template <class ForEach>
void relax(const MetalView& metal, float most_stretch, float least, ForEach for_each) {
    MetalVertices& vertices = metal.vertices();
    const MetalSprings& springs = metal.springs();
    for_each([&](uint32_t v) {
        const uint32_t row = metal.vertex(v);
        Vec3 sum;
        float shares = 0;
        metal.for_each_spring(v, [&](uint32_t other, uint32_t spring) {
            if (springs.is_tie[spring]) return;
            const float share = moves(metal, other) ? 0.5f : 1.0f;
            shares += share;
            const Vec3 way = vertices.place[metal.vertex(other)] - vertices.place[row];
            const Allowed allowed(springs.length[spring], most_stretch, least);
            if (allowed.hold(dot(way, way))) return;
            const float now = length(way);
            if (!(now > 1e-9f)) return;
            const float c = allowed.excess(now);
            sum += (c / now * share) * way;
        });
        // Of few edges it would go past their limits.
        const float step = shares > kStep ? kStep / shares : 1.0f;
        vertices.next.set(row, vertices.place[row] + step * sum);
    });
    for_each([&](uint32_t v) { vertices.place.set(metal.vertex(v), vertices.next[metal.vertex(v)]); });
}

template <class ForEach>
void clear(const MetalView& metal, const Striker& striker, double depth, ForEach for_each) {
    MetalVertices& vertices = metal.vertices();
    for_each([&](uint32_t v) {
        const uint32_t row = metal.vertex(v);
        const double covered = striker.covers(Vec3d(vertices.place[row]), depth);
        if (covered > 0) vertices.place.set(row, (Vec3d(vertices.place[row]) + covered * striker.push).to_float());
    });
}

/// What edges are let become at most, so that they are within their limits after the next dent as well.
float early(double most_stretch) {
    return static_cast<float>(kEarly * (1 + most_stretch) - 1);
}

}  // namespace

void relax_once(const MetalView& metal, float most_stretch) {
    relax(metal, most_stretch, kShortest, [&](auto visit) { for_each_moving(metal, visit); });
}

void clear_striker(const MetalView& metal, const Striker& striker, double depth) {
    clear(metal, striker, depth, [&](auto visit) { for_each_moving(metal, visit); });
}

void limit_stretch(const MetalView& metal, double most_stretch, const Striker& striker, double depth) {
    const uint8_t published = metal.shells().published[metal.row];
    const bool pulls = published & kPublishedSprings, is_shaped = !(published & kPublishedShape);
    const int rounds = pulls ? kPullingRounds : kRounds;
    if (pulls) sum_areas(metal);
    for (int round = 0; round < rounds; ++round) {
        if (pulls) pull_edges(metal, kMovedShare);
        if (published & kPublishedLimit)
            cut_long_edges(metal, most_stretch);
        else
            relax_once(metal, early(most_stretch));
        if (round % 2 == 1 && is_shaped) clear_striker(metal, striker, depth);
    }
}

void mend_edges(const MetalView& metal, double most_stretch, const Striker& striker, double depth) {
    const MetalVertices& vertices = metal.vertices();
    for (int mend = 0; mend < kMends; ++mend) {
        const uint32_t count = collect_overdrawn(metal, static_cast<float>(most_stretch));
        if (count == 0) return;
        const auto for_each = [&](auto visit) {
            for (uint32_t k = 0; k < count; ++k) visit(vertices.queued[metal.vertex(k)]);
        };
        for (int round = 0; round < kMendRounds; ++round) {
            relax(metal, early(most_stretch), kMended, for_each);
            if (round % 2 == 1) clear(metal, striker, depth, for_each);
        }
    }
}

void turn_back(const MetalView& metal) {
    MetalVertices& vertices = metal.vertices();
    for (int pass = 0; pass < kTurnPasses; ++pass) {
        bool is_any = false;
        for (uint32_t v = 0; v < metal.vertex_count(); ++v)
            vertices.next.set(metal.vertex(v), vertices.place[metal.vertex(v)]);
        for (uint32_t e = 0; e < metal.element_count(); ++e) {
            if (metal.is_dead(e)) continue;
            if (!is_turned(metal, e)) continue;
            is_any = true;
            const auto& c = metal.corners(e);
            Vec3 mean;
            for (const uint32_t v : c)
                mean += (1.0f / 3) * (vertices.place[metal.vertex(v)] - vertices.start[metal.vertex(v)]);
            for (const uint32_t v : c)
                if (moves(metal, v)) vertices.next.set(metal.vertex(v), vertices.start[metal.vertex(v)] + mean);
        }
        if (!is_any) return;
        for (uint32_t v = 0; v < metal.vertex_count(); ++v)
            vertices.place.set(metal.vertex(v), vertices.next[metal.vertex(v)]);
    }
}

StretchCount count_stretch(const MetalView& metal, double most_stretch, double most_shortening) {
    StretchCount count;
    const MetalSprings& springs = metal.springs();
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        metal.for_each_spring(v, [&](uint32_t other, uint32_t spring) {
            if (other < v || springs.is_tie[spring] || !(springs.length[spring] > 0)) return;
            const Vec3 way = metal.vertices().place[metal.vertex(other)] - metal.vertices().place[metal.vertex(v)];
            const double share = double{length(way)} / double{springs.length[spring]};
            ++count.edges;
            count.outside += share > 1 + most_stretch || share < 1 - most_shortening;
            count.longest = std::max(count.longest, share), count.shortest = std::min(count.shortest, share);
        });
    return count;
}

}  // namespace cullet
