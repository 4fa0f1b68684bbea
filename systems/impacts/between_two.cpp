#include "systems/impacts/between_two.hpp"

#include <algorithm>

#include "systems/impacts/balance.hpp"

namespace cullet {
namespace {

// Who weighs so many times what a body does stands, for it: no solver of so few iterations holds it up.
constexpr double kOutweighs = 20;
// Below it two that close on a body stand still, m/s: poses that a game sets far from the origin round by half of that.
constexpr double kDrivenSpeed = 1e-3;
// What lies so deep in the body, as a share of its size, squeezes it whether it could turn away or not.
constexpr double kPastTurning = 0.1;

bool is_heavy(const Bodies& bodies, Row<Bodies> body, const BodyLoad& l) {
    return l.toucher.exists() && !l.stands && bodies.mass[l.toucher] > kOutweighs * bodies.mass[body];
}

// m/s along the driver's push.
double closing_speed(const BodyLoad& by, const BodyLoad& against) {
    const Vec3d moving = against.velocity + cross(against.spin, by.place);
    return by.driven_speed - (against.is_backed ? dot(moving, by.push) : 0);
}

bool is_borne(const BodyLoad& by, std::span<const BodyLoad> loads, double reach, std::span<BodyLoad> room) {
    if (room.size() < loads.size()) return false;
    uint32_t count = 0;
    for (const BodyLoad& l : loads) {
        const bool is_his = l.toucher == by.toucher;
        if (!is_his && !l.is_backed && !l.stands) continue;
        room[count] = l;
        room[count].is_backed = !is_his;
        room[count].force = is_his;
        ++count;
    }
    return balance(room.first(count), {}, reach);
}

}  // namespace

double width_along(const BodyRows& rows, Row<Bodies> body, Vec3 way) {
    const Bodies& bodies = rows.bodies;
    if (bodies.is_sphere[body]) return 2 * double{bodies.radius[body]};
    const Row<Structures> structure = bodies.structure[body];
    if (!structure.exists()) return -1;
    const Structures& structures = rows.structures;
    const Vec3 own = rotate(conjugate(bodies.orientation[body]), way);
    const uint32_t first = structures.points[structure].first;
    double low = 1e30, high = -1e30;
    const auto include = [&](uint32_t begin, uint32_t count) {
        for (uint32_t p = first + begin; p < first + begin + count; ++p) {
            const double at = dot(own, rows.hull_points.point[p]);
            low = std::min(low, at), high = std::max(high, at);
        }
    };
    if (structures.shape_points[structure]) include(0, structures.shape_points[structure]);
    const Range cells = structures.cells[structure];
    for (uint32_t c = cells.first; c < cells.first + cells.count && !structures.shape_points[structure]; ++c)
        include(rows.cells.first_point[c], rows.cells.point_count[c]);
    return high - low + 2 * double{structures.margin[structure]};
}

Between between_two(const Bodies& bodies, Row<Bodies> body, std::span<const BodyLoad> loads, double seconds,
                    std::span<BodyLoad> room) {
    const bool is_pinned = static_cast<BodyKind>(bodies.kind[body]) != BodyKind::Dynamic;
    Between worst;
    for (const BodyLoad& by : loads) {
        const bool is_driven = by.stands && by.driven_speed > kDrivenSpeed, heavy = is_heavy(bodies, body, by);
        if (!is_driven && !heavy) continue;
        const auto look_at = [&](const BodyLoad* against) {
            Between found;
            found.by = &by, found.against = against, found.is_driven = is_driven;
            found.sunk = std::max(0.0, by.depth) + (against ? std::max(0.0, against->depth) : 0);
            if (is_driven) found.closing = against ? closing_speed(by, *against) : by.driven_speed;
            if (is_driven && !(found.closing > kDrivenSpeed)) return;
            if (found.sunk_in(seconds) > worst.sunk_in(seconds)) worst = found;
        };
        if (is_pinned) look_at(nullptr);
        for (const BodyLoad& against : loads)
            if (against.toucher != by.toucher && (against.stands || against.is_backed) &&
                are_opposite(by.push, against.push))
                look_at(&against);
    }
    const double size = 2 * double{bodies.radius[body]};
    if (worst.exists() && !is_pinned && worst.sunk < kPastTurning * size &&
        !is_borne(*worst.by, loads, double{bodies.radius[body]}, room))
        return {};
    return worst;
}

}  // namespace cullet
