// Whether the rows of a shell are what cooking could have made, or, of one that has been hit, what breaking may have
// made of them. First each column by itself, by the list of rules below, then what columns say about each other.
#include <algorithm>
#include <limits>
#include <vector>

#include "engine/mesh_file.hpp"
#include "systems/hulls/extreme_points.hpp"
#include "systems/structures/shell/cook/check_shell_rows.hpp"
#include "systems/structures/shell/piece_shape.hpp"
#include "systems/structures/shell/ring.hpp"
#include "systems/tasks/step_limits.hpp"

namespace cullet {
namespace {

/// What the numbers of a column are: numbers between two bounds, relative rows of a table of this shell, or something
/// that a function of its own looks at.
enum class Is : uint8_t { Number, Vertex, Element, Hinge, Cell, RowOrNone = 16, Elsewhere = 32 };
constexpr Is or_none(Is row) {
    return static_cast<Is>(static_cast<uint8_t>(row) | static_cast<uint8_t>(Is::RowOrNone));
}
/// Bounds of an intact shell, and of one that has been hit where these are wider.
struct Rule {
    const char* table;
    const char* column;
    Is is;
    double low = 0, high = 0;
    double worn_low = low, worn_high = high;
};
constexpr double kFar = kLargestCoordinate;                          // m
constexpr double kHuge = double{std::numeric_limits<float>::max()};  // any finite float
constexpr double kUnit = 1.01;                                       // components of unit vectors, rounded
constexpr double kIds = 4294967295.0;

constexpr Rule kRules[] = {
    {"structures", "kind", Is::Elsewhere},
    {"structures", "rows", Is::Elsewhere},
    {"structures", "live_elements", Is::Elsewhere},
    {"shells", "springs", Is::Elsewhere},
    {"shells", "vertices", Is::Elsewhere},
    {"shells", "elements", Is::Elsewhere},
    {"shells", "hinges", Is::Elsewhere},
    {"shells", "packs", Is::Elsewhere},
    {"shells", "blocks", Is::Elsewhere},
    {"shells", "links", Is::Elsewhere},
    {"structures", "cells", Is::Elsewhere},
    {"structures", "points", Is::Elsewhere},
    {"structures", "material", Is::Elsewhere},
    {"structures", "users", Is::Number, 1, 1, 1, kIds},
    {"structures", "mass", Is::Number, 1e-30, 1e30},
    {"structures", "intact_mass", Is::Number, 1e-30, 1e30},
    {"structures", "centre", Is::Number, -kFar, kFar},
    {"structures", "inertia", Is::Number, -kHuge, kHuge},
    {"shells", "thickness", Is::Number, 0, kFar},
    {"shells", "depth_floor", Is::Number, 0, kFar},
    {"shells", "mean_edge", Is::Number, 1e-30, kFar},
    {"structures", "area", Is::Number, 1e-30, kHuge},
    {"shells", "time_step", Is::Number, kShortestStep, 1},
    {"shells", "triangle_limit", Is::Number, 0, kHuge},
    {"shells", "hinge_limit", Is::Number, 0, kHuge},
    {"shells", "vertex_limit", Is::Number, 0, kHuge},
    {"structures", "first_crack_speed", Is::Number, 0, kHuge},
    {"structures", "first_crack_force", Is::Number, 0, kHuge},
    {"structures", "generation", Is::Number, 0, 0, 0, 255},
    {"structures", "has_cracks", Is::Number, 0, 0, 0, 1},
    {"structures", "shape", Is::Number, 0, 0, 0, static_cast<double>(ShapeKind::Box)},
    {"structures", "shape_points", Is::Number, 0, 0, 0, kMostHullPoints},
    {"structures", "box_ratio", Is::Number, 0, 0, 0, kHuge},
    {"structures", "hull_ratio", Is::Number, 0, 0, 0, kHuge},
    {"structures", "margin", Is::Number, 0, kFar},
    {"shells", "dead_elements", Is::Number, 0, 0, 0, kIds},
    {"structures", "damage_model", Is::Number, 0, 0, 0, 255},
    {"vertices", "rest", Is::Number, -kFar, kFar},
    {"vertices", "inward", Is::Number, -kUnit, kUnit},
    {"vertices", "depth", Is::Number, 0, kFar},
    {"vertices", "crack_shift", Is::Number, 0, 0, -kFar, kFar},
    {"vertices", "element", or_none(Is::Element)},
    {"vertices", "mass", Is::Number, 0, 1e30},
    {"vertices", "inverse_mass", Is::Number, 0, kHuge},
    {"vertices", "is_pinned", Is::Number, 0, 0, 0, 1},
    {"vertices", "strength_factor", Is::Number, 0.5, 1.5, 0, 1.5},
    {"vertices", "crack", Is::Number, 0, 0, 0, 2},
    {"vertices", "heading", Is::Number, -kUnit, kUnit},
    {"vertices", "ready_time", Is::Number, 0, kHuge, -kHuge, kHuge},
    {"vertices", "crack_start", or_none(Is::Vertex)},
    {"vertices", "is_start_banned", Is::Number, 0, 1},
    {"vertices", "displacement", Is::Number, 0, 0, -kHuge, kHuge},
    {"vertices", "crush", Is::Number, 0, 0, -kHuge, kHuge},
    {"vertices", "velocity", Is::Number, 0, 0, -kHuge, kHuge},
    {"vertices", "probe", Is::Number, 0, 0, -kHuge, kHuge},
    {"vertices", "stiffness_scale", Is::Number, 0, 1},
    {"elements", "corner", Is::Vertex},
    {"elements", "neighbour", or_none(Is::Element)},
    {"elements", "hinge", or_none(Is::Hinge)},
    {"elements", "edge_kind", Is::Number, 0, 1, 0, 2},
    {"elements", "mass", Is::Number, 0, 1e30},
    {"elements", "volume", Is::Number, 0, 1e30},
    {"elements", "flags", Is::Number, 0, kDegenerate, 0, kDegenerate | kDead | kIsTouched},
    {"elements", "cell", Is::Cell},
    {"elements", "part", Is::Number, 0, kIds},
    {"elements", "normal", Is::Number, -kUnit, kUnit},
    {"elements", "uv", Is::Number, -kFar, kFar},
    {"elements", "drawn_material", Is::Number, 0, 65535},
    {"triangle_springs", "axis_x", Is::Number, -kUnit, kUnit},
    {"triangle_springs", "axis_y", Is::Number, -kUnit, kUnit},
    {"triangle_springs", "inverse_edges", Is::Number, -kHuge, kHuge},
    {"triangle_springs", "area", Is::Number, 0, kHuge},
    {"triangle_springs", "thickness", Is::Number, 0, kFar},
    {"triangle_springs", "scale", Is::Number, 0, 1},
    {"triangle_springs", "altitude", Is::Number, 0, kHuge},
    {"hinges", "vertex", or_none(Is::Vertex)},
    {"hinges", "gradient", Is::Number, -kHuge, kHuge},
    {"hinges", "stiffness", Is::Number, 0, kHuge},
    {"hinges", "scale", Is::Number, 0, 1},
    {"stiffness_packs", "first_block", Is::Elsewhere},
    {"stiffness_packs", "block_count", Is::Elsewhere},
    {"stiffness_packs", "block_capacity", Is::Elsewhere},
    {"stiffness_packs", "first_link", Is::Elsewhere},
    {"stiffness_packs", "link_count", Is::Elsewhere},
    {"stiffness_packs", "link_capacity", Is::Elsewhere},
    {"stiffness_blocks", "block", Is::Elsewhere},
    {"stiffness_links", "link", Is::Elsewhere},
    {"cells", "first_point", Is::Elsewhere},
    {"cells", "point_count", Is::Number, 0, kMostCellPoints},
    {"cells", "part_points", Is::Number, 0, kMostHullPoints},
    {"cells", "element_count", Is::Elsewhere},
    {"cells", "is_stale", Is::Number, 0, 0, 0, 1},
    {"hull_points", "point", Is::Number, -kFar, kFar},
};

struct Checker {
    const ShellView& shell;
    const std::string& name;
    const char* advice;
    Wear wear;
    std::string trouble;

