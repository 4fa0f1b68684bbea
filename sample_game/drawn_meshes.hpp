// What the game draws is closed, body by body: for --validate and tests.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "cullet/world.hpp"

namespace cullet {

class DrawnMeshes {
 public:
    /// Checks the drawn mesh (systems/structures/shell/draw_shell.hpp) of each body where it is not what the last call
    /// saw. "" or a sentence on the first that is wrong. Allocates.
    std::string check_changed(World& world);
    uint64_t checked() const { return checked_; }

 private:
    std::vector<std::array<uint32_t, 2>> seen_;  // generation and stamp of each row of Bodies
    uint64_t checked_ = 0;
};

}  // namespace cullet
