// What a game has set of a damage model, looked at by the model's lists.
#pragma once
#include <string>

#include "cullet/setting_list.hpp"

namespace cullet {

/// "quick.steps is 7; use 8 to 100."
std::string out_of_range(const std::string& name, const Setting& setting, double value);

/// Empty, or a sentence: which value, what it is, the range.
template <class Groups, class Settings>
Result<void> check_settings(const Groups& groups, const Settings& settings) {
    for (const auto& group : groups)
        for (const Setting& setting : group.list) {
            const double value = group.get(settings, setting);
            if (is_in_range(setting, value)) continue;
            const std::string table = group.name;
            return Error{out_of_range((table.empty() ? "" : table + ".") + setting.name, setting, value)};
        }
    return {};
}

}  // namespace cullet
