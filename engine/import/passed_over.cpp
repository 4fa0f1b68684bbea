#include "engine/import/passed_over.hpp"

#include <algorithm>
#include <cstdint>
#include <set>

#include "engine/import/words.hpp"
#include "engine/mesh_file.hpp"

namespace cullet {
namespace {

constexpr std::string_view kBinaryFbx = "Kaydara FBX Binary";
constexpr size_t kLongestClass = 64;

/// A text of a binary FBX: "S", its length in four bytes, its letters.
std::string binary_text(std::string_view text) {
    std::string bytes = "S";
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(text.size() >> (8 * i));
    return bytes + std::string(text);
}

/// The text that stands there in a binary file, "" when there is none.
std::string_view text_at(std::string_view bytes, size_t at) {
    if (at + 5 > bytes.size() || bytes[at] != 'S') return {};
    const size_t length = static_cast<unsigned char>(bytes[at + 1]);
    const bool is_short = bytes[at + 2] == 0 && bytes[at + 3] == 0 && bytes[at + 4] == 0 && length <= kLongestClass;
    return is_short ? bytes.substr(at + 5, length) : std::string_view();
}

/// The class stands behind the name, which ends with that of its kind.
std::set<std::string> classes_in_binary(std::string_view bytes) {
    constexpr std::string_view kEndOfName("\0\1Geometry", 10);
    std::set<std::string> classes;
    for (size_t at = bytes.find(kEndOfName); at != bytes.npos; at = bytes.find(kEndOfName, at + 1))
        classes.emplace(text_at(bytes, at + kEndOfName.size()));
    return classes;
}

/// Geometry: 1001, "Geometry::Name", "Mesh" {
std::set<std::string> classes_in_text(std::string_view bytes) {
    std::set<std::string> classes;
    Words words(bytes);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        const size_t begin = words.offset();
        words.skip_line();
        if (word != "Geometry:") continue;
        const std::string_view line = bytes.substr(begin, words.offset() - begin);
        const size_t last = line.rfind('"');
        const size_t first = last == line.npos || last == 0 ? line.npos : line.rfind('"', last - 1);
        if (first != line.npos) classes.emplace(line.substr(first + 1, last - first - 1));
    }
    return classes;
}

bool is_curved(const std::string& name) {
    return name.find("Nurb") != name.npos || name.find("Patch") != name.npos || name == "Boundary";
}

}  // namespace

std::vector<std::string> notes_of_fbx(std::string_view bytes) {
    const bool is_binary = bytes.substr(0, kBinaryFbx.size()) == kBinaryFbx;
    std::vector<std::string> notes;
    const std::string unit = is_binary ? binary_text("UnitScaleFactor") : "\"UnitScaleFactor\"";
    if (bytes.find(unit) == bytes.npos) notes.push_back("It names no unit; its numbers were taken for centimetres.");
    std::set<std::string> classes = is_binary ? classes_in_binary(bytes) : classes_in_text(bytes);
    if (std::any_of(classes.begin(), classes.end(), is_curved))
        notes.push_back("Its curves and curved surfaces were left out.");
    for (const std::string& name : classes)
        if (!is_curved(name) && !name.empty() && name != "Mesh" && name != "Shape" && name != "Line")
            notes.push_back("Its geometry of the class \"" + one_line(name, kLongestClass) + "\" was left out.");
    return notes;
}

}  // namespace cullet
