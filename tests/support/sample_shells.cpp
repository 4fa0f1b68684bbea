#include "tests/support/sample_shells.hpp"

#include <algorithm>
#include <map>

#include "components/state.hpp"
#include "engine/random.hpp"
#include "systems/structures/shell/mass_properties.hpp"

namespace cullet {
namespace {

constexpr double kPi = 3.14159265358979323846;

using Edge = std::pair<uint32_t, uint32_t>;

// Angle-weighted normals would do as well; by area is enough for smooth samples.
void point_inward(SampleSurface& s, double depth) {
    s.inward.assign(s.position.size(), {});
    for (const auto& c : s.corner) {
        const Vec3d n = cross(s.position[c[1]] - s.position[c[0]], s.position[c[2]] - s.position[c[0]]);
        for (uint32_t v : c) s.inward[v] += -n;
    }
    for (Vec3d& m : s.inward) m = normalised(m);
    s.depth.assign(s.position.size(), depth);
    s.wanted_depth = depth;
}

}  // namespace

void link_elements(SampleSurface& s) {
    std::map<Edge, uint32_t> by_edge;
    for (uint32_t e = 0; e < s.corner.size(); ++e)
        for (int k = 0; k < 3; ++k) by_edge[{s.corner[e][k], s.corner[e][(k + 1) % 3]}] = e;
    s.neighbour.assign(s.corner.size(), {kNone, kNone, kNone});
    for (uint32_t e = 0; e < s.corner.size(); ++e)
        for (int k = 0; k < 3; ++k)
            if (auto found = by_edge.find({s.corner[e][(k + 1) % 3], s.corner[e][k]}); found != by_edge.end())
                s.neighbour[e][k] = found->second;
}

SampleSurface sample_sphere(double radius, double depth, int rounds) {
    SampleSurface s;
    s.position = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    s.corner = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int r = 0; r < rounds; ++r) {
        std::map<Edge, uint32_t> middle;
        const auto half = [&](uint32_t a, uint32_t b) {
            const auto [it, is_new] =
                middle.insert({{std::min(a, b), std::max(a, b)}, static_cast<uint32_t>(s.position.size())});
            if (is_new) s.position.push_back(normalised(s.position[a] + s.position[b]));
            return it->second;
        };
        std::vector<std::array<uint32_t, 3>> finer;
        for (const auto& c : s.corner) {
            const uint32_t p = half(c[0], c[1]), q = half(c[1], c[2]), t = half(c[2], c[0]);
            finer.insert(finer.end(), {{c[0], p, t}, {p, c[1], q}, {t, q, c[2]}, {p, q, t}});
        }
        s.corner = finer;
    }
    for (Vec3d& p : s.position) p = radius * normalised(p);
    point_inward(s, depth);
    for (size_t v = 0; v < s.position.size(); ++v) s.inward[v] = normalised(-s.position[v]);
    link_elements(s);
    return s;
}

SampleSurface sample_grid(double width, double length, uint32_t columns, uint32_t rows, double depth, double shake) {
    SampleSurface s;
    const Random random{7};
    for (uint32_t j = 0; j <= rows; ++j)
        for (uint32_t i = 0; i <= columns; ++i) {
            const bool is_inside = i > 0 && j > 0 && i < columns && j < rows;
            const double dx = is_inside ? shake * (random.uniform(i, j) - 0.5) : 0;
            const double dz = is_inside ? shake * (random.uniform(i, j + 1000) - 0.5) : 0;
            s.position.push_back({width * ((i + dx) / columns - 0.5), 0, length * ((j + dz) / rows - 0.5)});
        }
    const auto at = [&](uint32_t i, uint32_t j) { return j * (columns + 1) + i; };
    for (uint32_t j = 0; j < rows; ++j)
        for (uint32_t i = 0; i < columns; ++i) {
            const uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
            if ((i + j) % 2)
                s.corner.insert(s.corner.end(), {{a, d, b}, {b, d, c}});
            else
                s.corner.insert(s.corner.end(), {{a, d, c}, {a, c, b}});
        }
    point_inward(s, depth);
    link_elements(s);
    return s;
}

SampleSurface sample_vase(double height, double depth, uint32_t segments, uint32_t rows) {
    SampleSurface s;
    s.position.push_back({0, 0, 0});
    for (uint32_t j = 0; j <= rows; ++j)
        for (uint32_t i = 0; i < segments; ++i) {
            const double t = static_cast<double>(j) / rows;
            const double radius = height * (0.2 + 0.15 * std::sin(3.5 * t));
            const double turn = 2 * kPi * (i + 0.5 * (j % 2)) / segments;
            s.position.push_back({radius * std::cos(turn), height * t, radius * std::sin(turn)});
        }
    const auto at = [&](uint32_t i, uint32_t j) { return 1 + j * segments + i % segments; };
    for (uint32_t i = 0; i < segments; ++i) s.corner.push_back({0, at(i, 0), at(i + 1, 0)});
    for (uint32_t j = 0; j < rows; ++j)
        for (uint32_t i = 0; i < segments; ++i) {
            const uint32_t a = at(i, j), b = at(i + 1, j), c = at(i, j + 1), d = at(i + 1, j + 1);
            if (j % 2)
                s.corner.insert(s.corner.end(), {{a, d, b}, {a, c, d}});
            else
                s.corner.insert(s.corner.end(), {{a, c, b}, {b, c, d}});
        }
    point_inward(s, depth);
    link_elements(s);
    return s;
}

