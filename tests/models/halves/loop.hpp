// Its inner loop, and what a run of it costs.
#pragma once
#include "systems/model_loops.hpp"

namespace cullet::halves {

inline constexpr float kStep = 1.0f / 1024, kEnd = 7 * kStep;  // s; 8 steps

struct LoopWorld {
    BodyRows& rows;
    const Blows& blows;

    template <class T>
    auto& table() {
        if constexpr (std::is_same_v<T, Blows>)
            return blows;
        else
            return table_in<T>(rows);
    }
    template <class Set>
    Set& set() {
        return rows;
    }
    template <class T>
    Row<T> row_of(uint32_t task) const {
        return Row<T>(task);
    }
};
InnerLoop<LoopWorld> make_loop();

RunCost cost_of(const RunRows& rows, uint32_t task);
bool works_on(const RunRows& rows, uint32_t task);
bool may_be_shared(const RunRows& rows, uint32_t task);

}  // namespace cullet::halves
