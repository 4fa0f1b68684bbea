#include "engine/import/ply.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>
#include <utility>

#include "engine/import/ply_header.hpp"
#include "engine/import/text_encoding.hpp"
#include "engine/import/words.hpp"
#include "engine/mesh_file.hpp"
#include "engine/polygon.hpp"

namespace cullet {
namespace {

std::string text(uint64_t n) {
    return std::to_string(n);
}

std::string text_of(double n) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.10g", n);
    return buffer;
}

double whole_or_real(PlyType type, uint64_t bits) {
    switch (type) {
        case PlyType::Int8:
            return static_cast<int8_t>(bits);
        case PlyType::Int16:
            return static_cast<int16_t>(bits);
        case PlyType::Int32:
            return static_cast<int32_t>(bits);
        case PlyType::Float32:
            return std::bit_cast<float>(static_cast<uint32_t>(bits));
        case PlyType::Float64:
            return std::bit_cast<double>(bits);
        default:
            return static_cast<double>(bits);
    }
}

/// The rows behind the head, value by value. A value that is not there, or no number, makes it fail for good.
class Values {
 public:
    Values(std::string_view bytes, PlyFormat format) : bytes_(bytes), format_(format), words_(bytes) {}

    double next(PlyType type) { return format_ == PlyFormat::Text ? next_of_text(type) : next_of_binary(type); }

    void begin_row() { has_line_ = false; }
    /// In text a row is a line. False when words are left in its last one; where all its values stand in one line,
    /// these belong to nothing that the head knows, and are passed over and counted.
    bool ends_row() {
        if (format_ != PlyFormat::Text || words_.next_of_line().empty()) return true;
        if (!has_line_ || words_.line() != line_) return false;
        words_.skip_line();
        ++long_rows_;
        return true;
    }
    uint64_t take_long_rows() { return std::exchange(long_rows_, 0); }

    /// So many values of that type may still be there.
    bool can_hold(uint64_t count, PlyType type) const {
        const uint64_t size = format_ == PlyFormat::Text ? 2 : size_of(type);  // a digit and a blank; the last has none
        return count <= (left() + 1) / size;
    }
    uint64_t left() const { return bytes_.size() - (format_ == PlyFormat::Text ? words_.offset() : at_); }
    /// Bytes behind the last row that are no blanks.
    uint64_t rest() const { return format_ == PlyFormat::Text ? bytes_behind(bytes_, words_.offset()) : left(); }
    bool has_failed() const { return has_failed_; }

 private:
    double next_of_text(PlyType type) {
        const auto number = number_of(words_.next());
        if (!has_line_) line_ = words_.line();
        has_line_ = true;
        has_failed_ = has_failed_ || !number || (is_whole(type) && *number != std::floor(*number));
        return number ? *number : 0;
    }
    double next_of_binary(PlyType type) {
        const uint64_t size = size_of(type);
        if (size > left()) {
            has_failed_ = true;
            return 0;
        }
        uint64_t bits = 0;
        for (uint64_t i = 0; i < size; ++i) {
            const uint64_t place = format_ == PlyFormat::BigEndian ? size - 1 - i : i;
            bits |= uint64_t{static_cast<unsigned char>(bytes_[at_ + i])} << (8 * place);
        }
        at_ += size;
        return whole_or_real(type, bits);
    }

