#include "engine/host_scope.hpp"

namespace cullet {

Result<void> check_host(const Host& host) {
    if ((host.allocator.allocate == nullptr) != (host.allocator.release == nullptr))
        return Error{"Host::allocator has one of allocate and release; give both or neither."};
    if ((host.jobs.parallel_for == nullptr) != (host.jobs.worker_count == nullptr))
        return Error{"Host::jobs has one of worker_count and parallel_for; give both or neither."};
    return {};
}

}  // namespace cullet
