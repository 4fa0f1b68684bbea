#include "engine/import/text_encoding.hpp"

#include <gtest/gtest.h>

#include <random>

#include "engine/import/words.hpp"
#include "tests/support/encodings.hpp"

namespace cullet {
namespace {

using test::coded;
using test::Encoding;

const std::u32string kTexts[] = {U"v 1 2 3\n", U"name \u00e4\u20ac\u4e2d \U0001F3E0 end\r\n", U"#", U"<?xml?>"};

std::string utf8(const std::u32string& text) {
    return coded(text, Encoding::Utf8);
}

TEST(TextEncoding, EveryMarkIsKnownAndTaken) {
    for (const std::u32string& text : kTexts)
        for (const Encoding encoding : test::kEncodings) {
            const std::string bytes = coded(text, encoding);
            EXPECT_EQ(has_byte_order_mark(bytes), encoding != Encoding::Utf8);
            EXPECT_EQ(plain_text(bytes), utf8(text));
        }
}

TEST(TextEncoding, Utf16WithoutAMarkIsKnownByItsZeros) {
    for (const Encoding encoding : {Encoding::Utf16Little, Encoding::Utf16Big}) {
        const std::string bytes = coded(U"v 1 2 3\n\u00e4", encoding).substr(2);
        EXPECT_TRUE(is_like_utf16(bytes));
        EXPECT_EQ(plain_text(bytes), utf8(U"v 1 2 3\n\u00e4"));
    }
    for (const std::string& bytes :
         {std::string("v 1 2 3"), std::string("a\0\0\0", 4), std::string("\1\0\2\0", 4), std::string("v")}) {
        EXPECT_FALSE(is_like_utf16(bytes));
        EXPECT_EQ(plain_text(bytes), bytes);
    }
}

TEST(TextEncoding, HalvesOfPairsAndOddBytesDoNoHarm) {
    EXPECT_EQ(plain_text(std::string("\xFF\xFE\x00\xD8v\0", 6)), "\xEF\xBF\xBDv");
    EXPECT_EQ(plain_text(std::string("\xFF\xFE\x00\xDCv\0", 6)), "\xEF\xBF\xBDv");
    EXPECT_EQ(plain_text(std::string("\xFF\xFE\x3D\xD8\xE0", 5)), "\xEF\xBF\xBD");
    EXPECT_EQ(plain_text("\xEF\xBB\xBF"), "");
    EXPECT_EQ(plain_text(""), "");
    std::mt19937 random(3);
    for (int i = 0; i < 3000; ++i) {
        std::string bytes = i % 3 == 0 ? "\xFF\xFE" : i % 3 == 1 ? "\xFE\xFF" : "";
        for (size_t n = random() % 40; n > 0; --n) bytes += static_cast<char>(random() % 256);
        EXPECT_LE(plain_text(bytes).size(), 2 * bytes.size());
    }
}

TEST(TextEncoding, SurrogatesOverlongAndCutOffCharactersAreNoUtf8) {
    for (const std::string good : {"", "a", "\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9F\x98\x80", "x\xC3\xA9y",
                                   "\xED\x9F\xBF", "\xEE\x80\x80", "\xF4\x8F\xBF\xBF"})
        EXPECT_TRUE(is_utf8(good)) << good;
    for (const std::string bad :
         {"\xE9", "\xC0\x80", "\xC1\xBF", "\xE0\x80\x80", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF0\x80\x80\x80",
          "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xC3", "\xE2\x82", "\xC3\xA9\x80", "a\xFF"})
        EXPECT_FALSE(is_utf8(bad)) << bad;
}

TEST(Words, NumbersOfAllProgramsAreRead) {
    EXPECT_EQ(number_of("1"), 1);
    EXPECT_EQ(number_of("+1.5e+2"), 150);
    EXPECT_EQ(number_of("-.5"), -0.5);
    EXPECT_EQ(number_of("5."), 5);
    EXPECT_EQ(number_of("1e999"), std::numeric_limits<double>::infinity());
    EXPECT_EQ(number_of("-1e999"), -std::numeric_limits<double>::infinity());
    EXPECT_EQ(number_of("1e-999"), 0);
    for (const char* nan : {"nan", "NaN", "-nan", "-nan(ind)", "+nan", "nan(snan)", "1.#QNAN", "-1.#IND", "1.#SNAN0"})
        EXPECT_TRUE(number_of(nan) && std::isnan(*number_of(nan))) << nan;
    for (const char* infinite : {"inf", "-INF", "Infinity", "1.#INF", "-1.#INF"})
        EXPECT_TRUE(number_of(infinite) && std::isinf(*number_of(infinite))) << infinite;
    for (const char* none : {"", "-", "+", "x", "1x", "1,5", "--1", "0x10", "1e", "1.#", ".", "e5"})
        EXPECT_FALSE(number_of(none)) << none;
}

TEST(Words, LinesAreCountedWhateverEndsThem) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        const std::string text = "a b" + end + end + "c" + end + "d";
        Words words(text);
        EXPECT_EQ(words.next(), "a");
        EXPECT_EQ(words.next_of_line(), "b");
        EXPECT_EQ(words.next_of_line(), "");
        EXPECT_EQ(words.next(), "c");
        EXPECT_EQ(words.line(), 3u);
        EXPECT_EQ(words.peek(), "d");
        words.skip_line();
        EXPECT_EQ(words.next(), "d");
        EXPECT_EQ(words.line(), 4u);
        EXPECT_EQ(words.next(), "");
    }
}

}  // namespace
}  // namespace cullet
