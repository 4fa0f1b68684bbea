#pragma once
#include "components/shell_rows.hpp"

namespace cullet {

/// Stress of one face at a vertex, in the tangent plane. Both faces have the same axes.
struct VertexStress {
    Vec3 axis_x, axis_y, normal;   // right-handed; normal outward
    float xx = 0, yy = 0, xy = 0;  // Pa
};

/// Area-weighted mean of the stress of the elements round the vertex, each turned into the tangent plane by the least
/// rotation (thick shell note C1), of the outer face and the inner one. Reads what stress_elements wrote. Elements
/// folded back by more than 90 degrees from the mean normal are left out. Of both at once, because finding the ring and
/// turning its axes is nearly all of the work.
std::array<VertexStress, 2> vertex_stress(ShellView shell, uint32_t vertex);

/// Principal stresses s1 >= s2 and the direction of s1, a unit vector of the tangent plane (axis_x for equal ones).
void principal(const VertexStress& stress, float& s1, float& s2, Vec3& direction1);

}  // namespace cullet
