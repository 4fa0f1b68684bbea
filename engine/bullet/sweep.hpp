// Fast bodies stop where they would first touch: conservative advancement (Mirtich 1996) over axes whose gap is
// measured from support points, after the impulses and with the velocities that they left.
//
// Sweeping the motion that is about to be made, and not the one before, also stops what a blow has just made fast. The
// body stands at its time of impact, half a millimetre away, loses the rest of the step and what gravity gave it for
// that, and meets its contact in the next detect().
#pragma once
#include <atomic>
#include <compare>
#include <span>
#include <vector>

#include "engine/bullet/pair_algorithm.hpp"

namespace cullet::bullet {

class BulletWorld;

class Sweeper {
 public:
    explicit Sweeper(uint32_t body_limit) {
        fast_.reserve(body_limit), near_.reserve(body_limit);
        by_low_.reserve(body_limit), brakes_.resize(body_limit);
        suspects_.resize(4 * static_cast<size_t>(body_limit) + 1024);
    }
    /// Sets moved_fraction of every body, from 0 to 1; returns how many were stopped.
    uint32_t sweep(BulletWorld& world, float dt);
    /// After the step: what bodies were stopped by takes the speed that leads into it.
    void slow_down(BulletWorld& world);

 private:
    struct Fast {
        RigidId id;
        Box swept;
        int stopped_in;  // the last round in which it was, or -1
    };
    /// What stopped a body in this step, last.
    struct Brake {
        RigidId other = kNoRigid;                           // none: nothing did
        uint32_t ordinal = 0, other_ordinal = 0;            // of the pieces that met
        const Hull *hull = nullptr, *other_hull = nullptr;  // null: a triangle
        Vec3 normal;                                        // from the other one towards the body
    };
    void stop(Body& body, const Hull& hull, const Body& other, const Hull& other_hull, Vec3 normal, float at);
    static bool stop_closing(BulletWorld& world, Body& a, const Hull& p, Body& b, const Hull& q, Vec3 normal);
    /// Two whose ways meet, if nobody stops: one of fast_, and a body.
    struct Suspect {
        uint32_t fast;
        RigidId other;
        auto operator<=>(const Suspect&) const = default;
    };
    static void find_near(const BulletWorld& world, const Box& box, std::vector<RigidId>& near);
    double low_of(uint32_t k) const { return double{fast_[k].swept.low.*axis_}; }
    void list_fast(BulletWorld& world, float dt);
    void order_fast();
    void find_fast(uint32_t k, std::vector<uint32_t>& near) const;
    template <class Touch>
    static void visit_touches(const BulletWorld& world, Body& a, Body& b, float dt, PairScratch& scratch, Touch touch);
    static bool touch_on_whole_ways(const BulletWorld& world, Body& a, Body& b, float dt, PairScratch& scratch);
    void find_suspects(BulletWorld& world, float dt);
    std::span<const Suspect> suspects_of(uint32_t k) const;
    void sweep_slow(BulletWorld& world, uint32_t k, float dt);
    bool go_clear(const BulletWorld& world, uint32_t k, uint32_t j) const;
    void sweep_pair(BulletWorld& world, Body& a, Body& b, float dt);
    std::vector<Fast> fast_;
    std::vector<RigidId> near_;
    std::vector<uint32_t> by_low_;   // of fast_, by the low end of what they sweep along axis_
    float Vec3::*axis_ = &Vec3::x;   // along which fast bodies lie farthest apart
    double longest_ = 0;             // m, of what one sweeps along it
    std::vector<Brake> brakes_;      // by body
    std::vector<Suspect> suspects_;  // sorted up to suspects_end_
    std::atomic<uint32_t> suspect_count_ = 0;
    size_t suspects_end_ = 0;
    bool are_all_suspects_ = false;  // more than there is room for
};

}  // namespace cullet::bullet
