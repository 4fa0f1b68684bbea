// Blows that a game asks for. Here they are looked at and queued; the next step takes them (take_blows).
#include "components/body_id.hpp"
#include "engine/host_scope.hpp"
#include "systems/api/checks.hpp"
#include "systems/models.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

constexpr float kLeastMass = 1e-6f, kMostMass = 1e9f, kMostStrength = 1e9f;

bool is_from_to(float value, float least, float most) {
    return value >= least && value <= most;
}

Result<void> check_place(const char* name, Vec3 place) {
    if (is_within(place, kFarthest)) return {};
    return Error{std::string(name) + " is " + text(place) +
                 "; give metres, at most 1000000 from the origin along each axis."};
}

Result<void> check_unit(const char* name, Vec3 v) {
    if (std::fabs(dot(v, v) - 1) < 2e-3f) return {};
    return Error{std::string(name) + " is " + text(v) + "; give a vector of length 1."};
}

Result<void> check_number(const char* name, float value, float least, float most, const char* unit) {
    if (is_from_to(value, least, most)) return {};
    return Error{std::string(name) + " is " + std::to_string(value) + "; use " + unit + "."};
}

/// Room for one more, or a sentence. Half of the table stays free: take_blows writes each row anew behind the others.
Result<uint32_t> take_row(Blows& blows, BlowKind kind) {
    const uint32_t row = blows.size() < blows.limit() / 2 ? blows.append(1) : kNone;
    if (row == kNone)
        return Error{std::to_string(blows.size()) +
                     " blows wait already; step the world, or raise limits.queued_hits."};
    blows.kind[row] = static_cast<uint8_t>(kind);
    blows.body[row] = {};
    blows.task[row] = kNone;
    return row;
}

Result<void> check_push(const PushSettings& p) {
    if (Result<void> valid = check_place("push.place", p.place); !valid) return valid;
    if (Result<void> valid = check_unit("push.normal", p.normal); !valid) return valid;
    if (!(p.approach_speed > 0 && p.approach_speed <= kFastest))
        return Error{"push.approach_speed is " + std::to_string(p.approach_speed) +
                     "; use m/s above 0, at most 100000."};
    if (Result<void> valid = check_number("push.mass", p.mass, kLeastMass, kMostMass, "1e-6 to 1e9 kg"); !valid)
        return valid;
    return check_number("push.radius", p.radius, 0, 1e4f, "0 (flat) to 10000 m");
}

Result<void> check_explosion(const ExplosionSettings& e) {
    if (Result<void> valid = check_place("explosion.centre", e.centre); !valid) return valid;
    if (Result<void> valid = check_number("explosion.radius", e.radius, 1e-3f, 1e5f, "0.001 to 100000 m"); !valid)
        return valid;
    if (Result<void> valid = check_number("explosion.impulse", e.impulse, 0, kMostStrength, "0 to 1e9 N s/m2"); !valid)
        return valid;
    if (Result<void> valid = check_number("explosion.pressure", e.pressure, 0, 1e12f, "0 to 1e12 Pa"); !valid)
        return valid;
    if (Result<void> valid = check_number("explosion.seconds", e.seconds, 0, 10, "0 to 10 s"); !valid) return valid;
    const double strength = double{e.impulse} + double{e.pressure} * double{e.seconds};
    if (strength > 0 && strength <= double{kMostStrength}) return {};
    return Error{"explosion.impulse + pressure * seconds is " + std::to_string(strength) +
                 "; give above 0 and at most 1e9 N s/m2."};
}

Result<void> check_cut(const CutSettings& c) {
    if (c.point_count == 0) {
        if (Result<void> valid = check_place("cut.place", c.place); !valid) return valid;
        return check_unit("cut.normal", c.normal);
    }
    if (c.point_count < 2 || c.point_count > kMostCutPoints || !c.points)
        return Error{"cut.points has " + std::to_string(c.points ? c.point_count : 0) + " points; give 2 to " +
                     std::to_string(kMostCutPoints) + ", or none for a plane."};
    for (uint32_t i = 0; i < c.point_count; ++i)
        if (Result<void> valid = check_place(("cut.points[" + std::to_string(i) + "]").c_str(), c.points[i]); !valid)
            return valid;
    if (Result<void> valid = check_unit("cut.direction", c.direction); !valid) return valid;
    float longest = 0;
    for (uint32_t i = 0; i + 1 < c.point_count; ++i)
        longest = std::max(longest, length(cross(c.points[i + 1] - c.points[i], c.direction)));
    if (longest > 0) return {};
    return Error{"cut.points lie in one line along cut.direction, and sweep no surface; move them or turn it."};
}

