#include "engine/import/text_encoding.hpp"

#include <cstdint>
#include <optional>
#include <utility>

namespace cullet {
namespace {

struct Encoding {
    size_t mark = 0;  // bytes
    size_t unit = 1;  // bytes a code unit
    bool is_big_endian = false;
};

/// UTF-32 comes first: its little-endian mark begins with that of UTF-16.
std::optional<Encoding> marked_encoding(std::string_view bytes) {
    const auto begins = [bytes](std::string_view mark) { return bytes.substr(0, mark.size()) == mark; };
    if (begins("\xEF\xBB\xBF")) return Encoding{3, 1, false};
    if (begins(std::string_view("\xFF\xFE\0\0", 4))) return Encoding{4, 4, false};
    if (begins(std::string_view("\0\0\xFE\xFF", 4))) return Encoding{4, 4, true};
    if (begins("\xFF\xFE")) return Encoding{2, 2, false};
    if (begins("\xFE\xFF")) return Encoding{2, 2, true};
    return std::nullopt;
}

bool is_plain_character(char c) {
    return (c >= ' ' && c <= '~') || c == '\t' || c == '\n' || c == '\r';
}

/// UTF-16 without a mark: two plain characters, each beside a zero byte.
std::optional<Encoding> guessed_encoding(std::string_view bytes) {
    if (bytes.size() < 4) return std::nullopt;
    if (is_plain_character(bytes[0]) && bytes[1] == 0 && is_plain_character(bytes[2]) && bytes[3] == 0)
        return Encoding{0, 2, false};
    if (bytes[0] == 0 && is_plain_character(bytes[1]) && bytes[2] == 0 && is_plain_character(bytes[3]))
        return Encoding{0, 2, true};
    return std::nullopt;
}

uint32_t unit_at(std::string_view bytes, size_t at, const Encoding& encoding) {
    uint32_t value = 0;
    for (size_t i = 0; i < encoding.unit; ++i) {
        const size_t place = encoding.is_big_endian ? encoding.unit - 1 - i : i;
        value |= static_cast<uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * place);
    }
    return value;
}

void append_utf8(std::string& out, uint32_t c) {
    if (c > 0x10FFFF || (c >= 0xD800 && c < 0xE000)) c = 0xFFFD;
    const auto put = [&out](uint32_t byte) { out += static_cast<char>(byte); };
    if (c < 0x80) return put(c);
    if (c < 0x800) {
        put(0xC0 | (c >> 6));
    } else {
        if (c < 0x10000) {
            put(0xE0 | (c >> 12));
        } else {
            put(0xF0 | (c >> 18));
            put(0x80 | ((c >> 12) & 0x3F));
        }
        put(0x80 | ((c >> 6) & 0x3F));
    }
    put(0x80 | (c & 0x3F));
}

/// An odd byte at the end is half a character and goes.
std::string decoded(std::string_view bytes, const Encoding& encoding) {
    std::string out;
    out.reserve(bytes.size() / encoding.unit);
    const auto is_half = [](uint32_t c, uint32_t first) { return c >= first && c < first + 0x400; };
    for (size_t at = encoding.mark; at + encoding.unit <= bytes.size(); at += encoding.unit) {
        uint32_t c = unit_at(bytes, at, encoding);
        const size_t next = at + encoding.unit;
        if (encoding.unit == 2 && is_half(c, 0xD800) && next + 2 <= bytes.size()) {
            const uint32_t low = unit_at(bytes, next, encoding);
            if (is_half(low, 0xDC00)) {
                c = 0x10000 + ((c - 0xD800) << 10) + (low - 0xDC00);
                at = next;
            }
        }
        append_utf8(out, c);
    }
    return out;
}

}  // namespace

bool has_byte_order_mark(std::string_view bytes) {
    return marked_encoding(bytes).has_value();
}

bool is_like_utf16(std::string_view bytes) {
    return guessed_encoding(bytes).has_value();
}

int utf8_followers(std::string_view text) {
    const auto byte = [text](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const unsigned first = byte(0);
    const int followers = first < 0x80 ? 0 : first >= 0xC2 && first < 0xE0 ? 1 : first >= 0xE0 && first < 0xF0 ? 2 : 3;
    if (first >= 0x80 && (first < 0xC2 || first > 0xF4)) return -1;
    for (int i = 1; i <= followers; ++i)
        if ((byte(static_cast<size_t>(i)) & 0xC0) != 0x80) return -1;
    const unsigned second = byte(1);
    const bool is_too_long = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
    const bool is_no_character = (first == 0xED && second >= 0xA0) || (first == 0xF4 && second >= 0x90);
    return is_too_long || is_no_character ? -1 : followers;
}

bool is_utf8(std::string_view text) {
    for (size_t i = 0; i < text.size(); ++i) {
        const int followers = utf8_followers(text.substr(i, 4));
        if (followers < 0) return false;
        i += static_cast<size_t>(followers);
    }
    return true;
}

std::string plain_text(std::string bytes) {
    auto encoding = marked_encoding(bytes);
    if (!encoding) encoding = guessed_encoding(bytes);
    if (!encoding) return bytes;
    if (encoding->unit == 1) return bytes.erase(0, encoding->mark);
    return decoded(bytes, *encoding);
}

std::string plain_xml(std::string bytes) {
    std::string text = plain_text(std::move(bytes));
    text.erase(text.find_last_not_of(std::string_view(" \t\r\n\v\f\0\x1a", 8)) + 1);
    return text.erase(0, text.find_first_not_of(" \t\r\n"));
}

}  // namespace cullet
