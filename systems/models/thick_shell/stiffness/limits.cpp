// Bounds on stiffness over mass, so that no cut makes anything stiffer than the time step allows (thick shell note B7).
#include <algorithm>
#include <utility>
#include <vector>

#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "systems/models/thick_shell/stiffness/element_stiffness.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

/// Ratios in 1/s2, unscaled stiffness, present vertex masses; a pinned vertex adds nothing.
double triangle_ratio(const ShellView& shell, const PlaneStress& stress, uint32_t element) {
    const uint32_t row = shell.element(element);
    const TriangleTerms terms(shell.state.triangle_springs, row, stress);
    double ratio = 0;
    for (int i = 0; i < 3; ++i)
        ratio +=
            terms.trace(i) *
            shell.state.vertices.inverse_mass[shell.vertex(shell.state.elements.corner[row][static_cast<size_t>(i)])];
    return ratio;
}

double hinge_ratio(const ShellView& shell, uint32_t hinge) {
    const uint32_t row = shell.hinge(hinge);
    const Hinges& hinges = shell.state.hinges;
    double ratio = 0;
    for (int i = 0; i < 4; ++i)
        ratio += hinge_trace(hinges, row, i) *
                 shell.state.vertices.inverse_mass[shell.vertex(hinges.vertex[row][static_cast<size_t>(i)])];
    return ratio;
}

double vertex_ratio(const ShellView& shell, const PlaneStress& stress, uint32_t vertex, const Ring& ring,
                    const RingHinges& ring_hinges) {
    const float inverse_mass = shell.state.vertices.inverse_mass[shell.vertex(vertex)];
    if (inverse_mass == 0) return 0;
    double trace = 0;
    for (uint32_t i = 0; i < ring.count; ++i)
        trace +=
            TriangleTerms(shell.state.triangle_springs, shell.element(ring.element[i]), stress).trace(ring.corner[i]);
    for (uint32_t i = 0; i < ring_hinges.count; ++i) {
        const uint32_t row = shell.hinge(ring_hinges.hinge[i]);
        for (int k = 0; k < 4; ++k)
            if (shell.state.hinges.vertex[row][static_cast<size_t>(k)] == vertex)
                trace += hinge_trace(shell.state.hinges, row, k);
    }
    return trace * inverse_mass;
}

float factor(double ratio, float limit) {
    return limit > 0 && ratio > limit ? static_cast<float>(limit / ratio) : 1.0f;
}

/// Median and largest of the kinds of item, gathered while cooking.
struct Ratios {
    std::vector<double> all;
    double largest_free = 0;
    void add(double ratio, bool is_pinned) {
        if (!(ratio > 0)) return;
        all.push_back(ratio);
        if (!is_pinned) largest_free = std::max(largest_free, ratio);
    }
    float limit() {
        if (all.empty()) return 0;
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
        std::nth_element(all.begin(), middle, all.end());
        const double four = 4 * *middle;
        return static_cast<float>(largest_free > 0 ? std::min(four, largest_free) : four);
    }
};

/// Whether the element's scale changed.
bool limit_element(const ShellView& shell, const PlaneStress& stress, uint32_t element) {
    const uint32_t row = shell.element(element);
    float scale = factor(triangle_ratio(shell, stress, element), shell.shells().triangle_limit[shell.row]);
    for (const uint32_t v : shell.state.elements.corner[row])
        scale = std::min(scale, shell.state.vertices.stiffness_scale[shell.vertex(v)]);
    return std::exchange(shell.state.triangle_springs.scale[row], scale) != scale;
}

bool limit_hinge(const ShellView& shell, uint32_t hinge) {
    const uint32_t row = shell.hinge(hinge);
    float scale = factor(hinge_ratio(shell, hinge), shell.shells().hinge_limit[shell.row]);
    for (const uint32_t v : shell.state.hinges.vertex[row])
        scale = std::min(scale, shell.state.vertices.stiffness_scale[shell.vertex(v)]);
    return std::exchange(shell.state.hinges.scale[row], scale) != scale;
}

void limit_vertex(const ShellView& shell, const PlaneStress& stress, uint32_t vertex) {
    Ring ring;
    RingHinges hinges;
    collect_ring(shell, vertex, ring);
    collect_hinges(shell, ring, hinges);
    shell.state.vertices.stiffness_scale[shell.vertex(vertex)] =
        factor(vertex_ratio(shell, stress, vertex, ring, hinges), shell.shells().vertex_limit[shell.row]);
}

}  // namespace

void measure_limits(ShellView shell) {
    const Vertices& vertices = shell.state.vertices;
    const PlaneStress stress = plane_stress(shell.state, shell.structure);
    const auto pinned = [&](uint32_t v) { return vertices.is_pinned[shell.vertex(v)] != 0; };
    Ratios triangle, hinge, vertex;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const auto& corner = shell.state.elements.corner[shell.element(e)];
        if (shell.state.elements.flags[shell.element(e)] & kDead) continue;
        triangle.add(triangle_ratio(shell, stress, e), std::any_of(corner.begin(), corner.end(), pinned));
    }
    for (uint32_t h = 0; h < shell.hinge_count(); ++h) {
        const auto& held = shell.state.hinges.vertex[shell.hinge(h)];
        if (held[0] == kNone) continue;
        hinge.add(hinge_ratio(shell, h), std::any_of(held.begin(), held.end(), pinned));
    }
    Ring ring;
    RingHinges ring_hinges;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        collect_ring(shell, v, ring);
        collect_hinges(shell, ring, ring_hinges);
        vertex.add(vertex_ratio(shell, stress, v, ring, ring_hinges), pinned(v));
    }
    shell.shells().triangle_limit[shell.row] = triangle.limit();
    shell.shells().hinge_limit[shell.row] = hinge.limit();
    shell.shells().vertex_limit[shell.row] = vertex.limit();
}

void limit_stiffness(ShellView shell, std::span<const uint32_t> vertices, VertexList& rows) {
    const PlaneStress stress = plane_stress(shell.state, shell.structure);
    for (const uint32_t v : vertices) limit_vertex(shell, stress, v);
    Ring ring;
    RingHinges hinges;
    for (const uint32_t v : vertices) {
        collect_ring(shell, v, ring);
        collect_hinges(shell, ring, hinges);
        for (uint32_t i = 0; i < ring.count; ++i) {
            if (!limit_element(shell, stress, ring.element[i])) continue;
            for (const uint32_t c : shell.state.elements.corner[shell.element(ring.element[i])]) rows.add(c);
        }
        for (uint32_t i = 0; i < hinges.count; ++i) {
            if (!limit_hinge(shell, hinges.hinge[i])) continue;
            for (const uint32_t c : shell.state.hinges.vertex[shell.hinge(hinges.hinge[i])]) rows.add(c);
        }
    }
}

void limit_all_stiffness(ShellView shell) {
    const PlaneStress stress = plane_stress(shell.state, shell.structure);
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) limit_vertex(shell, stress, v);
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        if (!(shell.state.elements.flags[shell.element(e)] & kDead)) limit_element(shell, stress, e);
    for (uint32_t h = 0; h < shell.hinge_count(); ++h)
        if (shell.state.hinges.vertex[shell.hinge(h)][0] != kNone) limit_hinge(shell, h);
}

}  // namespace cullet
