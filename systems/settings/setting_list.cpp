// The public face of lists of settings: ranges and values in words.
#include "cullet/setting_list.hpp"

#include <charconv>
#include <cstdio>
#include <vector>

#include "systems/settings/check.hpp"

namespace cullet {
namespace {

std::string shown(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::vector<std::string> words_of(const Setting& setting) {
    if (setting.kind == SettingKind::Switch) return {"false", "true"};
    const std::string all = setting.words;
    std::vector<std::string> words;
    for (size_t from = 0, comma = 0; comma != std::string::npos; from = comma + 2) {
        comma = all.find(", ", from);
        words.push_back(all.substr(from, comma - from));
    }
    return words;
}

bool has_words(const Setting& setting) {
    return setting.kind == SettingKind::Switch || setting.kind == SettingKind::Word;
}

/// The ends of what is real as floats: what is written as 0.577 is not refused.
double end_of(const Setting& setting, double end) {
    return setting.kind == SettingKind::Real ? static_cast<double>(static_cast<float>(end)) : end;
}

}  // namespace

bool is_in_range(const Setting& setting, double value) {
    if (setting.may_be_zero && value == 0) return true;
    if (setting.kind == SettingKind::Real) value = static_cast<double>(static_cast<float>(value));
    return value >= end_of(setting, setting.least) && value <= end_of(setting, setting.most) &&
           (setting.kind == SettingKind::Real || value == static_cast<double>(static_cast<uint32_t>(value)));
}

std::string range_of(const Setting& setting) {
    if (setting.kind == SettingKind::Switch) return "true or false";
    if (has_words(setting)) {
        const std::vector<std::string> words = words_of(setting);
        std::string text;
        for (size_t k = 0; k < words.size(); ++k)
            text += (k == 0 ? "" : k + 1 == words.size() ? " or " : ", ") + words[k];
        return text;
    }
    const bool are_two = setting.kind == SettingKind::Whole && setting.most == setting.least + 1;
    return (setting.may_be_zero ? "0, or " : "") + shown(setting.least) + (are_two ? " or " : " to ") +
           shown(setting.most) + (std::string(setting.unit) == "1" ? "" : std::string(" ") + setting.unit);
}

std::string text_of(const Setting& setting, double value) {
    return has_words(setting) && is_in_range(setting, value) ? words_of(setting)[static_cast<size_t>(value)]
                                                             : shown(value);
}

Result<double> read_setting(const Setting& setting, const std::string& text) {
    double value = 0;
    bool is_read = false;
    if (has_words(setting)) {
        const std::vector<std::string> words = words_of(setting);
        for (size_t k = 0; k < words.size(); ++k)
            if (words[k] == text) value = static_cast<double>(k), is_read = true;
    } else {
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        is_read = error == std::errc() && end == text.data() + text.size();
    }
    if (!is_read || !is_in_range(setting, value))
        return Error{std::string(setting.name) + " is \"" + text + "\"; use " + range_of(setting) + "."};
    return value;
}

std::string out_of_range(const std::string& name, const Setting& setting, double value) {
    return name + " is " + (setting.kind == SettingKind::Word ? "number " : "") + shown(value) + "; use " +
           range_of(setting) + ".";
}

}  // namespace cullet
