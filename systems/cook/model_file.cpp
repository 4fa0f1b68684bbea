#include "systems/cook/model_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <new>
#include <optional>

#include "engine/file_header.hpp"
#include "engine/table_bytes.hpp"
#include "systems/cook/materials.hpp"
#include "systems/cook/solid_file.hpp"

namespace cullet {
namespace {

constexpr const char* kAdvice = "The model file is damaged or of another build; cook the mesh again and write it.";
constexpr FileKind kKind{{'c', 'm', 'o', 'd', 'l', '\r', '\n', '\x1a'},
                         14,
                         "model file",
                         ".cmodel",
                         "Write one with write_model.",
                         kAdvice,
                         "Cook the mesh again and write it."};

Error damaged(const std::string& name, const std::string& what) {
    return {name + ": " + what + ". " + kAdvice};
}

/// The tables of a shell in the file's order, each with the range that counts its rows.
template <class F>
void for_each_part(Workbench& state, Row<Structures> shell, F&& f) {
    ShellRows::for_each_range(state, shell, [&](Range& range, auto& table, auto, const char*) {
        f(table, range);
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(table)>, Elements>) f(state.triangle_springs, range);
    });
    // What is not of metal has no rows of these.
    const Row<MetalShells> metal = metal_of(state, shell);
    if (metal.exists())
        return for_each_metal_range(state, metal, {},
                                    [&](Range& range, auto& table, uint32_t, const char*) { f(table, range); });
    Range none;
    f(state.metal_vertices, none), f(state.metal_elements, none), f(state.metal_springs, none);
    f(state.sub_shells, none), f(state.sub_shell_borders, none);
}

/// The report's numbers in the file's order, for both ways.
template <class Report, class F>
void for_each_number(Report& report, F&& f) {
    f(report.units_of_a_hit);
    f(report.mass);
    f(report.mean_thickness);
    f(report.first_crack_speed);
    f(report.first_crack_force);
    f(report.vertices);
    f(report.elements);
    f(report.cells);
    f(report.degenerate_elements);
    f(report.collisions);
    f(report.inverted_elements);
    f(report.crossings);
}

void put_material(ByteWriter& writer, const std::string& name, const MaterialSettings& material, Vec3 grain) {
    writer.text(name);
    writer.number(static_cast<uint8_t>(material.kind));
    writer.number(static_cast<uint8_t>(material.fracture));
    for (const MaterialValue& value : material_values()) writer.number(material.*value.member);
    writer.number(grain.x), writer.number(grain.y), writer.number(grain.z);
}
/// A row that check_row finds good; trouble stays with the reader.
void take_material(ByteReader& reader, MaterialSettings& material, Vec3& grain) {
    material.name = reader.text("the material's name");
    material.kind = static_cast<MaterialKind>(reader.number<uint8_t>("the material's kind"));
    material.fracture = static_cast<FractureKind>(reader.number<uint8_t>("the material's fracture"));
    for (const MaterialValue& value : material_values()) material.*value.member = reader.number<float>(value.name);
    grain = {reader.number<float>("the grain"), reader.number<float>("the grain"), reader.number<float>("the grain")};
    if (!reader.is_sound()) return;
    const Result<void> valid = check_row(material);
    reader.expect(valid.ok(), valid.error());
    const float squared = dot(grain, grain);
    const bool is_zero = std::bit_cast<std::array<uint32_t, 3>>(grain) == std::array<uint32_t, 3>{};
    reader.expect(material.across_young_modulus > 0 ? std::abs(squared - 1) <= 1e-5f : is_zero,
                  "the grain's length squared is " + std::to_string(squared));
}

/// For one shell without rows.
std::unique_ptr<Workbench> make_workbench_of_one() {
    return std::make_unique<Workbench>(
        Limits{.bodies = 1, .structures = 1, .vertices = 64, .elements = 64, .tasks = 1, .models = 1});
}

/// Everything of the payload, with the rows still in the bytes.
struct Found {
    std::string name, damage_model;
    MaterialSettings material;
    Vec3 grain;
    ModelReport report;
    FoundTable structure, shell, metal;
    std::vector<FoundTable> parts;
    std::optional<FoundSolid> solid;  // in place of a shell
};

Result<Found> find_all(std::span<const uint8_t> payload, const std::string& name) {
    Found found;
    ByteReader reader(payload, name, kAdvice, kFileHeaderBytes);
    found.name = reader.text("the model's name");
    found.damage_model = reader.text("the damage model's name");
    take_material(reader, found.material, found.grain);
    found.report.repairs = reader.text("the sentence of repairs");
    found.report.advice = reader.text("the sentence of advice");
    found.report.walls = reader.text("the sentence of walls");
    for_each_number(found.report, [&](auto& number) {
        number = reader.number<std::remove_reference_t<decltype(number)>>("the report");
    });
    // Tables of no rows, for their lists of columns.
    const auto none = make_workbench_of_one();
    Workbench& like = *none;
    like.structures.append(1), like.shells.append(1);
    found.structure = find_table(reader, like.structures);
    if (reader.is_sound() && found.structure.rows == 1) found.structure.copy_to(like.structures, 0);
    if (reader.is_sound() && like.structures.kind[0] == static_cast<uint8_t>(StructureKind::Tetrahedra)) {
        found.solid = find_solid(reader);
        reader.expect(reader.is_at_end(), "the last table ends before the file does,");
        if (!reader.is_sound()) return Error{reader.trouble()};
        return found;
    }
    like.structures.clear_rows(0, 1);
    found.shell = reader.is_sound() ? find_table(reader, like.shells) : FoundTable{};
    found.metal = reader.is_sound() ? find_table(reader, like.metal_shells) : FoundTable{};
    for_each_part(like, Row<Structures>(0), [&](const AnyTable& table, [[maybe_unused]] const Range& range) {
        found.parts.push_back(reader.is_sound() ? find_table(reader, table) : FoundTable{});
    });
    reader.expect(reader.is_at_end(), "the last table ends before the file does,");
    for (const FoundTable* table : {&found.structure, &found.shell})
        reader.expect(table->rows == 1, "there are " + std::to_string(table->rows) + " structures or shells, not 1,");
    if (!reader.is_sound()) return Error{reader.trouble()};
    return found;
}

enum Part {
    kVertices,
    kElements,
    kSprings,
    kHinges,
    kPacks,
    kBlocks,
    kLinks,
    kCells,
    kPoints,
    kMetalVertices,
    kMetalElements,
    kMetalSprings,
    kSubShells,
    kSubShellBorders
};

/// Room for the shell alone. Components derive the limits of the smaller tables from those of vertices and elements.
Limits limits_for(const std::vector<FoundTable>& parts) {
    Limits limits = cooking_limits(0, 0);
    limits.structures = 2;
    const auto rows = [&](Part part) { return parts[part].rows; };
    const uint32_t slots = std::max(rows(kBlocks), rows(kLinks)), points = rows(kPoints) / 16 + 1;
    limits.vertices = std::max({rows(kVertices), slots / 12 * 8 + 8, 8 * rows(kCells), 8 * points}) + 1024;
    const uint32_t metal = std::max(rows(kMetalSprings) / 4, rows(kSubShellBorders) * 8);
    limits.elements = std::max({rows(kElements), rows(kHinges), metal, rows(kSubShells) * 64}) + 1024;
    return limits;
}

Result<void> check_counts(const Found& found, const std::string& name) {
    const auto rows = [&](Part part) { return found.parts[part].rows; };
    const auto count = [](uint32_t n) { return std::to_string(n); };
    if (rows(kVertices) == 0 || rows(kElements) == 0 || rows(kCells) == 0)
        return damaged(name, "it has " + count(rows(kVertices)) + " vertices, " + count(rows(kElements)) +
                                 " elements and " + count(rows(kCells)) + " cells; none of them may be 0");
    const uint32_t packs =
        rows(kBlocks) == 0 && rows(kLinks) == 0 ? 0 : rows(kVertices) / kLanes;  // none: no stiffness
    if (rows(kVertices) % kLanes != 0 || rows(kPacks) != packs || rows(kSprings) != rows(kElements))
        return damaged(name, count(rows(kVertices)) + " vertices and " + count(rows(kElements)) + " elements have " +
                                 count(rows(kPacks)) + " packs and " + count(rows(kSprings)) +
                                 " triangle springs; 8 vertices make a pack, and an element has one row of springs");
    const bool is_metal = found.metal.rows > 0;
    if (found.metal.rows > 1 || rows(kMetalElements) != (is_metal ? rows(kElements) : 0) ||
        (rows(kMetalVertices) > 0) != is_metal || (rows(kSubShells) > 0) != is_metal ||
        rows(kMetalVertices) > rows(kVertices) || rows(kSubShells) > kMostSubShells)
        return damaged(name, "it has " + count(rows(kMetalVertices)) + " vertices, " + count(rows(kMetalElements)) +
                                 " elements and " + count(rows(kSubShells)) + " sub-shells of metal, unlike its shell");
    return {};
}

/// Moves the rows into ranges of the state. The file's ranges say again how many rows there are.
Result<Row<Structures>> copy_rows(Workbench& state, const Found& found, const std::string& name) {
    const auto rows = [&](Part part) { return found.parts[part].rows; };
    const char* full = "";
    const Row<Structures> shell = make_shell(
        state,
        {rows(kVertices), rows(kElements), rows(kHinges), rows(kBlocks), rows(kLinks), rows(kCells), rows(kPoints)},
        &full);
    if (!shell.exists()) return damaged(name, std::string("its counts do not fit each other (") + full + ")");
    const MetalRoom metal{rows(kMetalVertices), rows(kMetalElements), rows(kMetalSprings), rows(kSubShells),
                          rows(kSubShellBorders)};
    if (found.metal.rows > 0 && !make_metal(state, shell, metal, &full).exists())
        return damaged(name, std::string("its counts do not fit each other (") + full + ")");
    const Row<MetalShells> metal_row = metal_of(state, shell);
    std::vector<Range> own;
    for_each_part(state, shell,
                  [&]([[maybe_unused]] const AnyTable& table, const Range& range) { own.push_back(range); });
    const Row<Shells> row = state.shell_of(shell);
    found.structure.copy_to(state.structures, shell);
    found.shell.copy_to(state.shells, row);
    if (metal_row.exists()) {
        found.metal.copy_to(state.metal_shells, metal_row);
        state.metal_shells.structure[metal_row] = shell;
    }
    const bool fits = state.structures.rows[shell] == 0 && !state.shells.springs[row].exists() &&
                      state.structures.kind[shell] == static_cast<uint8_t>(StructureKind::Shell);
    if (!fits) return damaged(name, "its structure is no shell that can stand alone");
    state.structures.rows[shell] = row;
    size_t part = 0;
    std::string trouble;
    for_each_part(state, shell, [&](AnyTable& table, const Range& range) {
        const uint32_t count = found.parts[part].rows;
        const bool is_second = part == kSprings;  // the elements' range, already set
        if (!is_second && (range.first != 0 || range.count != count || range.capacity != count) && trouble.empty())
            trouble = std::string("the shell's range of ") + table.name() + " is " + std::to_string(range.first) +
                      " + " + std::to_string(range.count) + " of " + std::to_string(range.capacity) + ", not 0 + " +
                      std::to_string(count);
        found.parts[part].copy_to(table, own[part].first);
        ++part;
    });
    part = 0;
    for_each_part(state, shell, [&]([[maybe_unused]] const AnyTable& table, Range& range) {
        range = own[part];
        range.count = found.parts[part++].rows;
    });
    if (!trouble.empty()) return damaged(name, trouble);
    return shell;
}

Result<void> check_report_of_solid(const Found& found, Read<SolidRows> state, Row<Structures> structure,
                                   const std::string& name) {
    const Structures& s = state.structures;
    const Row<CookedSolids> cooked = state.solids.cooked[solid_of(s, structure)];
    const ModelReport& r = found.report;
    const CookedSolids& own = state.cooked_solids;
    if (r.vertices != own.points[cooked].count || r.elements != own.cells[cooked].count ||
        r.cells != s.cells[structure].count || r.mass != s.mass[structure] ||
        r.mean_thickness != own.thickness[cooked] || r.first_crack_speed != s.first_crack_speed[structure] ||
        r.first_crack_force != s.first_crack_force[structure])
        return damaged(name, "the report is not the solid's");
    return {};
}

Result<void> check_report(const Found& found, const ShellRows& state, Row<Structures> shell, const std::string& name) {
    const Structures& s = state.structures;
    const Row<Shells> row = state.shell_of(shell);
    const ModelReport& r = found.report;
    if (r.vertices != state.shells.vertices[row].count || r.elements != state.shells.elements[row].count ||
        r.cells != s.cells[shell].count || r.degenerate_elements > r.elements || r.inverted_elements > r.elements)
        return damaged(name, "the report counts " + std::to_string(r.vertices) + " vertices, " +
                                 std::to_string(r.elements) + " elements, " + std::to_string(r.cells) + " cells and " +
                                 std::to_string(r.degenerate_elements) + " degenerate elements, unlike the tables");
    if (r.mass != s.mass[shell] || r.mean_thickness != double{state.shells.thickness[row]} ||
        r.first_crack_speed != s.first_crack_speed[shell] || r.first_crack_force != s.first_crack_force[shell])
        return damaged(name, "the report's mass, thickness, first crack speed or first crack force, " +
                                 std::to_string(r.mass) + " kg, " + std::to_string(r.mean_thickness) + " m, " +
                                 std::to_string(r.first_crack_speed) + " m/s, " + std::to_string(r.first_crack_force) +
                                 " N, is not the shell's");
    return {};
}

/// What stands before the tables.
void put_words(ByteWriter& writer, const Model::Contents& contents) {
    writer.text(contents.name);
    writer.text(contents.damage_model);
    const Row<Materials> material = contents.state.structures.material[contents.shell];
    if (material < contents.state.materials.size())
        put_material(writer, contents.material, material_settings(contents.state, material),
                     material_traits(contents.state, material).grain);
    else
        put_material(writer, {}, {}, {});  // of a shell that is not sound: no reader takes a material without a name
    writer.text(contents.report.repairs);
    writer.text(contents.report.advice);
    writer.text(contents.report.walls);
    for_each_number(contents.report, [&](const auto& number) { writer.number(number); });
}

}  // namespace

