// Bullet's sequential impulses over all contacts of a step at once, in the order that they are given.
//
// Bullet's world solves island by island. What bodies of two islands do never meets, so that one group gives the same
// impulses, without islands to build and sort.
#pragma once
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

#include <cstdint>
#include <vector>

namespace cullet::bullet {

class ContactSolver : private btSequentialImpulseConstraintSolver {
 public:
    explicit ContactSolver(uint32_t body_limit);
    void clear() { bodies_.clear(), manifolds_.clear(); }
    /// Each free body, touched or not: the solver gives it the impulses of its forces.
    void add_body(btRigidBody& body) { bodies_.push_back(&body); }
    void add_contacts(btPersistentManifold& manifold) { manifolds_.push_back(&manifold); }
    /// Impulses, and the push out of overlaps (split impulse). Nothing is integrated.
    void solve(float dt);

 private:
    btContactSolverInfo info_;
    std::vector<btCollisionObject*> bodies_;
    std::vector<btPersistentManifold*> manifolds_;
};

}  // namespace cullet::bullet
