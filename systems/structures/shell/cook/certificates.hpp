// Three reasons why two units of a shell (elements or rim walls) can never meet, whatever the depths up to the caps.
// Each is conservative: single precision only with a margin far above its rounding.
#pragma once
#include "systems/structures/shell/cook/extrusion_work.hpp"

namespace cullet {

/// The space a unit can ever fill is the convex hull of 6 (element) or 4 (rim wall) points.
struct Unit {
    std::array<float, 8> x, y, z;               // extreme points, the last ones repeated
    std::array<float, 3> centre, normal, push;  // push: sum of the directions
    std::array<uint32_t, 3> vertex;             // a rim wall repeats its second
    uint8_t vertex_count;
    uint32_t triangle;
};

Unit make_element(const ExtrusionWork& work, uint32_t t);
Unit make_rim(const ExtrusionWork& work, const BorderEdge& border);

/// Some plane lies between the two hulls.
bool are_hulls_apart(const Unit& a, const Unit& b);
/// Some plane through the segment of the one vertex they share has the other points of a on one side, of b on the
/// other.
bool are_split_at(const ExtrusionWork& work, const Unit& a, const Unit& b, uint32_t shared);
/// The inner face of element i never reaches the outer face of element j: it stays under the plane of j, or j lies on
/// or above the plane of i.
bool stays_below(const ExtrusionWork& work, uint32_t i, uint32_t j);

}  // namespace cullet
