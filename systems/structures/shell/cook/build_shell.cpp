#include "systems/structures/shell/cook/build_shell.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "systems/cook/crease_normals.hpp"
#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/structures/shell/cook/order_cells.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/structures/shell/prism.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

constexpr double kLeastDepth = 0.05;  // of the wanted depth, for mass, stiffness and contact; the drawn depth stays

Error refuse(const std::string& what, size_t index, const std::string& rest) {
    return Error{"shell source: " + what + " " + std::to_string(index) + " " + rest};
}

bool is_finite(Vec3d p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

Result<void> check_sizes(const ShellSource& s) {
    const size_t v = s.position.size(), e = s.corner.size();
    if (v == 0 || e == 0) return Error{"shell source: no vertex or no element. Give at least one triangle."};
    if (s.inward.size() != v || s.depth.size() != v || s.neighbour.size() != e)
        return Error{"shell source: inward, depth and neighbour need as many entries as position and corner (" +
                     std::to_string(v) + ", " + std::to_string(e) + ")."};
    const auto fits = [](size_t size, size_t wanted) { return size == 0 || size == wanted; };
    if (!fits(s.corner_normal.size(), 3 * e) || !fits(s.corner_uv.size(), 3 * e) || !fits(s.drawn_material.size(), e) ||
        !fits(s.is_degenerate.size(), e))
        return Error{"shell source: corner arrays need three entries an element, element arrays one, or none at all."};
    return {};
}

Result<void> check_values(const ShellSource& s) {
    for (size_t v = 0; v < s.position.size(); ++v) {
        if (!is_finite(s.position[v])) return refuse("position", v, "is not finite. Repair the mesh.");
        if (!(std::fabs(dot(s.inward[v], s.inward[v]) - 1) < 1e-3))
            return refuse("inward direction", v, "is not a unit vector. Normalise it.");
        if (!(s.depth[v] >= 0) || !std::isfinite(s.depth[v]))
            return refuse("depth", v, "is " + std::to_string(s.depth[v]) + " m. It must be finite and at least 0.");
    }
    for (size_t e = 0; e < s.corner.size(); ++e) {
        const auto c = s.corner[e];
        for (uint32_t v : c)
            if (v >= s.position.size())
                return refuse("element", e,
                              "names vertex " + std::to_string(v) + " of " + std::to_string(s.position.size()) +
                                  ". Correct its corners.");
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0])
            return refuse("element", e, "names a vertex twice. Drop it before.");
    }
    return {};
}

int edge_towards(const ShellSource& s, uint32_t element, uint32_t from, uint32_t to) {
    for (int k = 0; k < 3; ++k)
        if (s.corner[element][k] == from && s.corner[element][(k + 1) % 3] == to) return k;
    return -1;
}

Result<void> check_links(const ShellSource& s) {
    for (uint32_t e = 0; e < s.corner.size(); ++e)
        for (int k = 0; k < 3; ++k) {
            const uint32_t n = s.neighbour[e][k];
            if (n == kNone) continue;
            if (n >= s.corner.size() || n == e)
                return refuse("element", e, "has neighbour " + std::to_string(n) + ". Correct its links.");
            const int back = edge_towards(s, n, s.corner[e][(k + 1) % 3], s.corner[e][k]);
            if (back < 0 || s.neighbour[n][back] != e)
                return refuse("element", e,
                              "and its neighbour " + std::to_string(n) +
                                  " do not share the edge in opposite directions. Correct their links.");
        }
    return {};
}

