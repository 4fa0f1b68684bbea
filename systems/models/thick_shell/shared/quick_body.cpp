#include "systems/models/thick_shell/shared/quick_body.hpp"

#include <cstring>

#include "systems/models/thick_shell/shared/settings.hpp"
#include "systems/settings/kept.hpp"

namespace cullet {
namespace {

void grow(AnyTable& table, uint32_t row) {
    if (row >= table.size()) table.append(row + 1 - table.size());
}

void keep_rules(AnyTable& table, uint32_t row, const QuickSettings& settings, const LayerSettings& layers) {
    keep_settings(table, row, setting_list<QuickSettings>(), &settings);
    keep_settings(table, row, setting_list<LayerSettings>(), &layers);
}

void copy_rules(const QuickBodies& bodies, uint32_t body, QuickRuns& runs, uint32_t task) {
    const size_t count = bodies.columns().size();  // all of them are rules, with which those of runs begin
    for (size_t c = 0; c < count; ++c) {
        const ColumnInfo &from = bodies.columns()[c], &to = runs.columns()[c];
        std::memcpy(runs.column_memory(to, 0) + size_t{task} * to.row_bytes,
                    bodies.column_memory(from, 0) + size_t{body} * from.row_bytes, from.row_bytes);
    }
}

void begin_run(QuickRuns& runs, Row<Tasks> task, bool is_quick) {
    grow(runs, task);
    runs.clear_rows(task, 1);
    runs.is_quick[task] = is_quick;
    runs.springs[task] = {};
    runs.softening[task] = 1;
}

}  // namespace

void set_fracture(BodyRows& state, Row<Bodies> body, FractureMode mode, const QuickSettings& settings,
                  const LayerSettings& layers) {
    QuickBodies& quick = state.quick_bodies;
    if (mode == FractureMode::Hidden) {
        if (body < quick.size()) quick.clear_rows(body, 1);
        return;
    }
    grow(quick, body);
    quick.is_quick[body] = 1;
    keep_rules(quick, body, settings, layers);
}

void inherit_fracture(BodyRows& state, Row<Bodies> parent, Row<Bodies> piece) {
    QuickBodies& quick = state.quick_bodies;
    if (!is_quick_body(state, parent)) return set_fracture(state, piece, FractureMode::Hidden, {}, {});
    grow(quick, piece);
    quick.copy_rows(quick, parent, piece, 1);
}

void set_quick_task(BodyRows& state, Row<Tasks> task, Row<Bodies> body) {
    QuickRuns& runs = state.quick_runs;
    const bool is_quick = is_quick_body(state, body);
    if (!is_quick && task >= runs.size()) return;
    begin_run(runs, task, is_quick);
    if (!is_quick) return;
    copy_rules(state.quick_bodies, body, runs, task);
}

void set_hidden_task(QuickRuns& runs, Row<Tasks> task) {
    if (task < runs.size()) begin_run(runs, task, false);
}

void set_quick_task(RunRows& state, Row<Tasks> task, const QuickSettings& settings, const LayerSettings& layers) {
    QuickRuns& runs = state.quick_runs;
    begin_run(runs, task, true);
    keep_rules(runs, task, settings, layers);
}

}  // namespace cullet
