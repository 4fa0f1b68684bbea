#include "systems/impacts/overload.hpp"

#include <algorithm>
#include <cmath>

#include "engine/principal_axes.hpp"
#include "systems/impacts/balance.hpp"
#include "systems/impacts/bending.hpp"
#include "systems/impacts/closing.hpp"
#include "systems/impacts/underlay.hpp"

namespace cullet {
namespace {

// Whoever lies deeper in it, as a share of its wall and of its size, closes on it however slowly it comes.
constexpr double kDeepInWall = 0.1, kDeepInAll = 0.01;
// What falls and lands is stopped by contacts on one side for some steps, and is no beam under a load: in a heap that
// comes down slabs broke once more. Of a load the other contacts bear all but the body's own weight.
constexpr double kBalancedShare = 0.3;
// Pushes within 2 degrees are one direction, and of so many directions no more are looked at.
constexpr double kSameWay = 0.9994;
constexpr uint32_t kMostWays = 64;
// How near the surfaces of a body and of what bears it are: a share of two walls, and at least so many margins.
constexpr double kNearBelow = 0.05, kNearMargins = 3;
// What has a solid wall below it: as far as this many walls, which cooking may have made thinner than was asked, and as
// near as what bears it may be.
constexpr double kSolidWalls = 2.5;

// Who weighs so many times what a body does stands, for it: the solver leaves them closing on it, and what lies between
// such a one and a floor is crushed, slips away, or stands in both.
constexpr double kOutweighs = 20;

// Cosine, of 72 degrees, between a push and what pushes back.
constexpr double kJammed = 0.3;

// Pa, of brittle things, when nothing around confines what is crushed.
constexpr double kCrushOverPull = 10;

/// N along and against a direction: what pushes, and what could be borne.
struct Sides {
    double along = 0, against = 0, bears_along = 0, bears_against = 0;
    double squeeze() const { return std::max(std::min(along, bears_against), std::min(against, bears_along)); }
};

// What is filled is crushed where it is squeezed with more than its strength on its mean section: blows, which tell
// what a body bears, only crack it. What is hollow crumples first.
double crushed_at(const LoadedBody& of, Vec3d push) {
    const Reach along = of.reach({push})[0];
    const double low = std::min(0.0, along.low), high = std::max(0.0, along.high);
    const double hardness = of.strength_share() * of.materials.crush_strength[of.material()];
    return std::min(hardness, kCrushOverPull * of.strength()) * of.solid_volume() / std::max(high - low, 1e-9);
}

void squeeze(const LoadedBody& body, std::span<const BodyLoad> loads, double cracks_at, Overload& worst) {
    const bool is_pinned = body.is_pinned(), is_filled = body.is_filled();
    Vec3d ways[kMostWays];
    uint32_t count = 0;
    for (const BodyLoad& of : loads) {
        const auto is_same = [&](Vec3d way) { return dot(way, of.push) > kSameWay; };
        if (!(of.force > 0) || count == kMostWays || std::any_of(ways, ways + count, is_same)) continue;
        ways[count++] = of.push;
        Sides s;
        if (is_pinned) s.bears_along = s.bears_against = kBearsAll;
        for (const BodyLoad& l : loads) {
            const double c = dot(of.push, l.push);
            (c > 0 ? s.along : s.against) += std::fabs(c) * l.force * l.spread;
            (c > 0 ? s.bears_along : s.bears_against) += std::fabs(c) * l.bears * l.spread;
        }
        const double force = s.squeeze();
        const double borne = is_filled ? std::min(cracks_at, crushed_at(body, ways[count - 1])) : cracks_at;
        worst.load = std::max(worst.load, force);
        if (force > worst.share * borne) worst.share = force / borne;
    }
}

// Where the blow that stands for the load is to fall, when nobody drives: by the hardest push of what lies on it.
const BodyLoad& hardest(std::span<const BodyLoad> loads) {
    size_t hardest = 0;
    double most = -1;
    for (const BodyLoad& l : loads) {
        const double rank = l.is_backed ? 1e-12 * l.force : l.force;
        if (rank <= most) continue;
        most = rank;
        hardest = static_cast<size_t>(&l - loads.data());
    }
    return loads[hardest];
}

ClosingBody closing_body(const LoadedBody& of) {
    const double wall = of.wall(), radius = of.bodies.radius[of.body];
    return {of.is_pinned(), radius, std::min(kDeepInWall * wall, 2 * kDeepInAll * radius)};
}

bool are_balanced(std::span<const BodyLoad> loads) {
    Vec3d net;
    for (const BodyLoad& l : loads) net += l.force * l.push;
    return length(net) < kBalancedShare * sum_of(loads);
}

// m2, between the places: exact for four corners, and never more than there is.
double area_between(std::span<const BodyLoad> loads) {
    const BodyLoad* far = &loads[0];
    for (const BodyLoad& l : loads)
        if (length(l.place - loads[0].place) > length(far->place - loads[0].place)) far = &l;
    const Vec3d diagonal = far->place - loads[0].place;
    double one_side = 0, other_side = 0;
    for (const BodyLoad& l : loads) {
        const double twice = dot(cross(diagonal, l.place - loads[0].place), loads[0].push);
        one_side = std::max(one_side, twice), other_side = std::max(other_side, -twice);
    }
    return 0.5 * (one_side + other_side);
}

// Loads of one toucher stand together. What lies flat on a solid wall crushes it by its pressure.
void spread_flat(const LoadedBody& of, std::span<BodyLoad> loads, double borne) {
    const double crush = of.strength_share() * of.materials.crush_strength[of.material()];
    for (size_t first = 0, end; first < loads.size(); first = end) {
        bool is_flat = loads[first].is_laid;
        for (end = first + 1; end < loads.size() && loads[end].toucher == loads[first].toucher; ++end)
            is_flat = is_flat && loads[end].is_laid && dot(loads[end].push, loads[first].push) > kSameWay;
        const auto touches = loads.subspan(first, end - first);
        if (!is_flat || touches.size() < 3) continue;
        const double bears = crush * area_between(touches);
        if (!(bears > borne)) continue;
        for (BodyLoad& l : touches) l.spread = borne / bears;
    }
}

// Which loads go straight through the body into who is backed there; of a pinned one, who bears them bends it no more.
void find_laid(const LoadedBody& of, const Underlay& under, double near, std::span<BodyLoad> loads, double borne) {
    const double solid = kSolidWalls * of.wall() + near;
    bool is_massive = true;
    for (BodyLoad& l : loads) {
        if (l.is_backed) continue;
        const double way = under.way_through(l.place, l.push, loads);
        l.is_laid = way >= 0;
        is_massive = is_massive && way < solid;
    }
    if (is_massive) spread_flat(of, loads, borne);
    if (!of.is_pinned()) return;
    for (BodyLoad& l : loads) {
        const auto lies_on_it = [&](const BodyLoad& o) {
            return o.is_laid && !o.is_backed && dot(o.push, l.push) < -kSameWay;
        };
        l.is_laid = l.is_laid || (l.is_backed && std::any_of(loads.begin(), loads.end(), lies_on_it));
    }
}

// Squeezed or bent. Without `under` all loads bend.
void press(const LoadedBody& of, std::span<BodyLoad> loads, Vec3d weight, const OverloadRoom& room,
           const Underlay* under, Overload& worst) {
    squeeze(of, loads, force_borne(of), worst);
    if (under) {
        const auto left = std::remove_if(loads.begin(), loads.end(), [](const BodyLoad& l) { return l.is_laid; });
        loads = loads.first(static_cast<size_t>(left - loads.begin()));
    }
    const auto may_bend = [&] { return sum_of(loads) > least_bending_force(of); };
    const auto stands = [&] {
        return of.is_pinned() || (!under && are_balanced(loads)) || balance(loads, weight, of.bodies.radius[of.body]);
    };
    if (may_bend() && stands() && may_bend()) bend(of, loads, room.forces, under, worst);
}

// Somebody else pushes it back: in rubble nothing is just opposite.
bool is_jammed(const BodyLoad& by, std::span<const BodyLoad> loads) {
    return std::any_of(loads.begin(), loads.end(),
                       [&](const BodyLoad& l) { return l.toucher != by.toucher && dot(l.push, by.push) < -kJammed; });
}

}  // namespace

double sum_of(std::span<const BodyLoad> loads) {
    double sum = 0;
    for (const BodyLoad& l : loads) sum += l.force;
    return sum;
}

double force_borne(const LoadedBody& of) {
    return of.strength_share() * of.structures.first_crack_force[of.structure()];
}

double sunk_into(const LoadedBody& of, std::span<const BodyLoad> loads) {
    const Bodies& bodies = of.bodies;
    const double heavy = kOutweighs * bodies.mass[of.body];
    const auto is_kind = [&](const BodyLoad& l, BodyKind kind) {
        return l.toucher.exists() && static_cast<BodyKind>(bodies.kind[l.toucher]) == kind;
    };
    // Who is held in the grip of a run stands for some frames, no more.
    const auto stays = [&](const BodyLoad& l) {
        return !is_kind(l, BodyKind::Dynamic) || l.is_squeezed || bodies.mass[l.toucher] > heavy;
    };
    const auto presses = [&](const BodyLoad& l) { return is_kind(l, BodyKind::Kinematic) || l.is_squeezed; };
    // What fell between two stumps, or came loose there, lies in both, and nothing closes on it.
    const bool is_in_play = std::any_of(loads.begin(), loads.end(), [&](const BodyLoad& l) {
        return presses(l) || l.driven_speed > 0 || (is_kind(l, BodyKind::Dynamic) && stays(l));
    });
    const auto counts = [&](const BodyLoad& l) { return is_in_play && (of.yields_to_weights ? stays(l) : presses(l)); };
    const bool is_filled = of.is_filled();
    double deepest = 0, sunk = 0;
    for (const BodyLoad& l : loads) {
        deepest = std::max(deepest, l.depth);
        if (of.is_pinned() && counts(l)) sunk = std::max(sunk, l.depth);
        if (is_filled && presses(l) && is_jammed(l, loads)) sunk = std::max(sunk, l.depth);
    }
    for (const BodyLoad& a : loads) {
        if (!(a.depth > 0) || a.depth + deepest <= sunk || !counts(a)) continue;
        for (const BodyLoad& b : loads) {
            // A press holds what lies on others, too, after it has stopped.
            const bool is_held = (a.is_backed || b.is_backed) && (stays(b) || (presses(a) && b.is_backed));
            if (is_held && a.toucher != b.toucher && are_opposite(a.push, b.push))
                sunk = std::max(sunk, a.depth + std::max(0.0, b.depth));
        }
    }
    return sunk;
}

Overload overload_of(const LoadedBody& of, const RigidWorld& rigid, std::span<BodyLoad> loads, Vec3d weight,
                     const OverloadRoom& room) {
    Overload at_rest;
    if (loads.empty() || room.loads.size() < loads.size()) return at_rest;
    const Closing closing = closing_on(closing_body(of), loads, room.loads);
    const BodyLoad at = closing.driver ? *closing.driver : hardest(loads);
    at_rest.is_driven = closing.driver != nullptr;
    at_rest.is_between = closing.is_between;
    at_rest.driven_speed = at_rest.is_driven ? at.driven_speed : 0;
    at_rest.falling_speed = at_rest.is_driven ? 0 : at.closing;
    at_rest.sunk = sunk_into(of, loads);
    at_rest.contact = at.contact;
    at_rest.section = of.bodies.centre[of.body] + 0.5 * at.place;
    // What is squeezed splits along the push, across its longest side.
    at_rest.section_normal = axis_across(of.bodies.inertia[of.body], at.push, Inertia::Least);
    const auto as_solved = room.loads.first(loads.size());
    std::copy(loads.begin(), loads.end(), as_solved.begin());
    Overload worst = at_rest;
    press(of, loads, weight, room, nullptr, worst);
    if (worst.is_driven || !(worst.share > 1) || !rigid.knows_surfaces()) return worst;
    // Few come so far. Contacts tell only a few places of what lies under it.
    const double near =
        std::max(kNearMargins * double{of.structures.margin[of.structure()]}, kNearBelow * 2 * of.wall());
    const Underlay under(rigid, of.bodies, of.body, near);
    find_laid(of, under, near, as_solved, force_borne(of));
    worst = at_rest;
    press(of, as_solved, weight, room, &under, worst);
    return worst;
}

}  // namespace cullet
