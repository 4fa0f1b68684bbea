// Small shells for tests and measurements, written straight into the tables: constant depth, no cooking.
#pragma once
#include <array>
#include <functional>
#include <vector>

#include "components/state.hpp"

namespace cullet::test {

struct ShellMesh {
    std::vector<Vec3d> positions;
    std::vector<std::array<uint32_t, 3>> triangles;
};

/// n x n squares of side length / n in the plane z = 0, corners at 0 and (length, length). Inner points are moved by up
/// to `jitter` of the side, the diagonal's direction is hashed; jitter 0 gives right-angled triangles, one-way
/// diagonals.
ShellMesh grid_mesh(uint32_t n, double length, double jitter, uint64_t seed = 1);
/// The same square with rows of nearly equilateral triangles, n edges a side; border points stay on the border.
ShellMesh triangle_mesh(uint32_t n, double length, double jitter, uint64_t seed = 1);
/// Geodesic sphere, 10 frequency^2 + 2 vertices, in breadth-first order.
ShellMesh sphere_mesh(uint32_t frequency, double radius);

/// Linear elastic material of this density; strength etc. are those of porcelain.
Row<Materials> add_material(State& state, double young_modulus, double poisson_ratio, double density);

/// A shell of constant thickness: vertices, elements, neighbours, hinges, masses, centre, mean edge; then springs,
/// limits, rows and the time step. `is_pinned` may be empty. `spare` vertices and elements of room.
Row<Structures> make_test_shell(State& state, const ShellMesh& mesh, double thickness, Row<Materials> material,
                                const std::function<bool(Vec3d)>& is_pinned = {}, uint32_t spare = 0);

/// A task on the shell itself, without contacts.
Row<Tasks> make_test_task(State& state, Row<Structures> shell, uint32_t task = 0);
/// One hidden step of all packs, contacts included.
void step_task(State& state, Row<Tasks> task);

}  // namespace cullet::test
