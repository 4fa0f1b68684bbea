// Text in the encodings that editors write.
#pragma once
#include <string>

namespace cullet::test {

enum class Encoding { Utf8, Utf8Mark, Utf16Little, Utf16Big, Utf32Little, Utf32Big };
inline constexpr Encoding kEncodings[] = {Encoding::Utf8,     Encoding::Utf8Mark,    Encoding::Utf16Little,
                                          Encoding::Utf16Big, Encoding::Utf32Little, Encoding::Utf32Big};

/// With its mark; Utf8 has none.
inline std::string coded(const std::u32string& text, Encoding encoding) {
    std::string out;
    const auto put = [&out](uint32_t value, int bytes, bool is_big) {
        for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * (is_big ? bytes - 1 - i : i)));
    };
    const bool is_big = encoding == Encoding::Utf16Big || encoding == Encoding::Utf32Big;
    const bool is_16 = encoding == Encoding::Utf16Little || encoding == Encoding::Utf16Big;
    const bool is_8 = encoding == Encoding::Utf8 || encoding == Encoding::Utf8Mark;
    if (encoding == Encoding::Utf8Mark) out = "\xEF\xBB\xBF";
    if (!is_8) put(0xFEFF, is_16 ? 2 : 4, is_big);
    for (const char32_t c : text) {
        const auto value = static_cast<uint32_t>(c);
        if (is_16 && value >= 0x10000) {
            put(0xD800 + ((value - 0x10000) >> 10), 2, is_big);
            put(0xDC00 + ((value - 0x10000) & 0x3FF), 2, is_big);
        } else if (!is_8) {
            put(value, is_16 ? 2 : 4, is_big);
        } else if (value < 0x80) {
            put(value, 1, false);
        } else if (value < 0x800) {
            put(0xC0 | (value >> 6), 1, false);
            put(0x80 | (value & 0x3F), 1, false);
        } else {
            put(value < 0x10000 ? 0xE0 | (value >> 12) : 0xF0 | (value >> 18), 1, false);
            if (value >= 0x10000) put(0x80 | ((value >> 12) & 0x3F), 1, false);
            put(0x80 | ((value >> 6) & 0x3F), 1, false);
            put(0x80 | (value & 0x3F), 1, false);
        }
    }
    return out;
}

/// Of plain characters.
inline std::string coded(const std::string& text, Encoding encoding) {
    return coded(std::u32string(text.begin(), text.end()), encoding);
}

}  // namespace cullet::test
