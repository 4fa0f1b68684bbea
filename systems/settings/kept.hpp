// Settings that a damage model keeps for a body or a task: each in the column that has its name.
#pragma once
#include <string>

#include "cullet/setting_list.hpp"
#include "engine/table.hpp"

namespace cullet {

/// Every setting has its column, one number a row.
void keep_settings(AnyTable& table, uint32_t row, const SettingList& list, const void* settings);
/// Empty, or "quick_bodies.steps[3] is 7; use 8 to 100" of the first one that no call would have let in.
std::string trouble_of_kept(const AnyTable& table, uint32_t row, const SettingList& list);

}  // namespace cullet
