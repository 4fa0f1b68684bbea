#include "systems/structures/shell/cook/local_caps.hpp"

#include "systems/structures/shell/cook/element_shape.hpp"

namespace cullet {
namespace {

constexpr double kLeastFacing = 0.5;  // the mitre asks for at most twice the thickness
constexpr double kFarSkin = 6;        // thicknesses; an inner wall further away is not looked for
constexpr int kSlopeSweeps = 8;       // of D(v) <= D(u) + |uv|
constexpr int kShapeRounds = 40;
constexpr double kShrink = 0.85;    // of the caps of an unsound element
constexpr double kHopeless = 0.02;  // of the first cap: below, no depth cures the element

void limit_slope(ExtrusionWork& work) {
    struct Edge {
        uint32_t a, b;
        double length;
    };
    std::vector<Edge> edges;
    for (uint32_t t = 0; t < work.triangle_count(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = work.surface.triangles[t][k], b = work.surface.triangles[t][(k + 1) % 3];
            if (work.surface.neighbours[t][k] == kNone || t < work.surface.neighbours[t][k])
                edges.push_back({a, b, length(work.points[a] - work.points[b])});
        }
    std::vector<double>& caps = work.first_caps;
    bool has_changed = true;
    for (int sweep = 0; sweep < kSlopeSweeps && has_changed; ++sweep) {
        has_changed = false;
        for (const Edge& e : edges) {
            // A vertex without a direction is a point of its own and does not pull its neighbours down.
            if (work.is_frozen[e.a] || work.is_frozen[e.b]) continue;
            const double a = std::min(caps[e.a], caps[e.b] + e.length), b = std::min(caps[e.b], caps[e.a] + e.length);
            has_changed = has_changed || a < caps[e.a] || b < caps[e.b];
            caps[e.a] = a, caps[e.b] = b;
        }
    }
}

bool is_sound_at_caps(const ExtrusionWork& work, uint32_t t) {
    const Triangle& c = work.surface.triangles[t];
    const std::array<double, 3> depth{work.caps[c[0]], work.caps[c[1]], work.caps[c[2]]};
    return is_sound(work, t, {work.inner(c[0], depth[0]), work.inner(c[1], depth[1]), work.inner(c[2], depth[2])},
                    depth);
}

// Thickness of the wall between the skins, under the worst face of each vertex; where no inner skin lies behind, as at
// a lip, that of the neighbours. 0 where there is none.
std::vector<double> measure_wall(const ExtrusionWork& work, const OppositeWall& wall) {
    std::vector<double> thickness(work.vertex_count());
    std::vector<uint32_t> unknown;
    const double far = kFarSkin * work.thickness;
    for (uint32_t v = 0; v < work.vertex_count(); ++v) {
        if (work.is_frozen[v] || !wall.has_skin(v)) continue;
        const double way = wall.way_to_skin(v, work.directions[v], far);
        if (way < far)
            thickness[v] = way * work.facing[v];
        else
            unknown.push_back(v);
    }
    for (bool has_changed = true; has_changed && !unknown.empty();) {
        std::vector<double> found(unknown.size());
        for (size_t k = 0; k < unknown.size(); ++k) {
            double sum = 0, count = 0;
            for (const uint32_t t : work.ring[unknown[k]])
                for (const uint32_t w : work.surface.triangles[t])
                    if (thickness[w] > 0) sum += thickness[w], ++count;
            if (count > 0) found[k] = sum / count;
        }
        has_changed = false;
        size_t kept = 0;
        for (size_t k = 0; k < unknown.size(); ++k) {
            if (found[k] > 0)
                thickness[unknown[k]] = found[k], has_changed = true;
            else
                unknown[kept++] = unknown[k];
        }
        unknown.resize(kept);
    }
    return thickness;
}

}  // namespace

void find_wall_caps(ExtrusionWork& work, const OppositeWall& wall, const std::vector<uint8_t>& is_marked) {
    const std::vector<double> measured = measure_wall(work, wall);
    for (uint32_t v = 0; v < work.vertex_count(); ++v) {
        if (!is_marked.empty() && !is_marked[v]) continue;
        double wanted =
            work.settings.has_mitre ? work.thickness / std::max(kLeastFacing, work.facing[v]) : work.thickness;
        if (measured[v] > 0) wanted = std::min(measured[v] / work.facing[v], kFarSkin * work.thickness);
        work.wall_caps[v] = work.is_frozen[v] ? 0 : wall.cap(v, work.directions[v], wanted);
    }
}

void find_first_caps(ExtrusionWork& work) {
    work.first_caps = work.wall_caps;
    limit_slope(work);
    work.caps = work.first_caps;
}

void find_local_caps(ExtrusionWork& work) {
    find_first_caps(work);
    std::vector<uint32_t> elements(work.triangle_count());
    for (uint32_t t = 0; t < elements.size(); ++t) elements[t] = t;
    std::vector<uint8_t> is_lowered(work.vertex_count()), is_listed(work.triangle_count());
    for (int round = 0; round < kShapeRounds && !elements.empty(); ++round) {
        std::vector<uint32_t> lowered;
        for (const uint32_t t : elements)
            if (!is_sound_at_caps(work, t))
                for (const uint32_t v : work.surface.triangles[t])
                    if (!is_lowered[v]) is_lowered[v] = 1, lowered.push_back(v);
        elements.clear();
        for (const uint32_t v : lowered) {
            work.caps[v] *= kShrink;
            is_lowered[v] = 0;
            for (const uint32_t t : work.ring[v])
                if (!is_listed[t]) is_listed[t] = 1, elements.push_back(t);
        }
        for (const uint32_t t : elements) is_listed[t] = 0;
    }
    for (uint32_t v = 0; v < work.vertex_count(); ++v)
        if (work.caps[v] < kHopeless * work.first_caps[v]) work.caps[v] = work.first_caps[v];
}

}  // namespace cullet
