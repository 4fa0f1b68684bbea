#include <algorithm>
#include <optional>

#include "components/body_id.hpp"
#include "systems/bodies/thresholds.hpp"
#include "systems/impacts/between_two.hpp"
#include "systems/impacts/load_lists.hpp"
#include "systems/models.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

constexpr double kSqueezed = 0.01;  // of the size: what cannot give way is held from there on
// What yields in its shape does so until it is as flat as its model says, or as this share of its size.
constexpr double kFlatShare = 0.03;
// Of the room, that the centre of what is in both alike is away from either, at least: none is kept for what goes
// along.
constexpr float kLeastAway = 1e-3f;

double size_of(const Bodies& bodies, Row<Bodies> body) {
    return 2 * double{bodies.radius[body]};
}

bool is_there(const Bodies& bodies, Row<Bodies> body, uint32_t generation) {
    return body < bodies.size() && bodies.generation[body] == generation &&
           static_cast<BodyKind>(bodies.kind[body]) != BodyKind::Free;
}

Vec3 velocity_at(const Bodies& bodies, Row<Bodies> b, Vec3 point) {
    return bodies.velocity[b] + cross(bodies.spin[b], point - centre_of(bodies, b));
}

// J, of moving it so.
double work_against(const Bodies& bodies, Row<Bodies> body, Vec3 way, Vec3 gravity) {
    return -bodies.mass[body] * double{dot(gravity, way)};
}

uint32_t row_of(const Squeezes& squeezes, Row<Bodies> body) {
    uint32_t row = 0;
    while (row < squeezes.size() && squeezes.body[row] != body) ++row;
    return row < squeezes.size() ? row : kNone;
}
bool goes_along(const Squeezes& squeezes, uint32_t row) {
    return row != kNone && !(squeezes.share[row] > 0);
}

// It comes apart under what does not yield.
bool may_come_apart(const WorldRows& rows, const DamageSettings& settings, Row<Bodies> body) {
    const Row<Structures> structure = rows.bodies.structure[body];
    return structure.exists() && rows.bodies.is_breakable[body] && calls_of(rows.structures, structure).bears_loads &&
           may_be_crushed(rows.structures, structure, settings);
}

// It makes way for nobody, or for who is in it alone: nothing is left that could give way before. What is free may be
// pushed on, bends, or is held like that once it can do neither.
bool stays(const WorldRows& rows, const DamageSettings& settings, Row<Bodies> who) {
    const Bodies& bodies = rows.bodies;
    if (!who.exists()) return true;
    const auto kind = static_cast<BodyKind>(bodies.kind[who]);
    if (kind == BodyKind::Dynamic) {
        const uint32_t row = row_of(rows.squeezes, who);
        return row != kNone && !goes_along(rows.squeezes, row);
    }
    return kind == BodyKind::Kinematic || !may_come_apart(rows, settings, who) ||
           !may_be_halved(rows.structures, bodies.structure[who], settings);
}

struct Holding {
    Step step;
    RigidWorld& rigid;
    WorldRows& rows;
    DamageCounts& counts;

    /// In both alike, or, without a width, going as `by` does: what is against it gives way.
    void begin(Row<Bodies> body, const Between& between, std::optional<double> width);
    /// False: it has room again, or one of the three is gone.
    bool go_on(uint32_t row);
    void let_go(uint32_t row);
    void put(Row<Bodies> body, Vec3 velocity, Vec3 way);
};

// Whatever moved it, it moves so from now on.
void Holding::put(Row<Bodies> body, Vec3 velocity, Vec3 way) {
    Bodies& bodies = rows.bodies;
    const double square = double{dot(velocity, velocity)},
                 before = double{dot(bodies.velocity[body], bodies.velocity[body])};
    counts.work_from_outside += std::max(0.0, work_against(bodies, body, way, step.gravity)) +
                                0.5 * bodies.mass[body] * std::max(0.0, square - before);
    bodies.velocity.set(body, velocity);
    bodies.spin.set(body, {});
    rigid.set_motion(body, {velocity, {}});
    if (way == Vec3{}) return;
    rigid.carry(body, way);
    bodies.position.set(body, rigid.pose(body).position);
}

