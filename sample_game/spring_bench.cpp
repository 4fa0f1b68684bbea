#include "sample_game/spring_bench.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "components/state.hpp"
#include "engine/fp_mode.hpp"
#include "systems/models/thick_shell/springs/press_layers.hpp"
#include "systems/models/thick_shell/springs/spring_loop.hpp"
#include "systems/models/thick_shell/springs/spring_packs.hpp"
#include "systems/structures/shell/insert_vertex.hpp"

namespace cullet {
namespace {

Limits bench_limits(size_t vertices, size_t elements) {
    Limits limits;
    limits.bodies = limits.structures = 8;
    limits.tasks = limits.models = 1;
    limits.vertices = std::max<uint32_t>(1024, static_cast<uint32_t>(4 * vertices + 1024));
    limits.elements = std::max<uint32_t>(2048, static_cast<uint32_t>(4 * elements));
    limits.view_vertices = 1024;
    limits.debris = limits.queued_hits = 8;
    return limits;
}

Row<Structures> make_bench_shell(State& state, size_t vertices, size_t elements, uint32_t spare) {
    ShellRoom room;
    room.vertices = static_cast<uint32_t>(vertices) + spare;
    room.elements = static_cast<uint32_t>(elements) + kInsertElements * spare;
    room.hinges = kInsertHinges * spare;
    const Row<Structures> shell = make_shell(state, room);
    state.shells.vertices[state.shell_of(shell)].count = static_cast<uint32_t>(vertices);
    state.shells.elements[state.shell_of(shell)].count = static_cast<uint32_t>(elements);
    state.structures.live_elements[shell] = static_cast<uint32_t>(elements);
    return shell;
}

Row<Materials> add_material(State& state, const BenchMaterial& m) {
    const Row<Materials> row(state.materials.append(1));
    state.materials.young_modulus[row] = static_cast<float>(m.young_modulus);
    state.materials.poisson_ratio[row] = static_cast<float>(m.poisson_ratio);
    state.materials.density[row] = static_cast<float>(m.density);
    return row;
}

void link(const ShellView& shell) {
    Elements& elements = shell.state.elements;
    std::map<std::pair<uint32_t, uint32_t>, std::pair<uint32_t, uint32_t>> open;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t row = shell.element(e);
        elements.neighbour[row] = elements.hinge[row] = {kNone, kNone, kNone};
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t a = elements.corner[row][k], b = elements.corner[row][(k + 1) % 3];
            if (const auto found = open.find({b, a}); found != open.end()) {
                elements.neighbour[row][k] = found->second.first;
                elements.neighbour[shell.element(found->second.first)][found->second.second] = e;
                open.erase(found);
            } else {
                open[{a, b}] = {e, k};
            }
        }
    }
    for (const auto& [ends, at] : open)
        elements.edge_kind[shell.element(at.first)][at.second] = static_cast<uint8_t>(EdgeKind::Border);
}

void fill_shell(const ShellView& shell, const BenchMesh& mesh, double thickness,
                const std::function<bool(Vec3d)>& is_pinned) {
    ShellRows& s = shell.state;
    std::vector<Vec3d> normal(mesh.points.size());
    double edges = 0, area_sum = 0;
    const double density = s.materials.density[s.structures.material[shell.structure]];
    for (uint32_t e = 0; e < mesh.triangles.size(); ++e) {
        const auto& t = mesh.triangles[e];
        const Vec3d a = mesh.points[t[0]], b = mesh.points[t[1]], c = mesh.points[t[2]], n = cross(b - a, c - a);
        const uint32_t row = shell.element(e);
        s.elements.corner[row] = t;
        s.elements.volume[row] = 0.5 * length(n) * thickness;
        s.elements.mass[row] = density * s.elements.volume[row];
        s.structures.mass[shell.structure] += s.elements.mass[row];
        area_sum += 0.5 * length(n);
        edges += length(b - a) + length(c - b) + length(a - c);
        for (const uint32_t v : t) {
            normal[v] += n;
            s.vertices.mass[shell.vertex(v)] += s.elements.mass[row] / 3;
            if (s.vertices.element[shell.vertex(v)] == kNone) s.vertices.element[shell.vertex(v)] = e;
        }
    }
    for (uint32_t v = 0; v < mesh.points.size(); ++v) {
        const uint32_t row = shell.vertex(v);
        s.vertices.rest.set(row, mesh.points[v].to_float());
        s.vertices.inward.set(row, (-normalised(normal[v])).to_float());
        s.vertices.depth[row] = static_cast<float>(thickness);
        s.vertices.is_pinned[row] = is_pinned && is_pinned(mesh.points[v]);
    }
    s.shells.thickness[shell.row] = static_cast<float>(thickness);
    s.structures.area[shell.structure] = static_cast<float>(area_sum);
    s.shells.mean_edge[shell.row] = static_cast<float>(edges / (3.0 * static_cast<double>(mesh.triangles.size())));
    link(shell);
}

