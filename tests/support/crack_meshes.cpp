#include "tests/support/crack_meshes.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "components/state.hpp"
#include "engine/random.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet::crack_test {
namespace {

using Edge = std::pair<uint32_t, uint32_t>;

Vec3d middle(Vec3d a, Vec3d b) {
    return 0.5 * (a + b);
}

}  // namespace

TestSurface sheet(uint32_t nx, uint32_t ny, double width, double height, double jitter) {
    TestSurface s;
    const Random random{7};
    for (uint32_t j = 0; j <= ny; ++j)
        for (uint32_t i = 0; i <= nx; ++i) {
            const bool is_inner = i > 0 && i < nx && j > 0 && j < ny;
            const double dx = is_inner ? jitter * (random.uniform(i, j) - 0.5) : 0;
            const double dy = is_inner ? jitter * (random.uniform(i, j + 1000) - 0.5) : 0;
            s.place.push_back({width * (i + dx) / nx, height * (j + dy) / ny, 0});
        }
    for (uint32_t j = 0; j < ny; ++j)
        for (uint32_t i = 0; i < nx; ++i) {
            const uint32_t a = j * (nx + 1) + i, b = a + 1, c = b + nx + 1, d = a + nx + 1;
            if ((i + j) % 2) {
                s.triangle.push_back({a, b, c});
                s.triangle.push_back({a, c, d});
            } else {
                s.triangle.push_back({a, b, d});
                s.triangle.push_back({b, c, d});
            }
        }
    return s;
}

TestSurface sphere(uint32_t levels, double radius) {
    TestSurface s;
    s.place = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    s.triangle = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (uint32_t level = 0; level < levels; ++level) {
        std::map<Edge, uint32_t> made;
        std::vector<std::array<uint32_t, 3>> finer;
        const auto half = [&](uint32_t a, uint32_t b) {
            const auto [at, is_new] = made.try_emplace({std::min(a, b), std::max(a, b)}, s.place.size());
            if (is_new) s.place.push_back(middle(s.place[a], s.place[b]));
            return at->second;
        };
        for (const auto& t : s.triangle) {
            const uint32_t a = half(t[0], t[1]), b = half(t[1], t[2]), c = half(t[2], t[0]);
            finer.push_back({t[0], a, c});
            finer.push_back({a, t[1], b});
            finer.push_back({c, b, t[2]});
            finer.push_back({a, b, c});
        }
        s.triangle = finer;
        for (Vec3d& p : s.place) p = normalised(p);
    }
    for (Vec3d& p : s.place) p = radius * p;
    return s;
}

TestSurface closed_lathe(uint32_t segments, uint32_t rings, double radius, double height) {
    TestSurface s;
    for (uint32_t j = 0; j < rings; ++j) {
        double sine, cosine;
        sine_cosine(3.14159265 * (j + 1) / (rings + 1), sine, cosine);
        for (uint32_t i = 0; i < segments; ++i) {
            double x, z;
            sine_cosine(2 * 3.14159265358979 * (i + 0.5 * (j % 2)) / segments, z, x);
            s.place.push_back({radius * sine * x, -0.5 * height * cosine, -radius * sine * z});
        }
    }
    const uint32_t bottom = static_cast<uint32_t>(s.place.size()), top = bottom + 1;
    s.place.push_back({0, -0.5 * height, 0});
    s.place.push_back({0, 0.5 * height, 0});
    for (uint32_t i = 0; i < segments; ++i) {
        const uint32_t next = (i + 1) % segments, last = (rings - 1) * segments;
        s.triangle.push_back({next, i, bottom});
        s.triangle.push_back({last + i, last + next, top});
        for (uint32_t j = 0; j + 1 < rings; ++j) {
            const uint32_t a = j * segments + i, b = j * segments + next, c = a + segments, d = b + segments;
            if (j % 2) {
                s.triangle.push_back({a, b, d});
                s.triangle.push_back({a, d, c});
            } else {
                s.triangle.push_back({a, b, c});
                s.triangle.push_back({b, d, c});
            }
        }
    }
    return s;
}

