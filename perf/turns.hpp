// What is compared takes turns.
#pragma once
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "perf/perf.hpp"

namespace cullet::perf {

/// Least time of many runs, taken in turns, so that a busy moment of the machine hits all alike.
struct Timed {
    std::string name;
    uint32_t steps;
    std::function<void(uint32_t steps)> run;
    std::function<void()> prepare = {};
    double best = 1e9;  // s a step
};
inline void take_turns(std::vector<Timed>& all, uint32_t rounds) {
    for (uint32_t r = 0; r < rounds; ++r)
        for (Timed& t : all) {
            if (t.prepare) t.prepare();
            t.run(2);  // fills the caches that the others have emptied
            if (t.prepare) t.prepare();
            t.best = std::min(t.best, seconds([&] { t.run(t.steps); }) / t.steps);
        }
}

/// ", 1 thread".
inline std::string on_threads(unsigned threads) {
    return ", " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

}  // namespace cullet::perf
