// What a game may set of the metal shell, a line each (settings.cpp).
#pragma once
#include "cullet/metal_shell.hpp"
#include "systems/settings/setting_list.hpp"

namespace cullet {

template <>
SettingList setting_list<MetalShellSettings>();

}  // namespace cullet
