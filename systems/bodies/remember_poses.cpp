#include "systems/systems.hpp"

namespace cullet {

void remember_poses(Rows<Bodies> bodies, In<&Bodies::position> position, In<&Bodies::orientation> orientation,
                    Out<&Bodies::previous_position> previous_position,
                    Out<&Bodies::previous_orientation> previous_orientation) {
    for (auto b : bodies) {
        previous_position.set(b, position[b]);
        previous_orientation.set(b, orientation[b]);
    }
}

}  // namespace cullet
