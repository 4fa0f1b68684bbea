// The list that a struct of settings has.
#pragma once
#include "cullet/setting_list.hpp"

namespace cullet {

template <class Settings>
SettingList setting_list();

}  // namespace cullet
