#include "systems/models/metal_shell/check_metal.hpp"

#include <cmath>

#include "systems/models/metal_shell/shared/metal_view.hpp"
#include "systems/models/metal_shell/shared/striker.hpp"

namespace cullet::metal_shell {
namespace {

std::string trouble_of_counts(const MetalView& metal) {
    if (metal.vertex_count() != metal.shell.vertex_count() || metal.element_count() != metal.shell.element_count())
        return std::to_string(metal.vertex_count()) + " vertices and " + std::to_string(metal.element_count()) +
               " elements of metal stand beside " + std::to_string(metal.shell.vertex_count()) + " and " +
               std::to_string(metal.shell.element_count()) + " of its shell";
    if (metal.cell_count() == 0 || metal.cell_count() > kMostSubShells)
        return "it has " + std::to_string(metal.cell_count()) + " sub-shells, not 1 to " +
               std::to_string(kMostSubShells);
    return {};
}

std::string trouble_of_vertices(const MetalView& metal) {
    const MetalVertices& vertices = metal.vertices();
    const uint32_t springs = metal.shells().springs[metal.row].count;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.vertex(v), first = vertices.first_spring[row];
        if (first > springs || vertices.spring_count[row] > springs - first)
            return "springs " + std::to_string(first) + " on of vertex " + std::to_string(v) + " are beyond " +
                   std::to_string(springs);
        for (const uint16_t cell : vertices.cell[row])
            if (cell >= metal.cell_count())
                return "sub-shell " + std::to_string(cell) + " of vertex " + std::to_string(v) + " does not exist";
    }
    const uint32_t first = metal.shells().springs[metal.row].first;
    for (uint32_t k = 0; k < springs; ++k) {
        if (metal.springs().other[first + k] >= metal.vertex_count())
            return "spring " + std::to_string(k) + " ends at vertex " +
                   std::to_string(metal.springs().other[first + k]) + ", which does not exist";
        if (!(metal.springs().length[first + k] >= 0))
            return "spring " + std::to_string(k) + " is " + std::to_string(metal.springs().length[first + k]) +
                   " m long";
    }
    return {};
}

std::string trouble_of_cells(const MetalView& metal) {
    const uint32_t borders = metal.shells().borders[metal.row].count, at = metal.shells().borders[metal.row].first;
    for (uint32_t c = 0; c < metal.cell_count(); ++c) {
        const uint32_t first = metal.cells().first_border[metal.cell(c)],
                       count = metal.cells().border_count[metal.cell(c)];
        if (first > borders || count > borders - first)
            return "borders of sub-shell " + std::to_string(c) + " are beyond " + std::to_string(borders);
    }
    for (uint32_t k = 0; k < borders; ++k)
        if (metal.borders().other[at + k] >= metal.cell_count())
            return "border " + std::to_string(k) + " is beside sub-shell " +
                   std::to_string(metal.borders().other[at + k]) + ", which does not exist";
    for (uint32_t e = 0; e < metal.element_count(); ++e)
        if (metal.cell_of(e) >= metal.cell_count())
            return "element " + std::to_string(e) + " is of sub-shell " + std::to_string(metal.cell_of(e)) +
                   ", which does not exist";
    return {};
}

}  // namespace

Result<void> check_metal_shell(MetalShellRows rows, Row<Structures> structure, Wear wear, const std::string& name,
                               const char* advice) {
    const ShellView shell(rows, structure);
    if (const Result<void> sound = check_shell_rows(shell, wear, name, advice); !sound) return sound;
    const Row<MetalShells> row = metal_of(rows, shell.structure);
    const auto refuse = [&](const std::string& what) { return Error{name + ": " + what + ". " + advice}; };
    if (!row.exists() || row >= rows.metal_shells.size() || !rows.metal_shells.pool.is_taken(row, 1) ||
        rows.metal_shells.structure[row] != shell.structure)
        return refuse("it is of metal, and has no sub-shells");
    const MetalView metal(rows, structure);
    for (auto* look : {trouble_of_counts, trouble_of_vertices, trouble_of_cells})
        if (const std::string trouble = look(metal); !trouble.empty()) return refuse(trouble);
    return {};
}

std::string trouble_of_run(Read<MetalRows> rows, uint32_t task) {
    if (task >= rows.metal_runs.size()) return "has no row in metal_runs";
    return metal_of(rows, rows.tasks.working[task]).exists() ? "" : "works on a shell that is not of metal";
}

namespace {

// Of metal_runs and metal_impacts: columns that lead elsewhere, and numbers that may be worked with.
template <class Table>
std::string trouble_of_impact(const Table& table, uint32_t row, uint32_t bodies) {
    const Row<Bodies> striker = table.striker[row];
    const std::string where = std::string(table.kName) + "[" + std::to_string(row) + "]";
    if (striker.exists() && striker >= bodies)
        return where + " names body " + std::to_string(striker) + ", which does not exist";
    if (table.shape[row] > static_cast<uint8_t>(StrikerShape::Front))
        return where + " has a striker of shape " + std::to_string(table.shape[row]) + ", which does not exist";
    if (!(table.energy[row] >= 0 && table.energy[row] < 1e18 && table.radius[row] >= 0))
        return where + " has an energy of " + std::to_string(table.energy[row]) + " J, by a striker of radius " +
               std::to_string(table.radius[row]) + " m";
    return {};
}

}  // namespace

namespace {

std::string trouble_of_front(Read<MetalRows> rows, uint32_t task) {
    const MetalRuns& runs = rows.metal_runs;
    if (runs.shape[task] != static_cast<uint8_t>(StrikerShape::Front)) return {};
    const std::string where = "metal_runs[" + std::to_string(task) + "]";
    if ((task + 1) * kFrontRows > rows.striker_fronts.size()) return where + " has no front in striker_fronts";
    const auto &frame = runs.frame[task], &extent = runs.extent[task];
    const bool is_sound = std::fabs(frame[0]) < 1e9f && std::fabs(frame[1]) < 1e9f && frame[2] > 0 && frame[3] > 0 &&
                          extent[0] >= 0 && extent[1] >= 0;
    return is_sound ? "" : where + " has a front on a grid of no size";
}

}  // namespace

Result<void> check_metal_rows(Read<MetalRows> rows, uint8_t, const std::string& name, const char* advice) {
    for (uint32_t t = 0; t < rows.metal_runs.size(); ++t)
        if (const std::string trouble = trouble_of_impact(rows.metal_runs, t, rows.bodies.size()); !trouble.empty())
            return Error{name + ": " + trouble + ". " + advice};
    for (uint32_t t = 0; t < rows.metal_runs.size(); ++t)
        if (const std::string trouble = trouble_of_front(rows, t); !trouble.empty())
            return Error{name + ": " + trouble + ". " + advice};
    for (uint32_t b = 0; b < rows.metal_impacts.size(); ++b)
        if (const std::string trouble = trouble_of_impact(rows.metal_impacts, b, rows.bodies.size()); !trouble.empty())
            return Error{name + ": " + trouble + ". " + advice};
    return {};
}

}  // namespace cullet::metal_shell
