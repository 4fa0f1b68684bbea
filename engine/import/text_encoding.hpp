// Text of other programs as the readers want it: UTF-8 without a byte order mark. Windows editors put a mark before
// UTF-8 and write UTF-16 of either byte order; assimp and most parsers take the mark for a part of the first word.
#pragma once
#include <string>
#include <string_view>

namespace cullet {

/// True when the bytes begin with a byte order mark of UTF-8, UTF-16 or UTF-32.
bool has_byte_order_mark(std::string_view bytes);
/// True for UTF-16 without a mark: the first two characters are plain ones, each with its zero byte.
bool is_like_utf16(std::string_view bytes);

/// The bytes of the character at the front that follow its first one; -1 where it is none of UTF-8.
int utf8_followers(std::string_view text);
bool is_utf8(std::string_view text);

/// The text as UTF-8 without a mark. UTF-16 and UTF-32 are known by their marks, UTF-16 also without. Anything else
/// comes back as it is: what follows a UTF-8 mark and bytes of other encodings are not looked at. Halves of pairs that
/// stand alone become U+FFFD.
std::string plain_text(std::string bytes);

/// The same without blanks in front, and without blanks, zero bytes and Ctrl-Z behind: XML must begin with its first
/// tag and end with its last.
std::string plain_xml(std::string bytes);

}  // namespace cullet
