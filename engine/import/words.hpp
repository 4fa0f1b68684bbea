// Words and numbers of text formats: what stands between blanks, and where.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cullet {

/// Walks over a text word by word. Lines end with LF, CR or both.
class Words {
 public:
    explicit Words(std::string_view text) : text_(text) {}

    /// The next word, "" at the end. Zero bytes part words as blanks do.
    std::string_view next();
    /// The next word, which stays the next one.
    std::string_view peek();
    /// The next word when it stands in the line where the last one ended, "" otherwise.
    std::string_view next_of_line();
    /// Goes on with the next line.
    void skip_line();

    uint64_t line() const { return line_; }  // of the last word, from 1
    size_t offset() const { return at_; }    // behind the last word, in bytes

 private:
    void skip_blanks(bool across_lines);

    std::string_view text_;
    size_t at_ = 0;
    uint64_t line_ = 1;
};

/// The whole word as a number, whatever the locale. Also "+1", ".5", "1e5" and what programs write for values that are
/// none: "nan", "-nan(ind)", "1.#QNAN", "inf", "-1.#INF". Beyond the range of double it is infinite or 0.
std::optional<double> number_of(std::string_view word);

/// How many bytes stand behind `offset`, without the blanks, zero bytes and Ctrl-Z that end the text.
uint64_t bytes_behind(std::string_view text, size_t offset);

/// "1 byte", "2 bytes".
std::string counted(uint64_t n, const std::string& one, const std::string& many);

/// Letters A to Z small.
std::string small_letters(std::string_view word);

/// Both without regard to large and small letters; `wanted` in small ones.
bool is_word(std::string_view word, std::string_view wanted);

}  // namespace cullet
