// What can be set of the damage models, over all of them: for options, scripts, labels and help.
#pragma once
#include <string>
#include <vector>

#include "cullet/world.hpp"

namespace cullet {

std::vector<SettingGroup<CookSettings>> all_cook_settings();
std::vector<SettingGroup<SpawnSettings>> all_spawn_settings();

/// A line each, as a table of a page: name, default, range, what it is.
std::string settings_table();

}  // namespace cullet
