// Sequential impulses over all contacts of a step at once (Catto, Iterative Dynamics with Temporal Coherence, GDC
// 2005), with split impulses against overlaps, as Bullet's solver makes them, in four lanes.
//
// Pairs that share no free body are solved side by side: each takes the first colour that neither of its bodies has
// yet, in the order that pairs are given, and a colour's pairs fill batches of four. Half of a step of Bullet's own
// solver went into rows that wait for each other.
//
// Islands, bodies that touch each other with nothing that stands between them, go into two, four or eight groups by the
// number of their contacts, whatever the number of threads: what bodies of two groups do never meets, so that groups
// are solved side by side.
#pragma once
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <cstdint>
#include <vector>

#include "engine/bullet/contact_rows.hpp"
#include "engine/bullet/scratches.hpp"

namespace cullet::bullet {

class ContactSolver {
 public:
    /// The number of all that stands still.
    static constexpr uint32_t kStanding = 0;

    explicit ContactSolver(uint32_t body_limit);
    void clear();
    /// Each free body, touched or not (the solver gives it the impulses of its forces), and what is driven and touched.
    /// Returns its number.
    uint32_t add_body(btRigidBody& body);
    /// A pair of bodies with all their manifolds, by number: at least one is free. Those with something that is not
    /// free come last and hold best.
    /// With a grip, N s, contacts neither push out of overlaps nor bounce, but each holds the two to each other with at
    /// most so much in each direction, also against what would part them. Out of overlaps they are pushed by at most
    /// `most_push`, m. Siblings do not throw each other (see SiblingRows), nor bounce; they have no grip. The pair has
    /// the scale of lengths.hpp.
    void add_pair(uint32_t a, uint32_t b, float grip, float most_push, bool are_siblings, float scale);
    void add_contacts(btPersistentManifold& manifold);
    /// Impulses, and the push out of overlaps. Nothing is integrated. `pace` is 1 under g, less where things fall
    /// slower.
    void solve(float dt, float pace, Scratches& scratches);

 private:
    struct Contacts {
        uint32_t a, b;  // bodies, by number
        uint32_t first, count;
        float grip;       // N s
        float most_push;  // m
        bool are_siblings;
        bool is_laden;
        float scale;
        uint32_t key;  // batches are filled in rising order of it
    };
    struct Source;
    struct Island {
        uint32_t points, root;  // of its bodies' numbers the least
    };
    struct Group {
        uint32_t first, end;    // batches
        bool is_laden = false;  // of islands in which something bears many times its weight
    };
    bool is_free(uint32_t number) const;
    uint32_t root_of(uint32_t number);
    uint32_t root_of(const Contacts& pair);
    void weigh_bodies(float dt);
    bool is_heavier_laid_on_other(const Contacts& pair) const;
    bool is_laden(const Contacts& pair) const;
    void group_islands(float dt);
    void colour_pairs();
    void fill_batches();
    void fill_batch(const uint32_t* pairs, uint32_t count);
    void set_up(Batch& batch, const uint32_t* pairs, float dt, float pace);
    void set_up_point(PointRows& p, RollRows* r, SiblingRows* s, const Contacts* const (&of)[kLanes], uint32_t k,
                      const Source& a, const Source& b, float dt);
    int iterations_of(const Group& group) const;
    void iterate(const Group& group);
    void write_points() const;
    void write_bodies(float dt);

    std::vector<btRigidBody*> bodies_;                // by number; null at 0
    std::vector<SolverBody> changes_;                 // by number
    std::vector<uint64_t> colours_;                   // by number: a bit each, of those that the body has
    std::vector<float> weights_;                      // by number: N s in a step
    std::vector<uint32_t> above_;                     // by number: on the way to the island's root
    std::vector<uint32_t> island_points_, group_of_;  // by root
    std::vector<uint8_t> laden_;                      // by root
    std::vector<Island> islands_;
    std::vector<Group> groups_;
    std::vector<Contacts> pairs_;              // in the order of solving
    std::vector<btManifoldPoint*> points_;     // of the pairs, one pair after the other
    std::vector<uint32_t> order_, key_begin_;  // pairs_ by key
    std::vector<Batch> batches_;
    std::vector<uint32_t> batch_pairs_;  // four each, kNoPair where a lane is empty
    std::vector<PointRows> rows_;        // grows alone: what a batch uses it fills
    std::vector<RollRows> rolls_;
    std::vector<SiblingRows> siblings_;
};

}  // namespace cullet::bullet
