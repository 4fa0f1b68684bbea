#include "systems/bodies/rigid_energy.hpp"

#include "components/body_id.hpp"

namespace cullet {

double rigid_energy(const Bodies& bodies, Row<Bodies> body) {
    if (!is_dynamic(bodies, body)) return 0;  // nobody: a push of the game's
    return rigid_energy(bodies, body, {bodies.velocity[body], bodies.spin[body]});
}

double rigid_energy(const Bodies& bodies, Row<Bodies> body, const Motion& motion) {
    if (!is_dynamic(bodies, body)) return 0;
    const Vec3d v(motion.velocity), w(rotate(conjugate(bodies.orientation[body]), motion.angular_velocity));
    return 0.5 * (bodies.mass[body] * dot(v, v) + dot(w, bodies.inertia[body] * w));
}

}  // namespace cullet
