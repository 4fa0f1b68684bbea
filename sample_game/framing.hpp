// A camera for scenes that name none: it frames what moves, and what that is about to meet.
#pragma once
#include <vector>

#include "sample_game/game_world.hpp"

namespace cullet {

class Framing {
 public:
    /// Looks where things are; once a frame, in order. The same frames give the same camera, whichever are drawn.
    void follow(const GameWorld& game);
    const Camera& camera() const { return camera_; }

 private:
    struct Seen {
        Vec3 centre, velocity;
        float radius;
        uint32_t row;
    };
    void note_what_is_met(const std::vector<Seen>& moving, const std::vector<Seen>& still, uint64_t until_frame);

    Camera camera_;
    Vec3 middle_;
    float reach_ = 0;                    // m round the middle; 0: nothing was seen yet
    std::vector<uint64_t> noted_until_;  // frame, of each row of Bodies: it was about to be met
};

}  // namespace cullet
