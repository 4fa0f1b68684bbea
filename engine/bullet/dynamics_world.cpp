#include "engine/bullet/dynamics_world.hpp"

namespace cullet::bullet {

void ContactIslands::updateActivationState(btCollisionWorld* world, btDispatcher* dispatcher) {
    int count = 0;
    btCollisionObjectArray& objects = world->getCollisionObjectArray();
    for (int k = 0; k < objects.size(); ++k) {
        if (!objects[k]->isStaticOrKinematicObject()) objects[k]->setIslandTag(count++);
        objects[k]->setCompanionId(-1);
        objects[k]->setHitFraction(1);
    }
    initUnionFind(count);
    for (int k = 0; k < dispatcher->getNumManifolds(); ++k) {
        const btPersistentManifold* manifold = dispatcher->getManifoldByIndexInternal(k);
        const btCollisionObject *a = manifold->getBody0(), *b = manifold->getBody1();
        if (!a->isStaticOrKinematicObject() && !b->isStaticOrKinematicObject())
            getUnionFind().unite(a->getIslandTag(), b->getIslandTag());
    }
}

DynamicsWorld::DynamicsWorld(btDispatcher* dispatcher, btBroadphaseInterface* broadphase, btConstraintSolver* solver,
                             btCollisionConfiguration* configuration)
    : btDiscreteDynamicsWorld(dispatcher, broadphase, solver, configuration), islands_(new ContactIslands) {
    // The base class made an island manager of its own and frees it in its destructor; ours takes its place.
    m_islandManager->~btSimulationIslandManager();
    btAlignedFree(m_islandManager);
    m_islandManager = islands_;
    m_ownsIslandManager = false;
    m_dispatchInfo.m_deterministicOverlappingPairs = true;
    btContactSolverInfo& info = getSolverInfo();
    info.m_splitImpulse = 1;
    info.m_splitImpulsePenetrationThreshold = 0;  // all overlap is pushed out without adding velocity
    info.m_splitImpulseTurnErp = 0.1f;
    info.m_erp2 = 0.2f;
    info.m_linearSlop = 0;
    info.m_numIterations = 20;
    info.m_restitutionVelocityThreshold = 0.2f;  // m/s
    info.m_minimumSolverBatchSize = 1;           // an island's result does not depend on its neighbours in a batch
    // Friction along fixed directions: those of the velocity are noise once a heap is nearly at rest.
    info.m_solverMode = SOLVER_USE_WARMSTARTING | SOLVER_SIMD | SOLVER_USE_2_FRICTION_DIRECTIONS |
                        SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION;
}

DynamicsWorld::~DynamicsWorld() {
    delete islands_;
}

void DynamicsWorld::find_contacts() {
    computeOverlappingPairs();
    m_dispatcher1->dispatchAllCollisionPairs(m_broadphasePairCache->getOverlappingPairCache(), m_dispatchInfo,
                                             m_dispatcher1);
}

void DynamicsWorld::solve_contacts(float dt) {
    m_fixedTimeStep = dt;
    m_dispatchInfo.m_timeStep = dt;
    getSolverInfo().m_timeStep = dt;
    calculateSimulationIslands();
    solveConstraints(getSolverInfo());
}

}  // namespace cullet::bullet