void Holding::begin(Row<Bodies> body, const Between& between, std::optional<double> width) {
    Squeezes& squeezes = rows.squeezes;
    Bodies& bodies = rows.bodies;
    const uint32_t before = row_of(squeezes, body), row = before != kNone ? before : squeezes.append(1);
    if (row == kNone) return;
    const Row<Bodies> by = between.by->toucher, against = between.against->toucher;
    const Vec3 push = rotate(bodies.orientation[body], normalised(between.by->push - between.against->push).to_float());
    const Vec3 centre = centre_of(bodies, body);
    squeezes.clear_rows(row, 1);
    squeezes.body[row] = body, squeezes.by[row] = by, squeezes.against[row] = against;
    squeezes.generation[row] = bodies.generation[body];
    squeezes.generation_by[row] = bodies.generation[by];
    squeezes.generation_against[row] = bodies.generation[against];
    squeezes.push.set(row, push);
    if (width) {
        squeezes.room[row] = static_cast<float>(*width - between.sunk);
        const double from = std::max(0.0, -dot(between.by->place, between.by->push)),
                     to = std::max(0.0, -dot(between.against->place, between.against->push));
        const float share = from + to > 0 ? static_cast<float>(from / (from + to)) : 0.5f;
        squeezes.share[row] = std::clamp(share, kLeastAway, 1 - kLeastAway);
    }
    squeezes.point_by.set(row, to_body(pose_of(bodies, by), centre));
    squeezes.point_against.set(row, to_body(pose_of(bodies, against), centre));
    if (before == kNone) {
        rigid.hold(body);
        ++bodies.hold_count[body];
        bodies.is_asleep[body] = 0;
    }
    put(body, width ? Vec3{} : velocity_at(bodies, by, centre), {});
}

bool Holding::go_on(uint32_t row) {
    Squeezes& squeezes = rows.squeezes;
    Bodies& bodies = rows.bodies;
    const Row<Bodies> body = squeezes.body[row], by = squeezes.by[row], against = squeezes.against[row];
    const float share = squeezes.share[row], far = 2 * bodies.radius[body];
    if (!is_there(bodies, by, squeezes.generation_by[row]) || !is_there(bodies, body, squeezes.generation[row]) ||
        !is_dynamic(bodies, body))
        return false;
    if (share > 0 && !is_there(bodies, against, squeezes.generation_against[row])) return false;
    rigid.hold(body);  // a hit that held it may have ended
    const Vec3 centre = centre_of(bodies, body), push = squeezes.push[row];
    const auto moved = [&](Row<Bodies> who, Vec3 point) {
        const bool moves = static_cast<BodyKind>(bodies.kind[who]) != BodyKind::Static;
        return moves ? to_world(pose_of(bodies, who), point) - centre : Vec3{};
    };
    const Vec3 way_by = moved(by, squeezes.point_by[row]),
               way_against = share > 0 ? moved(against, squeezes.point_against[row]) : Vec3{};
    if (length(way_by) > far || length(way_against) > far) return false;
    if (share > 0) {
        squeezes.room[row] += dot(push, way_against - way_by);
        const double slack = kSqueezed * size_of(bodies, body);  // so deep it may have been when it began
        if (double{squeezes.room[row]} >= width_along(rows, body, push) + slack) return false;
    }
    const Vec3 way = (1 - share) * way_by + share * way_against;
    put(body, (1 / step.dt) * way, way);
    const Vec3 now = centre_of(bodies, body);
    squeezes.point_by.set(row, to_body(pose_of(bodies, by), now));
    if (share > 0) squeezes.point_against.set(row, to_body(pose_of(bodies, against), now));
    return true;
}

// It goes free at rest. Behind a sheet it would be gone.
void Holding::let_go(uint32_t row) {
    Bodies& bodies = rows.bodies;
    const Row<Bodies> body = rows.squeezes.body[row];
    const bool is_there_still = is_there(bodies, body, rows.squeezes.generation[row]);
    remove_squeeze(rows.squeezes, row);
    if (!is_there_still || bodies.hold_count[body] == 0) return;
    put(body, {}, {});
    if (--bodies.hold_count[body] == 0) rigid.release(body);
    const Vec3 before = centre_of(bodies, body);
    rigid.set_pose(body, pose_of(bodies, body));
    bodies.position.set(body, rigid.pose(body).position);
    counts.work_from_outside +=
        std::max(0.0, work_against(bodies, body, centre_of(bodies, body) - before, step.gravity));
}