    std::string_view bytes_;
    PlyFormat format_;
    Words words_;
    size_t at_ = 0;
    uint64_t line_ = 0, long_rows_ = 0;
    bool has_failed_ = false, has_line_ = false;
};

/// How the numbers of a list make triangles.
enum class Kind : uint8_t { Polygons, Strips, Fans };

constexpr uint32_t kRestart = ~0u;
constexpr uint32_t kNoMaterial = ~0u, kMostMaterials = 65535;
constexpr size_t kMostNamed = 8;  // properties in a sentence

/// What -1 becomes in that type.
uint32_t restart_of(PlyType type) {
    return type == PlyType::Uint8 ? 255 : type == PlyType::Uint16 ? 65535 : kRestart;
}

/// Of looks nothing is said.
bool is_colour(const std::string& name) {
    for (const char* part : {"red", "green", "blue", "alpha"})
        if (name == part || name.ends_with(std::string("_") + part)) return true;
    return name == "r" || name == "g" || name == "b" || name == "a";
}

struct Piece {
    Kind kind = Kind::Polygons;
    uint32_t restart = kRestart;  // begins the next strip where there is no such vertex
    uint32_t material = kNoMaterial;
    size_t first = 0, count = 0;  // in the list of all numbers
    size_t first_uv = 0;          // in the list of corners' texture coordinates
    bool has_uvs = false;
};

/// Everything in the file that counts, before numbers of vertices are believed.
struct Content {
    std::vector<Vec3d> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<uint32_t> numbers;  // of vertices; kRestart begins the next strip
    std::vector<Piece> pieces;
    std::vector<Vec2> corner_uvs;
    bool has_normals = false, has_uvs = false, has_vertices = false;
    uint64_t edges = 0, uneven_uvs = 0;
    uint32_t materials = 0;  // one more than the largest number
    std::vector<std::string> notes;
};

/// Which value of a vertex a property holds; -1 for none.
int place_of(const std::string& name) {
    constexpr struct {
        const char* name;
        int place;
    } kNames[] = {{"x", 0}, {"y", 1}, {"z", 2}, {"nx", 3},        {"ny", 4},        {"nz", 5},        {"u", 6},
                  {"v", 7}, {"s", 6}, {"t", 7}, {"texture_u", 6}, {"texture_v", 7}, {"texture_s", 6}, {"texture_t", 7}};
    for (const auto& known : kNames)
        if (name == known.name) return known.place;
    return -1;
}

class Reader {
 public:
    Reader(const PlyHeader& header, std::string_view rows, const std::string& path)
        : header_(header), values_(rows, header.format), path_(path) {}

    Result<Content> read() {
        for (const PlyElement& element : header_.elements)
            if (auto r = read_element(element); !r) return Error{r.error()};
        if (const uint64_t rest = values_.rest(); rest > 0)
            content_.notes.push_back(counted(rest, "byte", "bytes") + " behind the last row went unread.");
        if (content_.uneven_uvs > 0)
            content_.notes.push_back("The texture coordinates of " + counted(content_.uneven_uvs, "face", "faces") +
                                     " are not as many as the corners and went unread.");
        return std::move(content_);
    }

 private:
    Result<void> read_element(const PlyElement& element) {
        if (element.properties.empty() || element.rows == 0) return {};
        if (auto r = check_rows(element); !r) return r;
        if (auto r = read_rows(element); !r) return r;
        if (const uint64_t rows = values_.take_long_rows(); rows > 0)
            content_.notes.push_back(counted(rows, "line", "lines") + " of \"" + one_line(element.name, 40) + "\" " +
                                     (rows == 1 ? "holds" : "hold") +
                                     " more values than the head names; the last ones went unread.");
        return {};
    }

    Result<void> read_rows(const PlyElement& element) {
        if (element.name == "vertex" || element.name == "vertices") return read_vertices(element);
        if (element.name == "face" || element.name == "faces") return read_lists(element, Kind::Polygons);
        if (element.name.rfind("tristrip", 0) == 0) return read_lists(element, Kind::Strips);
        if (element.name.rfind("trifan", 0) == 0) return read_lists(element, Kind::Fans);
        if (element.name == "edge" || element.name == "edges")
            content_.edges += element.rows;
        else
            content_.notes.push_back(counted(element.rows, "row", "rows") + " of the element \"" +
                                     one_line(element.name, 40) + "\" went unread.");
        return read_past(element);
    }

    Result<void> check_rows(const PlyElement& element) const {
        uint64_t bytes = 0;
        for (const PlyProperty& property : element.properties)
            bytes +=
                header_.format == PlyFormat::Text ? 2 : size_of(property.is_list ? property.count_type : property.type);
        if (element.rows <= (values_.left() + 1) / bytes && element.rows <= kMostMeshRows) return {};
        return Error{path_ + ": states " + text(element.rows) + " rows of \"" + one_line(element.name, 40) +
                     "\", but only " + counted(values_.left(), "byte follows", "bytes follow") +
                     ". It is cut off or its head is wrong; copy or export it again."};
    }

    /// After each row, with its number.
    Result<void> check_row(const PlyElement& element, uint64_t row) {
        if (!values_.has_failed() && values_.ends_row()) return {};
        return Error{path_ + ": row " + text(row) + " of \"" + one_line(element.name, 40) +
                     "\" is not as its head says: a value is missing, too many or no number. Repair the file or "
                     "export it again."};
    }

