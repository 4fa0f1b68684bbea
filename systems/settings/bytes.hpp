// What a game has set of a damage model, as bytes of a recording: by the model's lists, in their order.
#pragma once
#include "cullet/setting_list.hpp"
#include "engine/byte_stream.hpp"

namespace cullet {

template <class Groups, class Settings>
void put_settings(ByteWriter& out, const Groups& groups, const Settings& settings) {
    for (const auto& group : groups)
        for (const Setting& setting : group.list) {
            const double value = group.get(settings, setting);
            if (setting.kind == SettingKind::Real)
                out.number(static_cast<float>(value));
            else if (setting.kind == SettingKind::Whole)
                out.number(static_cast<uint32_t>(value));
            else
                out.number(static_cast<uint8_t>(value));
        }
}

template <class Groups, class Settings>
void take_settings(ByteReader& in, const Groups& groups, Settings& settings) {
    for (const auto& group : groups)
        for (const Setting& setting : group.list) {
            const double value = setting.kind == SettingKind::Real ? static_cast<double>(in.number<float>(setting.name))
                                 : setting.kind == SettingKind::Whole
                                     ? static_cast<double>(in.number<uint32_t>(setting.name))
                                     : static_cast<double>(in.number<uint8_t>(setting.name));
            group.set(settings, setting, value);
        }
}

}  // namespace cullet
