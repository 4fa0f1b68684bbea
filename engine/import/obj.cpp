#include "engine/import/obj.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>

#include "engine/import/text_encoding.hpp"
#include "engine/import/words.hpp"
#include "engine/mesh_file.hpp"
#include "engine/polygon.hpp"

namespace cullet {
namespace {

constexpr size_t kShown = 40;  // letters of a word in a sentence
constexpr size_t kMostNamed = 8;
constexpr uint32_t kMostMaterials = 65535;

/// The words of one line behind its first, which go on in the next line behind a backslash. Comments are left out.
class RestOfLine {
 public:
    explicit RestOfLine(Words& words) : words_(words) {}
    std::string_view next() {
        if (is_comment_) return {};
        std::string_view word = goes_on_ ? words_.next() : words_.next_of_line();
        goes_on_ = !word.empty() && word.back() == '\\';
        if (goes_on_) word.remove_suffix(1);
        if (goes_on_ && word.empty()) return next();
        is_comment_ = word.find('#') != word.npos;
        return word.substr(0, word.find('#'));
    }

 private:
    Words& words_;
    bool goes_on_ = false, is_comment_ = false;
};

Error in_line(const std::string& path, uint64_t line, const std::string& what) {
    return Error{path + ": line " + std::to_string(line) + ": " + what};
}

std::string in_quotes(std::string_view word) {
    return "\"" + one_line(std::string(word), kShown) + "\"";
}

/// Everything behind a word in its line, without blanks at both ends.
std::string name_behind(Words& words, std::string_view text) {
    const size_t begin = words.offset();
    words.skip_line();
    const std::string_view line = text.substr(begin, words.offset() - begin);
    const size_t first = line.find_first_not_of(" \t\r\n"), last = line.find_last_not_of(" \t\r\n");
    return first == line.npos ? std::string() : std::string(line.substr(first, last - first + 1));
}

/// A number as it stands in a corner: from 1, or from the last one before the face backwards.
struct Reference {
    int64_t number = 0;
    bool is_there = false, is_sound = true;
};

Reference reference_of(std::string_view text) {
    Reference reference;
    if (text.empty()) return reference;
    reference.is_there = true;
    const auto [end, trouble] = std::from_chars(text.data(), text.data() + text.size(), reference.number);
    reference.is_sound = trouble == std::errc() && end == text.data() + text.size();
    return reference;
}

/// Places in the lists of the whole file, which may grow behind the face.
struct Corner {
    int64_t point = 0;
    int64_t uv = -1, normal = -1;  // -1: the corner names none
};
struct Face {
    size_t first = 0, count = 0;  // of the list of corners
    uint64_t line = 0;
    uint32_t material = 0;
};

constexpr uint32_t kNoMaterial = 0xffffffffu;

struct Content {
    std::vector<Vec3d> points, normals;
    std::vector<Vec2> uvs;
    std::vector<Corner> corners;
    std::vector<Face> faces;
    uint64_t left_out = 0;
    uint32_t materials = 0;
    std::vector<std::string> notes;
};

/// Of looks, names and groups nothing is said. Lines that only help to say what a curve is are told with it.
bool is_silent(std::string_view word) {
    constexpr std::string_view kSilent[] = {
        "o",        "g",        "s",     "mg",         "lod",       "usemap", "maplib", "bevel",
        "c_interp", "d_interp", "ctech", "shadow_obj", "trace_obj", "stech",  "vp",     "cstype",
        "deg",      "bmat",     "step",  "parm",       "trim",      "hole",   "scrv",   "sp",
        "end",      "con",      "bsp",   "bzp",        "cdc",       "cdp",    "res"};
    return word.front() == '#' || std::find(std::begin(kSilent), std::end(kSilent), word) != std::end(kSilent);
}

class Reader {
 public:
    Reader(std::string_view text, const std::string& path, const ReadBeside& read_beside)
        : text_(text), words_(text), path_(path), read_beside_(read_beside) {}

    Result<Content> read() {
        for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
            // Some programs write capitals.
            if (const Result<void> line = read_line(small_letters(word)); !line) return Error{line.error()};
            if (!is_past_line_) words_.skip_line();
            is_past_line_ = false;
        }
        content_.materials = static_cast<uint32_t>(materials_.size());
        if (content_.materials > kMostMaterials)
            return Error{path_ + ": has " + std::to_string(content_.materials) +
                         " materials, above 65535. Merge some materials."};
        add_notes();
        return std::move(content_);
    }

 private:
    Result<void> read_line(const std::string& word) {
        if (word == "v") return read_point();
        if (word == "f" || word == "fo") return read_face();
        if (word == "vn")
            read_normal();
        else if (word == "vt")
            read_uv();
        else if (word == "usemtl")
            use_material();
        else if (word == "mtllib")
            read_materials();
        else if (word == "l" || word == "p")
            count_lines(word == "l");
        else if (word == "surf" || word == "curv")
            ++curves_;
        else if (!is_silent(word))
            note_unknown(word);
        return {};
    }

