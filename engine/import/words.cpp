#include "engine/import/words.hpp"

#include <charconv>
#include <limits>

namespace cullet {
namespace {

bool is_end_of_line(char c) {
    return c == '\n' || c == '\r';
}

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\0';
}

char small_letter(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
}

bool begins_with(std::string_view word, std::string_view wanted) {
    return word.size() >= wanted.size() && is_word(word.substr(0, wanted.size()), wanted);
}

/// Without its sign.
std::optional<double> special_value(std::string_view word) {
    const bool is_of_windows = begins_with(word, "1.#");
    if (is_of_windows) word = word.substr(3);
    if (is_word(word, "inf") || is_word(word, "infinity")) return std::numeric_limits<double>::infinity();
    const bool is_nan =
        begins_with(word, "nan") ||
        (is_of_windows && (begins_with(word, "qnan") || begins_with(word, "snan") || begins_with(word, "ind")));
    if (is_nan) return std::numeric_limits<double>::quiet_NaN();
    return std::nullopt;
}

/// std::from_chars leaves the value alone when it is out of range; an exponent below zero tells which side.
double out_of_range(std::string_view digits) {
    const size_t exponent = digits.find_first_of("eE");
    const bool is_small = exponent != digits.npos ? digits.substr(exponent + 1, 1) == "-" : digits.substr(0, 1) == "0";
    return is_small ? 0 : std::numeric_limits<double>::infinity();
}

}  // namespace

void Words::skip_blanks(bool across_lines) {
    while (at_ < text_.size()) {
        const char c = text_[at_];
        if (is_end_of_line(c)) {
            if (!across_lines) return;
            line_ += c == '\n' || at_ + 1 == text_.size() || text_[at_ + 1] != '\n';
        } else if (!is_blank(c)) {
            return;
        }
        ++at_;
    }
}

std::string_view Words::next() {
    skip_blanks(true);
    const size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]) && !is_end_of_line(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
}

std::string_view Words::peek() {
    const Words here = *this;
    const std::string_view word = next();
    *this = here;
    return word;
}

std::string_view Words::next_of_line() {
    skip_blanks(false);
    if (at_ < text_.size() && is_end_of_line(text_[at_])) return {};
    return next();
}

void Words::skip_line() {
    while (at_ < text_.size() && !is_end_of_line(text_[at_])) ++at_;
}

std::optional<double> number_of(std::string_view word) {
    const bool is_negative = word.substr(0, 1) == "-";
    const std::string_view digits = is_negative || word.substr(0, 1) == "+" ? word.substr(1) : word;
    if (digits.empty()) return std::nullopt;
    double value = 0;
    if (digits[0] == '.' || (digits[0] >= '0' && digits[0] <= '9')) {
        const char* const end = digits.data() + digits.size();
        const auto read = std::from_chars(digits.data(), end, value);
        if (read.ptr == end && read.ec == std::errc()) return is_negative ? -value : value;
        if (read.ptr == end && read.ec == std::errc::result_out_of_range)
            return is_negative ? -out_of_range(digits) : out_of_range(digits);
    }
    const auto special = special_value(digits);
    if (!special) return std::nullopt;
    return is_negative ? -*special : *special;
}

uint64_t bytes_behind(std::string_view text, size_t offset) {
    const size_t end = text.find_last_not_of(std::string_view(" \t\r\n\v\f\0\x1a", 8));
    return end == text.npos || end < offset ? 0 : end + 1 - offset;
}

std::string counted(uint64_t n, const std::string& one, const std::string& many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

std::string small_letters(std::string_view word) {
    std::string small(word);
    for (char& c : small) c = small_letter(c);
    return small;
}

bool is_word(std::string_view word, std::string_view wanted) {
    if (word.size() != wanted.size()) return false;
    for (size_t i = 0; i < word.size(); ++i)
        if (small_letter(word[i]) != wanted[i]) return false;
    return true;
}

}  // namespace cullet
