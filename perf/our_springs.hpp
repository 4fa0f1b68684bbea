// The library's own springs of a net, as yardsticks have theirs.
#pragma once
#include <functional>

#include "perf/springs.hpp"
#include "sample_game/spring_bench.hpp"

namespace cullet::perf {

/// At rest; its substeps are integrate_springs, run by the inner loop.
SpringBench bench_of(const SpringNet& net, const std::function<bool(uint32_t)>& is_pinned = {});

}  // namespace cullet::perf