    Result<void> read_point() {
        RestOfLine rest(words_);
        const uint64_t line = words_.line();
        double number[3] = {};
        for (int k = 0; k < 3; ++k) {
            const std::string_view word = rest.next();
            if (word.empty())
                return in_line(path_, line,
                               "a point has " + counted(static_cast<uint64_t>(k), "number", "numbers") +
                                   "; write three, as in \"v 0.5 1 2\".");
            const std::optional<double> found = number_of(word);
            if (!found || !std::isfinite(*found))
                return in_line(path_, line,
                               in_quotes(word) + " is no finite number; write points as in \"v 0.5 1 2\".");
            number[k] = *found;
        }
        content_.points.push_back({number[0], number[1], number[2]});
        return {};
    }

    /// What is no number makes the normal unusable, which is counted where it is used.
    double next_number(RestOfLine& rest, double otherwise) {
        const std::string_view word = rest.next();
        if (word.empty()) return otherwise;
        return number_of(word).value_or(std::numeric_limits<double>::quiet_NaN());
    }
    void read_normal() {
        RestOfLine rest(words_);
        const double x = next_number(rest, 0), y = next_number(rest, 0), z = next_number(rest, 0);
        content_.normals.push_back({x, y, z});
    }
    void read_uv() {
        RestOfLine rest(words_);
        const double u = next_number(rest, 0), v = next_number(rest, 0);
        content_.uvs.push_back({static_cast<float>(u), static_cast<float>(v)});
    }

    void use_material() {
        const std::string name = name_behind(words_, text_);
        is_past_line_ = true;
        material_ = materials_.try_emplace(name, static_cast<uint32_t>(materials_.size())).first->second;
    }
    /// Names of materials in their order there. A name of a file may have blanks in it.
    void read_materials() {
        const std::string name = name_behind(words_, text_);
        is_past_line_ = true;
        std::optional<std::string> text = read_beside_(name);
        Words names(name);
        for (std::string_view word = names.next(); !word.empty() && !text; word = names.next())
            text = read_beside_(std::string(word));
        if (!text) return;
        const std::string plain = plain_text(std::move(*text));
        Words words(plain);
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            if (!is_word(word, "newmtl")) {
                words.skip_line();
                continue;
            }
            materials_.try_emplace(name_behind(words, plain), static_cast<uint32_t>(materials_.size()));
        }
    }

    Result<void> read_face() {
        RestOfLine rest(words_);
        Face face;
        face.line = words_.line();
        face.first = content_.corners.size();
        face.material = material_;
        for (std::string_view word = rest.next(); !word.empty(); word = rest.next())
            if (const Result<void> corner = read_corner(word, face); !corner) return corner;
        face.count = content_.corners.size() - face.first;
        if (face.count == 0)
            return in_line(path_, face.line, "a face has no points; write three or more, as in \"f 1 2 3\".");
        content_.left_out += face.count < 3;
        if (face.count >= 3) content_.faces.push_back(face);
        return {};
    }

    /// "7", "7/1", "7//3" or "7/1/3".
    Result<void> read_corner(std::string_view word, Face& face) {
        const size_t first = word.find('/'), second = first == word.npos ? first : word.find('/', first + 1);
        const auto part = [&](size_t begin, size_t end) {
            return begin == word.npos ? Reference{} : reference_of(word.substr(begin + 1, end - begin - 1));
        };
        const Reference point = reference_of(word.substr(0, first)), uv = part(first, std::min(second, word.size())),
                        normal = part(second, word.size());
        const auto points = static_cast<int64_t>(content_.points.size());
        if (!point.is_there || !point.is_sound || point.number == 0 || point.number < -points)
            return in_line(path_, face.line,
                           in_quotes(word) + " names no point of the " + std::to_string(points) +
                               " before it; points count from 1, or from -1 backwards.");
        if (!uv.is_sound || !normal.is_sound)
            return in_line(path_, face.line, in_quotes(word) + " is no corner; write corners as in \"7/1/3\".");
        content_.corners.push_back({place_of(point, content_.points.size()), place_of(uv, content_.uvs.size()),
                                    place_of(normal, content_.normals.size())});
        return {};
    }
    /// From 0; what is not there is past every end.
    static int64_t place_of(const Reference& reference, size_t before) {
        if (!reference.is_there) return -1;
        const int64_t place =
            reference.number > 0 ? reference.number - 1 : reference.number + static_cast<int64_t>(before);
        const bool is_none = reference.number == 0 || place < 0;
        return is_none ? std::numeric_limits<int64_t>::max() : place;
    }

    void count_lines(bool are_joined) {
        RestOfLine rest(words_);
        uint64_t points = 0;
        while (!rest.next().empty()) ++points;
        content_.left_out += are_joined && points > 0 ? points - 1 : points;
    }

    void note_unknown(const std::string& word) {
        if (unknown_.size() < kMostNamed || unknown_.contains(word))
            ++unknown_[word];
        else
            ++more_unknown_;
    }

