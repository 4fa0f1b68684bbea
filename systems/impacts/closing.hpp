// Whether those that do not yield close on a body, so that no force is enough for long.
#pragma once
#include <span>

#include "systems/impacts/overload.hpp"

namespace cullet {

struct Closing {
    const BodyLoad* driver = nullptr;  // the fastest that closes; null: nobody does
    bool is_between = false;           // and all that close touch the body themselves
};

/// How they move decides, one against the other at the same place: two walls that turn together close on nothing.
struct ClosingBody {
    bool is_pinned = false;
    double reach = 0;  // m, see balance()
    double deep = 0;   // m: whoever lies so deep in it closes on it however slowly it comes
};
/// From opposite sides, or so that what stands leaves the body no way out. `room`: for as many loads again.
Closing closing_on(const ClosingBody& body, std::span<const BodyLoad> loads, std::span<BodyLoad> room);

}  // namespace cullet
