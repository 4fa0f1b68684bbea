#include "sample_game/read_materials.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <toml++/toml.h>
#include <algorithm>

#include "cullet/model.hpp"
#include "engine/mesh_file.hpp"

namespace cullet {
namespace {

constexpr uint64_t kLargestFile = 1u << 20;  // bytes; the compiled table would take 4,000
constexpr size_t kMostRows = 256;
// What a new row without `like` may leave out.
constexpr const char* kOptional[] = {"bending_stiffness", "crush_pressure",  "across_young_modulus",
                                     "shear_modulus",     "across_strength", "across_fracture_energy",
                                     "heading_power",     "tip_factor",      "branching",
                                     "run_out",           "run_seconds"};

struct Reader {
    const std::string& path;
    MaterialTable& table;

    Error at(const toml::node& node, const std::string& what) const {
        return Error{fmt::format("{}:{}: {}", path, node.source().begin.line, what)};
    }

    static std::string shown(const toml::node& node) {
        if (const auto number = node.value<double>()) return fmt::format("{:.6g}", *number);
        if (const auto text = node.value<std::string>()) return fmt::format("\"{}\"", *text);
        return node.is_table() ? "a table" : node.is_array() ? "a list" : "no number";
    }

    template <class Kind>
    Result<void> read_kind(const std::string& name, const char* key, const toml::node& node, Kind& kind) const {
        const auto text = node.value<std::string>();
        std::string names;
        for (int k = 0; k < 3; ++k) {
            const Kind candidate = static_cast<Kind>(k);
            names += (k ? ", " : "") + std::string(name_of(candidate));
            if (text != name_of(candidate)) continue;
            kind = candidate;
            return {};
        }
        return at(node, fmt::format("[{}] {} is {}; use one of {}.", name, key, shown(node), names));
    }

    Result<void> read_model(const std::string& name, const toml::node& node, std::string& model) const {
        const std::vector<std::string> models = damage_model_names();
        const auto text = node.value<std::string>();
        if (!text || std::find(models.begin(), models.end(), *text) == models.end())
            return at(node,
                      fmt::format("[{}] model is {}; use one of {}.", name, shown(node), fmt::join(models, ", ")));
        model = *text;
        return {};
    }

    Result<void> read_value(const std::string& name, const MaterialValue& value, const toml::node& node,
                            MaterialSettings& row) const {
        if (!value.is_of(row.kind))
            return at(node, fmt::format("[{}] {} decides nothing in {} materials; leave it out.", name, value.name,
                                        name_of(row.kind)));
        const auto number = node.value<double>();
        if (!number || !(*number >= value.least && *number <= value.most))
            return at(node,
                      fmt::format("[{}] {} is {}; use {:.6g} to {:.6g}{}.", name, value.name, shown(node), value.least,
                                  value.most, std::string(value.unit) == "1" ? "" : std::string(" ") + value.unit));
        row.*value.member = static_cast<float>(*number);
        return {};
    }

    Result<void> read_entry(const std::string& name, const std::string& key, const toml::node& node,
                            MaterialSettings& row) const {
        if (key == "like" || key == "kind") return {};  // read before
        if (key == "fracture") return read_kind(name, "fracture", node, row.fracture);
        if (key == "model") return read_model(name, node, row.model);
        std::string known = "like, kind, fracture, model";
        for (const MaterialValue& value : material_values()) {
            if (key == value.name) return read_value(name, value, node, row);
            known += std::string(", ") + value.name;
        }
        return at(node, fmt::format("[{}] there is no {}; use {}.", name, key, known));
    }

    /// The row that the section starts from, with its kind.
    Result<MaterialSettings> first_of(const std::string& name, const toml::table& section) const {
        Result<MaterialSettings> row = row_before(name, section);
        if (!row.ok()) return row;
        const toml::node* const kind = section.get("kind");
        if (kind)
            if (Result<void> read = read_kind(name, "kind", *kind, row->kind); !read.ok()) return Error{read.error()};
        if (section.get("like") || table.find(name).ok()) return row;
        for (const MaterialValue& value : material_values()) {
            const bool may_miss = !value.is_of(row->kind) ||
                                  std::any_of(std::begin(kOptional), std::end(kOptional), [&](const char* optional) {
                                      return std::string_view(optional) == value.name;
                                  });
            if (!may_miss && !section.get(value.name))
                return at(section, fmt::format("[{}] is new and has no {}; give it, or like = one of {}.", name,
                                               value.name, table.names()));
        }
        return row;
    }

    Result<MaterialSettings> row_before(const std::string& name, const toml::table& section) const {
        const toml::node* const like = section.get("like");
        if (!like) {
            const Result<MaterialSettings> own = table.find(name);
            return own.ok() ? own.value() : MaterialSettings{};
        }
        const auto text = like->value<std::string>();
        const Result<MaterialSettings> found = table.find(text.value_or(""));
        if (!found.ok())
            return at(*like, fmt::format("[{}] like is {}; use one of {}.", name, shown(*like), table.names()));
        return found;
    }

    Result<void> read_section(const std::string& name, const toml::node& node) const {
        const toml::table* const section = node.as_table();
        if (!section)
            return at(node,
                      fmt::format("{} = {} stands outside of a material; write [name] above it.", name, shown(node)));
        Result<MaterialSettings> row = first_of(name, *section);
        if (!row.ok()) return Error{row.error()};
        row->name = name;
        for (const auto& [key, value] : *section)
            if (Result<void> read = read_entry(name, std::string(key.str()), value, *row); !read.ok()) return read;
        const bool is_new = !table.find(name).ok();
        if (is_new && table.rows().size() >= kMostRows)
            return at(node, fmt::format("[{}] is more than {} materials; give fewer.", name, kMostRows));
        const Result<void> taken = is_new ? table.add(*row) : table.change(*row);
        if (!taken.ok()) return at(node, taken.error());
        return {};
    }
};

/// In the order of the file: a section may be like one above it.
std::vector<std::pair<std::string, const toml::node*>> sections_of(const toml::table& file) {
    std::vector<std::pair<std::string, const toml::node*>> sections;
    for (const auto& [key, node] : file) sections.emplace_back(std::string(key.str()), &node);
    const auto line = [](const auto& section) { return section.second->source().begin.line; };
    std::stable_sort(sections.begin(), sections.end(), [&](auto& a, auto& b) { return line(a) < line(b); });
    return sections;
}

}  // namespace

Result<void> read_materials(const std::string& path, MaterialTable& table) {
    const Result<std::vector<uint8_t>> bytes = read_whole_file(path, kLargestFile);
    if (!bytes.ok()) return Error{bytes.error()};
    MaterialTable changed = table;
    try {
        const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
        const toml::table file = toml::parse(text, std::string_view(path));
        const Reader reader{path, changed};
        for (const auto& [name, node] : sections_of(file))
            if (Result<void> read = reader.read_section(name, *node); !read.ok()) return read;
    } catch (const toml::parse_error& error) {
        return Error{fmt::format("{}:{}: this is no TOML: {}.", path, error.source().begin.line, error.description())};
    }
    table = std::move(changed);
    return {};
}

}  // namespace cullet
