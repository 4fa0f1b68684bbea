#include "systems/models/metal_shell/cook/metal_rows.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "engine/principal_axes.hpp"
#include "systems/models/metal_shell/shared/metal_view.hpp"

namespace cullet {
namespace {

constexpr float kLeastStiffness = 0.05f, kMostStiffness = 3, kTieStiffness = 1;  // of the field, by cotangents
constexpr double kCreaseWidth = 0.6, kLeastCreaseWidth = 1.3;  // of a cell's radius, and of a mean edge
constexpr double kExtent = 1.5;                                // of the mean distance from the centre
constexpr double kNoFolds = 7, kGateWidth = 4;                 // longest edge squared over twice the area
constexpr double kOpenSide = 0.45;                             // of all area, that a body leaves open
constexpr double kTubeLoad = 7.6;

/// The shell as its elements stand, for what looks at surfaces.
Surface surface_of(const ShellView& shell) {
    const Vertices& vertices = shell.state.vertices;
    const Elements& elements = shell.state.elements;
    Surface surface;
    Vec3d low(1e30, 1e30, 1e30), high(-1e30, -1e30, -1e30);
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const Vec3d p(vertices.rest[shell.vertex(v)]);
        surface.positions.push_back(p);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        surface.triangles.push_back(elements.corner[shell.element(e)]);
        surface.neighbours.push_back(elements.neighbour[shell.element(e)]);
    }
    std::vector<uint32_t> order(surface.positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto comes_before = [&](uint32_t a, uint32_t b) {
        const Vec3d p = surface.positions[a], q = surface.positions[b];
        if (p.x != q.x) return p.x < q.x;
        if (p.y != q.y) return p.y < q.y;
        return p.z != q.z ? p.z < q.z : a < b;
    };
    std::sort(order.begin(), order.end(), comes_before);
    surface.position_ids.resize(order.size());
    for (size_t k = 0; k < order.size(); ++k) {
        if (k == 0 || !(surface.positions[order[k]] == surface.positions[order[k - 1]])) ++surface.position_count;
        surface.position_ids[order[k]] = surface.position_count - 1;
    }
    surface.low = low, surface.high = high;
    surface.diagonal = length(high - low);
    return surface;
}

struct Spring {
    uint32_t from, to;
    float length, stiffness;
    bool is_tie;
};

// Cotangents of the angles opposite, half of each triangle's.
std::vector<Spring> springs_of(const Surface& surface, const DualGraph& graph) {
    std::map<std::pair<uint32_t, uint32_t>, double> edges;
    for (const Triangle& t : surface.triangles)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
            const Vec3d p = surface.positions[a] - surface.positions[c],
                        q = surface.positions[b] - surface.positions[c];
            const double across = length(cross(p, q));
            edges[{std::min(a, b), std::max(a, b)}] += across > 0 ? 0.5 * dot(p, q) / across : 0;
        }
    std::vector<Spring> springs;
    const auto add = [&](uint32_t a, uint32_t b, float stiffness, bool is_tie) {
        const auto far = static_cast<float>(length(surface.positions[a] - surface.positions[b]));
        springs.push_back({a, b, far, stiffness, is_tie});
        springs.push_back({b, a, far, stiffness, is_tie});
    };
    for (const auto& [ends, weight] : edges)
        add(ends.first, ends.second, std::clamp(static_cast<float>(weight), kLeastStiffness, kMostStiffness), false);
    std::map<std::pair<uint32_t, uint32_t>, bool> ties;
    for (const SheetLink& link : graph.links) ties[{link.a, link.b}] = true;
    // Fans that were split at one place stay at one place.
    std::vector<uint32_t> at_place(surface.position_count, kNone);
    for (uint32_t v = 0; v < surface.positions.size(); ++v) {
        uint32_t& last = at_place[surface.position_ids[v]];
        if (last != kNone) ties[{last, v}] = true;
        last = v;
    }
    for (const auto& [ends, is_tied] : ties)
        if (is_tied && !edges.contains(ends)) add(ends.first, ends.second, kTieStiffness, true);
    std::sort(springs.begin(), springs.end(),
              [](const Spring& p, const Spring& q) { return p.from != q.from ? p.from < q.from : p.to < q.to; });
    return springs;
}

struct Border {
    uint32_t from, to;
    double length;
};
std::vector<Border> borders_of(const Surface& surface, const DualGraph& graph, const Segmentation& cells,
                               double mean_edge) {
    std::map<std::pair<uint32_t, uint32_t>, double> lengths;
    const auto add = [&](uint32_t a, uint32_t b, double far) {
        if (a == b) return;
        lengths[{a, b}] += far, lengths[{b, a}] += far;
    };
    for (uint32_t e = 0; e < surface.triangles.size(); ++e)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t beside = surface.neighbours[e][k];
            if (beside == kNone || beside < e) continue;
            add(cells.cell_of[e], cells.cell_of[beside],
                length(surface.positions[surface.triangles[e][(k + 1) % 3]] -
                       surface.positions[surface.triangles[e][k]]));
        }
    std::vector<uint32_t> cell_of_vertex(surface.positions.size(), 0);
    for (uint32_t e = 0; e < surface.triangles.size(); ++e)
        for (const uint32_t v : surface.triangles[e]) cell_of_vertex[v] = cells.cell_of[e];
    for (const SheetLink& link : graph.links) add(cell_of_vertex[link.a], cell_of_vertex[link.b], 0.5 * mean_edge);
    std::vector<Border> borders;
    for (const auto& [ends, far] : lengths) borders.push_back({ends.first, ends.second, far});
    return borders;
}

