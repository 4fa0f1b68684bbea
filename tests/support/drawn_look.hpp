// Looks at what is drawn, frame by frame: that it is closed, and that its crack faces carry metres.
#pragma once
#include <map>
#include <string>
#include <utility>

#include "cullet/world.hpp"

namespace cullet::test {

/// Looks at each body whose drawn mesh is another than at the last call.
class DrawnLook {
 public:
    /// "" or a sentence on the first that is wrong.
    std::string at(const World& world);
    uint32_t looked_at() const { return looked_at_; }
    uint32_t with_cracks() const { return with_cracks_; }

 private:
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> stamps_;  // by row and generation
    uint32_t looked_at_ = 0, with_cracks_ = 0;                  // meshes, and those of them that have crack faces
};

}  // namespace cullet::test
