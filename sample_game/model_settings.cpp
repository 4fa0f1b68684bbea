#include "sample_game/model_settings.hpp"

#include <fmt/format.h>

namespace cullet {
namespace {

template <class Groups>
std::string rows_of(const Groups& groups) {
    std::string rows;
    for (const auto& group : groups)
        for (const Setting& setting : group.list)
            rows += fmt::format("| `{}{}{}` | {} | {} | {} |\n", group.name, *group.name ? "." : "", setting.name,
                                text_of(setting, setting.standard), range_of(setting), setting.help);
    return rows;
}

}  // namespace

std::vector<SettingGroup<CookSettings>> all_cook_settings() {
    std::vector<SettingGroup<CookSettings>> all;
    for (const std::string& model : damage_model_names())
        for (const auto& group : cook_settings_of(model)) all.push_back(group);
    return all;
}

std::vector<SettingGroup<SpawnSettings>> all_spawn_settings() {
    std::vector<SettingGroup<SpawnSettings>> all;
    for (const std::string& model : damage_model_names())
        for (const auto& group : spawn_settings_of(model)) all.push_back(group);
    return all;
}

std::string settings_table() {
    std::string table;
    const auto add = [&table](const std::string& model, const char* when, const std::string& rows) {
        if (rows.empty()) return;
        table += fmt::format("{}| of {}, when {} | default | range | what it is |\n|---|---|---|---|\n{}",
                             table.empty() ? "" : "\n", model, when, rows);
    };
    for (const std::string& model : damage_model_names()) {
        add(model, "cooked", rows_of(cook_settings_of(model)));
        add(model, "spawned", rows_of(spawn_settings_of(model)));
    }
    return table;
}

}  // namespace cullet
