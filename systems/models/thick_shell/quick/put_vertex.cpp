#include "systems/models/thick_shell/quick/put_vertex.hpp"

#include <algorithm>

#include "systems/models/thick_shell/springs/edge_stiffness.hpp"
#include "systems/structures/shell/cut_edge.hpp"
#include "systems/structures/shell/insert_vertex.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

constexpr uint32_t kMostPatch = 5 + 4 * kMostRing;

/// The vertices round an inserted one and their neighbours, in both layers. Without the neighbours the turn that gives
/// angular momentum back gave runs up to 5 % of their energy at a single cut: the inserted vertex leaves its patch less
/// inertia, and as much angular momentum then takes more energy. The wider the patch, the less.
struct Patch {
    const RegionView& region;
    uint32_t vertex[kMostPatch], count = 0;

    void add(uint32_t v) { vertex[count++] = v; }
    /// Neighbours that may move, of the vertices so far. Across a cut there are none.
    void add_neighbours() {
        const ShellView& shell = region.shell;
        const uint32_t inner = count;
        Ring ring;
        for (uint32_t i = 0; i < inner; ++i) {
            walk_ring(shell, vertex[i], ring);
            for (uint32_t k = 0; k < ring.count; ++k)
                for (const uint32_t v : region.state.elements.corner[shell.element(ring.element[k])])
                    if (std::find(vertex, vertex + count, v) == vertex + count && count + 1 < kMostPatch && is_free(v))
                        add(v);
        }
    }

    /// f(mass, place, velocity getter and setter) for each point.
    template <class F>
    void for_each(F&& f) const {
        RunRows& state = region.state;
        const SpringView& view = region.springs;
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t v = vertex[i], row = region.shell.vertex(v);
            const double mass = state.vertices.mass[row];
            const bool has_inner = view.has_layers();
            const Vec3d place(view.position(v));
            f(has_inner ? 0.5 * mass : mass, place, Vec3d(state.vertices.velocity[row]),
              [&](Vec3d now) { state.vertices.velocity.set(row, now.to_float()); });
            if (!has_inner) continue;
            const uint32_t twin = view.twin(v);
            f(0.5 * mass, Vec3d(view.twin_position(v)), Vec3d(state.twins.velocity[twin]),
              [&](Vec3d now) { state.twins.velocity.set(twin, now.to_float()); });
        }
    }
    Vec3d centre() const {
        double mass = 0;
        Vec3d sum;
        for_each([&](double m, Vec3d x, Vec3d, auto&&) { mass += m, sum += m * x; });
        return mass > 0 ? (1 / mass) * sum : Vec3d{};
    }
    Vec3d angular(Vec3d about) const {
        Vec3d sum;
        for_each([&](double m, Vec3d x, Vec3d v, auto&&) { sum += m * cross(x - about, v); });
        return sum;
    }
    /// In the region, and not held by the ground.
    bool is_free(uint32_t v) const {
        return !region.state.vertices.is_pinned[region.shell.vertex(v)] && (region.is_awake(v) || region.is_held(v));
    }
    bool is_free() const {
        return std::all_of(vertex, vertex + count, [&](uint32_t v) { return is_free(v); });
    }
    /// A turn about the centre that has this angular momentum.
    void give(Vec3d wanted) const {
        const Vec3d about = centre();
        Sym3d tensor;
        for_each([&](double m, Vec3d x, Vec3d, auto&&) { tensor = tensor + m * inertia_of(outer(x - about)); });
        const double scale = trace(tensor);
        if (!(determinant(tensor) > 1e-9 * scale * scale * scale)) return;
        const Vec3d spin = inverse(tensor) * wanted;
        for_each([&](double, Vec3d x, Vec3d v, auto&& set) { set(v + cross(spin, x - about)); });
    }
};

