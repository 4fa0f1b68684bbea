// Pieces that came of one body, and what struck it, do not throw each other off.
#pragma once
#include <algorithm>
#include <span>

#include "engine/rigid_world.hpp"
#include "systems/births/make_break.hpp"
#include "systems/births/moment.hpp"

namespace cullet {

/// Of a fragment, body frame.
struct PieceBounds {
    Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
    void add(Vec3 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
};

/// What is left of the body is one of them.
void name_siblings(Births& births, const Break& of);

/// New pieces start in touch with each other, and with what struck them. What a cut or a tear parts has no motion of
/// its own that would take it out of its sibling: unmet, the upper half of a vase fell 30 cm into the lower one and
/// stayed there. Such pieces meet at once; their overlap is pushed out without adding velocity. `bounds`: of each
/// fragment in turn.
void part_siblings(Births& births, const Break& of, const Moment& moment, std::span<const PieceBounds> bounds);

/// A striker beside the shards it made is not tested against them for a while.
void part_strikers(Births& births, const Break& of, bool is_late);

}  // namespace cullet