    void add_notes() {
        if (curves_ > 0)
            content_.notes.push_back(counted(curves_, "curve or curved surface was", "curves or curved surfaces were") +
                                     " left out.");
        for (const auto& [word, count] : unknown_)
            content_.notes.push_back(counted(count, "line that begins", "lines that begin") + " with " +
                                     in_quotes(word) + " went unread.");
        if (more_unknown_ > 0)
            content_.notes.push_back(counted(more_unknown_, "line", "lines") +
                                     " that begin with other words of no meaning went unread.");
    }

    std::string_view text_;
    Words words_;
    const std::string& path_;
    const ReadBeside& read_beside_;
    Content content_;
    std::map<std::string, uint32_t> materials_;  // by name: their number
    uint32_t material_ = kNoMaterial;
    std::map<std::string, uint64_t> unknown_;
    uint64_t curves_ = 0, more_unknown_ = 0;
    bool is_past_line_ = false;
};

/// The triangles of the content, all numbers checked.
class Builder {
 public:
    Builder(const Content& content, const std::string& path)
        : content_(content), path_(path), used_(content.points.size()) {}

    Result<Corners> build() {
        if (const Result<void> faces = check_faces(); !faces) return Error{faces.error()};
        for (const Face& face : content_.faces) {
            append_face(face);
            if (auto r = check_triangles(out_, path_); !r) return Error{r.error()};
        }
        out_.left_out += content_.left_out;
        out_.notes = content_.notes;
        note(lost_uvs_, "texture coordinates");
        note(lost_normals_, "normals");
        return std::move(out_);
    }

 private:
    Result<void> check_faces() const {
        for (const Face& face : content_.faces)
            for (size_t i = face.first; i < face.first + face.count; ++i) {
                const Corner& corner = content_.corners[i];
                const std::string wrong =
                    is_past(corner.point, content_.points.size(), "point", "points") +
                    is_past(corner.uv, content_.uvs.size(), "texture coordinate", "texture coordinates") +
                    is_past(corner.normal, content_.normals.size(), "normal", "normals");
                if (!wrong.empty())
                    return in_line(path_, face.line,
                                   "the face names " + wrong + ". The file is damaged or cut off; export it again.");
            }
        return {};
    }
    static std::string is_past(int64_t place, size_t list, const char* one, const char* many) {
        if (place < static_cast<int64_t>(list)) return "";
        const bool is_number = place < std::numeric_limits<int64_t>::max();
        return std::string("a ") + one + " that is not there" +
               (is_number ? " (" + std::to_string(place + 1) + ")" : std::string()) + "; the file has " +
               counted(list, one, many);
    }

    enum class Names : uint8_t { None, All, Some };
    /// Whether all corners of a face name one of a list.
    template <class PlaceOf>
    Names names(const Face& face, PlaceOf place_of) const {
        size_t named = 0;
        for (size_t i = face.first; i < face.first + face.count; ++i) named += place_of(content_.corners[i]) >= 0;
        return named == 0 ? Names::None : named == face.count ? Names::All : Names::Some;
    }

    void append_face(const Face& face) {
        const Names uvs = names(face, [](const Corner& c) { return c.uv; });
        const Names normals = names(face, [](const Corner& c) { return c.normal; });
        const bool has_uvs = uvs == Names::All, has_normals = normals == Names::All;
        lost_uvs_ += uvs == Names::Some;
        lost_normals_ += normals == Names::Some;
        std::vector<Vec3d> corners(face.count);
        for (size_t i = 0; i < face.count; ++i) corners[i] = point(content_.corners[face.first + i]);
        for (const auto& t : cut_polygon(corners)) {
            SourceTriangle triangle;
            triangle.has_uvs = has_uvs, triangle.has_normals = has_normals;
            triangle.material = static_cast<uint16_t>(std::min(face.material, content_.materials));
            std::array<uint32_t, 3> points{};
            for (size_t c = 0; c < 3; ++c) {
                const Corner& corner = content_.corners[face.first + t[c]];
                points[c] = static_cast<uint32_t>(corner.point);
                triangle.corner[c].position = point(corner);
                if (has_normals) triangle.corner[c].normal = content_.normals[static_cast<size_t>(corner.normal)];
                if (has_uvs) triangle.corner[c].uv = content_.uvs[static_cast<size_t>(corner.uv)];
            }
            if (append_triangle(out_, triangle, {})) used_.add(out_, points);
        }
    }

    const Vec3d& point(const Corner& corner) const { return content_.points[static_cast<size_t>(corner.point)]; }

    void note(uint64_t faces, const std::string& what) {
        if (faces == 0) return;
        out_.notes.push_back("The " + what + " of " + counted(faces, "face", "faces") +
                             " are not all there and went unread.");
    }

    const Content& content_;
    const std::string& path_;
    Corners out_;
    UsedPoints used_;
    uint64_t lost_uvs_ = 0, lost_normals_ = 0;
};

}  // namespace

Result<Corners> read_obj(std::string bytes, const std::string& path, const ReadBeside& read_beside) {
    const std::string text = plain_text(std::move(bytes));
    const auto content = Reader(text, path, read_beside).read();
    if (!content) return Error{content.error()};
    return Builder(*content, path).build();
}

}  // namespace cullet
