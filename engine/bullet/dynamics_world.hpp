// Bullet's world, opened at the seams that a split step needs.
#pragma once
#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>
#include <btBulletDynamicsCommon.h>

namespace cullet::bullet {

/// Islands joined by contacts. Bullet joins by overlapping boxes, so that one jittering shard keeps all its neighbours
/// awake.
class ContactIslands : public btSimulationIslandManager {
 public:
    void updateActivationState(btCollisionWorld* world, btDispatcher* dispatcher) override;
};

class DynamicsWorld : public btDiscreteDynamicsWorld {
 public:
    DynamicsWorld(btDispatcher* dispatcher, btBroadphaseInterface* broadphase, btConstraintSolver* solver,
                  btCollisionConfiguration* configuration);
    ~DynamicsWorld() override;

    /// Pairs and narrow phase, from the boxes that the caller has set.
    void find_contacts();
    /// Islands, impulses, and the push out of overlaps (split impulse). Nothing is integrated.
    void solve_contacts(float dt);

 private:
    ContactIslands* islands_;
};

}  // namespace cullet::bullet