/// The inner point of w on the line between those of p and q, moving as they do. What is asleep has none so far: it
/// stands where it is at rest.
void put_twin(const RegionView& region, uint32_t p, uint32_t q, uint32_t w, float tau) {
    const SpringView& view = region.springs;
    ShellRows& state = view.state;
    Twins& twins = state.twins;
    for (const uint32_t end : {p, q}) {
        if (region.is_awake(end) || region.is_held(end)) continue;
        twins.clear_rows(view.twin(end), 1);
        view.place_twin(end, inner_rest(view, end).to_float());
    }
    const uint32_t from = view.twin(p), to = view.twin(q), row = view.twin(w);
    twins.copy_rows(twins, from, row, 1);
    twins.velocity.set(row, twins.velocity[from] + tau * (twins.velocity[to] - twins.velocity[from]));
    for (int side = 0; side < 2; ++side) {
        const Float4 a = twins.position.data(side)[from], b = twins.position.data(side)[to];
        twins.position.data(side)[row] = {a.x + tau * (b.x - a.x), a.y + tau * (b.y - a.y), a.z + tau * (b.z - a.z),
                                          -1};
    }
    twins.inverse_rest[row] = 0;  // its length at rest is to be measured
    twins.length[row] = length(view.twin_position(w) - view.position(w));
    if (!(twins.mass_share[row] > 0)) twins.mass_share[row] = 1;  // it is there; weighed when springs are rebuilt
}

/// Where an element's springs go when its edge k gets a vertex: the made element has the edge behind it, with its
/// spring, in the same turn. What is new has none yet. Returns the spring of the edge itself.
uint32_t hand_on_springs(const SpringView& view, uint32_t element, uint32_t k, uint32_t made) {
    ShellRows& state = view.state;
    auto& of_kept = state.element_springs.spring[view.edges(element)];
    auto& of_made = state.element_springs.spring[view.edges(made)];
    if (of_kept[k] == kAsleepSpring) {
        of_made = of_kept;
        return kNone;
    }
    const uint32_t next = (k + 1) % 3, split = of_kept[k], moved = of_kept[next];
    of_made = {kNone, kNone, kNone};
    of_made[next] = moved;
    of_kept[k] = of_kept[next] = kNone;
    if (moved != kNone && state.springs.element[view.spring(moved)] == element)
        state.springs.element[view.spring(moved)] = made;
    return split;
}

/// No element has the spring any more.
void drop_spring(const SpringView& view, uint32_t s) {
    if (s == kNone) return;
    Springs& springs = view.state.springs;
    const uint32_t row = view.spring(s);
    springs.element[row] = springs.a[row] = springs.b[row] = kNone;
    springs.stiffness[row] = 0;
}

}  // namespace

uint32_t put_vertex(const RegionView& region, uint32_t element, uint32_t edge, float tau, Touched& touched) {
    RunRows& state = region.state;
    const ShellView& shell = region.shell;
    const SpringView& view = region.springs;
    const auto corner = state.elements.corner[shell.element(element)];
    const uint32_t p = corner[edge], q = corner[(edge + 1) % 3];
    const uint32_t other = state.elements.neighbour[shell.element(element)][edge];
    Patch patch{region, {}, 0};
    for (const uint32_t v : corner) patch.add(v);
    if (other != kNone)
        patch.add(state.elements.corner[shell.element(other)][(edge_between(shell, other, q, p) + 2u) % 3]);
    const bool is_awake = region.is_awake(p) || region.is_awake(q), is_held = region.is_held(p) || region.is_held(q);
    const bool is_moving = is_awake || is_held, may_turn = is_moving && patch.is_free();
    if (may_turn) patch.add_neighbours();
    const Vec3d about = may_turn ? patch.centre() : Vec3d{};
    const Vec3d before = may_turn ? patch.angular(about) : Vec3d{};

    const uint32_t other_edge = other == kNone ? 3 : edge_between(shell, other, q, p);
    const uint32_t made = shell.element_count();  // the other's comes behind it
    const uint32_t w = insert_vertex(shell, element, edge, tau, touched);
    Range& edges = view.own().edges[view.row];
    for (; edges.count < shell.element_count(); ++edges.count)
        state.element_springs.spring[view.edges(edges.count)] = {kNone, kNone, kNone};
    drop_spring(view, hand_on_springs(view, element, edge, made));
    if (other != kNone) drop_spring(view, hand_on_springs(view, other, other_edge, made + 1));
    if (!is_moving) return w;
    region.add(w, !is_awake);
    if (view.has_layers()) put_twin(region, p, q, w, tau);
    patch.add(w);
    if (may_turn) patch.give(before - patch.angular(about));
    return w;
}

}  // namespace cullet
