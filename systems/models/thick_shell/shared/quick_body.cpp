#include "systems/models/thick_shell/shared/quick_body.hpp"

#include <string>

namespace cullet {
namespace {

constexpr float kRadiansADegree = 0.017453292519943295f;

void grow(AnyTable& table, uint32_t row) {
    if (row >= table.size()) table.append(row + 1 - table.size());
}

template <class QuickTable>
void set_layers(QuickTable& table, uint32_t row, const LayerSettings& layers) {
    table.layout[row] = static_cast<uint8_t>(layers.layout);
    table.length_factor[row] = layers.length_factor;
    table.area_energy[row] = layers.area_energy;
    table.volume_energy[row] = layers.volume_energy;
}

void begin_run(QuickRuns& runs, Row<Tasks> task, bool is_quick) {
    grow(runs, task);
    runs.clear_rows(task, 1);
    runs.is_quick[task] = is_quick;
    runs.springs[task] = {};
    runs.softening[task] = 1;
}

}  // namespace

Result<void> check_fracture(FractureMode mode, const QuickSettings& q) {
    if (mode != FractureMode::Hidden && mode != FractureMode::Quick)
        return Error{"fracture is " + std::to_string(static_cast<int>(mode)) + ". Give FractureMode::Hidden or Quick."};
    const auto refuse = [](const char* name, double value, const char* range) {
        return Error{std::string("quick.") + name + " is " + std::to_string(value) + ", not " + range +
                     ". Give a value in that range."};
    };
    const auto is_in = [](double value, double low, double high) { return value >= low && value <= high; };
    if (q.layers != 1 && q.layers != 2) return refuse("layers", q.layers, "1 or 2");
    if (!is_in(q.steps, 8, 100)) return refuse("steps", q.steps, "8 to 100");
    if (!is_in(q.crack_frequency, 0, 1000)) return refuse("crack_frequency", q.crack_frequency, "0 to 1000");
    if (!(q.strain_limit == 0) && !is_in(q.strain_limit, 1e-5f, 1))
        return refuse("strain_limit", q.strain_limit, "0 or 1e-5 to 1");
    if (!(q.compression_limit == 0) && !is_in(q.compression_limit, 1, 1e6))
        return refuse("compression_limit", q.compression_limit, "0 or 1 to 1e6");
    if (!is_in(q.crack_length, 0, 4)) return refuse("crack_length", q.crack_length, "0 to 4");
    if (!is_in(q.bump_angle, 0, 30)) return refuse("bump_angle", q.bump_angle, "0 to 30 degrees");
    return {};
}

Result<void> check_layers(const LayerSettings& l) {
    const auto refuse = [](const char* name, double value, const char* range) {
        return Error{std::string("layers.") + name + " is " + std::to_string(value) + ", not " + range +
                     ". Give a value in that range."};
    };
    const auto is_in = [](double value, double low, double high) { return value >= low && value <= high; };
    if (l.layout != LayerLayout::Sandwich && l.layout != LayerLayout::Crossed)
        return Error{"layers.layout is " + std::to_string(static_cast<int>(l.layout)) +
                     ". Give LayerLayout::Sandwich or Crossed."};
    if (!(l.length_factor == 0) && !is_in(l.length_factor, 0.577, 5))
        return refuse("length_factor", l.length_factor, "0 or 0.577 to 5");
    if (!is_in(l.area_energy, 0, 100)) return refuse("area_energy", l.area_energy, "0 to 100");
    if (!is_in(l.volume_energy, 0, 100)) return refuse("volume_energy", l.volume_energy, "0 to 100");
    return {};
}

void set_fracture(BodyRows& state, Row<Bodies> body, FractureMode mode, const QuickSettings& settings,
                  const LayerSettings& layers) {
    QuickBodies& quick = state.quick_bodies;
    if (mode == FractureMode::Hidden) {
        if (body < quick.size()) quick.clear_rows(body, 1);
        return;
    }
    grow(quick, body);
    quick.is_quick[body] = 1;
    quick.layers[body] = static_cast<uint8_t>(settings.layers);
    quick.steps[body] = static_cast<uint16_t>(settings.steps);
    quick.crack_frequency[body] = static_cast<uint16_t>(settings.crack_frequency);
    quick.strain_limit[body] = settings.strain_limit;
    quick.compression_limit[body] = settings.compression_limit;
    quick.crack_length[body] = settings.crack_length;
    quick.bump_angle[body] = kRadiansADegree * settings.bump_angle;
    set_layers(quick, body, layers);
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
    const QuickBodies& quick = state.quick_bodies;
    runs.layers[task] = quick.layers[body];
    runs.steps[task] = quick.steps[body];
    runs.crack_frequency[task] = quick.crack_frequency[body];
    runs.given_limit[task] = quick.strain_limit[body];
    runs.compression_limit[task] = quick.compression_limit[body];
    runs.crack_length[task] = quick.crack_length[body];
    runs.bump_angle[task] = quick.bump_angle[body];
    runs.layout[task] = quick.layout[body];
    runs.length_factor[task] = quick.length_factor[body];
    runs.area_energy[task] = quick.area_energy[body];
    runs.volume_energy[task] = quick.volume_energy[body];
}

void set_hidden_task(QuickRuns& runs, Row<Tasks> task) {
    if (task < runs.size()) begin_run(runs, task, false);
}

void set_quick_task(RunRows& state, Row<Tasks> task, const QuickSettings& settings, const LayerSettings& layers) {
    QuickRuns& runs = state.quick_runs;
    begin_run(runs, task, true);
    runs.layers[task] = static_cast<uint8_t>(settings.layers);
    runs.steps[task] = static_cast<uint16_t>(settings.steps);
    runs.crack_frequency[task] = static_cast<uint16_t>(settings.crack_frequency);
    runs.given_limit[task] = settings.strain_limit;
    runs.compression_limit[task] = settings.compression_limit;
    runs.crack_length[task] = settings.crack_length;
    runs.bump_angle[task] = kRadiansADegree * settings.bump_angle;
    set_layers(runs, task, layers);
}

}  // namespace cullet
