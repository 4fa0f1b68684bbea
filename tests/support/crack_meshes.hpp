// Small shells for the tests of cracks, with tables filled by hand, and the checks that any history of cuts must pass.
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "components/state.hpp"

namespace cullet::crack_test {

struct TestSurface {
    std::vector<Vec3d> place;
    std::vector<std::array<uint32_t, 3>> triangle;
};
/// nx x ny squares of two triangles each, diagonals to and fro, inner vertices jittered by `jitter` of an edge.
TestSurface sheet(uint32_t nx, uint32_t ny, double width, double height, double jitter = 0);
/// Octahedron divided `levels` times, pushed out to the radius.
TestSurface sphere(uint32_t levels, double radius);
/// A closed spindle: rings of `segments` vertices between two poles, radius bellied.
TestSurface closed_lathe(uint32_t segments, uint32_t rings, double radius, double height);

/// A state with one shell in it: porcelain 4 mm thick, inner twins straight below the area-weighted normal.
struct Shell {
    std::unique_ptr<State> state;
    ShellView view;
    double mass = 0;  // of all elements when built
};
Shell make_shell_of(const TestSurface& surface, uint32_t spare_vertices, uint32_t spare_elements);

using StressField = std::function<Sym3d(Vec3 place, int face)>;
/// Elements' stress of both faces and their principal value from a field of tensors in body axes, at the centroids.
void set_stress(ShellView shell, const StressField& field);
Sym3d tension_along(Vec3 direction, double pascal);

/// A running task on the shell at elastic time `time`.
Row<Tasks> make_task(Shell& shell, double time = 0);
void set_time(Shell& shell, Row<Tasks> task, double time);

/// Empty, or a sentence naming the first rule that is broken. Links are symmetric, a vertex has one fan, and each
/// interior edge has its kind, and a hinge with the right four vertices. Crack edges come in pairs of equal place (no
/// T-junctions), and tips are only at the ends of cracks. Masses by elements and by vertices are equal to the first to
/// 1e-12.
std::string broken_rule(const Shell& shell);
/// Components over neighbour links.
std::vector<uint32_t> components(ShellView shell);  // of each element, numbered by smallest element
uint32_t component_count(ShellView shell);
/// Elements that use a vertex; 0 for dead ones.
std::vector<uint32_t> uses(ShellView shell);
uint32_t edge_count(ShellView shell);
uint32_t live_vertex_count(ShellView shell);
uint32_t vertex_near(ShellView shell, Vec3 place);

struct Motion3 {
    Vec3d momentum, angular;
    double energy;
};
Motion3 motion_of(ShellView shell);
/// Seeded velocities and displacements everywhere.
void shake(ShellView shell, uint64_t seed);

}  // namespace cullet::crack_test
