#include "tests/support/shell_meshes.hpp"

#include <algorithm>
#include <map>

#include "components/state.hpp"
#include "engine/random.hpp"
#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/hidden/contact.hpp"
#include "systems/models/thick_shell/hidden/integrate_packs.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"

namespace cullet::test {
namespace {

ShellMesh breadth_first(const ShellMesh& mesh) {
    std::vector<std::vector<uint32_t>> near(mesh.positions.size());
    for (const auto& t : mesh.triangles)
        for (size_t k = 0; k < 3; ++k) near[t[k]].push_back(t[(k + 1) % 3]);
    std::vector<uint32_t> order{0}, place(mesh.positions.size(), kNone);
    place[0] = 0;
    for (size_t i = 0; i < order.size(); ++i)
        for (const uint32_t v : near[order[i]])
            if (place[v] == kNone) place[v] = static_cast<uint32_t>(order.size()), order.push_back(v);
    ShellMesh result;
    for (const uint32_t v : order) result.positions.push_back(mesh.positions[v]);
    for (const auto& t : mesh.triangles) result.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
    std::sort(result.triangles.begin(), result.triangles.end(), [](const auto& a, const auto& b) {
        return std::min({a[0], a[1], a[2]}) != std::min({b[0], b[1], b[2]})
                   ? std::min({a[0], a[1], a[2]}) < std::min({b[0], b[1], b[2]})
                   : a < b;
    });
    return result;
}

/// Neighbours and hinge ids; the number of hinges.
uint32_t link_elements(const ShellView& shell) {
    Elements& elements = shell.state.elements;
    std::map<std::pair<uint32_t, uint32_t>, std::pair<uint32_t, uint32_t>> open;
    uint32_t hinges = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t row = shell.element(e);
        elements.neighbour[row] = elements.hinge[row] = {kNone, kNone, kNone};
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t a = elements.corner[row][k], b = elements.corner[row][(k + 1) % 3];
            const auto found = open.find({b, a});
            if (found == open.end()) {
                open[{a, b}] = {e, k};
                continue;
            }
            const auto [other, edge] = found->second;
            elements.neighbour[row][k] = other;
            elements.neighbour[shell.element(other)][edge] = e;
            elements.hinge[row][k] = elements.hinge[shell.element(other)][edge] = hinges++;
            open.erase(found);
        }
        for (uint32_t k = 0; k < 3; ++k) elements.edge_kind[row][k] = static_cast<uint8_t>(EdgeKind::Interior);
    }
    for (const auto& [ends, at] : open)
        elements.edge_kind[shell.element(at.first)][at.second] = static_cast<uint8_t>(EdgeKind::Border);
    return hinges;
}

void fill_vertices(const ShellView& shell, const ShellMesh& mesh, double thickness,
                   const std::function<bool(Vec3d)>& is_pinned) {
    Vertices& vertices = shell.state.vertices;
    std::vector<Vec3d> normal(mesh.positions.size());
    for (const auto& t : mesh.triangles) {
        const Vec3d n = cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
        for (const uint32_t v : t) normal[v] += n;
    }
    for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
        const uint32_t row = shell.vertex(v);
        vertices.rest.set(row, mesh.positions[v].to_float());
        vertices.inward.set(row, (-normalised(normal[v])).to_float());
        vertices.depth[row] = static_cast<float>(thickness);
        vertices.is_pinned[row] = is_pinned && is_pinned(mesh.positions[v]);
        vertices.strength_factor[row] = vertices.stiffness_scale[row] = 1;
        vertices.crack_start[row] = kNone;
    }
}

void fill_elements(const ShellView& shell, const ShellMesh& mesh, double thickness) {
    Elements& elements = shell.state.elements;
    Vertices& vertices = shell.state.vertices;
    Shells& shells = shell.shells();
    Structures& structures = shell.structures();
    const double density = shell.state.materials.density[structures.material[shell.structure]];
    double edges = 0;
    Vec3d centre;
    for (uint32_t e = 0; e < mesh.triangles.size(); ++e) {
        const uint32_t row = shell.element(e);
        const auto& t = mesh.triangles[e];
        const Vec3d a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
        const double area = 0.5 * length(cross(b - a, c - a));
        elements.corner[row] = t;
        elements.volume[row] = area * thickness;
        elements.mass[row] = density * area * thickness;
        edges += length(b - a) + length(c - b) + length(a - c);
        structures.mass[shell.structure] += elements.mass[row];
        structures.area[shell.structure] += static_cast<float>(area);
        centre += elements.mass[row] / 3 * (a + b + c);
        for (const uint32_t v : t) {
            vertices.mass[shell.vertex(v)] += elements.mass[row] / 3;
            if (vertices.element[shell.vertex(v)] == kNone) vertices.element[shell.vertex(v)] = e;
        }
    }
    structures.centre.set(shell.structure, (1 / structures.mass[shell.structure]) * centre);
    shells.mean_edge[shell.row] = static_cast<float>(edges / (3.0 * static_cast<double>(mesh.triangles.size())));
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        vertices.inverse_mass[row] = vertices.is_pinned[row] ? 0.0f : static_cast<float>(1 / vertices.mass[row]);
    }
}

}  // namespace

