#include "systems/models/thick_shell/quick/check_quick.hpp"

#include <algorithm>

#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "systems/models/thick_shell/shared/settings.hpp"
#include "systems/settings/kept.hpp"

namespace cullet {
namespace {

std::string place(const AnyTable& table, const char* column, uint32_t row) {
    return std::string(table.name()) + "." + column + "[" + std::to_string(row) + "]";
}

/// Empty, or the first of the game's settings that is out of range.
std::string trouble_of_rules(const AnyTable& table, uint32_t row) {
    const std::string trouble = trouble_of_kept(table, row, setting_list<QuickSettings>());
    return trouble.empty() ? trouble_of_kept(table, row, setting_list<LayerSettings>()) : trouble;
}

std::string trouble_of_body(const QuickBodies& quick, uint32_t b) {
    if (quick.is_quick[b] > 1) return place(quick, "is_quick", b) + " is not 0 or 1";
    return quick.is_quick[b] ? trouble_of_rules(quick, b) : std::string();
}

/// Of this model. What works on its tasks stands in the same rows as what worked on those that had the place before.
bool is_open_task(const BodyRows& s, uint8_t own, uint32_t t) {
    return t < s.tasks.size() && static_cast<TaskState>(s.tasks.state[t]) != TaskState::Free && s.model_of(t) == own;
}

std::string trouble_of_run(const BodyRows& s, uint8_t own, uint32_t t) {
    const QuickRuns& runs = s.quick_runs;
    if (runs.is_quick[t] > 1) return place(runs, "is_quick", t) + " is not 0 or 1";
    if (!runs.is_quick[t] || !is_open_task(s, own, t)) return {};
    const Row<Bodies> body = s.tasks.body[t];
    if (!is_quick_body(s, body)) return place(runs, "is_quick", t) + " is 1, but its body is not";
    const uint32_t springs = runs.springs[t];
    if (springs >= s.shell_springs.size() || !s.shell_springs.is_used[springs] ||
        s.shell_springs.structure[springs] != s.tasks.working[t])
        return place(runs, "springs", t) + " is " + std::to_string(springs) + ", not the springs of its shell";
    if (std::string trouble = trouble_of_rules(runs, t); !trouble.empty()) return trouble;
    if (!(runs.softening[t] >= 1) || !(runs.split_strain[t] > 0) || !(runs.diagonal[t] >= 0))
        return place(runs, "softening", t) + " or a number beside it is out of range";
    if ((s.shell_springs.steps[springs] & 1) != (s.tasks.steps_done[t] & 1))
        return place(s.shell_springs, "steps", springs) + " and its task's differ";
    const uint32_t first = t * kMostMarkedPacks, count = s.hidden_runs.pack_count[t];
    if (count > kMostMarkedPacks || first + count > s.marked_packs.size())
        return place(s.hidden_runs, "pack_count", t) + " is " + std::to_string(count);
    const uint32_t vertices = s.shells.vertices[s.shell_of(s.tasks.working[t])].count;
    for (uint32_t row = first; row < first + count; ++row) {
        const uint32_t pack = s.marked_packs.pack[row];
        const uint32_t bits = s.marked_packs.awake[row] | uint32_t{s.marked_packs.held[row]};
        const uint32_t lanes = pack * kLanes < vertices ? std::min(kLanes, vertices - pack * kLanes) : 0;
        if ((row > first && pack <= s.marked_packs.pack[row - 1]) || bits >> lanes)
            return place(s.marked_packs, "pack", row) + " is " + std::to_string(pack) +
                   ", not rising or not of its shell";
    }
    return {};
}

std::string trouble_of_part(const BodyRows& s, uint8_t own, uint32_t t) {
    if (!is_open_task(s, own, t) || !is_cut_out(s, t)) return {};
    auto& rows = const_cast<BodyRows&>(s);  // scratch alone is written
    return is_quick_task(s, t) ? trouble_of_cut_out(rows, t) : trouble_of_hidden_region(rows, t);
}

}  // namespace

Result<void> check_quick_rows(const BodyRows& s, uint8_t own, const std::string& name, const std::string& advice) {
    std::string trouble;
    for (uint32_t b = 0; b < s.quick_bodies.size() && trouble.empty(); ++b)
        trouble = trouble_of_body(s.quick_bodies, b);
    for (uint32_t t = 0; t < s.quick_runs.size() && trouble.empty(); ++t) trouble = trouble_of_run(s, own, t);
    for (uint32_t t = 0; t < s.tasks.size() && trouble.empty(); ++t) trouble = trouble_of_part(s, own, t);
    // A task of a quick body without a run of its own would step stiffness that it does not have.
    for (uint32_t t = 0; t < s.tasks.size() && trouble.empty(); ++t)
        if (is_open_task(s, own, t) && is_quick_body(s, s.tasks.body[t]) && !is_quick_task(s, t))
            trouble = place(s.tasks, "body", t) + " is quick, and its task is not";
    if (!trouble.empty()) return Error{name + ": " + trouble + ". " + advice};
    return {};
}

}  // namespace cullet
