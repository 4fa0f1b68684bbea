#include "engine/bullet/contact_solver.hpp"

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <algorithm>

namespace cullet::bullet {
namespace {

constexpr unsigned long kSeed = 1;
// Bodies of a heap have 4 to 6 contact points each, half of their neighbours' counted. Beyond that Bullet's arrays grow
// while they run.
constexpr int kPointsOfABody = 16;
// Iterations end once the largest change of a contact's speed in one of them is below this, (m/s) squared: at ten times
// it heaps sleep as soon and lie a quarter deeper in each other, at a tenth they lie no better.
constexpr float kSettledSquare = 1e-5f;
// Until then a step takes as many as come to this many contacts in all, within these bounds. Twenty leave a heap of
// fifty curved shards that lands 0.1 to 0.3 m/s of approach for fifteen steps, and shards are pressed through each
// other: of 24 heaps 7 have a contact deeper than 4 mm, and they sleep after 310 steps in the mean. With 80 none is
// deeper than 3 mm, and they sleep after 165. From 4,000 contacts on it is twenty: heaps of thousands have no time for
// more.
constexpr int kContactTurns = 80000, kLeastIterations = 20, kMostIterations = 100;
constexpr int kRollingRows = 3;  // of a point: one about the normal, two across

}  // namespace

ContactSolver::ContactSolver(uint32_t body_limit) {
    const auto bodies = static_cast<int>(body_limit);
    const int points = kPointsOfABody * bodies + 1024;
    setRandSeed(kSeed);
    info_.m_splitImpulse = 1;
    info_.m_splitImpulsePenetrationThreshold = 0;  // all overlap is pushed out without adding velocity
    info_.m_splitImpulseTurnErp = 0.1f;
    info_.m_erp2 = 0.2f;
    info_.m_linearSlop = 0;
    info_.m_leastSquaresResidualThreshold = kSettledSquare;
    info_.m_restitutionVelocityThreshold = 0.2f;  // m/s
    // Friction along fixed directions: those of the velocity are noise once a heap is nearly at rest.
    info_.m_solverMode = SOLVER_USE_WARMSTARTING | SOLVER_SIMD | SOLVER_USE_2_FRICTION_DIRECTIONS |
                         SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION;
    bodies_.reserve(body_limit);
    manifolds_.reserve(static_cast<size_t>(points));
    m_tmpSolverBodyPool.reserve(bodies + 1);  // and all that stands still
    m_tmpSolverContactConstraintPool.reserve(points);
    m_tmpSolverContactFrictionConstraintPool.reserve(2 * points);
    m_tmpSolverContactRollingFrictionConstraintPool.reserve(kRollingRows * points);
    m_orderTmpConstraintPool.reserve(points);
    m_orderFrictionConstraintPool.reserve(2 * points);
}

void ContactSolver::solve(float dt) {
    info_.m_timeStep = dt;
    if (bodies_.empty()) return;
    int contacts = 0;
    for (const btPersistentManifold* manifold : manifolds_) contacts += manifold->getNumContacts();
    info_.m_numIterations = std::clamp(kContactTurns / std::max(contacts, 1), kLeastIterations, kMostIterations);
    solveGroup(bodies_.data(), static_cast<int>(bodies_.size()), manifolds_.data(), static_cast<int>(manifolds_.size()),
               nullptr, 0, info_, nullptr, nullptr);
}

}  // namespace cullet::bullet
