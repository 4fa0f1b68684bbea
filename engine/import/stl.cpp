#include "engine/import/stl.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/import/text_encoding.hpp"
#include "engine/import/words.hpp"
#include "engine/mesh_file.hpp"
#include "engine/polygon.hpp"

namespace cullet {
namespace {

constexpr uint64_t kHeader = 84, kFacet = 50;    // bytes of a binary file
constexpr size_t kFront = 1 << 16;               // bytes in which the words of a text are looked for
constexpr uint64_t kMostCornersOfAFacet = 1000;  // some programs write four; more than some is a damaged file

std::optional<uint32_t> facets_of(std::string_view bytes) {
    if (bytes.size() < kHeader) return std::nullopt;
    uint32_t facets = 0;
    std::memcpy(&facets, bytes.data() + kHeader - 4, 4);
    return facets;
}

/// The words that stand inside of a facet of a text, one after another.
bool has_loop(std::string_view text) {
    Words words(text);
    std::string_view before, word = words.next();
    for (; !word.empty(); before = word, word = words.next())
        if (is_word(before, "outer") && is_word(word, "loop") && is_word(words.peek(), "vertex")) return true;
    return false;
}

/// "solid" at the front, or a facet begun in a line of its own near it. A binary file has zero bytes there; some
/// programs fill the name in a text with them, so then the words of a facet decide.
bool has_words_of_stl(std::string_view text) {
    const std::string_view front = text.substr(0, kFront);
    if (front.substr(0, 512).find('\0') != front.npos) return has_loop(front);
    Words words(front);
    if (is_word(words.peek(), "solid")) return true;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        if (is_word(word, "facet") || is_word(word, "solid")) return true;
        words.skip_line();
    }
    return false;
}

/// Programs that write as they go may not come back to fill the number in: all bytes behind it are facets. Any other
/// number that is too large is a damaged file.
bool is_without_count(std::string_view bytes, uint32_t stated) {
    return stated == 0 && bytes.size() > kHeader && (bytes.size() - kHeader) % kFacet == 0;
}

bool is_comment(std::string_view word) {
    return word.substr(0, 1) == "#" || word.substr(0, 1) == ";" || word.substr(0, 2) == "//";
}

bool is_usable(Vec3d normal) {
    const double squared = dot(normal, normal);
    return squared > 0 && std::isfinite(squared);
}

/// A corner of an STL is a point of its own.
void append_facet(Corners& out, const Vec3d* corners, Vec3d normal, bool has_normals) {
    SourceTriangle triangle;
    triangle.has_normals = has_normals;
    for (int c = 0; c < 3; ++c) triangle.corner[c] = {corners[c], normal, {}};
    if (append_triangle(out, triangle, {})) out.points += 3;
}

void note_bytes_behind(Corners& out, uint64_t count) {
    if (count > 0)
        out.notes.push_back(counted(count, "byte behind the last facet was", "bytes behind the last facet were") +
                            " left unread.");
}

Vec3d vector_at(const char* at) {
    float xyz[3];
    std::memcpy(xyz, at, sizeof xyz);
    return {xyz[0], xyz[1], xyz[2]};
}

/// Where no facet has a normal of some length, the file has none: that is how programs say so.
bool has_normals(const char* facets, uint32_t count) {
    for (uint32_t f = 0; f < count; ++f)
        if (is_usable(vector_at(facets + f * kFacet))) return true;
    return false;
}

Result<Corners> read_binary(std::string_view bytes, uint32_t facets, const std::string& path) {
    Corners out;
    const char* at = bytes.data() + kHeader;
    const bool uses_normals = has_normals(at, facets);
    for (uint32_t f = 0; f < facets; ++f, at += kFacet) {
        const Vec3d corners[3] = {vector_at(at + 12), vector_at(at + 24), vector_at(at + 36)};
        append_facet(out, corners, vector_at(at), uses_normals);
    }
    if (auto r = check_triangles(out, path); !r) return Error{r.error()};
    note_bytes_behind(out, bytes.size() - kHeader - kFacet * facets);
    return out;
}

/// One facet of a text as it stands there.
struct Facet {
    Vec3d normal;
    std::vector<Vec3d> corners;
};

class TextReader {
 public:
    TextReader(std::string_view text, const std::string& path) : text_(text), words_(text), path_(path) {}

