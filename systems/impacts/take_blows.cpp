#include <algorithm>

#include "components/body_id.hpp"
#include "systems/bodies/blows.hpp"
#include "systems/bodies/explosion.hpp"
#include "systems/models.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

// Of the speed of a rigid striker: what it gives at most to what it meets, however light that is.
constexpr float kMostReturned = 2;

struct Taking {
    WorldRows& state;
    Blows& blows;
    RigidWorld& rigid;
    const DamageModels& models;
    DamageCounts& counts;
    Events<RefusedEvent>& refused;
    uint32_t named = 0;  // blows on one body that are still to be written: what reaches many leaves them room

    bool has_shell(Row<Bodies> b) const {
        return static_cast<BodyKind>(state.bodies.kind[b]) != BodyKind::Free && state.bodies.structure[b].exists();
    }

    /// The striker of another body's hit is rigid till that ends.
    bool may_move_by_itself(Row<Bodies> b) const { return !state.bodies.hold_count[b]; }
    /// It comes from outside.
    void book(Row<Bodies> b, Vec3d impulse) {
        if (static_cast<BodyKind>(state.bodies.kind[b]) != BodyKind::Dynamic) return;
        const Vec3d booked(rotate(state.bodies.orientation[b], impulse.to_float()));
        for (int k = 0; k < 3; ++k) counts.impulse_to_static[k] -= booked[k];
    }
    /// False: no model moves the body by itself.
    bool push_points(uint32_t row) {
        const Row<Bodies> body = blows.body[row];
        const Row<Structures> structure = state.bodies.structure[body];
        if (!structure.exists() || !may_move_by_itself(body)) return false;
        const PointPush push{blows.point[row], blows.impulse[row].to_float(),
                             calls_of(state.structures, structure).patch_radius(state, structure, blows.radius[row]),
                             kMostReturned * blows.speed[row]};
        if (!models.push(state, rigid, body, push)) return false;
        book(body, blows.impulse[row]);
        return true;
    }

    /// A copy of the blow for this body, at the end; kNone where there is no room.
    uint32_t copy_for(uint32_t row, Row<Bodies> body) {
        const bool has_room = blows.size() + named < blows.limit();
        const uint32_t made = has_room ? blows.append(1) : kNone;
        if (made == kNone) {
            refused.push(refused_event(state.bodies, body, "limits.queued_hits"));
            return kNone;
        }
        blows.copy_rows(blows, row, made, 1);
        blows.body[made] = body;
        return made;
    }

    /// Where the push meets the surface. What has no structure is met where the game says.
    Vec3 place_of_push(uint32_t row) const {
        const Row<Bodies> body = blows.body[row];
        if (!has_shell(body)) return blows.point[row];
        const Row<Structures> structure = state.bodies.structure[body];
        return calls_of(state.structures, structure).nearest_point(state, structure, blows.point[row]);
    }

    // The striker bounces off as a rigid one: J = (1 + e) v / (1/m_body + 1/m_striker).
    void measure_push(uint32_t row) {
        const Row<Bodies> body = blows.body[row];
        blows.point.set(row, place_of_push(row));
        const Vec3d point(blows.point[row]), normal(blows.direction[row]);
        const double both = inverse_mass_at(state.bodies, body, point, normal) + double{blows.inverse_mass[row]};
        const double size = (1 + double{state.bodies.restitution[body]}) * double{blows.speed[row]} / both;
        blows.impulse.set(row, size * normal);
        blows.turning.set(row, cross(point - state.bodies.centre[body], size * normal));
    }

    void explode_ball(uint32_t row, Row<Bodies> body) {
        const Bodies& bodies = state.bodies;
        const Vec3d away = Vec3d(centre_of(bodies, body) - blows.point[row]);
        const double distance = length(away);
        const double size =
            impulse_on_ball(distance, double{bodies.radius[body]}, blows.radius[row], blows.strength[row]);
        if (!(size > 0)) return;
        const Vec3 along = rotate(conjugate(bodies.orientation[body]), ((1 / distance) * away).to_float());
        push_body(state.bodies, rigid, counts, body, size * Vec3d(along), {});
    }

