// Which bodies break quickly, and how.
#pragma once
#include "components/body_rows.hpp"
#include "cullet/thick_shell.hpp"

namespace cullet {

/// Writes the row of a body; of a hidden one only where some row is there already.
void set_fracture(BodyRows& state, Row<Bodies> body, FractureMode mode, const QuickSettings& settings,
                  const LayerSettings& layers);
/// A piece breaks as its parent does.
void inherit_fracture(BodyRows& state, Row<Bodies> parent, Row<Bodies> piece);

inline bool is_quick_body(const BodyRows& state, Row<Bodies> body) {
    return body < state.quick_bodies.size() && state.quick_bodies.is_quick[body];
}
inline bool is_quick_task(Tables<const QuickRuns> state, uint32_t task) {
    return task < state.quick_runs.size() && state.quick_runs.is_quick[task];
}
/// The row of a task whose body is `body`; none is written while no body is quick. Serial.
void set_quick_task(BodyRows& state, Row<Tasks> task, Row<Bodies> body);
/// The same of a task without a body: hidden, or quick.
void set_hidden_task(QuickRuns& runs, Row<Tasks> task);
void set_quick_task(RunRows& state, Row<Tasks> task, const QuickSettings& settings, const LayerSettings& layers);

/// s of B7 for the task's contact: stiffness is E / s, forces that do not grow with it are divided by the root of s. 1
/// of hidden runs.
inline float softening_of(Tables<const QuickRuns> state, uint32_t task) {
    return is_quick_task(state, task) ? state.quick_runs.softening[task] : 1.0f;
}

}  // namespace cullet
