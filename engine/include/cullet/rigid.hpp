// The rigid bodies behind a world. Bullet serves them; a host's own engine comes with a later version, through the same
// few calls. What a game may count today:
#pragma once
#include <cstdint>

namespace cullet {

struct RigidReport {
    uint32_t pairs = 0, contacts = 0;  // of the last step
    uint32_t sweeps = 0;               // fast bodies placed at their time of impact, since the world was made
};

}  // namespace cullet