Shell make_shell_of(const TestSurface& surface, uint32_t spare_vertices, uint32_t spare_elements) {
    const uint32_t vertex_count = static_cast<uint32_t>(surface.place.size());
    const uint32_t element_count = static_cast<uint32_t>(surface.triangle.size());
    Limits limits;
    limits.bodies = limits.structures = limits.tasks = 4;
    limits.models = 1;
    limits.vertices = 1u << 16;
    limits.elements = 1u << 17;
    limits.view_vertices = limits.debris = 64;
    auto owned = std::make_unique<State>(limits);
    State& state = *owned;
    state.materials.append(1);
    Materials& m = state.materials;
    m.density[0] = 2400, m.young_modulus[0] = 70e9f, m.poisson_ratio[0] = 0.2f, m.tensile_strength[0] = 50e6f;
    m.fracture_energy[0] = 20, m.crush_strength[0] = 6e9f, m.heading_power[0] = 6, m.tip_factor[0] = 0.6f,
    m.run_seconds[0] = 1e-3f;

    std::map<Edge, std::pair<uint32_t, uint32_t>> sides;
    for (uint32_t e = 0; e < element_count; ++e)
        for (uint32_t k = 0; k < 3; ++k) sides[{surface.triangle[e][k], surface.triangle[e][(k + 1) % 3]}] = {e, k};
    ShellRoom room;
    room.vertices = vertex_count + spare_vertices;
    room.elements = element_count + spare_elements;
    room.hinges = 3 * room.elements;
    Shell shell{std::move(owned), ShellView(state, make_shell(state, room)), 0};
    const ShellView view = shell.view;
    view.structures().material[view.structure] = Row<Materials>(0);
    view.vertices().count = vertex_count;
    view.elements().count = element_count;
    view.structures().live_elements[view.structure] = element_count;
    // Ranges are rounded up; tests of full shells want the room they asked for.
    view.vertices().capacity = room.vertices;
    view.elements().capacity = room.elements;
    Elements& elements = state.elements;
    Vertices& vertices = state.vertices;
    constexpr double kDepth = 4e-3;
    std::vector<Vec3d> normal(vertex_count);
    double edges = 0, area_sum = 0;
    for (uint32_t e = 0; e < element_count; ++e) {
        const uint32_t row = view.element(e);
        const auto& t = surface.triangle[e];
        elements.corner[row] = t;
        const Vec3d n = cross(surface.place[t[1]] - surface.place[t[0]], surface.place[t[2]] - surface.place[t[0]]);
        const double area = 0.5 * length(n);
        area_sum += area;
        elements.volume[row] = kDepth * area;
        elements.mass[row] = 2400 * kDepth * area;
        shell.mass += elements.mass[row];
        elements.cell[row] = 0;
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t a = t[k], b = t[(k + 1) % 3];
            normal[a] += n;
            edges += length(surface.place[a] - surface.place[b]);
            const auto other = sides.find({b, a});
            elements.hinge[row][k] = elements.neighbour[row][k] = kNone;
            elements.edge_kind[row][k] =
                static_cast<uint8_t>(other == sides.end() ? EdgeKind::Border : EdgeKind::Interior);
            if (other != sides.end()) elements.neighbour[row][k] = other->second.first;
            for (uint32_t i = 0; i < 3; ++i) elements.normal[row][3 * k + i] = static_cast<float>(normalised(n)[i]);
            elements.uv[row][2 * k] = static_cast<float>(surface.place[a].x);
            elements.uv[row][2 * k + 1] = static_cast<float>(surface.place[a].y);
        }
    }
    view.shells().mean_edge[view.row] = static_cast<float>(edges / (3 * element_count));
    view.shells().thickness[view.row] = static_cast<float>(kDepth);
    view.structures().area[view.structure] = static_cast<float>(area_sum);
    view.structures().mass[view.structure] = shell.mass;
    for (uint32_t v = 0; v < vertex_count; ++v) {
        const uint32_t row = view.vertex(v);
        vertices.rest.set(row, surface.place[v].to_float());
        vertices.inward.set(row, (-normalised(normal[v])).to_float());
        vertices.depth[row] = static_cast<float>(kDepth);
        vertices.strength_factor[row] = 1;
        vertices.stiffness_scale[row] = 1;
        vertices.crack_start[row] = kNone;
    }
    for (uint32_t e = 0; e < element_count; ++e) {
        const auto& t = surface.triangle[e];
        for (uint32_t k = 0; k < 3; ++k) {
            vertices.element[view.vertex(t[k])] = e;
            const uint32_t other = elements.neighbour[view.element(e)][k];
            if (other == kNone || other < e) continue;
            const uint32_t j = sides.at({t[(k + 1) % 3], t[k]}).second;
            const uint32_t h = view.hinges().count++;
            elements.hinge[view.element(e)][k] = elements.hinge[view.element(other)][j] = h;
            state.hinges.vertex[view.hinge(h)] = {t[k], t[(k + 1) % 3], t[(k + 2) % 3],
                                                  surface.triangle[other][(j + 2) % 3]};
        }
    }
    for (uint32_t e = 0; e < element_count; ++e) assemble_element(view, e);
    for (uint32_t h = 0; h < view.hinge_count(); ++h) assemble_hinge(view, h);
    for (uint32_t v = 0; v < vertex_count; ++v) weigh_vertex(view, v);
    return shell;
}