    bool is_intact() const { return wear == Wear::Intact; }
    /// Of the shell, with those behind its vertices that packs reach over.
    uint32_t vertex_rows() const {
        const Range vertices = shell.vertices();
        return is_intact() ? vertices.count : shell.state.vertices.pool.rounded(vertices.capacity);
    }

    bool is_sound() const { return trouble.empty(); }
    /// True when it fits; the first thing that does not is kept.
    bool expect(bool fits, const std::string& what) {
        if (!fits && is_sound()) trouble = name + ": " + what + ". " + advice;
        return fits;
    }
    uint32_t count_of(Is is) const {
        const uint8_t row = static_cast<uint8_t>(is) & 15;
        const Shells& s = shell.shells();
        return row == static_cast<uint8_t>(Is::Vertex)    ? s.vertices[shell.row].count
               : row == static_cast<uint8_t>(Is::Element) ? s.elements[shell.row].count
               : row == static_cast<uint8_t>(Is::Hinge)   ? s.hinges[shell.row].count
                                                          : shell.cells().count;
    }
};

double number_at(const ColumnInfo& c, const std::byte* row, uint32_t k) {
    const auto read = [&]<class T>(T value) {
        std::memcpy(&value, row + k * sizeof(T), sizeof(T));
        return static_cast<double>(value);
    };
    switch (c.scalar) {
        case Scalar::U8:
            return read(uint8_t{});
        case Scalar::U16:
            return read(uint16_t{});
        case Scalar::Row:
        case Scalar::U32:
            return read(uint32_t{});
        case Scalar::U64:
            return read(uint64_t{});
        case Scalar::F32:
            return read(float{});
        case Scalar::F64:
            return read(double{});
        case Scalar::Bytes:
            break;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// Of a Rule's column: every number is in its range, also those that are not finite.
void check_column(Checker& check, const AnyTable& table, const ColumnInfo& c, const Rule& rule, const Range& range) {
    const bool is_number = rule.is == Is::Number;
    const bool may_be_none = (static_cast<uint8_t>(rule.is) & static_cast<uint8_t>(Is::RowOrNone)) != 0;
    const double least = check.is_intact() ? rule.low : rule.worn_low,
                 most = check.is_intact() ? rule.high : rule.worn_high;
    const double low = is_number ? least : 0,
                 high = is_number ? most : static_cast<double>(check.count_of(rule.is)) - 1;
    for (int a = 0; a < c.lanes * c.sides; ++a) {
        const std::byte* rows = table.column_memory(c, a) + size_t{range.first} * c.row_bytes;
        for (uint32_t row = 0; row < range.count; ++row)
            for (uint32_t k = 0; k < c.components; ++k) {
                const double value = number_at(c, rows + size_t{row} * c.row_bytes, k);
                if ((value >= low && value <= high) || (may_be_none && value == double{kNone})) continue;
                check.expect(false, table.place_of(c, a, row) + " is " + table.describe_value(c, a, range.first + row) +
                                        ", not within " + std::to_string(low) + " and " + std::to_string(high));
                return;
            }
    }
}

void check_columns(Checker& check, const AnyTable& table, const Range& range) {
    for (const ColumnInfo& c : table.columns()) {
        if (!c.is_state() || !check.is_sound()) continue;
        const auto is_its = [&](const Rule& rule) {
            return std::strcmp(rule.table, table.name()) == 0 && std::strcmp(rule.column, c.name) == 0;
        };
        const Rule* rule = std::find_if(std::begin(kRules), std::end(kRules), is_its);
        if (!check.expect(rule != std::end(kRules), std::string("no rule is known for ") + table.name() + "." + c.name))
            return;
        // A hidden run's cut-out has no cells of its own; its elements name the body's, which trouble_of_cut_out looks
        // at.
        const bool has_none = rule->is == Is::Cell && check.wear == Wear::CutOut && check.count_of(Is::Cell) == 0;
        if (rule->is != Is::Elsewhere && !has_none) check_column(check, table, c, *rule, range);
    }
}

std::string place(const char* column, uint32_t row) {
    return std::string(column) + "[" + std::to_string(row) + "]";
}

/// Corners differ; neighbours name each other across the same two vertices; kinds of edges and hinges fit.
void check_links(Checker& check) {
    const ShellView& shell = check.shell;
    const Elements& elements = shell.state.elements;
    for (uint32_t e = 0; e < shell.element_count() && check.is_sound(); ++e) {
        const uint32_t row = shell.element(e);
        const auto corner = elements.corner[row];
        check.expect(corner[0] != corner[1] && corner[1] != corner[2] && corner[2] != corner[0],
                     place("elements.corner", e) + " names vertex " + std::to_string(corner[0]) + ", " +
                         std::to_string(corner[1]) + ", " + std::to_string(corner[2]) + "; they must differ");
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t n = elements.neighbour[row][k], hinge = elements.hinge[row][k];
            const auto kind = static_cast<EdgeKind>(elements.edge_kind[row][k]);
            check.expect(n != kNone ? kind == EdgeKind::Interior
                                    : kind == EdgeKind::Border || (!check.is_intact() && kind == EdgeKind::Crack),
                         place("elements.edge_kind", e) + " is " + std::to_string(elements.edge_kind[row][k]) +
                             " on edge " + std::to_string(k) + ", unlike its neighbour");
            if (n == kNone) {
                check.expect(hinge == kNone,
                             place("elements.hinge", e) + " is " + std::to_string(hinge) + " on a free edge");
                continue;
            }
            const uint32_t other = shell.element(n);
            const uint32_t back = corner_of(shell, n, corner[(k + 1) % 3]);
            if (!check.expect(back < 3 && n != e && elements.corner[other][(back + 1) % 3] == corner[k] &&
                                  elements.neighbour[other][back] == e,
                              place("elements.neighbour", e) + " is " + std::to_string(n) + " across edge " +
                                  std::to_string(k) + ", which does not lead back"))
                return;
            check.expect(elements.hinge[other][back] == hinge,
                         place("elements.hinge", e) + " is " + std::to_string(hinge) + " on edge " + std::to_string(k) +
                             ", and " + std::to_string(elements.hinge[other][back]) + " from the other side");
            if (hinge == kNone || !check.is_sound() || !check.is_intact()) continue;
            const uint32_t low = std::min(e, n), from = low == e ? k : back;
            const auto a = elements.corner[shell.element(low)], b = elements.corner[shell.element(std::max(e, n))];
            const uint32_t far = low == e ? (back + 2) % 3 : (k + 2) % 3;
            const std::array<uint32_t, 4> wanted{a[from], a[(from + 1) % 3], a[(from + 2) % 3], b[far]};
            check.expect(shell.state.hinges.vertex[shell.hinge(hinge)] == wanted,
                         place("hinges.vertex", hinge) + " is not the edge between elements " + std::to_string(e) +
                             " and " + std::to_string(n));
        }
    }
}

/// Each hinge stands on one edge, seen from both sides. Breaking leaves dead ones, which name no vertex.
void check_hinges(Checker& check) {
    const ShellView& shell = check.shell;
    for (uint32_t h = 0; h < shell.hinge_count(); ++h) {
        const auto& named = shell.state.hinges.vertex[shell.hinge(h)];
        const auto names = std::count_if(named.begin(), named.end(), [](uint32_t v) { return v != kNone; });
        check.expect(names == 4 || (named[0] == kNone && !check.is_intact()),
                     place("hinges.vertex", h) + " names " + std::to_string(names) + " vertices, not 4");
    }
    if (!check.is_intact()) return;
    std::vector<uint8_t> sides(shell.hinge_count(), 0);
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (const uint32_t hinge : shell.state.elements.hinge[shell.element(e)])
            if (hinge != kNone && sides[hinge] < 3) ++sides[hinge];
    for (uint32_t h = 0; h < shell.hinge_count(); ++h)
        check.expect(sides[h] == 2,
                     place("hinges.vertex", h) + " is named by " + std::to_string(sides[h]) + " elements, not by 2");
}

/// Every vertex has one ring that holds all elements that name it; its mass is their third.
void check_vertices(Checker& check) {
    const ShellView& shell = check.shell;
    const Vertices& vertices = shell.state.vertices;
    std::vector<uint32_t> elements_at(shell.vertex_count(), 0);
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        if (shell.state.elements.flags[shell.element(e)] & kDead) continue;
        for (const uint32_t v : shell.state.elements.corner[shell.element(e)]) ++elements_at[v];
    }
    for (uint32_t v = 0; v < shell.vertex_count() && check.is_sound(); ++v) {
        const uint32_t row = shell.vertex(v), element = vertices.element[row];
        if (!check.expect(element == kNone ? elements_at[v] == 0 : corner_of(shell, element, v) < 3,
                          place("vertices.element", v) + " is " + std::to_string(element) +
                              ", which does not have it as a corner"))
            return;
        Ring ring;
        walk_ring(shell, v, ring);
        // A vertex on the border of a cut-out may have lost the elements between two of its fans.
        const bool is_cut = check.wear == Wear::CutOut && !ring.is_closed && ring.count < elements_at[v];
        check.expect(is_cut || ring.count == elements_at[v],
                     place("vertices.element", v) + " leads to " + std::to_string(ring.count) +
                         " elements round the vertex, " + std::to_string(elements_at[v]) + " name it");
        if (!check.is_intact()) continue;  // pinned or not, and masses as cuts rounded them
        double mass = 0;
        for (uint32_t i = 0; i < ring.count; ++i) mass += shell.state.elements.mass[shell.element(ring.element[i])];
        mass /= 3;
        check.expect(std::fabs(vertices.mass[row] - mass) <= 1e-9 * mass,
                     place("vertices.mass", v) + " is " + std::to_string(vertices.mass[row]) +
                         " kg, a third of its elements is " + std::to_string(mass) + " kg");
        const double product = mass * double{vertices.inverse_mass[row]};
        check.expect(mass > 0 ? std::fabs(product - 1) < 1e-6 : product == 0 && vertices.inverse_mass[row] == 0,
                     place("vertices.inverse_mass", v) + " is " + std::to_string(vertices.inverse_mass[row]) +
                         " 1/kg for " + std::to_string(mass) + " kg");
        const Vec3 inward = vertices.inward[row];
        check.expect(element == kNone || std::fabs(dot(inward, inward) - 1) < 1e-3f,
                     place("vertices.inward", v) + " is not of length 1");
    }
}

/// The slots of each pack are inside the table, and no other pack's.
void check_slots(Checker& check, const char* what, const uint32_t* first, const uint16_t* used,
                 const uint16_t* capacity, uint32_t packs, uint32_t slots) {
    std::vector<std::pair<uint32_t, uint32_t>> taken;
    for (uint32_t p = 0; p < packs && check.is_sound(); ++p) {
        check.expect(used[p] <= capacity[p] && capacity[p] <= slots && first[p] <= slots - capacity[p],
                     place(what, p) + " is " + std::to_string(first[p]) + " for " + std::to_string(used[p]) + " of " +
                         std::to_string(capacity[p]) + " slots; there are " + std::to_string(slots));
        if (capacity[p] > 0) taken.push_back({first[p], first[p] + capacity[p]});
    }
    std::sort(taken.begin(), taken.end());
    for (size_t i = 1; i < taken.size() && check.is_sound(); ++i)
        check.expect(taken[i - 1].second <= taken[i].first,
                     std::string(what) + ": two packs use the slot " + std::to_string(taken[i].first));
}

void check_stiffness(Checker& check) {
    const ShellView& shell = check.shell;
    const ShellRows& state = shell.state;
    const StiffnessPacks& p = state.stiffness_packs;
    const Range packs = state.shells.packs[shell.row], blocks = state.shells.blocks[shell.row],
                links = state.shells.links[shell.row];
    const uint32_t at = packs.first, rows = check.vertex_rows();
    check.expect(packs.count == 0 || (packs.count * kLanes >= shell.vertex_count() && packs.count * kLanes <= rows),
                 "shells.packs counts " + std::to_string(packs.count) + " packs of 8 for " +
                     std::to_string(shell.vertex_count()) + " vertices");
    check_slots(check, "stiffness_packs.first_block", p.first_block.data() + at, p.block_count.data() + at,
                p.block_capacity.data() + at, packs.count, blocks.count);
    check_slots(check, "stiffness_packs.first_link", p.first_link.data() + at, p.link_count.data() + at,
                p.link_capacity.data() + at, packs.count, links.count);
    const auto are_numbers = [](const float* k, size_t count) {
        return std::all_of(k, k + count, [](float x) { return std::fabs(double{x}) <= kHuge; });
    };
    const auto are_vertices = [&](const uint32_t(&neighbour)[kLanes]) {
        return std::all_of(neighbour, neighbour + kLanes, [&](uint32_t v) { return v < rows; });
    };
    // Spare slots hold what the rows held before: nobody reads a slot that is not in use, and who takes one into use
    // clears it.
    const auto for_each_used = [&](const uint32_t* first, const uint16_t* used, auto&& look) {
        for (uint32_t q = 0; q < packs.count; ++q)
            for (uint32_t i = first[q]; i < first[q] + used[q] && check.is_sound(); ++i) look(i);
    };
    if (!check.is_sound()) return;
    for_each_used(p.first_block.data() + at, p.block_count.data() + at, [&](uint32_t i) {
        const StiffnessBlock& block = state.stiffness_blocks.block[blocks.first + i];
        check.expect(are_vertices(block.neighbour) && are_numbers(block.k[0], 9 * kLanes),
                     place("stiffness_blocks.block", i) + " names a vertex above " + std::to_string(rows) +
                         " or has a number that is not finite");
    });
    for_each_used(p.first_link.data() + at, p.link_count.data() + at, [&](uint32_t i) {
        const StiffnessLink& link = state.stiffness_links.link[links.first + i];
        check.expect(are_vertices(link.neighbour) && are_numbers(link.row[0], 3 * kLanes) &&
                         are_numbers(link.column[0], 3 * kLanes),
                     place("stiffness_links.link", i) + " names a vertex above " + std::to_string(rows) +
                         " or has a number that is not finite");
    });
}

void check_cells(Checker& check) {
    const ShellView& shell = check.shell;
    const ShellRows& state = shell.state;
    const Range cells = state.structures.cells[shell.structure], points = state.structures.points[shell.structure];
    if (check.wear == Wear::CutOut && cells.count == 0) return;
    const uint32_t whole = state.structures.shape_points[shell.structure];
    check.expect((points.capacity == 0 && !check.is_intact()) || whole <= points.count,
                 "structures.shape_points is " + std::to_string(whole) + "; there are " + std::to_string(points.count));
    check.expect((whole == 0) == (shape_of(shell) == ShapeKind::Cells),
                 "structures.shape_points is " + std::to_string(whole) + " for structures.shape " +
                     std::to_string(state.structures.shape[shell.structure]));
    std::vector<uint32_t> elements_of(cells.count, 0);
    uint32_t last = 0;
    for (uint32_t e = 0; e < shell.element_count() && check.is_sound(); ++e) {
        const uint32_t cell = state.elements.cell[shell.element(e)];
        check.expect(cell >= last || !check.is_intact(), place("elements.cell", e) + " is " + std::to_string(cell) +
                                                             " after " + std::to_string(last) +
                                                             "; elements stand in order of cells");
        last = cell;
        ++elements_of[cell];
    }
    for (uint32_t c = 0; c < cells.count && check.is_sound(); ++c) {
        const uint32_t row = cells.first + c;
        check.expect(state.cells.element_count[row] == elements_of[c] || !check.is_intact(),
                     place("cells.element_count", c) + " is " + std::to_string(state.cells.element_count[row]) + ", " +
                         std::to_string(elements_of[c]) + " elements name the cell");
        if (points.capacity == 0 && !check.is_intact()) continue;  // of a task: hulls are its body's
        check.expect(state.cells.point_count[row] <= points.count &&
                         state.cells.first_point[row] <= points.count - state.cells.point_count[row],
                     place("cells.first_point", c) + " is " + std::to_string(state.cells.first_point[row]) + " for " +
                         std::to_string(state.cells.point_count[row]) + " points; there are " +
                         std::to_string(points.count));
        uint32_t sum = 0;
        for (const uint8_t part : state.cells.part_points[row]) sum += part;
        check.expect(sum == state.cells.point_count[row], place("cells.part_points", c) + " add up to " +
                                                              std::to_string(sum) + "; the cell has " +
                                                              std::to_string(state.cells.point_count[row]) + " points");
    }
}

void check_masses(Checker& check) {
    const ShellView& shell = check.shell;
    const Structures& s = shell.structures();
    const Row<Structures> row = shell.structure;
    double mass = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e) mass += shell.state.elements.mass[shell.element(e)];
    check.expect(
        !check.is_intact() || (std::fabs(s.mass[row] - mass) <= 1e-9 * mass && s.intact_mass[row] == s.mass[row]),
        "structures.mass is " + std::to_string(s.mass[row]) + " kg and structures.intact_mass " +
            std::to_string(s.intact_mass[row]) + " kg; the elements weigh " + std::to_string(mass) + " kg");
    const Sym3d& inertia = s.inertia[row];
    const double determinant = inertia.xx * (inertia.yy * inertia.zz - inertia.yz * inertia.yz) -
                               inertia.xy * (inertia.xy * inertia.zz - inertia.yz * inertia.xz) +
                               inertia.xz * (inertia.xy * inertia.yz - inertia.yy * inertia.xz);
    check.expect(inertia.xx > 0 && inertia.xx * inertia.yy > inertia.xy * inertia.xy && determinant > 0,
                 "structures.inertia is not positive definite");
}

}  // namespace

