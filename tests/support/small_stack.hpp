// Threads with as little stack as a host may give, and how much of it was used.
#pragma once
#include <functional>

#include "cullet/host.hpp"

namespace cullet::test {

/// What the headers promise, bytes.
inline constexpr size_t kPromisedStack = 64 * 1024;

/// Runs `call` on a thread of its own with `bytes` of stack and nothing below it: who needs more dies. How many bytes
/// were written at some time, the thread's own data among them.
size_t run_on_stack(size_t bytes, const std::function<void()>& call);

/// A job system whose jobs run on two threads of so much stack, and never on the caller's. `most`: used by any of them.
class SmallStackJobs {
 public:
    explicit SmallStackJobs(size_t bytes) : bytes_(bytes) {}
    HostJobs jobs();
    size_t most_used() const { return most_used_; }

 private:
    size_t bytes_, most_used_ = 0;
};

}  // namespace cullet::test