/// Why the body cannot be cut, and what to do; empty: it can.
std::string why_not_cut(const State& state, const DamageModels& models, Row<Bodies> body) {
    if (!state.bodies.structure[body].exists()) return "it was not spawned from a model; cut one that was";
    if (const char* const why = models.why_not_cut(state, body)) return why;
    if (state.bodies.is_breakable[body]) return {};
    return "it was spawned to stay whole; spawn it with is_breakable and a strength_scale that can be reached";
}

}  // namespace

Result<void> World::push_impact(BodyId id, const PushSettings& push) {
    const HostScope call(contents_->host);
    State& state = contents_->data.state;
    const Row<Bodies> body = body_row(state.bodies, id);
    if (!body.exists()) return stale("body", id.index);
    if (Result<void> valid = check_push(push); !valid) return valid;
    if (contents_->recorder) contents_->recorder->push_impact(id, push);
    const Result<uint32_t> row = take_row(state.blows, BlowKind::Push);
    if (!row) return Error{row.error()};
    const Pose pose = pose_of(state.bodies, body);
    Blows& blows = state.blows;
    blows.body[*row] = body;
    blows.point.set(*row, to_body(pose, push.place));
    blows.direction.set(*row, rotate(conjugate(pose.orientation), normalised(push.normal)));
    blows.speed[*row] = push.approach_speed;
    blows.inverse_mass[*row] = 1 / push.mass;
    blows.radius[*row] = push.radius;
    return {};
}

Result<void> World::explode(const ExplosionSettings& explosion) {
    const HostScope call(contents_->host);
    if (Result<void> valid = check_explosion(explosion); !valid) return valid;
    if (contents_->recorder) contents_->recorder->explode(explosion);
    Blows& blows = contents_->data.state.blows;
    const Result<uint32_t> row = take_row(blows, BlowKind::Explosion);
    if (!row) return Error{row.error()};
    blows.point.set(*row, explosion.centre);
    blows.radius[*row] = explosion.radius;
    blows.strength[*row] = explosion.impulse + explosion.pressure * explosion.seconds;
    return {};
}

Result<void> World::cut(BodyId id, const CutSettings& cut) {
    const HostScope call(contents_->host);
    State& state = contents_->data.state;
    const Row<Bodies> body = body_row(state.bodies, id);
    if (!(id == BodyId{})) {
        if (!body.exists()) return stale("body", id.index);
        if (const std::string why = why_not_cut(state, *contents_->data.damage_models, body); !why.empty())
            return Error{"body " + std::to_string(id.index) + " is not breakable, and cannot be cut: " + why + "."};
    }
    if (Result<void> valid = check_cut(cut); !valid) return valid;
    if (contents_->recorder) contents_->recorder->cut(id, cut);
    const Result<uint32_t> row = take_row(state.blows, BlowKind::Cut);
    if (!row) return Error{row.error()};
    Blows& blows = state.blows;
    // In the body's frame at once where there is one body.
    const Pose pose = body.exists() ? pose_of(state.bodies, body) : Pose{};
    blows.body[*row] = body;
    blows.point.set(*row, cut.point_count ? Vec3{} : to_body(pose, cut.place));
    blows.direction.set(*row,
                        rotate(conjugate(pose.orientation), normalised(cut.point_count ? cut.direction : cut.normal)));
    blows.point_count[*row] = cut.point_count;
    for (uint32_t i = 0; i < cut.point_count; ++i) set_cut_point(blows, *row, i, to_body(pose, cut.points[i]));
    return {};
}

}  // namespace cullet
