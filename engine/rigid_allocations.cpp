#include "engine/rigid_allocations.hpp"

namespace cullet {

bool& inside_rigid_engine() {
    static thread_local bool is_inside = false;
    return is_inside;
}

uint64_t& rigid_allocation_count() {
    static thread_local uint64_t count = 0;
    return count;
}

}  // namespace cullet
