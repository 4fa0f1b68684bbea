#include "systems/impacts/closing.hpp"

#include <algorithm>

#include "systems/impacts/balance.hpp"

namespace cullet {
namespace {

// Below it two that close on a body stand still, m/s: poses that a game sets far from the origin round by half of that.
// The second is for who lies deep in it already.
constexpr double kDrivenSpeed = 1e-3, kCreepingSpeed = 1e-6;

Vec3d velocity_at(const BodyLoad& l, Vec3d place) {
    return l.velocity + cross(l.spin, place);
}

double least_speed(const ClosingBody& body, const BodyLoad& driver) {
    return driver.depth > body.deep ? kCreepingSpeed : kDrivenSpeed;
}

// Of two rigid motions, along the line between the pushes, where it is less: what moves as one closes nowhere.
double closing_speed(const BodyLoad& a, const BodyLoad& b) {
    const Vec3d along = normalised(a.push - b.push);
    const auto at = [&](Vec3d place) { return dot(velocity_at(a, place) - velocity_at(b, place), along); };
    return std::min(at(a.place), at(b.place));
}

// From opposite sides.
bool are_closing(const ClosingBody& body, const BodyLoad& driver, std::span<const BodyLoad> loads, bool is_direct) {
    if (body.is_pinned) return true;
    return std::any_of(loads.begin(), loads.end(), [&](const BodyLoad& l) {
        return (is_direct ? l.stands : l.is_backed) && are_opposite(driver.push, l.push) &&
               closing_speed(driver, l) > least_speed(body, driver);
    });
}

// W, that these give to a body that does not move as they push.
double power_of(std::span<const BodyLoad> loads, const BodyLoad& seen_from) {
    double power = 0;
    for (const BodyLoad& l : loads)
        power += l.force * dot(velocity_at(l, l.place) - velocity_at(seen_from, l.place), l.push);
    return power;
}

// A push of the driver's is balanced by those that stand and do not make way, and the pushes together do work: then no
// motion of the body leaves all of them (Farkas). Seen from the driver the sum is the same but for what the balance
// leaves over.
bool has_no_way_out(const ClosingBody& body, const BodyLoad& driver, std::span<const BodyLoad> loads,
                    std::span<BodyLoad> room) {
    if (room.size() < loads.size()) return false;
    const double least = least_speed(body, driver);
    uint32_t count = 0;
    for (const BodyLoad& l : loads) {
        if (&l == &driver || !l.is_backed || l.driven_speed < -kDrivenSpeed) continue;
        room[count++] = l;
    }
    room[count] = driver;
    room[count].is_backed = false;
    room[count].force = 1;
    const auto all = room.first(count + 1);
    return balance(all, {}, body.reach) && std::min(power_of(all, BodyLoad{}), power_of(all, driver)) > least;
}

}  // namespace

Closing closing_on(const ClosingBody& body, std::span<const BodyLoad> loads, std::span<BodyLoad> room) {
    Closing closing;
    for (const BodyLoad& driver : loads) {
        if (!(driver.driven_speed > least_speed(body, driver))) continue;
        const bool is_between = driver.stands && are_closing(body, driver, loads, true);
        if (!is_between && !are_closing(body, driver, loads, false) && !has_no_way_out(body, driver, loads, room))
            continue;
        closing.is_between = closing.is_between || is_between;
        if (!closing.driver || driver.driven_speed > closing.driver->driven_speed) closing.driver = &driver;
    }
    return closing;
}

}  // namespace cullet