/// A sub-shell as a plate.
struct Plate {
    double area = 0, distance = 0, slimness = 0;
    Vec3d first, centre;
    Sym3d second;
    uint32_t count = 0;
};
std::vector<Plate> plates_of(const Surface& surface, const Segmentation& cells) {
    std::vector<Plate> plates(cells.count());
    for (uint32_t e = 0; e < surface.triangles.size(); ++e) {
        Plate& plate = plates[cells.cell_of[e]];
        const FaceShape face = shape_of(surface, e);
        plate.area += face.area;
        plate.first += face.area * face.centroid;
        double longest = 0;
        Vec3d sum;
        Sym3d squares;
        for (size_t k = 0; k < 3; ++k) {
            const Vec3d p = surface.positions[surface.triangles[e][k]];
            const Vec3d way = surface.positions[surface.triangles[e][(k + 1) % 3]] - p;
            longest = std::max(longest, dot(way, way));
            sum += p;
            squares = squares + outer(p);
        }
        plate.second = plate.second + (face.area / 12) * (squares + outer(sum));
        if (face.area > 0) plate.slimness += face.area * std::min(100.0, longest / (2 * face.area));
        ++plate.count;
    }
    for (Plate& plate : plates)
        if (plate.area > 0) plate.centre = (1 / plate.area) * plate.first;
    for (uint32_t e = 0; e < surface.triangles.size(); ++e) {
        Plate& plate = plates[cells.cell_of[e]];
        plate.distance += length(shape_of(surface, e).centroid - plate.centre) / plate.count;
    }
    return plates;
}

Vec3d axis_of(const Plate& plate, double thickness, Vec3d away_from) {
    Sym3d inertia = inertia_of(plate.second - plate.area * outer(plate.centre));
    const double thin = plate.area * thickness * thickness / 12;
    inertia.xx += thin, inertia.yy += thin, inertia.zz += thin;
    const PrincipalAxes own = principal_axes(inertia);
    const Vec3d m = own.moments;
    const Vec3 unit = m.z >= m.x && m.z >= m.y ? Vec3{0, 0, 1} : m.y >= m.x ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    const Vec3d axis(rotate(own.axes, unit));
    return dot(axis, plate.centre - away_from) < 0 ? -axis : axis;
}

