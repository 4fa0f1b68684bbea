// From a cooked surface to rows: vertices ordered by cells, elements, hinges, masses, hulls.
#pragma once
#include <span>

#include "components/shell_rows.hpp"
#include "cullet/result.hpp"

namespace cullet {

/// A surface with depths, as plain arrays. Corner arrays hold three entries an element; those marked so may be empty.
struct ShellSource {
    std::span<const Vec3d> position;                     // m
    std::span<const Vec3d> inward;                       // unit, one a vertex
    std::span<const double> depth;                       // m, one a vertex, >= 0
    std::span<const std::array<uint32_t, 3>> corner;     // counter-clockwise from outside; every vertex one fan
    std::span<const std::array<uint32_t, 3>> neighbour;  // element across edge k (corner k to k + 1), kNone at borders
    std::span<const Vec3> corner_normal;                 // unit; empty: made from the surface
    std::span<const Vec2> corner_uv;                     // empty: zero
    std::span<const uint16_t> drawn_material;            // one an element; empty: zero
    std::span<const uint8_t> is_degenerate;              // one an element; empty: none
    double wanted_depth = 0;                             // m; mass has a floor of 0.05 of it where depth is smaller
};

/// A new shell with one user: vertices, elements, hinges (vertices only), cells and hulls, mass properties.
/// Strengths are the median. Springs, stiffness, limits, strengths and time step are filled in afterwards
/// (systems/damage). An error names the first bad
/// entry. Cost: about 10 microseconds a vertex.
Result<Row<Structures>> build_shell(ShellRows& state, const ShellSource& source, Row<Materials> material);

}  // namespace cullet
