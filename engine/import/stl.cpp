#include "engine/import/stl.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/import/polygon.hpp"
#include "engine/import/text_encoding.hpp"
#include "engine/import/words.hpp"
#include "engine/mesh_file.hpp"

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

/// "solid" at the front, or a facet begun in a line of its own near it. A binary file has zero bytes there.
bool has_words_of_stl(std::string_view text) {
    const std::string_view front = text.substr(0, kFront);
    if (front.substr(0, 512).find('\0') != front.npos) return false;
    Words words(front);
    if (is_word(words.peek(), "solid")) return true;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        if (is_word(word, "facet") || is_word(word, "solid")) return true;
        words.skip_line();
    }
    return false;
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

std::string bytes_behind(uint64_t count) {
    return std::to_string(count) + (count == 1 ? " byte" : " bytes") + " behind the last facet " +
           (count == 1 ? "was" : "were") + " left unread.";
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

Result<Corners> read_binary(std::string_view bytes, uint32_t facets) {
    Corners out;
    const char* at = bytes.data() + kHeader;
    const bool uses_normals = has_normals(at, facets);
    for (uint32_t f = 0; f < facets; ++f, at += kFacet) {
        const Vec3d corners[3] = {vector_at(at + 12), vector_at(at + 24), vector_at(at + 36)};
        append_facet(out, corners, vector_at(at), uses_normals);
    }
    const uint64_t behind = bytes.size() - kHeader - kFacet * facets;
    if (behind > 0) out.notes.push_back(bytes_behind(behind));
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
        return gathered();
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
        out_.notes.push_back(std::to_string(lines) + (lines == 1 ? " line" : " lines") + " before the first solid " +
                             (lines == 1 ? "was" : "were") + " left unread.");
        return {};
    }

    /// From its first word, or from its first facet where that word is missing, to its last.
    Result<void> read_solid() {
        const bool is_named = is_word(words_.peek(), "solid");
        if (is_named) skip_name();
        for (;;) {
            const std::string_view word = words_.peek();
            if (is_word(word, "facet")) {
                if (auto r = read_facet(); !r) return r;
            } else if (is_word(word, "endsolid") || is_word(word, "end")) {
                words_.next();
                if (is_word(word, "end") && is_word(words_.peek(), "solid")) words_.next();
                if (!is_word(words_.peek(), "solid")) words_.skip_line();
                is_closed_ = true;
                return {};
            } else if (is_word(word, "color") || is_word(word, "colour")) {
                words_.next();
                words_.skip_line();
                ++colours_;
            } else if (word.empty()) {
                if (!is_named) return {};
                return cut_off("endsolid");
            } else {
                return Error{unknown_word()};
            }
        }
    }

    /// A name is the rest of its line, and may be the word "facet"; "facet normal" begins the first facet there.
    void skip_name() {
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
        if (auto r = expect("endloop"); !r) return r;
        if (auto r = expect("endfacet"); !r) return r;
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

    Corners gathered() {
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
        return std::move(out_);
    }

    void note_rest() {
        if (colours_ > 0)
            out_.notes.push_back(std::to_string(colours_) + (colours_ == 1 ? " line" : " lines") +
                                 " of colours went unread.");
        const size_t end = text_.find_last_not_of(std::string_view(" \t\r\n\v\f\0\x1a", 8));
        const size_t behind = end == text_.npos || end < words_.offset() ? 0 : end + 1 - words_.offset();
        if (behind > 0) out_.notes.push_back(bytes_behind(behind));
    }

    Result<void> expect(const char* wanted) {
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
    Error cut_off(const char* wanted) const {
        return {path_ + ": ends without its \"" + wanted + "\": it is cut off. Copy or export it again."};
    }

    std::string_view text_;
    Words words_;
    const std::string& path_;
    Corners out_;
    std::vector<Vec3d> normals_, corners_;
    std::vector<uint32_t> corner_counts_;
    uint64_t colours_ = 0;
    bool is_closed_ = false;
};

}  // namespace

Result<Corners> read_stl(std::string bytes, const std::string& path) {
    const auto facets = facets_of(bytes);
    const uint64_t needed = facets ? kHeader + kFacet * uint64_t{*facets} : 0;
    if (facets && bytes.size() == needed) return read_binary(bytes, *facets);
    std::string text = plain_text(bytes);
    if (has_words_of_stl(text)) return TextReader(text, path).read();
    if (facets && *facets > 0 && bytes.size() > needed) return read_binary(bytes, *facets);
    if (!facets)
        return Error{path + ": has " + std::to_string(bytes.size()) +
                     " bytes and none of the words of STL, too few for a binary one. Export the model again."};
    return Error{path + ": states " + std::to_string(*facets) + " facets, which need " + std::to_string(needed) +
                 " bytes, but has " + std::to_string(bytes.size()) +
                 ", and none of the words of STL. It is cut off or no STL; copy or export it again."};
}

}  // namespace cullet