Sym3d tension_along(Vec3 direction, double pascal) {
    return pascal * outer(normalised(Vec3d(direction)));
}

void set_stress(ShellView shell, const StressField& field) {
    ShellRows& s = shell.state;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t row = shell.element(e);
        Vec3 centre;
        for (const uint32_t v : s.elements.corner[row]) centre += (1.0f / 3) * s.vertices.rest[shell.vertex(v)];
        const Vec3d x(s.triangle_springs.axis_x[row]), y(s.triangle_springs.axis_y[row]);
        float most = 0;
        for (int face = 0; face < 2; ++face) {
            const Sym3d t = field(centre, face);
            const double xx = dot(x, t * x), yy = dot(y, t * y), xy = dot(x, t * y);
            auto& column = face == 0 ? s.elements.outer_stress : s.elements.inner_stress;
            column.set(row, {static_cast<float>(xx), static_cast<float>(yy), static_cast<float>(xy)});
            const double largest = 0.5 * (xx + yy) + std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
            most = std::max(most, static_cast<float>(largest));
        }
        s.elements.principal[row] = most;
        s.elements.over_limit[row] = 0xff;
    }
}

Row<Tasks> make_task(Shell& shell, double time) {
    Tasks& tasks = shell.state->tasks;
    const Row<Tasks> task(0);
    tasks.state[task] = static_cast<uint8_t>(TaskState::Running);
    tasks.working[task] = shell.view.structure;
    tasks.strength_scale[task] = 1;
    shell.state->hidden_runs.time_step[task] = 1e-6f;
    set_time(shell, task, time);
    return task;
}

void set_time(Shell& shell, Row<Tasks> task, double time) {
    shell.state->tasks.steps_done[task] = static_cast<uint32_t>(time / shell.state->hidden_runs.time_step[task] + 0.5);
}

