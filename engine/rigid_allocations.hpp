// Allocations are counted by programs that interpose malloc (tests, the sample game). The bridge marks the time that a
// thread spends inside of the rigid engine, so that its allocations are counted apart from ours.
#pragma once

namespace cullet {

/// True on this thread while a RigidWorld call runs.
bool& inside_rigid_engine();

struct InsideRigidEngine {
    InsideRigidEngine() : before_(inside_rigid_engine()) { inside_rigid_engine() = true; }
    ~InsideRigidEngine() { inside_rigid_engine() = before_; }
    InsideRigidEngine(const InsideRigidEngine&) = delete;
    InsideRigidEngine& operator=(const InsideRigidEngine&) = delete;

 private:
    bool before_;
};

}  // namespace cullet
