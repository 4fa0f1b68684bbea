// What a game may set of the thick shell, a line each (settings.cpp).
#pragma once
#include "cullet/thick_shell.hpp"
#include "systems/settings/setting_list.hpp"

namespace cullet {

template <>
SettingList setting_list<ThickShellCookSettings>();
/// Without `quick` and `springs`, which have lists of their own.
template <>
SettingList setting_list<ThickShellSpawnSettings>();
template <>
SettingList setting_list<QuickSettings>();
template <>
SettingList setting_list<LayerSettings>();

}  // namespace cullet
