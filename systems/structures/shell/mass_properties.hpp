// Mass, centre and inertia of sets of elements, from their tetrahedra.
#pragma once
#include "components/shell_rows.hpp"

namespace cullet {

/// Sums of m, m p and m p p^T about the body frame's origin. They add and subtract, so a body that loses elements needs
/// no sum over those that stay.
struct Moments {
    double mass = 0;
    Vec3d first;
    Sym3d second;
};
inline Moments operator+(const Moments& a, const Moments& b) {
    return {a.mass + b.mass, a.first + b.first, a.second + b.second};
}
inline Moments operator-(const Moments& a, const Moments& b) {
    return {a.mass - b.mass, a.first - b.first, a.second - b.second};
}

struct MassProperties {
    double mass = 0;  // kg
    Vec3d centre;     // m
    Sym3d inertia;    // about the centre, kg m2
};

/// Of one element with its stored mass: a volume's second moment is V/20 (sum p p^T + (sum p)(sum p)^T) over each
/// tetrahedron, scaled from volume to mass. A flat element (depth 0) keeps its mass as a lamina on its outer triangle.
Moments element_moments(const ShellView& shell, uint32_t element);
/// Of all live elements, in stored order.
Moments shell_moments(const ShellView& shell);
MassProperties mass_properties(const Moments& moments);
/// Back from properties to sums, for `whole - part`.
Moments moments_of(const MassProperties& properties);

/// What a shell's mass properties, area and thickness are made of.
struct ShellSums {
    Moments moments;
    double area = 0;        // m2
    double depth_area = 0;  // m3: mean depth of the corners, times area
};
inline ShellSums operator+(const ShellSums& a, const ShellSums& b) {
    return {a.moments + b.moments, a.area + b.area, a.depth_area + b.depth_area};
}
inline ShellSums operator-(const ShellSums& a, const ShellSums& b) {
    return {a.moments - b.moments, a.area - b.area, a.depth_area - b.depth_area};
}
ShellSums element_sums(const ShellView& shell, uint32_t element);
/// Back from the shell's rows.
ShellSums sums_of(const ShellView& shell);
/// Writes mass, centre, inertia, area and thickness into the shell's rows.
void write_sums(ShellView shell, const ShellSums& sums);

/// Writes mass, centre, inertia, area and thickness (mean depth by area) of the shell from its elements.
void measure_shell(ShellView shell);

/// No vertex is farther from the shell's centre, m.
float radius_of(const ShellView& shell);

/// Re-sums all vertex masses: a third of each incident element, in stored element order. Pinned and dead rows get
/// inverse mass 0.
void sum_vertex_masses(ShellView shell);

}  // namespace cullet
