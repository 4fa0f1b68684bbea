// Between rows of Bodies and what the game keeps.
#pragma once
#include "components/bodies.hpp"
#include "cullet/events.hpp"

namespace cullet {

inline BodyId body_id(const Bodies& bodies, Row<Bodies> b) {
    return b.exists() ? BodyId{b.index, bodies.generation[b]} : BodyId{};
}
/// The row of a live body, or a row that does not exist.
inline Row<Bodies> body_row(const Bodies& bodies, BodyId id) {
    const bool is_alive = id.generation != 0 && id.index < bodies.size() &&
                          bodies.generation[id.index] == id.generation &&
                          static_cast<BodyKind>(bodies.kind[id.index]) != BodyKind::Free;
    return is_alive ? Row<Bodies>(id.index) : Row<Bodies>();
}
/// It is there and moves by forces.
inline bool is_dynamic(const Bodies& bodies, Row<Bodies> b) {
    return b.exists() && static_cast<BodyKind>(bodies.kind[b]) == BodyKind::Dynamic;
}
inline Pose pose_of(const Bodies& bodies, uint32_t b) {
    return {bodies.position[b], bodies.orientation[b]};
}

/// World, m.
inline Vec3 centre_of(const Bodies& bodies, Row<Bodies> b) {
    return to_world(pose_of(bodies, b), bodies.centre[b].to_float());
}

inline RefusedEvent refused_event(const Bodies& bodies, Row<Bodies> b, const char* setting) {
    return {body_id(bodies, b), bodies.user_data[b], centre_of(bodies, b), setting};
}
/// What RefusedEvent names where a body's cracks have filled the room that they were given. That room is a share of its
/// mesh; a finer mesh has more.
inline constexpr const char* kCrackRoom = "longest_edge";

}  // namespace cullet
