#include "engine/import/ply_header.hpp"

#include <cmath>
#include <optional>

#include "engine/import/words.hpp"
#include "engine/mesh_file.hpp"

namespace cullet {
namespace {

constexpr size_t kMostElements = 256, kMostProperties = 4096;  // far more than any program writes

std::optional<PlyType> type_of(std::string_view word) {
    constexpr struct {
        const char* name;
        PlyType type;
    } kTypes[] = {{"char", PlyType::Int8},      {"int8", PlyType::Int8},       {"uchar", PlyType::Uint8},
                  {"uint8", PlyType::Uint8},    {"short", PlyType::Int16},     {"int16", PlyType::Int16},
                  {"ushort", PlyType::Uint16},  {"uint16", PlyType::Uint16},   {"int", PlyType::Int32},
                  {"int32", PlyType::Int32},    {"uint", PlyType::Uint32},     {"uint32", PlyType::Uint32},
                  {"float", PlyType::Float32},  {"float32", PlyType::Float32}, {"double", PlyType::Float64},
                  {"float64", PlyType::Float64}};
    for (const auto& known : kTypes)
        if (is_word(word, known.name)) return known.type;
    return std::nullopt;
}

/// The lines of the head. Its first line says how lines end: behind "end_header" binary data may begin with a line
/// feed.
class Lines {
 public:
    explicit Lines(std::string_view bytes) : bytes_(bytes) {
        const size_t end = bytes.find_first_of("\r\n");
        if (end != bytes.npos && bytes[end] == '\r' && bytes.substr(end, 2) != "\r\n") end_ = '\r';
    }
    /// False behind the last one that has an end.
    bool next(std::string_view& line) {
        const size_t end = bytes_.find(end_, at_);
        if (end == bytes_.npos) return false;
        line = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        ++number_;
        return true;
    }
    size_t offset() const { return at_; }
    uint64_t number() const { return number_; }

 private:
    std::string_view bytes_;
    char end_ = '\n';  // a CR before it is a blank
    size_t at_ = 0;
    uint64_t number_ = 0;
};

class HeaderReader {
 public:
    HeaderReader(std::string_view bytes, const std::string& path) : lines_(bytes), path_(path) {}

    Result<PlyHeader> read() {
        std::string_view line;
        if (!lines_.next(line) || !is_word(Words(line).peek(), "ply"))
            return Error{path_ + ": does not begin with a line \"ply\". Repair the file or export it again."};
        while (lines_.next(line)) {
            Words words(line);
            const std::string first = small_letters(words.next());
            if (first == "end_header") return finished();
            if (first.empty() || first == "comment" || first == "obj_info") continue;
            if (!(first == "format"    ? take_format(words)
                  : first == "element" ? take_element(words)
                                       : first == "property" && take_property(words)))
                return Error{path_ + ": line " + std::to_string(lines_.number()) + " of its head is \"" +
                             one_line(std::string(line.substr(0, 80)), 80) +
                             "\", which is not PLY. Repair the file or export it again."};
        }
        return Error{path_ + ": ends without its \"end_header\": it is cut off. Copy or export it again."};
    }

 private:
    Result<PlyHeader> finished() {
        if (!has_format_)
            return Error{path_ + ": its head has no line \"format\". Repair the file or export it again."};
        header_.size = lines_.offset();
        return std::move(header_);
    }

    bool take_format(Words& words) {
        const std::string name = small_letters(words.next());
        has_format_ = true;
        header_.format = name == "binary_big_endian"      ? PlyFormat::BigEndian
                         : name == "binary_little_endian" ? PlyFormat::LittleEndian
                                                          : PlyFormat::Text;
        return name == "ascii" || name == "binary_big_endian" || name == "binary_little_endian";
    }

    bool take_element(Words& words) {
        PlyElement element;
        element.name = small_letters(words.next());
        const auto rows = number_of(words.next());
        if (!rows || !(*rows >= 0) || *rows > 1e15 || *rows != std::floor(*rows)) return false;
        element.rows = static_cast<uint64_t>(*rows);
        header_.elements.push_back(element);
        return header_.elements.size() <= kMostElements;
    }

    bool take_property(Words& words) {
        if (header_.elements.empty()) return false;
        PlyProperty property;
        if (is_word(words.peek(), "list")) {
            words.next();
            const auto count_type = type_of(words.next());
            if (!count_type || !is_whole(*count_type)) return false;
            property.is_list = true;
            property.count_type = *count_type;
        }
        const auto type = type_of(words.next());
        property.name = small_letters(words.next());
        if (!type || property.name.empty()) return false;
        property.type = *type;
        auto& properties = header_.elements.back().properties;
        properties.push_back(property);
        return properties.size() <= kMostProperties;
    }

    Lines lines_;
    const std::string& path_;
    PlyHeader header_;
    bool has_format_ = false;
};

}  // namespace

uint64_t size_of(PlyType type) {
    switch (type) {
        case PlyType::Int8:
        case PlyType::Uint8:
            return 1;
        case PlyType::Int16:
        case PlyType::Uint16:
            return 2;
        case PlyType::Float64:
            return 8;
        default:
            return 4;
    }
}

bool is_whole(PlyType type) {
    return type != PlyType::Float32 && type != PlyType::Float64;
}

Result<PlyHeader> read_ply_header(std::string_view bytes, const std::string& path) {
    return HeaderReader(bytes, path).read();
}

}  // namespace cullet
