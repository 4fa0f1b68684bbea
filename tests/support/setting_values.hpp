// Values at and beyond the ends of a setting's range.
#pragma once
#include <cmath>
#include <limits>
#include <vector>

#include "cullet/setting_list.hpp"

namespace cullet::test {

/// In the range: both ends, and 0 where it may be had.
inline std::vector<double> right_values(const Setting& setting) {
    std::vector<double> values{setting.least, setting.most};
    if (setting.kind == SettingKind::Real)
        for (double& value : values) value = static_cast<double>(static_cast<float>(value));
    if (setting.may_be_zero) values.push_back(0);
    return values;
}

/// Out of it by as little as there is, and no number. A switch has none.
inline std::vector<double> wrong_values(const Setting& setting) {
    if (setting.kind == SettingKind::Switch) return {};
    if (setting.kind == SettingKind::Word) return {setting.most + 1};
    if (setting.kind == SettingKind::Whole) {
        std::vector<double> values{setting.most + 1};
        if (setting.least > 0) values.push_back(setting.least - 1);
        return values;
    }
    const auto least = static_cast<float>(setting.least), most = static_cast<float>(setting.most);
    // The next number below 0 is 0 for who flushes what is tiny.
    const float below = least == 0 ? -1e-6f : std::nextafter(least, -1.0f);
    return {static_cast<double>(below), static_cast<double>(std::nextafter(most, 2 * most)), -1,
            std::numeric_limits<double>::quiet_NaN()};
}

}  // namespace cullet::test