namespace {

std::string say(const char* what, uint32_t a, uint32_t b = 0) {
    return std::string(what) + " " + std::to_string(a) + ", " + std::to_string(b);
}

std::string broken_link(ShellView shell) {
    const Elements& elements = shell.state.elements;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t row = shell.element(e);
        const auto& c = elements.corner[row];
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) return say("repeated corner in element", e);
        for (uint32_t k = 0; k < 3; ++k) {
            if (c[k] >= shell.vertex_count()) return say("corner out of range in element", e, c[k]);
            const uint32_t other = elements.neighbour[row][k], hinge = elements.hinge[row][k];
            const bool is_interior = elements.edge_kind[row][k] == static_cast<uint8_t>(EdgeKind::Interior);
            if (is_interior != (other != kNone)) return say("edge kind and neighbour disagree at element, edge", e, k);
            if ((hinge != kNone) != is_interior) return say("hinge without interior edge at element, edge", e, k);
            if (!is_interior) continue;
            const uint32_t other_row = shell.element(other);
            uint32_t j = 0;
            while (j < 3 && !(elements.corner[other_row][j] == c[(k + 1) % 3] &&
                              elements.corner[other_row][(j + 1) % 3] == c[k]))
                ++j;
            if (j == 3) return say("neighbours without a common edge", e, other);
            if (elements.neighbour[other_row][j] != e) return say("one-sided link between elements", e, other);
            if (elements.hinge[other_row][j] != hinge) return say("two hinges between elements", e, other);
            std::array<uint32_t, 4> named = shell.state.hinges.vertex[shell.hinge(hinge)];
            std::array<uint32_t, 4> wanted = {c[k], c[(k + 1) % 3], c[(k + 2) % 3],
                                              elements.corner[other_row][(j + 2) % 3]};
            for (auto* a : {&named, &wanted}) {
                std::sort(a->begin(), a->begin() + 2);
                std::sort(a->begin() + 2, a->end());
            }
            if (named != wanted) return say("hinge with wrong vertices: hinge, element", hinge, e);
        }
    }
    return {};
}

using Place = std::array<float, 3>;
Place place_of(ShellView shell, uint32_t v) {
    const Vec3 p = shell.state.vertices.rest[shell.vertex(v)];
    return {p.x, p.y, p.z};
}

std::string broken_vertex(ShellView shell) {
    const Vertices& vertices = shell.state.vertices;
    const Elements& elements = shell.state.elements;
    const std::vector<uint32_t> used = uses(shell);
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        Ring ring;
        walk_ring(shell, v, ring);
        if (ring.is_cut_short) continue;
        if (ring.count != used[v]) return say("vertex with more than one fan: vertex, elements", v, used[v]);
        for (uint32_t i = 0; i < ring.count; ++i)
            if (elements.corner[shell.element(ring.element[i])][ring.corner[i]] != v) return say("wrong ring at", v);
        if (vertices.crack[shell.vertex(v)] != static_cast<uint8_t>(CrackState::Tip)) continue;
        if (ring.is_closed || ring.count == 0) return say("tip inside the shell at vertex", v);
        const uint32_t first = shell.element(ring.element[0]), last = shell.element(ring.element[ring.count - 1]);
        const uint32_t k = ring.corner[0], j = (ring.corner[ring.count - 1] + 2u) % 3;
        const auto is_crack = [&](uint32_t row, uint32_t edge) {
            return elements.edge_kind[row][edge] == static_cast<uint8_t>(EdgeKind::Crack);
        };
        if (!is_crack(first, k) || !is_crack(last, j)) return say("tip that is no end of a crack: vertex", v);
        if (place_of(shell, elements.corner[first][(k + 1) % 3]) != place_of(shell, elements.corner[last][j]))
            return say("tip whose crack is open at its end: vertex", v);
    }
    return {};
}

std::string open_junction(ShellView shell) {
    std::map<std::pair<Place, Place>, int> sides;
    const Elements& elements = shell.state.elements;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t row = shell.element(e);
            if (elements.edge_kind[row][k] != static_cast<uint8_t>(EdgeKind::Crack)) continue;
            const Place a = place_of(shell, elements.corner[row][k]);
            const Place b = place_of(shell, elements.corner[row][(k + 1) % 3]);
            a < b ? ++sides[{a, b}] : --sides[{b, a}];
        }
    for (const auto& [edge, sum] : sides)
        if (sum != 0) return "crack edge without its other side at x = " + std::to_string(edge.first[0]);
    return {};
}

}  // namespace

