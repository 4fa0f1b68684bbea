#include "systems/structures/shell/cook/extrude.hpp"

#include "systems/structures/shell/cook/front.hpp"
#include "systems/structures/shell/cook/guarded_front.hpp"
#include "systems/structures/shell/cook/local_caps.hpp"
#include "systems/structures/shell/cook/single_vertex.hpp"
#include "systems/structures/shell/cook/tetrahedra.hpp"

namespace cullet {
namespace {

constexpr int kMostRepeats = 8;

VertexRows rings_of(const Surface& surface) {
    VertexRows ring;
    ring.start.assign(surface.positions.size() + 1, 0);
    for (const Triangle& t : surface.triangles)
        for (const uint32_t v : t) ++ring.start[v + 1];
    for (size_t v = 0; v < surface.positions.size(); ++v) ring.start[v + 1] += ring.start[v];
    ring.row.resize(ring.start.back());
    std::vector<uint32_t> next(ring.start.begin(), ring.start.end() - 1);
    for (uint32_t t = 0; t < surface.triangles.size(); ++t)
        for (const uint32_t v : surface.triangles[t]) ring.row[next[v]++] = t;
    return ring;
}

double signed_volume(Vec3d a, Vec3d b, Vec3d c) {
    return dot(a, cross(b, c)) / 6;
}

// The last condition of the certificate: a closed inner surface has not passed through itself, so its volume has the
// sign of the outer one. Halves the caps of components that fail, sets them to 0 when `gives_up`.
bool has_turned_inside_out(ExtrusionWork& work, const std::vector<double>& depth, bool gives_up) {
    std::vector<double> outer(work.surface.components.size()), inner(outer.size());
    const Vec3d middle = 0.5 * (work.frame(work.surface.low) + work.frame(work.surface.high));
    for (uint32_t t = 0; t < work.triangle_count(); ++t) {
        const Triangle& c = work.surface.triangles[t];
        const auto in = [&](uint32_t v) { return work.inner(v, depth[v]) - middle; };
        const auto out = [&](uint32_t v) { return work.points[v] - middle; };
        outer[work.surface.component_of[t]] += signed_volume(out(c[0]), out(c[1]), out(c[2]));
        inner[work.surface.component_of[t]] += signed_volume(in(c[0]), in(c[1]), in(c[2]));
    }
    bool has_turned = false;
    for (uint32_t c = 0; c < outer.size(); ++c) {
        // Equal to the last bit: no depth at all, as on a closed surface folded flat.
        if (!work.surface.components[c].is_closed || outer[c] * inner[c] > 0 || outer[c] == inner[c]) continue;
        has_turned = true;
        ++work.statistics.repeats;
        for (uint32_t v = 0; v < work.vertex_count(); ++v)
            if (work.component_of_vertex[v] == c) work.caps[v] *= gives_up ? 0.0 : 0.5;
    }
    return has_turned;
}

Result<void> check(const Surface& surface, double thickness, const ExtrusionSettings& settings) {
    if (surface.triangles.empty()) return Error{"extrude: the surface has no triangles; prepare it from a mesh first."};
    if (!(thickness > 0) || !std::isfinite(thickness))
        return Error{"extrude: thickness " + std::to_string(thickness) +
                     " m must be above 0 and finite; 3 % of the diagonal (" + std::to_string(0.03 * surface.diagonal) +
                     " m) is usual."};
    if (settings.rounds < 1 || settings.rounds > 1000 || settings.extra_rounds > 1000)
        return Error{"extrude: rounds " + std::to_string(settings.rounds) + " and extra_rounds " +
                     std::to_string(settings.extra_rounds) + " must be 1 to 1000 and 0 to 1000; 5 and 12 are usual."};
    if (settings.propagation > Propagation::SingleVertexTets)
        return Error{"extrude: there is no way of propagation " +
                     std::to_string(static_cast<int>(settings.propagation)) + "; GuardedFront is usual."};
    return {};
}

// The published ways test no element, so neither do their caps, and what comes out is not made good.
bool tests_elements(Propagation way) {
    return way == Propagation::GuardedFront || way == Propagation::SingleVertexTets;
}

std::vector<double> push_inward(ExtrusionWork& work) {
    switch (work.settings.propagation) {
        case Propagation::Front:
            return run_front(work);
        case Propagation::SingleVertex:
            return run_single_vertex(work, false);
        case Propagation::SingleVertexTets:
            return run_single_vertex(work, true);
        default:
            return run_guarded_front(work);
    }
}

uint32_t count_inverted(const ExtrusionWork& work, const std::vector<double>& depth) {
    uint32_t inverted = 0;
    for (const Triangle& c : work.surface.triangles) {
        std::array<Vec3d, 3> outer, inner;
        for (size_t k = 0; k < 3; ++k) outer[k] = work.points[c[k]], inner[k] = work.inner(c[k], depth[c[k]]);
        const PrismTetrahedra tets = prism_tetrahedra(outer, inner, c);
        bool is_inverted = false;
        for (size_t k = 0; k < 3; ++k)
            is_inverted = is_inverted || (depth[c[tets.flattens[k]]] > 0 && !(tets.volume[k] > 0));
        inverted += is_inverted;
    }
    return inverted;
}

Extrusion finish(ExtrusionWork& work, const std::vector<double>& depth) {
    // Where elements are tested, none is.
    if (!tests_elements(work.settings.propagation)) work.statistics.inverted_elements = count_inverted(work, depth);
    Extrusion result;
    result.direction = std::move(work.directions);
    const double metres = 1 / work.frame.scale;
    for (uint32_t v = 0; v < work.vertex_count(); ++v) {
        result.depth.push_back(metres * depth[v]);
        result.cap.push_back(metres * work.caps[v]);
        work.statistics.depth_zero_vertices += depth[v] == 0;
    }
    for (const Triangle& t : work.surface.triangles) {
        const bool is_degenerate = depth[t[0]] == 0 || depth[t[1]] == 0 || depth[t[2]] == 0;
        result.is_degenerate_element.push_back(is_degenerate);
        work.statistics.degenerate_elements += is_degenerate;
    }
    for (std::vector<double>& state : work.path) {
        for (double& d : state) d *= metres;
        result.path.push_back(std::move(state));
    }
    result.statistics = work.statistics;
    return result;
}

}  // namespace

ExtrusionWork::ExtrusionWork(const Surface& s, double metres, const ExtrusionSettings& e)
    : surface(s),
      frame(s.low, s.diagonal),
      thickness(frame.scale * metres),
      settings(e),
      ring(rings_of(s)),
      component_of_vertex(s.positions.size()),
      directions(s.positions.size()),
      facing(s.positions.size()),
      is_frozen(s.positions.size()),
      wall_caps(s.positions.size()) {
    for (const Vec3d p : s.positions) points.push_back(frame(p));
    for (size_t t = 0; t < s.triangles.size(); ++t) {
        const Triangle& c = s.triangles[t];
        const Vec3d twice = cross(points[c[1]] - points[c[0]], points[c[2]] - points[c[0]]);
        const double l = length(twice);
        normals.push_back((1 / l) * twice);
        areas.push_back(l / 2);
        for (const uint32_t v : c) component_of_vertex[v] = s.component_of[t];
    }
}

Result<Extrusion> extrude(const Surface& surface, double thickness, const ExtrusionSettings& settings,
                          const InnerSkin* skin) {
    if (auto checked = check(surface, thickness, settings); !checked) return Error{checked.error()};
    // Beyond the diagonal nothing changes, and local coordinates stay small.
    ExtrusionWork work(surface, std::min(thickness, surface.diagonal), settings);
    choose_directions(work, skin);
    const OppositeWall wall(work, skin);
    find_wall_caps(work, wall, {});
    if (!tests_elements(settings.propagation)) {
        find_first_caps(work);
        return finish(work, push_inward(work));
    }
    find_local_caps(work);
    if (settings.straightens) straighten(work, wall);
    std::vector<double> depth = push_inward(work);
    for (int repeat = 1; repeat <= kMostRepeats && has_turned_inside_out(work, depth, repeat == kMostRepeats);
         ++repeat) {
        work.path.clear();
        depth = push_inward(work);
    }
    return finish(work, depth);
}

}  // namespace cullet
