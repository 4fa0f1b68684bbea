// Fast bodies stop where they would first touch: conservative advancement (Mirtich 1996) over axes whose gap is
// measured from support points, after the impulses and with the velocities that they left.
//
// Sweeping the motion that is about to be made, and not the one before, also stops what a blow has just made fast. The
// body stands at its time of impact, half a millimetre away, loses the rest of the step, and meets its contact in the
// next detect() with its velocity whole.
#pragma once
#include <vector>

#include "engine/bullet/pair_algorithm.hpp"

namespace cullet::bullet {

class BulletWorld;

class Sweeper {
 public:
    explicit Sweeper(uint32_t body_limit) { fast_.reserve(body_limit), near_.reserve(body_limit); }
    /// Sets moved_fraction of every body, from 0 to 1; returns how many were stopped.
    uint32_t sweep(BulletWorld& world, float dt);

 private:
    struct Fast {
        RigidId id;
        Box swept;
    };
    void sweep_pair(BulletWorld& world, Body& a, Body& b, float dt);
    std::vector<Fast> fast_;
    std::vector<RigidId> near_;
};

}  // namespace cullet::bullet