// Every vertex is one chain or one cycle of elements: round it, elements less links is 0 (cycle) or 1 (chain).
Result<void> check_fans(const ShellSource& s) {
    std::vector<uint32_t> fan(3 * s.corner.size());
    std::iota(fan.begin(), fan.end(), 0u);
    const auto root = [&](uint32_t c) {
        while (fan[c] != c) c = fan[c] = fan[fan[c]];
        return c;
    };
    for (uint32_t e = 0; e < s.corner.size(); ++e)
        for (int k = 0; k < 3; ++k) {
            const uint32_t n = s.neighbour[e][k];
            if (n == kNone || n < e) continue;
            const int back = edge_towards(s, n, s.corner[e][(k + 1) % 3], s.corner[e][k]);
            fan[root(3 * e + k)] = root(3 * n + (back + 1) % 3);
            fan[root(3 * e + (k + 1) % 3)] = root(3 * n + back);
        }
    std::vector<uint32_t> fan_of(s.position.size(), kNone);
    for (uint32_t e = 0; e < s.corner.size(); ++e)
        for (int k = 0; k < 3; ++k) {
            uint32_t& known = fan_of[s.corner[e][k]];
            const uint32_t found = root(3 * e + k);
            if (known == kNone) known = found;
            if (known != found)
                return refuse("vertex", s.corner[e][k], "has more than one fan of elements. Give each its own vertex.");
        }
    std::vector<uint32_t> elements(s.position.size(), 0);
    for (const auto& corner : s.corner)
        for (const uint32_t v : corner) ++elements[v];
    for (size_t v = 0; v < fan_of.size(); ++v) {
        if (fan_of[v] == kNone) return refuse("vertex", v, "is in no element. Drop it before.");
        if (elements[v] > kMostRing)
            return refuse("vertex", v,
                          "is in " + std::to_string(elements[v]) + " elements, more than " + std::to_string(kMostRing) +
                              ". Give the pole fewer segments, or cut its triangles by a ring of edges.");
    }
    return {};
}

void write_vertices(ShellView shell, const ShellSource& source, const CellOrder& order) {
    Vertices& vertices = shell.state.vertices;
    for (uint32_t v = 0; v < source.position.size(); ++v) {
        const uint32_t row = shell.vertex(order.row[v]);
        vertices.rest.set(row, source.position[v].to_float());
        vertices.inward.set(row, normalised(source.inward[v]).to_float());
        vertices.depth[row] = static_cast<float>(source.depth[v]);
        vertices.strength_factor[row] = 1;
        vertices.crack_start[row] = kNone;
        vertices.stiffness_scale[row] = 1;
    }
    shell.vertices().count = order.row_count;
}

std::array<float, 9> packed_normals(std::span<const Vec3> of_corners, uint32_t e) {
    std::array<float, 9> out;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3 n = of_corners[3 * size_t{e} + k];
        out[3 * k] = n.x, out[3 * k + 1] = n.y, out[3 * k + 2] = n.z;
    }
    return out;
}

void write_element(ShellView shell, const ShellSource& source, const CellOrder& order, uint32_t to, uint32_t e,
                   const std::vector<uint32_t>& element_row, std::span<const Vec3> normals) {
    Elements& elements = shell.state.elements;
    const uint32_t row = shell.element(to);
    uint32_t lowest = kNone;
    for (int k = 0; k < 3; ++k) {
        const uint32_t v = order.row[source.corner[e][k]], n = source.neighbour[e][k];
        lowest = std::min(lowest, v);
        elements.corner[row][k] = v;
        elements.neighbour[row][k] = n == kNone ? kNone : element_row[n];
        elements.hinge[row][k] = kNone;
        elements.edge_kind[row][k] = static_cast<uint8_t>(n == kNone ? EdgeKind::Border : EdgeKind::Interior);
        shell.state.vertices.element[shell.vertex(v)] = to;
        if (!source.corner_uv.empty()) {
            elements.uv[row][2 * k] = source.corner_uv[3 * e + k].x;
            elements.uv[row][2 * k + 1] = source.corner_uv[3 * e + k].y;
        }
    }
    elements.normal[row] = packed_normals(normals, e);
    const auto cell = std::upper_bound(order.first_row.begin(), order.first_row.end(), lowest) - 1;
    elements.cell[row] = static_cast<uint32_t>(cell - order.first_row.begin());
    elements.flags[row] = !source.is_degenerate.empty() && source.is_degenerate[e] ? kDegenerate : 0;
    elements.drawn_material[row] = source.drawn_material.empty() ? uint16_t{0} : source.drawn_material[e];
    const Prism prism = load_prism(shell, to);
    const double volume = std::max(0.0, prism_volume(prism));
    const double density = shell.state.materials.density[shell.structures().material[shell.structure]];
    elements.volume[row] = volume;
    elements.mass[row] = density * std::max(volume, kLeastDepth * source.wanted_depth * prism_area(prism));
}

/// Elements by lowest corner, and so by cell; returns the row of each source element.
std::vector<uint32_t> order_elements(const ShellSource& source, const CellOrder& order) {
    std::vector<std::pair<uint32_t, uint32_t>> keys;
    for (uint32_t e = 0; e < source.corner.size(); ++e) {
        const auto& c = source.corner[e];
        keys.push_back({std::min({order.row[c[0]], order.row[c[1]], order.row[c[2]]}), e});
    }
    std::sort(keys.begin(), keys.end());
    std::vector<uint32_t> row(keys.size());
    for (uint32_t to = 0; to < keys.size(); ++to) row[keys[to].second] = to;
    return row;
}

