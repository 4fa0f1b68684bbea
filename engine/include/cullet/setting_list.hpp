// Settings of damage models as lists, a line each. The check of a call, recordings, scripts, options and help loop over
// them. So may an editor that shows them.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "cullet/result.hpp"

namespace cullet {

/// What a member of a settings struct is: a float, a uint32_t, a bool, an enum.
enum class SettingKind : uint8_t { Real = 0, Whole, Switch, Word };

/// One member of a settings struct. Whatever it is, its value comes and goes as a number: a switch is 0 or 1, a word
/// its place among `words`.
struct Setting {
    const char* name;  // as in the struct, and in scripts
    SettingKind kind;
    const char* unit;    // "1": a pure number, a switch or a word
    double least, most;  // both ends may be had
    bool may_be_zero;    // 0 may be had too, below `least`
    const char* words;   // of a word: "hidden, quick", by number
    double standard;     // what the struct has when nothing is given
    const char* help;    // what it is, in one line
    double (*get)(const void* settings);
    void (*set)(void* settings, double value);
};
struct SettingList {
    const Setting* data;
    size_t count;
    const Setting* begin() const { return data; }
    const Setting* end() const { return data + count; }
};

/// A struct of them within CookSettings or SpawnSettings.
template <class Settings>
struct SettingGroup {
    const char* name;  // of its table in scripts: "quick"; empty: they stand beside what all models have
    SettingList list;
    void* (*within)(Settings&);
    double get(const Settings& settings, const Setting& setting) const {
        return setting.get(within(const_cast<Settings&>(settings)));
    }
    void set(Settings& settings, const Setting& setting, double value) const { setting.set(within(settings), value); }
};

bool is_in_range(const Setting& setting, double value);
/// "8 to 100", "0, or 1 to 1e+06", "0 to 30 degrees", "hidden or quick", "true or false"
std::string range_of(const Setting& setting);
/// As people write it: "0.5", "quick", "true".
std::string text_of(const Setting& setting, double value);
/// The value that this text means. An error says what it wants.
Result<double> read_setting(const Setting& setting, const std::string& text);

}  // namespace cullet
