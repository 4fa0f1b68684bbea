// What one spring is, from the surface at rest: lengths, stiffness and masses (B1, B3, B5).
#pragma once
#include <algorithm>

#include "systems/models/thick_shell/springs/spring_view.hpp"

namespace cullet {

/// Bits of ShellSprings.keeps_lengths.
inline constexpr uint8_t kKeepsLengths = 1, kIsSlender = 2;

/// Where the vertex and its inner twin stand at rest; the twin gamma times the depth inward.
template <class Rows>
Vec3d outer_rest(const SpringsIn<Rows>& view, uint32_t vertex) {
    return Vec3d(view.state.vertices.rest[view.shell.vertex(vertex)]);
}
template <class Rows>
Vec3d inner_rest(const SpringsIn<Rows>& view, uint32_t vertex) {
    const Vertices& vertices = view.state.vertices;
    const uint32_t row = view.shell.vertex(vertex);
    const double reach = double{view.own().length_factor[view.row]} * vertices.depth[row];
    return Vec3d(vertices.rest[row]) + reach * Vec3d(vertices.inward[row]);
}
/// Depth of stiffness and mass: at least a twentieth of the wanted one (section 9).
template <class Rows>
double stiff_depth(const SpringsIn<Rows>& view, uint32_t vertex) {
    const Shells& shells = view.shell.shells();
    const double floor = shells.depth_floor[view.shell.row];
    const double least = floor > 0 ? floor : 0.05 * shells.thickness[view.shell.row];
    return std::max<double>(view.state.vertices.depth[view.shell.vertex(vertex)], least);
}

/// Fills stiffness and damping of spring s from the elements on both sides of the edge of Springs.element, and its
/// layers. Lengths at rest stay, so that a piece keeps those of the edge that it was cut from; is_new measures them.
void measure_spring(const SpringView& view, uint32_t spring, bool is_new);
/// The internal spring of vertex v from its ring, and with `is_new` its length: k = min(E A / (gamma h), 10 k_skin).
void measure_twin(const SpringView& view, uint32_t vertex, bool is_new);
struct VertexSprings;
/// The same where its springs are collected already.
void measure_twin(const SpringView& view, uint32_t vertex, const VertexSprings& list, bool is_new);
/// Masses of a vertex and its twin, a sixth of each element of the ring each, from the ring.
void weigh_points(const SpringView& view, uint32_t vertex);

}  // namespace cullet
