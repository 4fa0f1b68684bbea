#include "engine/system.hpp"

namespace cullet {

// g++: "std::string cullet::system_name() [with auto System = cullet::integrate; std::string = ...]";
// clang: "std::string cullet::system_name() [System = &cullet::integrate]". Takes the name after the first '=', without
// its scope.
std::string type_name_of(std::string_view pretty) {
    size_t first = pretty.find("= ");
    if (first == std::string_view::npos) return std::string(pretty);
    first += 2;
    size_t last = first;
    int depth = 0;
    while (last < pretty.size()) {
        const char c = pretty[last];
        if (c == '<') ++depth;
        if (c == '>') --depth;
        if (depth == 0 && (c == ';' || c == ']')) break;
        ++last;
    }
    std::string name(pretty.substr(first, last - first));
    for (size_t at = name.find("cullet::"); at != std::string::npos; at = name.find("cullet::")) name.erase(at, 8);
    if (!name.empty() && name[0] == '&') name.erase(0, 1);
    return name;
}

bool Access::overlaps(const Access& other) const {
    if (name == other.name) return true;
    if ((kind == Kind::EveryTable && other.kind != Kind::Resource) ||
        (other.kind == Kind::EveryTable && kind != Kind::Resource))
        return true;
    const auto is_table_of = [](const std::string& table, const std::string& column) {
        return column.size() > table.size() && column.compare(0, table.size(), table) == 0 &&
               column[table.size()] == '.';
    };
    return is_table_of(name, other.name) || is_table_of(other.name, name);
}

}  // namespace cullet
