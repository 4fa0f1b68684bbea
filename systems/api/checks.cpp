#include "systems/api/checks.hpp"

#include <array>

namespace cullet {

std::string text(Vec3 v) {
    return "(" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + ")";
}

Result<void> check_motion(const Motion& motion) {
    if (!is_within(motion.velocity, kFastest))
        return Error{"motion.velocity is " + text(motion.velocity) + "; give m/s, at most 100000 a component."};
    if (!is_within(motion.angular_velocity, kFastest))
        return Error{"motion.angular_velocity is " + text(motion.angular_velocity) +
                     "; give rad/s, at most 100000 a component."};
    return {};
}

Result<void> check_pose(const Pose& pose) {
    const Quat q = pose.orientation;
    const float norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    if (!is_within(pose.position, kFarthest))
        return Error{"pose.position is " + text(pose.position) +
                     "; give metres, at most 1000000 from the origin along each axis."};
    if (!(std::fabs(norm - 1) < 1e-3f))
        return Error{"pose.orientation has length " + std::to_string(std::sqrt(norm)) + "; give a unit quaternion."};
    return {};
}

Result<void> check_contact(const ContactSettings& contact) {
    if (!(contact.friction <= 100))
        return Error{"contact.friction is " + std::to_string(contact.friction) +
                     "; use 0 to 100, or less than 0 for the default."};
    if (!(contact.restitution <= 1))
        return Error{"contact.restitution is " + std::to_string(contact.restitution) +
                     "; use 0 to 1, or less than 0 for 0.2."};
    if (!(contact.rolling_friction <= 1))
        return Error{"contact.rolling_friction is " + std::to_string(contact.rolling_friction) +
                     "; use 0 to 1, or less than 0 for the default (0.01 of a ball's radius)."};
    return {};
}

Result<void> check_body(const Pose& pose, const Motion& motion, const ContactSettings& contact) {
    if (Result<void> valid = check_pose(pose); !valid) return valid;
    if (Result<void> valid = check_motion(motion); !valid) return valid;
    return check_contact(contact);
}

Result<void> check_gravity(const char* name, Vec3 gravity) {
    if (is_within(gravity, 1e4f)) return {};
    return Error{std::string(name) + " is " + text(gravity) + "; give m/s2, at most 10000 a component."};
}

namespace {

constexpr uint64_t kMostUnits = 1'000'000'000'000'000;

struct NamedLimit {
    const char* name;
    uint32_t value, least, most;
};

std::array<NamedLimit, 10> named(const LimitSettings& l) {
    return {{{"bodies", l.bodies, 1, 1u << 20},
             {"models", l.models, 1, 1u << 20},
             {"vertices", l.vertices, 4096, 1u << 26},
             {"elements", l.elements, 4096, 1u << 26},
             {"open_hits", l.open_hits, 1, 1024},
             {"view_vertices", l.view_vertices, 4096, 1u << 28},
             {"debris", l.debris, 1, 1u << 24},
             {"queued_hits", l.queued_hits, 1, 1u << 16},
             {"fragments", l.fragments, 1, 1u << 20},
             {"births_a_frame", l.births_a_frame, 1, 1u << 20}}};
}

}  // namespace

Error no_room_for(const LimitSettings& limits) {
    std::string list;
    for (const NamedLimit& limit : named(limits))
        list += std::string(list.empty() ? "" : ", ") + limit.name + " " + std::to_string(limit.value);
    return Error{"no memory for a world of Settings::limits " + list +
                 ". Lower them, or let the program have more address space."};
}

Result<void> check_settings(const Settings& s) {
    if (!(s.step_seconds >= 1.0f / 1000 && s.step_seconds <= 1.0f / 20))
        return Error{"Settings::step_seconds is " + std::to_string(s.step_seconds) + "; use 0.001 to 0.05."};
    if (const Result<void> valid = check_gravity("Settings::gravity", s.gravity); !valid) return valid;
    if (s.units_a_frame < 1000 || s.units_a_frame > kMostUnits)
        return Error{"Settings::units_a_frame is " + std::to_string(s.units_a_frame) + "; use 1000 to 1e15."};
    if (s.generations > 100)
        return Error{"Settings::generations is " + std::to_string(s.generations) + "; use 0 to 100."};
    if (!(s.break_share >= 0 && s.break_share <= 1))
        return Error{"Settings::break_share is " + std::to_string(s.break_share) + "; use 0 to 1."};
    if (s.break_elements > 1'000'000)
        return Error{"Settings::break_elements is " + std::to_string(s.break_elements) + "; use 0 to 1000000."};
    if (!(s.debris_share >= 0 && s.debris_share <= 1))
        return Error{"Settings::debris_share is " + std::to_string(s.debris_share) + "; use 0 to 1."};
    if (!(s.debris_seconds >= 0 && s.debris_seconds <= 1e6f))
        return Error{"Settings::debris_seconds is " + std::to_string(s.debris_seconds) + "; use 0 to 1000000."};
    if (!(s.hold_seconds >= 0 && s.hold_seconds <= 1))
        return Error{"Settings::hold_seconds is " + std::to_string(s.hold_seconds) + "; use 0 to 1."};
    if (s.frames_ahead > 60)
        return Error{"Settings::frames_ahead is " + std::to_string(s.frames_ahead) + "; use 0 to 60."};
    if (s.threads == 0 || s.threads > 256)
        return Error{"Settings::threads is " + std::to_string(s.threads) + "; use 1 to 256."};
    for (const NamedLimit& limit : named(s.limits))
        if (limit.value < limit.least || limit.value > limit.most)
            return Error{std::string("Settings::limits.") + limit.name + " is " + std::to_string(limit.value) +
                         "; use " + std::to_string(limit.least) + " to " + std::to_string(limit.most) + "."};
    return {};
}

Error stale(const char* what, uint32_t index) {
    return Error{std::string(what) + " handle " + std::to_string(index) +
                 " names nothing that is alive; it was removed, or never was."};
}

}  // namespace cullet
