// What a game may set of the lattice, a line each (settings.cpp).
#pragma once
#include "cullet/lattice.hpp"
#include "systems/settings/setting_list.hpp"

namespace cullet {

template <>
SettingList setting_list<LatticeSettings>();

}  // namespace cullet
