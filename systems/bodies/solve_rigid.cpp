#include "systems/systems.hpp"

namespace cullet {

void solve_rigid(Serial, Step step, RigidWorld& rigid) {
    rigid.solve(step.dt);
}

}  // namespace cullet