// The nearest eight sub-shells by the straight line: a field in space moves doubled sheets, trim and lining alike.
void blend(const std::vector<Plate>& plates, double width, Vec3d place, std::array<uint16_t, kBlended>& cell,
           std::array<float, kBlended>& weight) {
    std::vector<std::pair<double, uint16_t>> near;
    for (uint16_t c = 0; c < plates.size(); ++c) {
        const Vec3d way = place - plates[c].centre;
        near.push_back({dot(way, way), c});
    }
    const size_t count = std::min<size_t>(kBlended, near.size());
    std::partial_sort(near.begin(), near.begin() + static_cast<ptrdiff_t>(count), near.end());
    double value[kBlended] = {}, sum = 0;
    for (size_t k = 0; k < count; ++k)
        value[k] = exponential(std::max(-600.0, (near[0].first - near[k].first) / (2 * width * width)));
    const double last = count == kBlended ? value[count - 1] : 0;
    for (size_t k = 0; k < count; ++k) sum += value[k] -= last;
    for (size_t k = 0; k < kBlended; ++k) {
        cell[k] = near[k < count ? k : 0].second;
        weight[k] = k < count ? static_cast<float>(sum > 0 ? value[k] / sum : (k == 0 ? 1.0 : 0.0)) : 0.0f;
    }
}

// What looks to all sides as much encloses something, holes or not: a car's windows are open, a drum may lack its lid,
// and most bodies of cars are modelled without a floor, which leaves 0.3 to 0.42 of their area open (vans least, low
// cars most). A half-pipe leaves 0.64 of its area, half a ball 0.5.
bool is_a_body(const Surface& surface) {
    Vec3d sum;
    double area = 0;
    for (uint32_t f = 0; f < surface.triangles.size(); ++f) {
        const FaceShape face = shape_of(surface, f);
        sum += face.area * face.normal, area += face.area;
    }
    return length(sum) < kOpenSide * area;
}

// Alexander's mean load of a tube that folds like a concertina, over its section.
float crush_pressure_of(const ShellView& shell, const Surface& surface, const MetalCookSettings& settings) {
    if (settings.crush_pressure > 0) return settings.crush_pressure;
    if (!is_a_body(surface)) return 0;
    if (settings.body_pressure > 0) return settings.body_pressure;
    const Row<Materials> material = shell.structures().material[shell.structure];
    const MaterialRows& of = shell.state;
    const double yield = double{of.materials.young_modulus[material]} *
                         (material < of.material_traits.size() ? double{of.material_traits.yield_strain[material]} : 0);
    const Vec3d size = surface.high - surface.low;
    const double width = std::min({std::max(size.x, size.y), std::max(size.y, size.z), std::max(size.x, size.z)});
    const double ratio = double{shell.shells().thickness[shell.row]} / width;
    return static_cast<float>(kTubeLoad * yield * ratio * std::sqrt(ratio));
}

}  // namespace

