#include "systems/systems.hpp"

namespace cullet {

// Semi-implicit Euler under standard gravity; a crumb that reaches its floor stays where it fell.
void fall_debris(Rows<Debris> debris, Step step, InOut<&Debris::position> position, InOut<&Debris::velocity> velocity,
                 In<&Debris::floor> floor, InOut<&Debris::is_resting> is_resting, In<&Debris::is_used> is_used) {
    for (auto d : debris) {
        if (!is_used[d] || is_resting[d]) continue;
        const Vec3 falling = velocity[d] + step.dt * step.gravity;
        Vec3 place = position[d] + step.dt * falling;
        if (place.y <= floor[d]) {
            place.y = floor[d];
            is_resting[d] = 1;
        }
        position.set(d, place);
        velocity.set(d, is_resting[d] ? Vec3{} : falling);
    }
}

}  // namespace cullet