Result<void> check_shell_rows(const ShellView& shell, Wear wear, const std::string& name, const char* advice) {
    Checker check{shell, name, advice, wear, {}};
    ShellRows& state = shell.state;
    const Shells& s = state.shells;
    check_columns(check, state.structures, {shell.structure, 1, 1});
    check_columns(check, s, {shell.row, 1, 1});
    check_columns(check, state.vertices, s.vertices[shell.row]);
    check_columns(check, state.elements, s.elements[shell.row]);
    check_columns(check, state.triangle_springs, s.elements[shell.row]);
    check_columns(check, state.hinges, s.hinges[shell.row]);
    check_columns(check, state.stiffness_packs, s.packs[shell.row]);
    check_columns(check, state.stiffness_blocks, s.blocks[shell.row]);
    check_columns(check, state.stiffness_links, s.links[shell.row]);
    check_columns(check, state.cells, shell.cells());
    check_columns(check, state.hull_points, shell.points());
    const uint32_t material = shell.structures().material[shell.structure];
    check.expect(material < state.materials.size(), "structures.material is " + std::to_string(material));
    const uint32_t dead = s.dead_elements[shell.row], live = state.structures.live_elements[shell.structure];
    check.expect(uint64_t{dead} + live == shell.element_count(),
                 "structures.live_elements is " + std::to_string(live) + " and shells.dead_elements " +
                     std::to_string(dead) + ", of " + std::to_string(shell.element_count()));
    // Each believes what those before it have found.
    for (auto* look : {check_links, check_hinges, check_vertices, check_stiffness, check_cells, check_masses})
        if (check.is_sound()) look(check);
    if (!check.is_sound()) return Error{check.trouble};
    return {};
}

}  // namespace cullet