ShellMesh grid_mesh(uint32_t n, double length, double jitter, uint64_t seed) {
    const Random random{seed};
    const double side = length / n;
    ShellMesh mesh;
    for (uint32_t y = 0; y <= n; ++y)
        for (uint32_t x = 0; x <= n; ++x) {
            const uint64_t id = y * (n + 1) + x;
            const bool inner_x = x > 0 && x<n, inner_y = y> 0 && y < n;
            const double dx = inner_x ? jitter * (2 * random.uniform(id, 0) - 1) : 0;
            const double dy = inner_y ? jitter * (2 * random.uniform(id, 1) - 1) : 0;
            mesh.positions.push_back({side * (x + dx), side * (y + dy), 0});
        }
    for (uint32_t y = 0; y < n; ++y)
        for (uint32_t x = 0; x < n; ++x) {
            const uint32_t a = y * (n + 1) + x, b = a + 1, c = b + n + 1, d = a + n + 1;
            const bool turn = jitter > 0 && random.uniform(a, 2) < 0.5;
            if (turn)
                mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
            else
                mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
        }
    return mesh;
}

ShellMesh triangle_mesh(uint32_t n, double length, double jitter, uint64_t seed) {
    const Random random{seed};
    const double side = length / n;
    // Odd rows have their points at half sides, and both ends.
    const auto rows = static_cast<uint32_t>(std::floor(2 * n / std::sqrt(3.0) + 0.5));
    const double height = length / rows;
    ShellMesh mesh;
    std::vector<std::vector<uint32_t>> row(rows + 1);
    for (uint32_t y = 0; y <= rows; ++y) {
        const bool is_odd = y % 2;
        const uint32_t points = is_odd ? n + 2 : n + 1;
        for (uint32_t x = 0; x < points; ++x) {
            const bool is_end = x == 0 || x == points - 1, is_border = is_end || y == 0 || y == rows;
            const uint64_t id = mesh.positions.size();
            const double px = is_end ? (x == 0 ? 0 : length) : side * (is_odd ? x - 0.5 : x);
            const double dx = is_border ? 0 : jitter * side * (2 * random.uniform(id, 0) - 1);
            const double dy = is_border ? 0 : jitter * side * (2 * random.uniform(id, 1) - 1);
            row[y].push_back(static_cast<uint32_t>(id));
            mesh.positions.push_back({px + dx, height * y + dy, 0});
        }
    }
    for (uint32_t y = 0; y < rows; ++y) {
        // Zip the two rows: the one whose next point is more to the left advances.
        const auto &low = row[y], &high = row[y + 1];
        size_t i = 0, j = 0;
        const auto at = [&](const std::vector<uint32_t>& r, size_t k, bool is_odd) {
            return k + 1 == r.size() ? double(n) : k == 0 ? 0.0 : is_odd ? double(k) - 0.5 : double(k);
        };
        const bool low_odd = y % 2;
        while (i + 1 < low.size() || j + 1 < high.size()) {
            const bool advance_low =
                j + 1 == high.size() || (i + 1 < low.size() && at(low, i + 1, low_odd) + at(low, i, low_odd) <
                                                                   at(high, j + 1, !low_odd) + at(high, j, !low_odd));
            if (advance_low)
                mesh.triangles.push_back({low[i], low[i + 1], high[j]}), ++i;
            else
                mesh.triangles.push_back({low[i], high[j + 1], high[j]}), ++j;
        }
    }
    return mesh;
}

