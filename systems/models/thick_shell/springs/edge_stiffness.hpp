// What one spring is, from the surface at rest: lengths, stiffness and masses (B1, B3, B5).
#pragma once
#include "systems/models/thick_shell/springs/spring_view.hpp"

namespace cullet {

/// Bits of ShellSprings.keeps_lengths.
inline constexpr uint8_t kKeepsLengths = 1, kIsSlender = 2;

/// Where the vertex and its inner twin stand at rest; the twin gamma times the depth inward.
Vec3d outer_rest(const SpringView& view, uint32_t vertex);
Vec3d inner_rest(const SpringView& view, uint32_t vertex);
/// Depth of stiffness and mass: at least a twentieth of the wanted one (section 9).
double stiff_depth(const SpringView& view, uint32_t vertex);

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