// It cannot give way, or not any more. What comes apart does so before; what yields in its shape has a dent to come.
bool is_at_its_end(const WorldRows& rows, const DamageLedger& ledger, Row<Bodies> body, const Between& between,
                   double width, double dt) {
    const double size = size_of(rows.bodies, body);
    if (!may_come_apart(rows, ledger.settings, body)) return between.sunk_in(dt) > kSqueezed * size;
    const std::optional<double> flat = ledger.models.least_width(rows, body);
    return flat && between.sunk > kSqueezed * size && width - between.sunk < std::max(*flat, kFlatShare * size);
}

// Who pushes it lies in it, and so does somebody on the other side, whoever that is now.
bool is_still_between(const WorldRows& rows, uint32_t row, std::span<const BodyLoad> loads) {
    const Squeezes& squeezes = rows.squeezes;
    const Vec3d push(rotate(conjugate(rows.bodies.orientation[squeezes.body[row]]), squeezes.push[row]));
    bool is_by = false, is_against = false;
    for (const BodyLoad& l : loads) {
        if (!(l.depth > 0)) continue;
        if (l.toucher == squeezes.by[row])
            is_by = true;
        else
            is_against = is_against || ((l.stands || l.is_backed) && are_opposite(push, l.push));
    }
    return is_by && is_against;
}

SqueezedEvent event_of(const Bodies& bodies, Row<Bodies> body, Row<Bodies> by) {
    return {body_id(bodies, body), body_id(bodies, by), bodies.user_data[body], bodies.user_data[by],
            centre_of(bodies, body)};
}

}  // namespace

void hold_squeezed(Serial, Step step, RigidWorld& rigid, WorldRows& rows, DamageLedger ledger, Arena& arena,
                   Events<SqueezedEvent>& told) {
    if (!rigid.knows_surfaces()) return;
    Bodies& bodies = rows.bodies;
    Squeezes& squeezes = rows.squeezes;
    Holding holding{step, rigid, rows, ledger.counts};
    for (uint32_t row = 0; row < squeezes.size();) {
        if (holding.go_on(row))
            ++row;
        else
            holding.let_go(row);
    }
    if (squeezes.size() == 0 && !is_anything_driven(bodies)) return;
    const LoadLists lists(bodies, squeezes, rigid.loads(), step, arena);
    const auto found = arena.take<BodyLoad>(lists.longest()), room = arena.take<BodyLoad>(lists.longest());
    const double dt = double{step.dt};
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const Row<Bodies> body(b);
        if (!is_dynamic(bodies, body)) continue;
        const uint32_t row = row_of(squeezes, body);
        if (bodies.hold_count[b] && !goes_along(squeezes, row)) continue;
        auto loads = found.first(lists.has_loads(body) ? lists.take(body, found) : 0);
        // What was ground in this step is gone.
        const auto gone = std::remove_if(loads.begin(), loads.end(), [&](const BodyLoad& l) {
            return static_cast<BodyKind>(bodies.kind[l.toucher]) == BodyKind::Free;
        });
        loads = {loads.begin(), gone};
        const auto is_squeezed = [&](const Between& between) {
            return between.exists() && between.is_driven && between.against &&
                   between.sunk_in(dt) > kSqueezed * size_of(bodies, body);
        };
        // Those between whom it has no room, whatever else gives way.
        const auto yielding = std::partition(loads.begin(), loads.end(), [&](const BodyLoad& l) {
            return l.driven_speed > 0 || stays(rows, ledger.settings, l.toucher);
        });
        Between between = between_two(bodies, body, {loads.begin(), yielding}, dt, room);
        const bool is_final = is_squeezed(between);
        if (!is_final && row != kNone) {
            if (!is_still_between(rows, row, loads)) holding.let_go(row);
            continue;
        }
        if (!is_final) between = between_two(bodies, body, loads, dt, room);
        if (!is_squeezed(between)) continue;
        if (ledger.models.call_up(rows, body)) continue;
        const Vec3 push =
            rotate(bodies.orientation[body], normalised(between.by->push - between.against->push).to_float());
        const double width = width_along(rows, body, push);
        if (width < 0 || !is_at_its_end(rows, ledger, body, between, width, dt)) continue;
        holding.begin(body, between, is_final ? std::optional(width) : std::nullopt);
        if (is_final) told.push(event_of(bodies, body, between.by->toucher));
    }
}

}  // namespace cullet
