#include "sample_game/script/setting_calls.hpp"

#include <algorithm>

namespace cullet {

std::string expected_of(const Setting& setting) {
    const char* const kind = setting.kind == SettingKind::Real    ? "a number: "
                             : setting.kind == SettingKind::Whole ? "a whole number: "
                                                                  : "";
    return kind + range_of(setting);
}

double setting_given(const Arguments& given, const Setting& setting, double otherwise) {
    if (!given.has(setting.name)) return otherwise;
    const std::string expected = expected_of(setting);
    if (setting.kind == SettingKind::Switch) return given.is(setting.name, false) ? 1 : 0;
    if (setting.kind == SettingKind::Word) {
        const Result<double> value = read_setting(setting, given.word(setting.name, expected.c_str()));
        if (!value.ok()) given.refuse_value(setting.name, expected);
        return *value;
    }
    const double least = setting.may_be_zero ? std::min(0.0, setting.least) : setting.least;
    const double value = given.number(setting.name, {expected.c_str(), least, setting.most});
    if (!is_in_range(setting, value)) given.refuse_value(setting.name, expected);
    return value;
}

}  // namespace cullet
