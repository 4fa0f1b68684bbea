// Between whom a body is squeezed.
#pragma once
#include <span>

#include "components/body_rows.hpp"
#include "systems/impacts/overload.hpp"

namespace cullet {

/// Two that make no way for the body press on it from opposite sides.
struct Between {
    const BodyLoad* by = nullptr;       // who comes, or is the deeper in it
    const BodyLoad* against = nullptr;  // who stands on the other side; null: the body is pinned
    double sunk = 0;                    // m, that they lie in it together
    double closing = 0;                 // m/s, of the one who comes
    bool is_driven = false;             // no force holds up the one who comes; else it is many times as heavy

    bool exists() const { return by; }
    /// m, after so long if nothing gives way.
    double sunk_in(double seconds) const { return sunk + closing * seconds; }
};

/// The deepest such pair after `seconds`. Touches, and more: pushes of the one are borne by the others, so that the
/// body has no way out to turn or to slide.
Between between_two(const Bodies& bodies, Row<Bodies> body, std::span<const BodyLoad> loads, double seconds,
                    std::span<BodyLoad> room);

/// m, that the body takes along a way, a unit vector of the world; less than nothing where nobody knows its shape.
double width_along(const BodyRows& rows, Row<Bodies> body, Vec3 way);

}  // namespace cullet
