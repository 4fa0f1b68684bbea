// Settings of damage models in the tables of game.cook and game.spawn, by the models' lists.
#pragma once
#include <string_view>
#include <vector>

#include "cullet/setting_list.hpp"
#include "sample_game/script/arguments.hpp"

namespace cullet {

/// "a whole number: 8 to 100", "hidden or quick"
std::string expected_of(const Setting& setting);
/// The value that the table gives, or `otherwise`.
double setting_given(const Arguments& given, const Setting& setting, double otherwise);

/// Names that stand in the call's own table: of settings, and of the tables that they are in.
template <class Groups>
void add_names(std::vector<const char*>& names, const Groups& groups) {
    for (const auto& group : groups) {
        if (*group.name) names.push_back(group.name);
        for (const Setting& setting : group.list)
            if (!*group.name) names.push_back(setting.name);
    }
}

/// `left_out`: a name that the call reads by itself.
template <class Groups, class Settings>
void read_settings(lua_State* lua, const std::string& call, const Arguments& given, const Groups& groups,
                   Settings& settings, std::string_view left_out = {}) {
    for (const auto& group : groups) {
        const auto read = [&](const Arguments& table) {
            for (const Setting& setting : group.list)
                if (setting.name != left_out)
                    group.set(settings, setting, setting_given(table, setting, group.get(settings, setting)));
        };
        if (!*group.name) {
            read(given);
        } else if (given.has(group.name)) {
            given.push(group.name);
            std::vector<const char*> names;
            for (const Setting& setting : group.list) names.push_back(setting.name);
            const std::string within = call + "." + group.name;
            read(Arguments(lua, within.c_str(), names, false, -1));
            given.pop();
        }
    }
}

}  // namespace cullet