ShellMesh sphere_mesh(uint32_t frequency, double radius) {
    const double g = 0.5 * (1 + std::sqrt(5.0));
    const Vec3d corner[12] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    const uint32_t face[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                  {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                  {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    // A point is known by its (corner, weight) pairs, so that faces share it exactly.
    std::map<std::array<uint32_t, 6>, uint32_t> known;
    ShellMesh mesh;
    const auto point = [&](const uint32_t(&f)[3], uint32_t i, uint32_t j) {
        std::array<std::pair<uint32_t, uint32_t>, 3> part{{{f[0], frequency - i - j}, {f[1], i}, {f[2], j}}};
        for (auto& p : part)
            if (p.second == 0) p.first = kNone;
        std::sort(part.begin(), part.end());
        const std::array<uint32_t, 6> key{part[0].first,  part[0].second, part[1].first,
                                          part[1].second, part[2].first,  part[2].second};
        const auto [at, is_new] = known.try_emplace(key, static_cast<uint32_t>(mesh.positions.size()));
        if (is_new) {
            Vec3d p;
            for (const auto& [c, w] : part)
                if (c != kNone) p += double(w) * corner[c];
            mesh.positions.push_back(radius * normalised(p));
        }
        return at->second;
    };
    for (const auto& f : face)
        for (uint32_t i = 0; i < frequency; ++i)
            for (uint32_t j = 0; i + j < frequency; ++j) {
                mesh.triangles.push_back({point(f, i, j), point(f, i + 1, j), point(f, i, j + 1)});
                if (i + j + 1 < frequency)
                    mesh.triangles.push_back({point(f, i + 1, j), point(f, i + 1, j + 1), point(f, i, j + 1)});
            }
    return breadth_first(mesh);
}

Row<Materials> add_material(State& state, double young_modulus, double poisson_ratio, double density) {
    const Row<Materials> m(state.materials.append(1));
    state.materials.young_modulus[m] = static_cast<float>(young_modulus);
    state.materials.poisson_ratio[m] = static_cast<float>(poisson_ratio);
    state.materials.density[m] = static_cast<float>(density);
    state.materials.tensile_strength[m] = 50e6f;
    state.materials.fracture_energy[m] = 20;
    state.materials.crush_strength[m] = 6e9f;
    state.materials.restitution[m] = 0.6f;
    state.materials.friction[m] = 0.45f;
    state.materials.heading_power[m] = 6;
    state.materials.tip_factor[m] = 0.6f;
    state.materials.run_seconds[m] = 1e-3f;
    return m;
}

Row<Structures> make_test_shell(State& state, const ShellMesh& mesh, double thickness, Row<Materials> material,
                                const std::function<bool(Vec3d)>& is_pinned, uint32_t spare) {
    const auto count = static_cast<uint32_t>(mesh.positions.size());
    const auto triangles = static_cast<uint32_t>(mesh.triangles.size());
    ShellRoom room;
    room.vertices = count + spare, room.elements = triangles + spare, room.hinges = (triangles + spare) / 2 * 3 + 3;
    room.blocks = room.links = (count + spare + 64) / kLanes * 14 + 64;
    if (material_traits(state, material).has_grain()) room.links *= 3;
    const Row<Structures> row = make_shell(state, room);
    if (!row.exists()) return row;
    const ShellView shell(state, row);
    state.structures.material[row] = material;
    state.shells.thickness[state.shell_of(row)] = static_cast<float>(thickness);
    shell.vertices().count = count;
    shell.elements().count = triangles;
    state.structures.live_elements[row] = triangles;
    fill_vertices(shell, mesh, thickness, is_pinned);
    fill_elements(shell, mesh, thickness);
    shell.hinges().count = link_elements(shell);
    assemble_springs(shell);
    measure_limits(shell);
    limit_all_stiffness(shell);
    assemble_stiffness(shell);
    state.shells.time_step[state.shell_of(row)] = stable_time_step(shell);
    return row;
}

Row<Tasks> make_test_task(State& state, Row<Structures> shell, uint32_t task) {
    const Row<Tasks> t(task);
    state.tasks.working[t] = shell;
    state.tasks.state[t] = static_cast<uint8_t>(TaskState::Running);
    state.tasks.first_contact[t] = task * kMostContacts;
    state.tasks.strength_scale[t] = 1;
    state.hidden_runs.time_step[t] = state.shells.time_step[state.shell_of(shell)];
    state.hidden_runs.damping_time[t] = 0.15f * state.shells.time_step[state.shell_of(shell)];
    return t;
}

void step_task(State& state, Row<Tasks> task) {
    Tasks& tasks = state.tasks;
    const uint32_t side = tasks.steps_done[task] & 1;
    contact_forces(state, task);
    const HiddenStep step(ShellView(state, tasks.working[task]), state.hidden_runs.time_step[task],
                          state.hidden_runs.damping_time[task], side);
    integrate_packs(step, 0, step.pack_count);
    apply_contact(state, task, side);
    ++tasks.steps_done[task];
}

}  // namespace cullet::test
