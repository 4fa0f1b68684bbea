// Allocations are counted by programs that interpose malloc (tests, the sample game). The bridge marks the time that a
// thread spends inside of the rigid engine, so that its allocations are counted apart from ours.
#pragma once
#include <cstdint>

namespace cullet {

/// True on this thread while a RigidWorld call runs.
bool& inside_rigid_engine();
/// Calls for memory that this thread made meanwhile. Whoever interposes malloc adds to it; else it stays 0.
uint64_t& rigid_allocation_count();

class InsideRigidEngine {
 public:
    InsideRigidEngine() : before_(inside_rigid_engine()) { inside_rigid_engine() = true; }
    /// Adds what is asked for until the end of the scope to `total`.
    explicit InsideRigidEngine(uint64_t& total) : InsideRigidEngine() {
        // A call within a call is counted by the outer one.
        if (before_) return;
        total_ = &total;
        first_ = rigid_allocation_count();
    }
    ~InsideRigidEngine() {
        inside_rigid_engine() = before_;
        if (total_) *total_ += rigid_allocation_count() - first_;
    }
    InsideRigidEngine(const InsideRigidEngine&) = delete;
    InsideRigidEngine& operator=(const InsideRigidEngine&) = delete;

 private:
    bool before_;
    uint64_t* total_ = nullptr;
    uint64_t first_ = 0;
};

}  // namespace cullet