    void explode_shell(uint32_t row, Row<Bodies> body) {
        const Bodies& bodies = state.bodies;
        Explosion explosion = explosion_of(blows, row);
        explosion.centre = to_body(pose_of(bodies, body), explosion.centre);
        const Row<Structures> structure = bodies.structure[body];
        const ExplosionSums sums =
            calls_of(state.structures, structure).measure_explosion(state, structure, explosion, bodies.centre[body]);
        if (!(sums.size > 0)) return;
        if (may_move_by_itself(body) && models.explode(state, rigid, body, explosion)) return book(body, sums.impulse);
        if (!bodies.is_breakable[body]) return push_body(state.bodies, rigid, counts, body, sums.impulse, sums.turning);
        const uint32_t made = copy_for(row, body);
        if (made == kNone) return push_body(state.bodies, rigid, counts, body, sums.impulse, sums.turning);
        blows.point.set(made, explosion.centre);
        blows.impulse.set(made, sums.impulse);
        blows.turning.set(made, sums.turning);
        blows.speed[made] = sums.speed;
        // The way the body is pushed: events tell it.
        blows.direction.set(made, normalised(sums.impulse).to_float());
    }

    void explode(uint32_t row) {
        const Bodies& bodies = state.bodies;
        for (uint32_t b = 0; b < bodies.size(); ++b) {
            const Row<Bodies> body(b);
            const auto kind = static_cast<BodyKind>(bodies.kind[b]);
            const bool is_hit = kind == BodyKind::Dynamic || (kind == BodyKind::Static && has_shell(body));
            if (!is_hit) continue;
            const float away = length(centre_of(bodies, body) - blows.point[row]);
            if (away > blows.radius[row] + bodies.radius[b]) continue;
            if (has_shell(body))
                explode_shell(row, body);
            else if (bodies.is_sphere[b])
                explode_ball(row, body);
        }
    }

    void cut(uint32_t row) {
        const uint32_t bodies = state.bodies.size();
        for (uint32_t b = 0; b < bodies; ++b) {
            const Row<Bodies> body(b);
            if (!has_shell(body) || !state.bodies.is_breakable[b]) continue;
            const uint32_t made = copy_for(row, body);
            if (made == kNone) continue;
            const Pose pose = pose_of(state.bodies, b);
            blows.point.set(made, to_body(pose, blows.point[made]));
            blows.direction.set(made, rotate(conjugate(pose.orientation), blows.direction[made]));
            for (uint32_t i = 0; i < blows.point_count[made]; ++i)
                set_cut_point(blows, made, i, to_body(pose, cut_point(blows, made, i)));
            const Row<Structures> structure = state.bodies.structure[b];
            const bool passes = calls_of(state.structures, structure).is_cut_by(state, structure, blows, made);
            // What cannot be cut is told, not left in silence.
            const char* const why = passes ? models.why_not_cut(state, body) : nullptr;
            if (why) refused.push(refused_event(state.bodies, body, why));
            if (!passes || why) remove_blow(blows, made);
        }
    }
};

}  // namespace

// New rows stand behind those that wait. Each is written anew at the end, once for each body that it reaches, and then
// the old ones go: rows keep the order of the calls, and in it that of the bodies.
void take_blows(Serial, Blows& blows, WorldRows& rows, RigidWorld& rigid, const DamageModels& models,
                DamageCounts& counts, Events<RefusedEvent>& refused) {
    if (blows.size() == 0) return;
    Bodies& bodies = rows.bodies;
    Taking taking{rows, blows, rigid, models, counts, refused};
    uint32_t first = 0;
    while (first < blows.size() && blows.is_taken[first]) ++first;
    const uint32_t end = blows.size();
    for (uint32_t row = first; row < end; ++row) taking.named += blows.body[row].exists();
    for (uint32_t row = first; row < end; ++row) {
        const Row<Bodies> body = blows.body[row];
        if (!body.exists()) {
            if (is_kind(blows, row, BlowKind::Explosion))
                taking.explode(row);
            else
                taking.cut(row);
            continue;
        }
        --taking.named;
        if (is_kind(blows, row, BlowKind::Push)) {
            taking.measure_push(row);
            if (taking.push_points(row)) continue;
            if (!taking.has_shell(body) || !bodies.is_breakable[body]) {
                pay_blow(blows, bodies, rigid, counts, row);
                continue;
            }
        }
        // Where there is no room the body is at least moved.
        if (taking.copy_for(row, body) == kNone) pay_blow(blows, bodies, rigid, counts, row);
    }
    const uint32_t made = blows.size() - end;
    if (made && end > first) blows.copy_rows(blows, end, first, made);
    blows.truncate(first + made);
}

}  // namespace cullet