std::vector<uint8_t> encode_model_file(const Model::Contents& contents) {
    // Reads only; the parts are listed once, for states that may change.
    Workbench& state = const_cast<Workbench&>(contents.state);
    const bool is_solid =
        contents.state.structures.kind[contents.shell] == static_cast<uint8_t>(StructureKind::Tetrahedra);
    if (is_solid && contents.state.structures.rows[contents.shell] < contents.state.solids.size()) {
        ByteWriter writer;
        writer.bytes.resize(kFileHeaderBytes);
        put_words(writer, contents);
        put_solid(writer, state, contents.shell);
        finish_file(kKind, writer.bytes);
        return std::move(writer.bytes);
    }
    const auto alone = make_workbench_of_one();
    Workbench& row = *alone;
    const Row<Structures> first = make_shell(row, {});
    copy_values(row, state, contents.shell, first);
    row.structures.material[first] = Row<Materials>(0);  // its values stand before the tables
    const Row<MetalShells> metal = metal_of(state, contents.shell);
    if (metal.exists()) {
        const Row<MetalShells> own = make_metal(row, first, {});
        row.metal_shells.copy_rows(state.metal_shells, metal, own, 1);
        row.metal_shells.structure[own] = first;
    }
    std::vector<uint32_t> counts;
    for_each_part(state, contents.shell, [&](const auto&, const Range& range) { counts.push_back(range.count); });
    size_t part = 0;
    for_each_part(row, first, [&](const auto&, Range& range) {
        range = {0, counts[part], counts[part]};
        ++part;
    });
    ByteWriter writer;
    writer.bytes.resize(kFileHeaderBytes);
    put_words(writer, contents);
    put_table(writer, row.structures, first, 1);
    put_table(writer, row.shells, row.shell_of(first), 1);
    put_table(writer, row.metal_shells, 0, metal.exists() ? 1 : 0);
    for_each_part(state, contents.shell, [&](const AnyTable& table, const Range& range) {
        put_table(writer, table, range.first, range.count);
    });
    finish_file(kKind, writer.bytes);
    return std::move(writer.bytes);
}