// One a linked edge. Elements of no area have no altitude to turn about and get none; elements of no depth do (their
// thickness has a floor), else a blow along the normal would meet no resistance there.
void write_hinges(ShellView shell) {
    Elements& elements = shell.state.elements;
    const auto has_area = [&](uint32_t e) {
        const auto c = elements.corner[shell.element(e)];
        const Vec3d p(shell.state.vertices.rest[shell.vertex(c[0])]), q(shell.state.vertices.rest[shell.vertex(c[1])]),
            r(shell.state.vertices.rest[shell.vertex(c[2])]);
        const double longest = std::max({dot(q - p, q - p), dot(r - q, r - q), dot(p - r, p - r)});
        return length(cross(q - p, r - p)) > 1e-6 * longest;
    };
    uint32_t& count = shell.hinges().count;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t n = elements.neighbour[shell.element(e)][k];
            if (n == kNone || n < e || !has_area(e) || !has_area(n)) continue;
            const auto a = elements.corner[shell.element(e)], b = elements.corner[shell.element(n)];
            uint32_t back = 0;
            while (b[back] != a[(k + 1) % 3] || b[(back + 1) % 3] != a[k]) ++back;
            elements.hinge[shell.element(e)][k] = count;
            elements.hinge[shell.element(n)][back] = count;
            shell.state.hinges.vertex[shell.hinge(count)] = {a[k], a[(k + 1) % 3], a[(k + 2) % 3], b[(back + 2) % 3]};
            shell.state.hinges.scale[shell.hinge(count)] = 1;
            ++count;
        }
}

float mean_edge(ShellView shell) {
    double sum = 0;
    uint32_t count = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t row = shell.element(e), n = shell.state.elements.neighbour[row][k];
            if (n != kNone && n < e) continue;
            const auto c = shell.state.elements.corner[row];
            sum += length(Vec3d(shell.state.vertices.rest[shell.vertex(c[(k + 1) % 3])]) -
                          Vec3d(shell.state.vertices.rest[shell.vertex(c[k])]));
            ++count;
        }
    return static_cast<float>(sum / count);
}

}  // namespace

Result<Row<Structures>> build_shell(ShellRows& state, const ShellSource& source, Row<Materials> material) {
    for (auto check : {check_sizes, check_values, check_links, check_fans})
        if (const Result<void> sound = check(source); !sound) return Error{sound.error()};
    if (material >= state.materials.size() || !(state.materials.density[material] > 0))
        return refuse("material", material, "does not exist or has no density. Add it before.");

    const CellOrder order = order_cells(source.position, source.corner);
    const uint32_t element_count = static_cast<uint32_t>(source.corner.size());
    const uint32_t cell_count = static_cast<uint32_t>(order.first_row.size());
    const ShellRoom room{.vertices = order.row_count,
                         .elements = element_count,
                         .hinges = element_count * 3 / 2,
                         .cells = cell_count,
                         .points = most_points(cell_count, element_count)};
    const char* full = nullptr;
    const Row<Structures> row = make_shell(state, room, &full);
    if (!row.exists())
        return Error{std::string("shell source: no room for ") + std::to_string(source.position.size()) +
                     " vertices. Raise " + full + "."};
    const ShellView shell(state, row);
    state.structures.material[row] = material;
    write_vertices(shell, source, order);
    const std::vector<uint32_t> element_row = order_elements(source, order);
    const std::vector<Vec3> made = source.corner_normal.empty()
                                       ? crease_normals(source.position, source.corner, source.neighbour)
                                       : std::vector<Vec3>();
    const std::span<const Vec3> normals = source.corner_normal.empty() ? std::span(made) : source.corner_normal;
    for (uint32_t e = 0; e < element_count; ++e)
        write_element(shell, source, order, element_row[e], e, element_row, normals);
    shell.elements().count = element_count;
    shell.structures().live_elements[shell.structure] = element_count;
    state.structures.cells[row].count = cell_count;
    write_hinges(shell);
    sum_vertex_masses(shell);
    measure_shell(shell);
    state.shells.mean_edge[state.shell_of(row)] = mean_edge(shell);
    state.shells.depth_floor[state.shell_of(row)] = static_cast<float>(kLeastDepth * source.wanted_depth);
    build_hulls(shell);
    return row;
}

}  // namespace cullet
