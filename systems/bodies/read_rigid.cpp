#include "components/body_id.hpp"
#include "systems/systems.hpp"

namespace cullet {

void read_rigid(Serial, const RigidWorld& rigid, Bodies& bodies, Events<AsleepEvent>& asleep) {
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const auto kind = static_cast<BodyKind>(bodies.kind[b]);
        if (kind != BodyKind::Dynamic && kind != BodyKind::Kinematic) continue;
        const Pose pose = rigid.pose(b);
        bodies.position.set(b, pose.position);
        bodies.orientation.set(b, pose.orientation);
        if (bodies.hold_count[b]) continue;  // its rows keep the velocity that it will go on with
        const Motion motion = rigid.motion(b);
        bodies.velocity.set(b, motion.velocity);
        bodies.spin.set(b, motion.angular_velocity);
        const bool is_asleep = kind == BodyKind::Dynamic && rigid.is_asleep(b);
        if (is_asleep && !bodies.is_asleep[b])
            asleep.push({body_id(bodies, Row<Bodies>(b)), bodies.user_data[b], centre_of(bodies, Row<Bodies>(b))});
        bodies.is_asleep[b] = is_asleep;
    }
}

}  // namespace cullet
