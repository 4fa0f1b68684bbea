// The contacts of the last solve, body by body, and each as a load.
#pragma once
#include <span>

#include "components/squeezes.hpp"
#include "engine/arena.hpp"
#include "engine/rigid_world.hpp"
#include "systems/impacts/overload.hpp"

namespace cullet {

/// The game moves something: a press, a door, a lift.
bool is_anything_driven(const Bodies& bodies);

/// Through Bodies.first_load and `next`: entry 2 c + side is contact c on its body a (side 0) or b, in the order of
/// contacts. No entries, when the arena is full.
class LoadLists {
 public:
    LoadLists(Bodies& bodies, const Squeezes& squeezes, std::span<const RigidContact> contacts, Step step,
              Arena& arena);

    uint32_t longest() const { return longest_; }  // loads of one body
    bool has_loads(Row<Bodies> body) const { return bodies_.first_load[body] != kNone; }
    /// m, of its contacts, that a toucher lies in it.
    float deepest(Row<Bodies> body) const;
    /// As many as there is room for, the first; how many.
    uint32_t take(Row<Bodies> body, std::span<BodyLoad> loads) const;

 private:
    bool counts(const RigidContact& c) const;
    BodyLoad load_of(uint32_t entry) const;
    /// It moves whatever pushes it: the game moves it, or those who squeeze it do.
    bool is_driven(Row<Bodies> b) const;
    Vec3 spin_of(Row<Bodies> b) const;  // rad/s, of who is driven; what stands still or sleeps has none
    Vec3 velocity_at(Row<Bodies> b, Vec3 point) const;
    struct Behind {
        Row<Bodies> who;       // the fastest that stands there; none: nobody does
        bool stands = false;   // somebody does
        float speed = -1e30f;  // m/s, of it at `place` along `push`
        Vec3 place, push;      // of the load: world

        void meet(const LoadLists& lists, Row<Bodies> other);
    };
    void look_behind(Row<Bodies> body, Row<Bodies> from, uint32_t& looks, Behind& behind) const;
    void share_what_is_missing(std::span<BodyLoad> loads, Row<Bodies> body) const;
    struct Through {
        Row<Bodies> body, on;  // who passes on what presses on it, and to whom
        Vec3 push;             // of the load: world
        double speed;          // m/s, that it loses when it is stopped
    };
    struct Pressing {
        uint32_t supports = 0;  // contacts that bear it against the push
        double unborne = 0;     // N s, of its weight and of what the solver gave it along the push
    };
    Pressing pressing_of(Row<Bodies> body, Vec3 push) const;
    double passed_on(const Through& by, uint32_t& looks) const;

    Bodies& bodies_;
    const Squeezes& squeezes_;
    std::span<const RigidContact> contacts_;
    Step step_;
    std::span<uint32_t> next_;
    uint32_t longest_ = 0;
};

}  // namespace cullet
