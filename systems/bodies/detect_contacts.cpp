#include "systems/systems.hpp"

namespace cullet {

void detect_contacts(Serial, Step step, RigidWorld& rigid) {
    rigid.detect(step.dt);
}

}  // namespace cullet
