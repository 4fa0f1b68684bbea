#include "engine/rigid_allocations.hpp"

namespace cullet {

bool& inside_rigid_engine() {
    static thread_local bool is_inside = false;
    return is_inside;
}

}  // namespace cullet