    /// Number of entries of the list that comes next; nothing when it cannot be there.
    std::optional<uint64_t> next_count(const PlyProperty& property) {
        const double count = values_.next(property.count_type);
        if (!(count >= 0) || !values_.can_hold(static_cast<uint64_t>(std::fmin(count, 1e15)), property.type))
            return std::nullopt;
        return static_cast<uint64_t>(count);
    }

    Result<void> wrong_list(const PlyElement& element, uint64_t row) const {
        return Error{path_ + ": row " + text(row) + " of \"" + one_line(element.name, 40) +
                     "\" states a list longer than the file. It is cut off or damaged; copy or export it again."};
    }

    bool skip(const PlyProperty& property) {
        uint64_t count = 1;
        if (property.is_list) {
            const auto stated = next_count(property);
            if (!stated) return false;
            count = *stated;
        }
        for (uint64_t i = 0; i < count; ++i) values_.next(property.type);
        return true;
    }

    Result<void> read_past(const PlyElement& element) {
        for (uint64_t row = 0; row < element.rows; ++row) {
            values_.begin_row();
            for (const PlyProperty& property : element.properties)
                if (!skip(property)) return wrong_list(element, row);
            if (auto r = check_row(element, row); !r) return r;
        }
        return {};
    }

    Result<void> read_vertices(const PlyElement& element) {
        if (content_.has_vertices)
            return Error{path_ + ": has two elements \"vertex\". Repair the file or export it again."};
        content_.has_vertices = true;
        bool has[8] = {};
        std::vector<int> places;
        for (const PlyProperty& property : element.properties) {
            const int place = property.is_list ? -1 : place_of(property.name);
            places.push_back(place);
            if (place >= 0) has[place] = true;
        }
        if (!has[0] || !has[1] || !has[2])
            return Error{path_ + ": its vertices have no x, y and z. Repair the file or export it again."};
        content_.has_normals = has[3] && has[4] && has[5];
        content_.has_uvs = has[6] && has[7];
        std::vector<std::string> unread;
        for (size_t p = 0; p < places.size(); ++p)
            if (places[p] < 0 || (places[p] >= 3 && !(places[p] < 6 ? content_.has_normals : content_.has_uvs)))
                unread.push_back(element.properties[p].name);
        note_unread(element, unread);
        for (uint64_t row = 0; row < element.rows; ++row) {
            values_.begin_row();
            double value[8] = {};
            for (size_t p = 0; p < places.size(); ++p)
                if (places[p] >= 0)
                    value[places[p]] = values_.next(element.properties[p].type);
                else if (!skip(element.properties[p]))
                    return wrong_list(element, row);
            if (auto r = check_row(element, row); !r) return r;
            content_.positions.push_back({value[0], value[1], value[2]});
            if (content_.has_normals) content_.normals.push_back({value[3], value[4], value[5]});
            if (content_.has_uvs) content_.uvs.push_back({static_cast<float>(value[6]), static_cast<float>(value[7])});
        }
        return {};
    }

    void note_unread(const PlyElement& element, std::vector<std::string> names) {
        std::erase_if(names, is_colour);
        if (names.empty()) return;
        std::string list;
        for (size_t i = 0; i < std::min(names.size(), kMostNamed); ++i)
            list += (i == 0 ? "\"" : ", \"") + one_line(names[i], 40) + "\"";
        if (names.size() > kMostNamed) list += " and " + text(names.size() - kMostNamed) + " more";
        content_.notes.push_back("Of \"" + one_line(element.name, 40) + "\" " +
                                 (names.size() == 1 ? "the property " : "the properties ") + list + " went unread.");
    }

    /// The list of vertices: by its name, or the only one of whole numbers that there is.
    static size_t list_of(const PlyElement& element) {
        size_t only = element.properties.size(), lists = 0;
        for (size_t p = 0; p < element.properties.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (property.is_list && property.name.rfind("vertex_ind", 0) == 0) return p;
            if (!property.is_list || !is_whole(property.type)) continue;
            only = p;
            ++lists;
        }
        return lists == 1 ? only : element.properties.size();
    }

