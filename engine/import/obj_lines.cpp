#include "engine/import/obj_lines.hpp"

#include <charconv>
#include <cmath>
#include <optional>

#include "engine/import/words.hpp"
#include "engine/mesh_file.hpp"

namespace cullet {
namespace {

constexpr size_t kShown = 40;  // letters of a word in a sentence

/// The words of one line behind its first, which go on in the next line behind a backslash. Comments are left out.
class RestOfLine {
 public:
    explicit RestOfLine(Words& words) : words_(words) {}
    std::string_view next() {
        std::string_view word = goes_on_ ? words_.next() : words_.next_of_line();
        goes_on_ = !word.empty() && word.back() == '\\';
        if (goes_on_) word.remove_suffix(1);
        if (goes_on_ && word.empty()) return next();
        return word.substr(0, word.find('#'));
    }

 private:
    Words& words_;
    bool goes_on_ = false;
};

Error in_line(const std::string& path, uint64_t line, const std::string& what) {
    return Error{path + ": line " + std::to_string(line) + ": " + what};
}

std::string quoted(std::string_view word) {
    return "\"" + one_line(std::string(word), kShown) + "\"";
}

/// Of "7", "7/1", "7//3": the 7.
std::optional<int64_t> point_of(std::string_view corner) {
    const std::string_view number = corner.substr(0, corner.find('/'));
    int64_t point = 0;
    const auto [end, trouble] = std::from_chars(number.data(), number.data() + number.size(), point);
    if (trouble != std::errc() || end != number.data() + number.size()) return std::nullopt;
    return point;
}

/// Counts from 1, or from the last point before the face backwards.
struct Reach {
    int64_t most = 0, line = 0;  // the highest point that a face names, and where
};

class ObjLines {
 public:
    ObjLines(std::string_view text, const std::string& path) : words_(text), path_(path) {}
    Result<void> check() {
        for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
            const Result<void> line = word == "v" ? check_point() : word == "f" ? check_face() : Result<void>{};
            if (!line) return line;
            words_.skip_line();
        }
        if (reach_.most <= points_) return {};
        return in_line(path_, static_cast<uint64_t>(reach_.line),
                       "the face names point " + std::to_string(reach_.most) + ", and the file has " +
                           counted(static_cast<uint64_t>(points_), "point", "points") +
                           ". The file is damaged or cut off; export it again.");
    }

 private:
    Result<void> check_point() {
        RestOfLine rest(words_);
        const uint64_t line = words_.line();
        for (int k = 0; k < 3; ++k) {
            const std::string_view word = rest.next();
            if (word.empty())
                return in_line(path_, line,
                               "a point has " + counted(static_cast<uint64_t>(k), "number", "numbers") +
                                   "; write three, as in \"v 0.5 1 2\".");
            const std::optional<double> number = number_of(word);
            if (!number || !std::isfinite(*number))
                return in_line(path_, line, quoted(word) + " is no finite number; write points as in \"v 0.5 1 2\".");
        }
        ++points_;
        return {};
    }
    Result<void> check_face() {
        RestOfLine rest(words_);
        const auto line = static_cast<int64_t>(words_.line());
        for (std::string_view word = rest.next(); !word.empty(); word = rest.next()) {
            const std::optional<int64_t> point = point_of(word);
            if (!point || *point == 0 || *point < -points_)
                return in_line(path_, static_cast<uint64_t>(line),
                               quoted(word) + " names no point of the " + std::to_string(points_) +
                                   " before it; points count from 1, or from -1 backwards.");
            if (*point > reach_.most) reach_ = {*point, line};
        }
        return {};
    }

    Words words_;
    const std::string& path_;
    int64_t points_ = 0;
    Reach reach_;
};

}  // namespace

Result<void> check_obj(std::string_view text, const std::string& path) {
    return ObjLines(text, path).check();
}

}  // namespace cullet
