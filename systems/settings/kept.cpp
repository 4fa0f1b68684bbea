#include "systems/settings/kept.hpp"

#include "systems/settings/check.hpp"

namespace cullet {
namespace {

constexpr float kRadiansADegree = 0.017453292519943295f;

const ColumnInfo& column_of(const AnyTable& table, const Setting& setting) {
    const ColumnInfo* found = nullptr;
    for (const ColumnInfo& column : table.columns())
        if (std::string_view(column.name) == setting.name) found = &column;
    CULLET_ASSERT(found && found->lanes == 1 && found->sides == 1 && found->components == 1,
                  "%s has no column of numbers for the setting %s", table.name(), setting.name);
    return *found;
}

/// What the column's numbers are times the setting's. In single precision, as both are.
float scale_of(const ColumnInfo& column, const Setting& setting) {
    const bool is_turned = std::string_view(setting.unit) == "degrees" && std::string_view(column.unit) == "rad";
    return is_turned ? kRadiansADegree : 1;
}

template <class T>
void put(std::byte* row, double value) {
    const T number = static_cast<T>(value);
    std::memcpy(row, &number, sizeof number);
}

template <class T>
double taken(const std::byte* row) {
    T number;
    std::memcpy(&number, row, sizeof number);
    return static_cast<double>(number);
}

}  // namespace

void keep_settings(AnyTable& table, uint32_t row, const SettingList& list, const void* settings) {
    for (const Setting& setting : list) {
        const ColumnInfo& column = column_of(table, setting);
        std::byte* const place = table.column_memory(column, 0) + size_t{row} * column.row_bytes;
        const double value = setting.get(settings);
        switch (column.scalar) {
            case Scalar::U8:
                put<uint8_t>(place, value);
                break;
            case Scalar::U16:
                put<uint16_t>(place, value);
                break;
            case Scalar::U32:
                put<uint32_t>(place, value);
                break;
            default:
                put<float>(place, static_cast<double>(scale_of(column, setting) * static_cast<float>(value)));
        }
    }
}

std::string trouble_of_kept(const AnyTable& table, uint32_t row, const SettingList& list) {
    for (const Setting& setting : list) {
        const ColumnInfo& column = column_of(table, setting);
        const std::byte* const place = table.column_memory(column, 0) + size_t{row} * column.row_bytes;
        const double value = column.scalar == Scalar::U8    ? taken<uint8_t>(place)
                             : column.scalar == Scalar::U16 ? taken<uint16_t>(place)
                             : column.scalar == Scalar::U32 ? taken<uint32_t>(place)
                                                            : taken<float>(place);
        Setting in_row = setting;
        const auto scale = static_cast<double>(scale_of(column, setting));
        if (scale != 1) in_row.least *= scale, in_row.most *= scale, in_row.unit = column.unit;
        if (!is_in_range(in_row, value)) {
            std::string said = out_of_range(table.place_of(column, 0, row), in_row, value);
            said.pop_back();
            return said;
        }
    }
    return {};
}

}  // namespace cullet