    Result<Corners> read() {
        Words front = words_;
        if (!is_word(front.peek(), "solid"))
            if (auto r = skip_front(); !r) return Error{r.error()};
        while (!words_.peek().empty()) {
            if (is_word(words_.peek(), "solid") || is_word(words_.peek(), "facet")) {
                if (auto r = read_solid(); !r) return Error{r.error()};
            } else if (is_closed_) {
                break;
            } else {
                return unknown_word();
            }
        }
        note_rest();
        gather();
        if (auto r = check_triangles(out_, path_); !r) return Error{r.error()};
        return std::move(out_);
    }

 private:
    /// Lines of a header that is none: comments, the name of the program.
    Result<void> skip_front() {
        uint64_t lines = 0;
        while (!words_.peek().empty() && !is_word(words_.peek(), "solid") && !is_word(words_.peek(), "facet")) {
            words_.next();
            words_.skip_line();
            ++lines;
        }
        if (lines > 0)
            out_.notes.push_back(
                counted(lines, "line before the first solid was", "lines before the first solid were") +
                " left unread.");
        return {};
    }

    /// From its first word, or from its first facet where that word is missing, to its last.
    Result<void> read_solid() {
        const bool is_named = is_word(words_.peek(), "solid"), is_named_solid = is_named && is_name_solid();
        facets_before_ = corner_counts_.size();
        if (is_named) skip_words_of_line();
        for (;;) {
            const std::string_view word = words_.peek();
            if (is_word(word, "facet")) {
                if (auto r = read_facet(); !r) return r;
            } else if (is_word(word, "endsolid") || is_word(word, "end")) {
                words_.next();
                if (is_word(word, "end") && is_word(words_.peek(), "solid")) words_.next();
                if (is_named_solid || !is_word(words_.peek(), "solid")) words_.skip_line();
                is_closed_ = true;
                return {};
            } else if (is_word(word, "color") || is_word(word, "colour")) {
                words_.next();
                words_.skip_line();
                ++colours_;
            } else if (word.empty()) {
                if (!is_named) return {};
                if (facets_of_solid() == 0) return cut_off("endsolid");
                out_.notes.push_back("It ends without its \"endsolid\"; the facets that are there were read.");
                return {};
            } else if (is_comment(word)) {
                words_.next();
                words_.skip_line();
                ++odd_lines_;
            } else if (facets_of_solid() == 0) {
                skip_words_of_line();
                ++odd_lines_;
            } else {
                return Error{unknown_word()};
            }
        }
    }

    /// A solid may be called "solid ...", and is so again at its end: that begins no other one.
    bool is_name_solid() const {
        Words ahead = words_;
        ahead.next();
        return is_word(ahead.next_of_line(), "solid");
    }
    size_t facets_of_solid() const { return corner_counts_.size() - facets_before_; }

    /// A name is the rest of its line, and may be the word "facet"; "facet normal" begins the first facet there.
    void skip_words_of_line() {
        words_.next();
        for (;;) {
            const Words before = words_;
            const std::string_view word = words_.next_of_line();
            if (word.empty()) return;
            const bool begins_facet = is_word(word, "facet") && is_word(words_.peek(), "normal");
            if (begins_facet || is_word(word, "endsolid")) {
                words_ = before;
                return;
            }
        }
    }

    Result<void> read_facet() {
        Facet facet;
        words_.next();
        if (is_word(words_.peek(), "normal")) {
            words_.next();
            facet.normal = read_normal();
        }
        if (auto r = expect("outer"); !r) return r;
        if (auto r = expect("loop"); !r) return r;
        while (is_word(words_.peek(), "vertex")) {
            words_.next();
            if (auto r = read_corner(facet); !r) return r;
        }
        if (facet.corners.size() < 3 || facet.corners.size() > kMostCornersOfAFacet)
            return Error{path_ + ": the facet that ends in line " + std::to_string(words_.line()) + " has " +
                         std::to_string(facet.corners.size()) + " corners, not 3 to " +
                         std::to_string(kMostCornersOfAFacet) + ". Repair the file or export it again."};
        if (auto r = expect_end("loop"); !r) return r;
        if (auto r = expect_end("facet"); !r) return r;
        append(facet);
        return {};
    }

    /// What is no number is not a normal; the line's words up to "outer" belong to it, however many there are.
    Vec3d read_normal() {
        double xyz[3] = {};
        for (size_t i = 0; !words_.peek().empty() && !is_word(words_.peek(), "outer") && i < 8; ++i) {
            const auto number = number_of(words_.next());
            if (i < 3) xyz[i] = number ? *number : std::nan("");
        }
        return {xyz[0], xyz[1], xyz[2]};
    }