std::string broken_rule(const Shell& shell) {
    const ShellView view = shell.view;
    for (const std::string& found : {broken_link(view), broken_vertex(view), open_junction(view)})
        if (!found.empty()) return found;
    double by_elements = 0, by_vertices = 0, by_volume = 0, sound = 0;  // the last two without flat elements
    for (uint32_t e = 0; e < view.element_count(); ++e) {
        const uint32_t row = view.element(e);
        by_elements += view.state.elements.mass[row];
        if (view.state.elements.flags[row] & kDegenerate) continue;
        sound += view.state.elements.mass[row];
        by_volume +=
            view.state.materials.density[view.structures().material[view.structure]] * view.state.elements.volume[row];
    }
    for (uint32_t v = 0; v < view.vertex_count(); ++v) {
        const uint32_t row = view.vertex(v);
        if (view.state.vertices.element[row] == kNone) continue;
        by_vertices += view.state.vertices.mass[row];
        if (!(view.state.vertices.mass[row] > 0)) return say("vertex without mass", v);
    }
    if (std::fabs(by_elements / shell.mass - 1) > 1e-12) return "mass of the elements changed";
    if (std::fabs(by_vertices / shell.mass - 1) > 1e-12) return "mass of the vertices is not that of the elements";
    if (std::fabs(by_volume - sound) > 1e-12 * sound) return "mass of the elements is not density times their volume";
    return {};
}

std::vector<uint32_t> components(ShellView shell) {
    std::vector<uint32_t> parent(shell.element_count());
    for (uint32_t e = 0; e < parent.size(); ++e) parent[e] = e;
    const auto root = [&](uint32_t e) {
        while (parent[e] != e) e = parent[e] = parent[parent[e]];
        return e;
    };
    for (uint32_t e = 0; e < parent.size(); ++e)
        for (const uint32_t n : shell.state.elements.neighbour[shell.element(e)])
            if (n != kNone) {
                const uint32_t a = root(e), b = root(n);
                parent[std::max(a, b)] = std::min(a, b);
            }
    std::map<uint32_t, uint32_t> number;
    std::vector<uint32_t> found(parent.size());
    for (uint32_t e = 0; e < parent.size(); ++e)
        found[e] = number.try_emplace(root(e), static_cast<uint32_t>(number.size())).first->second;
    return found;
}

uint32_t component_count(ShellView shell) {
    const auto found = components(shell);
    return found.empty() ? 0 : 1 + *std::max_element(found.begin(), found.end());
}

std::vector<uint32_t> uses(ShellView shell) {
    std::vector<uint32_t> used(shell.vertex_count());
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (const uint32_t v : shell.state.elements.corner[shell.element(e)]) ++used[v];
    return used;
}

uint32_t edge_count(ShellView shell) {
    uint32_t halves = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (const uint32_t n : shell.state.elements.neighbour[shell.element(e)]) halves += n == kNone ? 2 : 1;
    return halves / 2;
}

uint32_t live_vertex_count(ShellView shell) {
    uint32_t live = 0;
    for (const uint32_t n : uses(shell)) live += n > 0;
    return live;
}

uint32_t vertex_near(ShellView shell, Vec3 place) {
    uint32_t found = 0;
    float nearest = 1e30f;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const float d = length(shell.state.vertices.rest[shell.vertex(v)] - place);
        if (d < nearest) nearest = d, found = v;
    }
    return found;
}

Motion3 motion_of(ShellView shell) {
    Motion3 m{{}, {}, 0};
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        if (shell.state.vertices.element[row] == kNone) continue;
        const Vec3d p = shell.state.vertices.mass[row] * Vec3d(shell.state.vertices.velocity[row]);
        m.momentum += p;
        m.angular += cross(Vec3d(shell.state.vertices.rest[row]), p);
        m.energy += 0.5 * dot(p, Vec3d(shell.state.vertices.velocity[row]));
    }
    return m;
}

void shake(ShellView shell, uint64_t seed) {
    const Random random{seed};
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const auto draw = [&](uint32_t k) { return static_cast<float>(2 * random.uniform(v, k) - 1); };
        shell.state.vertices.velocity.set(shell.vertex(v), {1 + draw(0), draw(1), draw(2)});
        shell.state.vertices.displacement.set(shell.vertex(v), 1e-6f * Vec3{draw(3), draw(4), draw(5)});
    }
}

}  // namespace cullet::crack_test