    Result<void> read_lists(const PlyElement& element, Kind kind) {
        const size_t list = list_of(element);
        if (list == element.properties.size())
            return Error{path_ + ": the element \"" + one_line(element.name, 40) +
                         "\" has no list \"vertex_indices\" of whole numbers. Repair the file or export it again."};
        if (!is_whole(element.properties[list].type))
            content_.notes.push_back("The numbers of vertices in \"" + one_line(element.name, 40) +
                                     "\" are of a type with fractions; they were taken as whole ones.");
        std::vector<std::string> unread;
        for (size_t p = 0; p < element.properties.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            const bool is_read = p == list || is_material(property) || (is_texture(property) && kind == Kind::Polygons);
            if (!is_read) unread.push_back(property.name);
        }
        note_unread(element, unread);
        for (uint64_t row = 0; row < element.rows; ++row) {
            values_.begin_row();
            Piece piece;
            piece.kind = kind;
            piece.restart = restart_of(element.properties[list].type);
            for (size_t p = 0; p < element.properties.size(); ++p) {
                const PlyProperty& property = element.properties[p];
                const bool is_read = p == list               ? read_numbers(property, piece)
                                     : is_texture(property)  ? read_corner_uvs(property, piece)
                                     : is_material(property) ? read_material(property, piece)
                                                             : skip(property);
                if (!is_read) return wrong_list(element, row);
            }
            if (auto r = check_row(element, row); !r) return r;
            if (has_bad_number_)
                return Error{path_ + ": row " + text(row) + " of \"" + one_line(element.name, 40) + "\" names vertex " +
                             text_of(bad_number_) + ". Repair the file or export it again."};
            if (has_bad_material_)
                return Error{path_ + ": row " + text(row) + " of \"" + one_line(element.name, 40) + "\" has material " +
                             text_of(bad_number_) + ", not a whole number below 65535. Merge some materials."};
            const bool has_uvs = piece.has_uvs && kind == Kind::Polygons;
            piece.has_uvs = has_uvs && content_.corner_uvs.size() - piece.first_uv == piece.count;
            content_.uneven_uvs += has_uvs && !piece.has_uvs;
            content_.pieces.push_back(piece);
        }
        return {};
    }

    static bool is_texture(const PlyProperty& property) { return property.is_list && property.name == "texcoord"; }

    static bool is_material(const PlyProperty& property) {
        return !property.is_list && property.name == "material_index";
    }

    /// A number below 0 is none.
    bool read_material(const PlyProperty& property, Piece& piece) {
        const double number = values_.next(property.type);
        if (!(number >= 0)) return true;
        has_bad_material_ = has_bad_material_ || !(number < kMostMaterials) || number != std::floor(number);
        if (has_bad_material_) return bad_number_ = number, true;
        piece.material = static_cast<uint32_t>(number);
        content_.materials = std::max(content_.materials, piece.material + 1);
        return true;
    }

    bool read_numbers(const PlyProperty& property, Piece& piece) {
        const auto count = next_count(property);
        if (!count) return false;
        piece.first = content_.numbers.size();
        piece.count = *count;
        for (uint64_t i = 0; i < *count; ++i)
            content_.numbers.push_back(number_in(property.type, values_.next(property.type), piece.kind));
        return true;
    }

    /// What can be no vertex becomes kRestart, which a polygon may not hold. The largest number of an unsigned type
    /// begins a strip where the file has not that many vertices; this is decided when they are known.
    uint32_t number_in(PlyType type, double value, Kind kind) {
        if (value >= 0 && value < 4294967295.0 && value == std::floor(value)) return static_cast<uint32_t>(value);
        const bool is_restart = value == -1 || (type == PlyType::Uint32 && value == 4294967295.0);
        if (!is_restart || kind == Kind::Polygons) {
            has_bad_number_ = true;
            bad_number_ = value;
        }
        return kRestart;
    }

    bool read_corner_uvs(const PlyProperty& property, Piece& piece) {
        const auto count = next_count(property);
        if (!count) return false;
        piece.first_uv = content_.corner_uvs.size();
        piece.has_uvs = *count > 0;
        for (uint64_t i = 0; i < *count; i += 2) {
            const double u = values_.next(property.type), v = i + 1 < *count ? values_.next(property.type) : 0;
            content_.corner_uvs.push_back({static_cast<float>(u), static_cast<float>(v)});
        }
        return true;
    }

    const PlyHeader& header_;
    Values values_;
    const std::string& path_;
    Content content_;
    bool has_bad_number_ = false, has_bad_material_ = false;
    double bad_number_ = 0;
};

/// The triangles of the content, all numbers checked.
class Builder {
 public:
    Builder(const Content& content, const std::string& path)
        : content_(content), path_(path), used_(content.positions.size()) {}