    Result<void> read_corner(Facet& facet) {
        double xyz[3] = {};
        for (double& value : xyz) {
            const std::string_view word = words_.next();
            if (word.empty()) return cut_off("endsolid");
            const auto number = number_of(word);
            if (!number)
                return Error{path_ + ": line " + std::to_string(words_.line()) + " has \"" +
                             one_line(std::string(word), 40) +
                             "\" in place of a coordinate. Repair the file or export it again."};
            value = *number;
        }
        if (facet.corners.size() <= kMostCornersOfAFacet) facet.corners.push_back({xyz[0], xyz[1], xyz[2]});
        return {};
    }

    void append(const Facet& facet) {
        normals_.push_back(facet.normal);
        corner_counts_.push_back(static_cast<uint32_t>(facet.corners.size()));
        corners_.insert(corners_.end(), facet.corners.begin(), facet.corners.end());
    }

    void gather() {
        bool uses_normals = false;
        for (const Vec3d normal : normals_) uses_normals = uses_normals || is_usable(normal);
        size_t first = 0;
        for (size_t f = 0; f < normals_.size(); ++f) {
            const std::span<const Vec3d> corners(corners_.data() + first, corner_counts_[f]);
            for (const auto& t : cut_polygon(corners)) {
                const Vec3d triangle[3] = {corners[t[0]], corners[t[1]], corners[t[2]]};
                append_facet(out_, triangle, normals_[f], uses_normals);
            }
            first += corners.size();
        }
    }

    void note_rest() {
        if (colours_ > 0) out_.notes.push_back(counted(colours_, "line", "lines") + " of colours went unread.");
        if (odd_lines_ > 0)
            out_.notes.push_back(counted(odd_lines_, "line that is no facet was", "lines that are no facets were") +
                                 " left unread.");
        note_bytes_behind(out_, bytes_behind(text_, words_.offset()));
    }

    /// "endloop", or in two words.
    Result<void> expect_end(const std::string& what) {
        if (!is_word(words_.peek(), "end")) return expect("end" + what);
        words_.next();
        return expect(what);
    }

    Result<void> expect(const std::string& wanted) {
        const std::string_view word = words_.peek();
        if (word.empty()) return cut_off(wanted);
        if (!is_word(word, wanted)) return Error{unknown_word()};
        words_.next();
        return {};
    }

    Error unknown_word() {
        const std::string word(words_.next());
        return {path_ + ": line " + std::to_string(words_.line()) + " has the word \"" + one_line(word, 40) +
                "\" where STL has none. Repair the file or export it again."};
    }
    Error cut_off(const std::string& wanted) const {
        return {path_ + ": ends without its \"" + wanted + "\": it is cut off. Copy or export it again."};
    }

    std::string_view text_;
    Words words_;
    const std::string& path_;
    Corners out_;
    std::vector<Vec3d> normals_, corners_;
    std::vector<uint32_t> corner_counts_;
    uint64_t colours_ = 0, odd_lines_ = 0;
    size_t facets_before_ = 0;  // this solid
    bool is_closed_ = false;
};

}  // namespace

Result<Corners> read_stl(std::string bytes, const std::string& path) {
    const auto facets = facets_of(bytes);
    const uint64_t needed = facets ? kHeader + kFacet * uint64_t{*facets} : 0;
    if (facets && bytes.size() == needed) return read_binary(bytes, *facets, path);
    std::string text = plain_text(bytes);
    if (has_words_of_stl(text)) return TextReader(text, path).read();
    if (facets && is_without_count(bytes, *facets)) {
        const auto there = static_cast<uint32_t>((bytes.size() - kHeader) / kFacet);
        auto corners = read_binary(bytes, there, path);
        if (corners)
            corners->notes.push_back("It states " + std::to_string(*facets) + " facets; the " + std::to_string(there) +
                                     " that are there were read.");
        return corners;
    }
    if (facets && *facets > 0 && bytes.size() > needed) return read_binary(bytes, *facets, path);
    if (!facets)
        return Error{path + ": has " + std::to_string(bytes.size()) +
                     " bytes and none of the words of STL, too few for a binary one. Export the model again."};
    return Error{path + ": states " + std::to_string(*facets) + " facets, which need " + std::to_string(needed) +
                 " bytes, but has " + std::to_string(bytes.size()) +
                 ", and none of the words of STL. It is cut off or no STL; copy or export it again."};
}

}  // namespace cullet