Row<ShellSprings> expect(const Result<Row<ShellSprings>>& given) {
    if (!given.ok()) throw std::runtime_error(given.error());
    return given.value();
}

}  // namespace

SpringBench::SpringBench(const BenchMesh& mesh, double thickness, const BenchMaterial& material,
                         const SpringSettings& settings, const std::function<bool(Vec3d)>& is_pinned, uint32_t spare)
    : state_(std::make_unique<State>(bench_limits(mesh.points.size(), mesh.triangles.size()))) {
    shell_ = make_bench_shell(*state_, mesh.points.size(), mesh.triangles.size(), spare);
    state_->structures.material[shell_] = add_material(*state_, material);
    fill_shell(ShellView(*state_, shell_), mesh, thickness, is_pinned);
    springs_ = expect(give_springs(*state_, shell_, settings));
    start_springs(view(), {});
}

SpringBench::SpringBench(const std::vector<Vec3d>& points, const std::vector<double>& masses,
                         const std::vector<GivenSpring>& springs, const SpringSettings& settings,
                         const std::function<bool(uint32_t)>& is_pinned)
    : state_(std::make_unique<State>(bench_limits(points.size(), springs.size()))) {
    shell_ = make_bench_shell(*state_, points.size(), 0, 0);
    state_->structures.material[shell_] = add_material(*state_, {});
    for (uint32_t v = 0; v < points.size(); ++v) {
        state_->vertices.rest.set(row(v), points[v].to_float());
        state_->vertices.mass[row(v)] = masses[v];
        const bool is_free = !is_pinned || !is_pinned(v);
        state_->vertices.is_pinned[row(v)] = !is_free;
        state_->vertices.inverse_mass[row(v)] = is_free ? static_cast<float>(1 / masses[v]) : 0;
    }
    springs_ = expect(give_springs(*state_, shell_, springs, settings));
    start_springs(view(), {});
}

Vec3d SpringBench::middle(uint32_t v) {
    const SpringView now = view();
    if (!now.has_layers()) return Vec3d(now.position(v));
    return 0.5 * (Vec3d(now.position(v)) + Vec3d(now.twin_position(v)));
}

void SpringBench::set_velocity(uint32_t v, Vec3 speed) {
    state_->vertices.velocity.set(row(v), speed);
    if (view().has_layers()) state_->twins.velocity.set(view().twin(v), speed);
}

void SpringBench::load(uint32_t v, Vec3d force) {
    loads_.push_back({v, force});
}

// Half of a force on each of two layers, each of half the mass: the same speed.
void SpringBench::push_loads() {
    const bool has_layers = view().has_layers();
    for (const Load& l : loads_) {
        const Vec3 push = (time_step() * double{state_->vertices.inverse_mass[row(l.vertex)]} * l.force).to_float();
        state_->vertices.velocity.set(row(l.vertex), state_->vertices.velocity[row(l.vertex)] + push);
        if (!has_layers) continue;
        const uint32_t twin = view().twin(l.vertex);
        state_->twins.velocity.set(twin, state_->twins.velocity[twin] + push);
    }
}

void SpringBench::step() {
    const FpMode mode;
    push_loads();
    const SpringView now = view();
    uint32_t& steps = state_->shell_springs.steps[springs_];
    const SpringStep one(now, steps);
    const uint32_t packs = (size() + kLanes - 1) / kLanes;
    if (has_energies(now.own(), now.row)) press_packs(now, steps & 1, 0, packs);
    switch (now.layout()) {
        case SpringLayout::OneLayer:
            integrate_spring_packs(one, 0, packs);
            break;
        case SpringLayout::Sandwich:
            integrate_sandwich_packs(one, 0, packs);
            break;
        case SpringLayout::Crossed:
            integrate_crossed_packs(one, 0, packs);
            break;
    }
    ++steps;
}

void SpringBench::settle(double omega, double seconds) {
    const auto keep = static_cast<float>(std::max(0.0, 1 - 2 * omega * time_step()));
    const auto damp = [&](auto& velocity, uint32_t first) {
        for (int k = 0; k < 3; ++k)
            for (uint32_t v = 0; v < size(); ++v) velocity.lane(k)[first + v] *= keep;
    };
    for (double t = 0; t < seconds; t += time_step()) {
        step();
        damp(state_->vertices.velocity, row(0));
        if (view().has_layers()) damp(state_->twins.velocity, view().twin(0));
    }
}

}  // namespace cullet
