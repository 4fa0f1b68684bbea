// A part of a host that has Bullet in double precision of its own: a box that falls on the ground.
#define BT_USE_DOUBLE_PRECISION
#include <btBulletDynamicsCommon.h>

extern "C" double height_of_a_box_at_rest() {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase pairs;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world(&dispatcher, &pairs, &solver, &configuration);
    btBoxShape ground(btVector3(10, 1, 10)), box(btVector3(0.1, 0.1, 0.1));
    btRigidBody below(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &ground));
    below.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, -1, 0)));
    btVector3 inertia;
    box.calculateLocalInertia(1, inertia);
    btRigidBody falling(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &box, inertia));
    falling.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 1, 0)));
    world.addRigidBody(&below);
    world.addRigidBody(&falling);
    for (int step = 0; step < 120; ++step) world.stepSimulation(1 / 60.0, 0);
    const double height = falling.getWorldTransform().getOrigin().y();
    world.removeRigidBody(&falling);
    world.removeRigidBody(&below);
    return height;
}