Result<Model> parse_model_file(std::span<const uint8_t> bytes, const std::string& name, const DamageModels& models) {
    try {
        const auto payload = payload_of(kKind, bytes, name);
        if (!payload) return Error{payload.error()};
        const Result<Found> found = find_all(*payload, name);
        if (!found) return Error{found.error()};
        if (!found->solid)
            if (const Result<void> fits = check_counts(*found, name); !fits) return Error{fits.error()};
        const std::optional<uint8_t> number = models.find(found->damage_model);
        if (!number)
            return Error{name + ": is cooked for the damage model \"" + found->damage_model + "\"; this version has " +
                         models.names() + ". Cook the mesh again for one of them."};
        const auto contents =
            std::make_shared<Model::Contents>(found->solid ? limits_for(*found->solid) : limits_for(found->parts));
        fill_materials(contents->state.materials);
        Result<Row<Structures>> shell = Row<Structures>();
        if (found->solid) {
            shell = copy_solid(contents->state, found->structure, *found->solid);
            if (!shell) return damaged(name, shell.error());
        } else {
            shell = copy_rows(contents->state, *found, name);
            if (!shell) return Error{shell.error()};
        }
        // The values before the tables say which row it is; the writer left 0 there.
        if (contents->state.structures.material[*shell] != Row<Materials>(0))
            return damaged(name, "the shell's material is row " +
                                     std::to_string(contents->state.structures.material[*shell].index) + ", not 0");
        contents->state.structures.material[*shell] =
            material_row({contents->state.materials, contents->state.material_traits, contents->state.structures},
                         found->material, found->grain);
        const auto check = models[*number].calls().check_shell;
        if (!check != found->solid.has_value())
            return damaged(name, "the damage model " + found->damage_model + " breaks no such structure");
        if (check)
            if (const Result<void> sound = check(contents->state, *shell, Wear::Intact, name, kAdvice); !sound)
                return Error{sound.error()};
        const Result<void> fits = found->solid ? check_report_of_solid(*found, contents->state, *shell, name)
                                               : check_report(*found, contents->state, *shell, name);
        if (!fits) return Error{fits.error()};
        contents->shell = *shell;
        contents->name = found->name;
        contents->damage_model = found->damage_model;
        contents->material = found->material.name;
        contents->report = found->report;
        Model model;
        model.contents = contents;
        return model;
    } catch (const std::bad_alloc&) {
        return Error{name + ": no memory for " + std::to_string(bytes.size()) +
                     " bytes of model. Free memory or cook with longer edges."};
    }
}

}  // namespace cullet
