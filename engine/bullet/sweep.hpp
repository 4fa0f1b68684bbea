// Fast bodies stop where they would first touch: conservative advancement (Mirtich 1996) over axes whose gap is
// measured from support points, after the impulses and with the velocities that they left.
//
// Sweeping the motion that is about to be made, and not the one before, also stops what a blow has just made fast. The
// body stands at its time of impact, half a millimetre away, loses the rest of the step and what gravity gave it for
// that, and meets its contact in the next detect(). What glances over something that stands goes on along it: panes at
// 7 m/s lost a twelfth of their way over a hill of ridges of one degree, at each of which they stood for half a step.
#pragma once
#include <atomic>
#include <vector>

#include "engine/bullet/pair_algorithm.hpp"

namespace cullet::bullet {

class BulletWorld;

class Sweeper {
 public:
    explicit Sweeper(uint32_t body_limit) {
        fast_.reserve(body_limit), by_low_.reserve(body_limit), brakes_.resize(body_limit),
            carriers_.resize(body_limit);
        driven_.reserve(body_limit), group_.reserve(body_limit), is_in_group_.resize(body_limit);
        rows_.resize(48 * static_cast<size_t>(body_limit) + 16384);
    }
    /// Sets moved_fraction of every body, from 0 to 1; returns how many were stopped.
    uint32_t sweep(BulletWorld& world, float dt);
    /// The way, m, that a kinematic body takes a struck one along after the stop of that.
    Vec3 carry(const BulletWorld& world, const Body& body, float dt) const;
    /// After the step: what bodies were stopped by takes the speed that leads into it.
    void slow_down(BulletWorld& world);

 private:
    struct Fast {
        RigidId id;
        Box swept;
        int stopped_in;  // the last round in which it was, or -1
        // Its neighbours: those that stand or go slowly, if it touches them on its whole way, then fast ones behind it.
        uint32_t first_row = 0, slow_count = 0, fast_count = 0;
    };
    struct Neighbour {
        uint32_t other;  // body, or number in fast_
        float seen_a,
            seen_b;  // moved_fraction of both after they were last swept: while they are that, they need not be
    };
    /// What stopped a body in this step, last.
    struct Brake {
        RigidId other = kNoRigid;                           // none: nothing did
        uint32_t ordinal = 0, other_ordinal = 0;            // of the pieces that met
        const Hull *hull = nullptr, *other_hull = nullptr;  // null: a triangle
        Vec3 normal;                                        // from the other one towards the body
        bool is_new = false;                                // the two had no contact in this step
    };
    struct Touch {
        Vec3 normal;  // towards whom it is told of
        float at;     // fraction of the step
        bool is_new;
    };
    void stop(Body& body, const Hull& hull, const Body& other, const Hull& other_hull, const Touch& touch);
    /// The kinematic body that a fast one goes along with.
    struct Carrier {
        RigidId driven = kNoRigid;  // none
        Vec3 normal, place;         // from it towards the body; about where they touch
        float most = 0;             // m
        float at = 1;               // of the step, from when on
    };
    static bool is_borne(const BulletWorld& world, const Body& body, RigidId driven, Vec3 normal);
    void take_along(const BulletWorld& world, const Body& body, const Hull& hull, const Body& driven,
                    const Hull& driven_hull, const Touch& touch);
    float driven_until(const BulletWorld& world, const Body& driven, const Body& other, Vec3 normal, float at,
                       float dt) const;
    bool is_before(const Body& body, RigidId driven, Vec3 normal) const;
    static float carried_speed(const BulletWorld& world, const Carrier& carrier);
    static void slow_spins(Body& a, Body& b, Vec3 place, Vec3 normal, float closing);
    static bool stop_closing(BulletWorld& world, Body& a, const Hull& p, Body& b, const Hull& q, Vec3 normal);
    static void find_near(const BulletWorld& world, const Box& box, std::vector<RigidId>& near);
    double low_of(uint32_t k) const { return double{fast_[k].swept.low.*axis_}; }
    void list_fast(BulletWorld& world, float dt);
    void order_fast();
    void find_fast(uint32_t k, std::vector<uint32_t>& near) const;
    template <class Found>
    static void visit_touches(const BulletWorld& world, Body& a, Body& b, float dt, PairScratch& scratch, Found found);
    static bool touch_on_whole_ways(const BulletWorld& world, Body& a, Body& b, float dt, PairScratch& scratch);
    void find_neighbours(BulletWorld& world, float dt);
    void list_neighbours(BulletWorld& world, uint32_t k, float dt, PairScratch& scratch);
    bool sweep_slow(BulletWorld& world, uint32_t k, float dt);
    void sweep_near(BulletWorld& world, const Fast& fast, float dt);
    void go_along(BulletWorld& world, Fast& fast, float dt);
    bool sweep_fast(BulletWorld& world, uint32_t k, int round, float dt);
    bool sweep_two_fast(BulletWorld& world, Fast& fast, Fast& other, int round, float dt);
    void sweep_pair(BulletWorld& world, Body& a, Body& b, float dt);
    void gather_as_one(const BulletWorld& world, uint32_t k);
    bool stop_as_one(BulletWorld& world, int round);
    std::vector<Fast> fast_;         // rising ids
    std::vector<uint32_t> driven_;   // of fast_, kinematic ones
    std::vector<uint32_t> group_;    // of these, some that move as one
    std::vector<bool> is_in_group_;  // by place in fast_
    std::vector<uint32_t> by_low_;   // of fast_, by the low end of what they sweep along axis_
    float Vec3::*axis_ = &Vec3::x;   // along which fast bodies lie farthest apart
    double longest_ = 0;             // m, of what one sweeps along it
    std::vector<Brake> brakes_;      // by body
    std::vector<Carrier> carriers_;  // by body
    std::vector<Neighbour> rows_;    // of one fast body after another, in any order of these
    std::atomic<size_t> row_count_ = 0;
    bool has_rows_ = true;  // there was room for all neighbours
};

}  // namespace cullet::bullet
