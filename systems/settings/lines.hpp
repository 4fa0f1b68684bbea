// One line a setting: name, unit, member, range, help. Kind and default follow from the member.
#pragma once
#include <type_traits>

#include "cullet/setting_list.hpp"

namespace cullet {

struct SettingRange {
    double least, most;
    bool may_be_zero = false;
};
constexpr SettingRange zero_or(double least, double most) {
    return {least, most, true};
}

template <class Member>
struct SettingMember;
template <class S, class V>
struct SettingMember<V S::*> {
    using Settings = S;
    using Value = V;
};

template <class V>
constexpr SettingKind kSettingKind = std::is_same_v<V, bool> ? SettingKind::Switch
                                     : std::is_enum_v<V>     ? SettingKind::Word
                                     : std::is_integral_v<V> ? SettingKind::Whole
                                                             : SettingKind::Real;

template <auto Member>
constexpr Setting setting_line(const char* name, const char* unit, SettingRange range, const char* words,
                               const char* help) {
    using S = typename SettingMember<decltype(Member)>::Settings;
    using V = typename SettingMember<decltype(Member)>::Value;
    static_assert(std::is_same_v<V, float> || std::is_same_v<V, uint32_t> || std::is_same_v<V, bool> ||
                      (std::is_enum_v<V> && sizeof(V) == 1),
                  "recordings know no other kinds");
    return {name,
            kSettingKind<V>,
            unit,
            range.least,
            range.most,
            range.may_be_zero,
            words,
            static_cast<double>(S{}.*Member),
            help,
            [](const void* settings) { return static_cast<double>(static_cast<const S*>(settings)->*Member); },
            [](void* settings, double value) { static_cast<S*>(settings)->*Member = static_cast<V>(value); }};
}

template <auto Member>
constexpr Setting number(const char* name, const char* unit, SettingRange range, const char* help) {
    return setting_line<Member>(name, unit, range, "", help);
}
template <auto Member>
constexpr Setting yes_or_no(const char* name, const char* help) {
    return setting_line<Member>(name, "1", {0, 1}, "", help);
}
/// `words`: "hidden, quick", in the order of the enum.
template <auto Member>
constexpr Setting word(const char* name, const char* words, const char* help) {
    double last = 0;
    for (const char* c = words; *c; ++c) last += *c == ',';
    return setting_line<Member>(name, "1", {0, last}, words, help);
}

/// Takes the place of any member, to count them.
struct AnyMember {
    template <class T>
    constexpr operator T() const;
};
/// Members of a plain struct: a list that leaves one out does not compile.
template <class S, class... Found>
consteval size_t member_count() {
    if constexpr (requires { S{Found{}..., AnyMember{}}; })
        return member_count<S, Found..., AnyMember>();
    else
        return sizeof...(Found);
}

}  // namespace cullet
