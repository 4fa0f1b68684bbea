#include "systems/models/metal_shell/dent/limit_stretch.hpp"

#include <algorithm>

#include "systems/models/metal_shell/published/pull_edges.hpp"

namespace cullet {
namespace {

constexpr int kRounds = 6, kMoreRounds = 18, kPullingRounds = 10, kTurnPasses = 3;
constexpr double kMovedShare = 0.1;               // what the impact moved yields so much less to pulling edges
constexpr float kShortest = 0.92f, kPush = 0.7f;  // of the original length; how much of what is missing is asked for
constexpr double kEarly = 0.88;   // of the longest: what only just keeps to its limit is over it after the next dent
constexpr float kStep = 2.4f;     // over the number of springs
constexpr float kTurned = -0.3f;  // cosine of a triangle's normals before and after

bool moves(const MetalView& metal, uint32_t v) {
    return metal.vertices().field[metal.vertex(v)] > 0 && !metal.is_pinned(v);
}

/// What a length may be, and what one that is not is to become.
struct Allowed {
    float longest, shortest;  // m

    Allowed(float original, float most_stretch)
        : longest((1 + most_stretch) * original), shortest(kShortest * original) {}
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

bool has_long_edge(const MetalView& metal, float most_stretch) {
    const MetalVertices& vertices = metal.vertices();
    const MetalSprings& springs = metal.springs();
    bool is_any = false;
    for (uint32_t v = 0; v < metal.vertex_count() && !is_any; ++v) {
        if (!moves(metal, v)) continue;
        metal.for_each_spring(v, [&](uint32_t other, uint32_t spring) {
            const Vec3 way = vertices.place[metal.vertex(other)] - vertices.place[metal.vertex(v)];
            const float longest = (1 + most_stretch) * springs.length[spring];
            is_any = is_any || (!springs.is_tie[spring] && dot(way, way) > longest * longest);
        });
    }
    return is_any;
}

}  // namespace

// Both ends of a spring take an equal share; one that stays where it is leaves all to the other. Ties between sheets
// are no edges.
void relax_once(const MetalView& metal, float most_stretch) {
    MetalVertices& vertices = metal.vertices();
    const MetalSprings& springs = metal.springs();
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.vertex(v);
        if (!moves(metal, v)) continue;
        Vec3 sum;
        uint32_t valence = 0;
        metal.for_each_spring(v, [&](uint32_t other, uint32_t spring) {
            if (springs.is_tie[spring]) return;
            ++valence;
            const Vec3 way = vertices.place[metal.vertex(other)] - vertices.place[row];
            const Allowed allowed(springs.length[spring], most_stretch);
            if (allowed.hold(dot(way, way))) return;
            const float now = length(way);
            if (!(now > 1e-9f)) return;
            const float c = allowed.excess(now);
            sum += (c / now * (moves(metal, other) ? 0.5f : 1.0f)) * way;
        });
        // Of few edges it would go past their limits.
        const float step = std::min(1.0f, kStep / static_cast<float>(std::max(valence, 1u)));
        vertices.next.set(row, vertices.place[row] + step * sum);
    }
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        if (moves(metal, v)) vertices.place.set(metal.vertex(v), vertices.next[metal.vertex(v)]);
}

void clear_striker(const MetalView& metal, const Striker& striker, double depth) {
    MetalVertices& vertices = metal.vertices();
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        if (!moves(metal, v)) continue;
        const uint32_t row = metal.vertex(v);
        const double covered = striker.covers(Vec3d(vertices.place[row]), depth);
        if (covered > 0) vertices.place.set(row, (Vec3d(vertices.place[row]) + covered * striker.push).to_float());
    }
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
            relax_once(metal, static_cast<float>(kEarly * (1 + most_stretch) - 1));
        if (round % 2 == 1 && is_shaped) clear_striker(metal, striker, depth);
    }
    // A ball goes in deeper than it is wide, and over dents that are there: six rounds leave what it drew out.
    if (published != 0 || striker.shape != StrikerShape::Sphere) return;
    for (int round = 0; round < kMoreRounds; ++round) {
        if (round % 2 == 0 && !has_long_edge(metal, static_cast<float>(most_stretch))) return;
        relax_once(metal, static_cast<float>(kEarly * (1 + most_stretch) - 1));
        if (round % 2 == 1) clear_striker(metal, striker, depth);
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