Row<Materials> sample_material(State& state, float density) {
    const Row<Materials> row(state.materials.append(1));
    state.materials.density[row] = density;
    state.materials.young_modulus[row] = 70e9f;
    state.materials.poisson_ratio[row] = 0.2f;
    state.materials.tensile_strength[row] = 50e6f;
    state.materials.fracture_energy[row] = 20;
    state.materials.crush_strength[row] = 6e9f;
    return row;
}

Vec3d element_middle(const ShellView& shell, uint32_t element) {
    Vec3d sum;
    for (uint32_t v : shell.state.elements.corner[shell.element(element)])
        sum += Vec3d(shell.state.vertices.rest[shell.vertex(v)]);
    return 1.0 / 3 * sum;
}

std::function<int(uint32_t)> nearest_seed(const ShellView& shell, int count, uint64_t seed) {
    std::vector<Vec3d> points;
    const Random random{seed};
    for (int i = 0; i < count; ++i)
        points.push_back(element_middle(shell, static_cast<uint32_t>(random.bits(i) % shell.element_count())));
    std::vector<int> labels;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const Vec3d p = element_middle(shell, e);
        int best = 0;
        for (int i = 1; i < count; ++i)
            if (length(points[i] - p) < length(points[best] - p)) best = i;
        labels.push_back(best);
    }
    return [labels](uint32_t e) { return labels[e]; };
}

namespace {

void cut_links(ShellView shell, const std::function<int(uint32_t)>& label) {
    Elements& elements = shell.state.elements;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (int k = 0; k < 3; ++k) {
            const uint32_t row = shell.element(e), n = elements.neighbour[row][k];
            if (n == kNone || label(e) == label(n)) continue;
            for (int j = 0; j < 3; ++j) {
                const uint32_t other = shell.element(n);
                if (elements.corner[other][j] != elements.corner[row][(k + 1) % 3]) continue;
                elements.neighbour[other][j] = elements.hinge[other][j] = kNone;
                elements.edge_kind[other][j] = static_cast<uint8_t>(EdgeKind::Crack);
            }
            elements.neighbour[row][k] = elements.hinge[row][k] = kNone;
            elements.edge_kind[row][k] = static_cast<uint8_t>(EdgeKind::Crack);
        }
}

// Every fan of a vertex after the first gets a copy.
void split_fans(ShellView shell) {
    Elements& elements = shell.state.elements;
    Vertices& vertices = shell.state.vertices;
    const uint32_t corner_count = 3 * shell.element_count();
    std::vector<uint32_t> fan(corner_count);
    for (uint32_t c = 0; c < corner_count; ++c) fan[c] = c;
    const auto root = [&](uint32_t c) {
        while (fan[c] != c) c = fan[c];
        return c;
    };
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (int k = 0; k < 3; ++k) {
            const uint32_t n = elements.neighbour[shell.element(e)][k];
            if (n == kNone) continue;
            for (int i : {k, (k + 1) % 3})
                for (uint32_t j = 0; j < 3; ++j)
                    if (elements.corner[shell.element(n)][j] == elements.corner[shell.element(e)][i]) {
                        const uint32_t a = root(3 * e + i), b = root(3 * n + j);
                        fan[std::max(a, b)] = std::min(a, b);
                    }
        }
    std::map<Edge, uint32_t> vertex_of;  // (vertex, fan)
    std::vector<uint8_t> is_taken(shell.vertex_count(), 0);
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (int k = 0; k < 3; ++k) {
            uint32_t& corner = elements.corner[shell.element(e)][k];
            const uint32_t old = corner;
            const auto [found, is_new] = vertex_of.insert({{old, root(3 * e + k)}, old});
            if (is_new && is_taken[old]) {
                found->second = shell.vertices().count++;
                vertices.copy_rows(vertices, shell.vertex(old), shell.vertex(found->second), 1);
                vertices.crack[shell.vertex(found->second)] = static_cast<uint8_t>(CrackState::Cracked);
            }
            is_taken[old] = 1;
            corner = found->second;
            vertices.element[shell.vertex(corner)] = e;
        }
}

void renew_hinges(ShellView shell) {
    Elements& elements = shell.state.elements;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (int k = 0; k < 3; ++k) {
            const uint32_t h = elements.hinge[shell.element(e)][k], n = elements.neighbour[shell.element(e)][k];
            if (h == kNone || n < e) continue;
            const auto a = elements.corner[shell.element(e)], b = elements.corner[shell.element(n)];
            uint32_t opposite = 0;
            for (uint32_t v : b)
                if (v != a[k] && v != a[(k + 1) % 3]) opposite = v;
            shell.state.hinges.vertex[shell.hinge(h)] = {a[k], a[(k + 1) % 3], a[(k + 2) % 3], opposite};
        }
}

}  // namespace

Row<Structures> cut_by_label(State& state, Row<Structures> source, const std::function<int(uint32_t)>& label) {
    const Range v = state.shells.vertices[state.shell_of(source)], e = state.shells.elements[state.shell_of(source)],
                h = state.shells.hinges[state.shell_of(source)];
    const ShellRoom room{.vertices = 2 * v.count + 64,
                         .elements = e.count,
                         .hinges = h.count,
                         .cells = state.structures.cells[source].count,
                         .points = state.structures.points[source].count};
    const Row<Structures> row = copy_shell(state, source, room);
    const ShellView shell(state, row);
    cut_links(shell, label);
    split_fans(shell);
    renew_hinges(shell);
    sum_vertex_masses(shell);
    return row;
}

}  // namespace cullet