    Result<Corners> build() {
        for (const Piece& piece : content_.pieces) {
            if (auto r = check_numbers(piece); !r) return Error{r.error()};
            if (piece.kind == Kind::Polygons)
                append_polygon(piece);
            else
                append_strips(piece);
            if (auto r = check_triangles(out_, path_); !r) return Error{r.error()};
        }
        out_.left_out += content_.edges;
        out_.notes = content_.notes;
        return std::move(out_);
    }

 private:
    uint32_t number(const Piece& piece, size_t i) const { return content_.numbers[piece.first + i]; }

    bool is_restart(const Piece& piece, uint32_t number) const {
        return number == kRestart || (number == piece.restart && number >= content_.positions.size());
    }

    Result<void> check_numbers(const Piece& piece) const {
        for (size_t i = 0; i < piece.count; ++i) {
            const uint32_t v = number(piece, i);
            if (v < content_.positions.size() || (piece.kind != Kind::Polygons && is_restart(piece, v))) continue;
            return Error{path_ + ": row " + text(static_cast<uint64_t>(&piece - content_.pieces.data())) +
                         " of its faces or strips names vertex " + (v == kRestart ? "-1" : text(uint64_t{v})) +
                         ", but there are " + text(content_.positions.size()) +
                         ". Repair the file or export it again."};
        }
        return {};
    }

    void append_polygon(const Piece& piece) {
        if (piece.count == 1 || piece.count == 2) ++out_.left_out;
        if (piece.count < 3) return;
        std::vector<Vec3d> corners;
        if (piece.count > 3)
            for (size_t i = 0; i < piece.count; ++i) corners.push_back(content_.positions[number(piece, i)]);
        else
            corners.resize(3);
        for (const auto& t : cut_polygon(corners)) {
            const size_t uv = piece.first_uv;
            const Vec2* const uvs = content_.corner_uvs.data();
            const Vec2 of_corners[3] = {piece.has_uvs ? uvs[uv + t[0]] : Vec2{},
                                        piece.has_uvs ? uvs[uv + t[1]] : Vec2{},
                                        piece.has_uvs ? uvs[uv + t[2]] : Vec2{}};
            append(piece, {number(piece, t[0]), number(piece, t[1]), number(piece, t[2])},
                   piece.has_uvs ? of_corners : nullptr);
        }
    }

    /// Triangles with a number twice only join strips, and are none.
    void append_strips(const Piece& piece) {
        for (size_t begin = 0; begin < piece.count;) {
            size_t end = begin;
            while (end < piece.count && !is_restart(piece, number(piece, end))) ++end;
            if (end - begin == 1 || end - begin == 2) ++out_.left_out;
            for (size_t t = 0; begin + t + 2 < end; ++t) {
                const auto corners = piece.kind == Kind::Fans ? corners_in_fan(t) : corners_in_strip(t);
                const auto at = [&](size_t corner) { return number(piece, begin + corners[corner]); };
                const uint32_t a = at(0), b = at(1), c = at(2);
                if (a != b && b != c && c != a) append(piece, {a, b, c}, nullptr);
            }
            begin = end + 1;
        }
    }

    void append(const Piece& piece, std::array<uint32_t, 3> vertices, const Vec2* uvs) {
        SourceTriangle triangle;
        triangle.material = static_cast<uint16_t>(std::min(piece.material, content_.materials));
        triangle.has_normals = content_.has_normals;
        triangle.has_uvs = uvs != nullptr || content_.has_uvs;
        for (size_t c = 0; c < 3; ++c) {
            const uint32_t v = vertices[c];
            triangle.corner[c].position = content_.positions[v];
            if (content_.has_normals) triangle.corner[c].normal = content_.normals[v];
            if (triangle.has_uvs) triangle.corner[c].uv = uvs != nullptr ? uvs[c] : content_.uvs[v];
        }
        if (!append_triangle(out_, triangle, {})) return;
        used_.add(out_, vertices);
    }

    const Content& content_;
    const std::string& path_;
    Corners out_;
    UsedPoints used_;
};

}  // namespace

Result<Corners> read_ply(std::string bytes, const std::string& path) {
    const std::string plain = plain_text(std::move(bytes));
    const auto header = read_ply_header(plain, path);
    if (!header) return Error{header.error()};
    Reader reader(*header, std::string_view(plain).substr(header->size), path);
    const auto content = reader.read();
    if (!content) return Error{content.error()};
    return Builder(*content, path).build();
}

}  // namespace cullet