Result<MetalReport> make_metal_rows(MetalShellRows rows, Row<Structures> structure, const MetalCookSettings& settings) {
    const ShellView shell(rows, structure);
    const Surface surface = surface_of(shell);
    const DualGraph graph = build_dual_graph(surface, settings.dual);
    const Segmentation cells = find_sub_shells(surface, graph, settings.cells);
    if (cells.count() > kMostSubShells)
        return Error{"its parts lie too far from each other: " + std::to_string(graph.component_count) +
                     " of them need a sub-shell each, and there is room for " + std::to_string(kMostSubShells) +
                     ". Join parts, or raise link_distance."};
    const std::vector<Spring> springs = springs_of(surface, graph);
    double edges = 0;
    uint32_t edge_count = 0;
    for (const Spring& s : springs)
        if (!s.is_tie) edges += double{s.length}, ++edge_count;
    const double mean_edge = edge_count ? edges / edge_count : 0;
    const std::vector<Border> borders = borders_of(surface, graph, cells, mean_edge);
    const std::vector<Plate> plates = plates_of(surface, cells);

    const MetalRoom room{shell.vertex_count(), shell.element_count(), static_cast<uint32_t>(springs.size()),
                         cells.count(), static_cast<uint32_t>(borders.size())};
    const char* full = "";
    const Row<MetalShells> row = make_metal(rows, structure, room, &full);
    if (!row.exists()) return Error{std::string("no room for its sub-shells; raise ") + full + "."};
    MetalShells& own = rows.metal_shells;
    own.vertices[row].count = room.vertices, own.elements[row].count = room.elements;
    own.springs[row].count = room.springs, own.cells[row].count = room.cells, own.borders[row].count = room.borders;
    own.mean_edge[row] = static_cast<float>(mean_edge);
    own.half_diagonal[row] = static_cast<float>(0.5 * surface.diagonal);
    own.crush_pressure[row] = crush_pressure_of(shell, surface, settings);
    own.published[row] = settings.published;
    own.impulse_time[row] = settings.impulse_time;
    own.tear_strain[row] = settings.tear_strain;

    Vec3d middle;
    double area = 0, radius = 0;
    for (const Plate& plate : plates)
        middle += plate.first, area += plate.area, radius += plate.distance / static_cast<double>(plates.size());
    if (area > 0) middle = (1 / area) * middle;
    const double width = std::max(kCreaseWidth * kExtent * radius, kLeastCreaseWidth * mean_edge);
    const MetalView metal(rows, structure);
    const double thickness = double{rows.shell_rows.shells.thickness[shell.row]};
    size_t b = 0;
    for (uint32_t c = 0; c < cells.count(); ++c) {
        SubShells& to = rows.sub_shells;
        const uint32_t at = metal.cell(c);
        const Plate& plate = plates[c];
        to.clear_rows(at, 1);
        to.representative[at] = cells.representative[c];
        to.element_count[at] = plate.count;
        to.area[at] = static_cast<float>(plate.area);
        to.centre.set(at, plate.centre.to_float());
        to.axis.set(at, axis_of(plate, thickness, middle).to_float());
        to.extent[at] = static_cast<float>(kExtent * plate.distance);
        const double slimness = plate.area > 0 ? plate.slimness / plate.area : kNoFolds;
        to.gate[at] = static_cast<float>(std::clamp((kNoFolds - slimness) / kGateWidth, 0.0, 1.0));
        to.first_border[at] = static_cast<uint32_t>(b);
        for (; b < borders.size() && borders[b].from == c; ++b) {
            const uint32_t to_row = own.borders[row].first + static_cast<uint32_t>(b);
            rows.sub_shell_borders.other[to_row] = static_cast<uint16_t>(borders[b].to);
            rows.sub_shell_borders.length[to_row] = static_cast<float>(borders[b].length);
        }
        to.border_count[at] = static_cast<uint32_t>(b) - to.first_border[at];
    }
    size_t s = 0;
    for (uint32_t v = 0; v < room.vertices; ++v) {
        MetalVertices& to = rows.metal_vertices;
        const uint32_t at = metal.vertex(v);
        to.clear_rows(at, 1);
        to.original.set(at, rows.shell_rows.vertices.rest[shell.vertex(v)]);
        to.pin_distance[at] = 1e30f;
        blend(plates, width, surface.positions[v], to.cell[at], to.weight[at]);
        to.first_spring[at] = static_cast<uint32_t>(s);
        for (; s < springs.size() && springs[s].from == v; ++s) {
            const uint32_t spring = own.springs[row].first + static_cast<uint32_t>(s);
            rows.metal_springs.other[spring] = springs[s].to;
            rows.metal_springs.length[spring] = springs[s].length;
            rows.metal_springs.stiffness[spring] = springs[s].stiffness;
            rows.metal_springs.is_tie[spring] = springs[s].is_tie;
        }
        to.spring_count[at] = static_cast<uint16_t>(s - to.first_spring[at]);
    }
    for (uint32_t e = 0; e < room.elements; ++e)
        rows.metal_elements.cell[own.elements[row].first + e] = cells.cell_of[e];
    return MetalReport{cells.count(), static_cast<uint32_t>(graph.links.size()), graph.component_count,
                       cells.sums.back(), cells.radius};
}

void measure_pins(MetalShellRows rows, Row<Structures> structure) {
    const MetalView metal(rows, structure);
    std::vector<Vec3> pins;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        if (metal.is_pinned(v)) pins.push_back(rows.metal_vertices.original[metal.vertex(v)]);
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        float least = 1e30f;
        const Vec3 place = rows.metal_vertices.original[metal.vertex(v)];
        for (const Vec3 pin : pins) least = std::min(least, length(place - pin));
        rows.metal_vertices.pin_distance[metal.vertex(v)] = least;
    }
}

}  // namespace cullet
