// Small shells for tests: generated surfaces with one depth everywhere, and cuts made by hand.
#pragma once
#include <functional>
#include <vector>

#include "components/state.hpp"
#include "systems/structures/shell/cook/build_shell.hpp"

namespace cullet {

/// The arrays behind a ShellSource.
struct SampleSurface {
    std::vector<Vec3d> position, inward;
    std::vector<double> depth;
    std::vector<std::array<uint32_t, 3>> corner, neighbour;
    double wanted_depth = 0;

    ShellSource source() const {
        ShellSource s;
        s.position = position, s.inward = inward, s.depth = depth;
        s.corner = corner, s.neighbour = neighbour;
        s.wanted_depth = wanted_depth;
        return s;
    }
};

/// An octahedron halved `rounds` times, on the sphere; 8 * 4^rounds elements.
SampleSurface sample_sphere(double radius, double depth, int rounds);
/// columns x rows squares in the plane y = 0, the normal up, `shake` of the spacing moved about; an open sheet.
SampleSurface sample_grid(double width, double length, uint32_t columns, uint32_t rows, double depth, double shake = 0);
/// A vase: closed foot, open lip; `segments` round, `rows` up.
SampleSurface sample_vase(double height, double depth, uint32_t segments, uint32_t rows);
/// Links of edges with two triangles.
void link_elements(SampleSurface& surface);

Row<Materials> sample_material(State& state, float density = 2400);

/// A copy of the shell in which the links of every edge whose two elements have different labels are cut, vertices of
/// several fans split, and masses summed anew: what a task leaves behind.
Row<Structures> cut_by_label(State& state, Row<Structures> shell, const std::function<int(uint32_t element)>& label);
/// Labels by the nearest of `count` seeded points: cracks like those of a Voronoi pattern.
std::function<int(uint32_t element)> nearest_seed(const ShellView& shell, int count, uint64_t seed);
/// Middle of the element's outer triangle.
Vec3d element_middle(const ShellView& shell, uint32_t element);

}  // namespace cullet
