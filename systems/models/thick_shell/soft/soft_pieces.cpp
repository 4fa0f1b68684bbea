#include "systems/models/thick_shell/soft/soft_pieces.hpp"

#include <algorithm>

#include "systems/births/part_motion.hpp"
#include "systems/models/thick_shell/soft/soft_body.hpp"
#include "systems/models/thick_shell/springs/edge_stiffness.hpp"
#include "systems/models/thick_shell/springs/give_springs.hpp"
#include "systems/models/thick_shell/springs/rebuild_springs.hpp"
#include "systems/models/thick_shell/springs/start_springs.hpp"
#include "systems/structures/shell/fragment_parts.hpp"

namespace cullet {
namespace {

/// Calls f(part, mass, place, velocity) for each point: places in the body frame, velocities along the world's axes.
template <class F>
void for_each_point(const ShellRows& s, const SpringView& view, F&& f) {
    for (uint32_t v = 0; v < view.shell.vertex_count(); ++v) {
        const uint32_t row = view.shell.vertex(v), element = s.vertices.element[row];
        if (element == kNone) continue;
        const uint32_t part = s.elements.part[view.shell.element(element)];
        const double mass = s.vertices.mass[row];
        const Vec3 rest = s.vertices.rest[row];
        if (!view.has_layers()) {
            f(part, mass, Vec3d(rest), s.vertices.velocity[row]);
            continue;
        }
        f(part, mass / 2, Vec3d(rest), s.vertices.velocity[row]);
        f(part, mass / 2, Vec3d(rest + through_at_rest(view, v)), s.twins.velocity[view.twin(v)]);
    }
}

// Edge k of the parent's element e and of the piece's c: the same spring, perhaps the other way round.
void copy_lengths(ShellRows& s, const SpringView& parent, uint32_t e, const SpringView& piece, uint32_t c, size_t k) {
    const uint32_t from = s.element_springs.spring[parent.edges(e)][k],
                   to = s.element_springs.spring[piece.edges(c)][k];
    if (from == kNone || to == kNone) return;
    const uint32_t old = parent.spring(from), made = piece.spring(to);
    s.springs.rest_length[made] = s.springs.rest_length[old];
    s.springs.plastic_length[made] = s.springs.plastic_length[old];
    s.springs.can_crack[made] = s.springs.can_crack[old];
    if (!piece.has_layers()) return;
    LayerSprings& layers = s.layer_springs;
    const uint32_t old_layer = parent.layer(from), layer = piece.layer(to);
    layers.inner_length[layer] = layers.inner_length[old_layer];
    layers.inner_plastic[layer] = layers.inner_plastic[old_layer];
    layers.mid_length[layer] = layers.mid_length[old_layer];
    layers.cross_length[layer] = layers.cross_length[old_layer];
    const bool was_along = s.springs.a[old] == s.elements.corner[parent.shell.element(e)][k];
    const bool is_along = s.springs.a[made] == s.elements.corner[piece.shell.element(c)][k];
    if (was_along != is_along) std::swap(layers.cross_length[layer][0], layers.cross_length[layer][1]);
}

bool give_piece_springs(ShellRows& s, const SpringView& parent, const FragmentPart& part, Row<Structures> shell) {
    const ShellSprings& own = s.shell_springs;
    SpringSettings settings;
    settings.layout = parent.layout();
    settings.young_modulus = own.young_modulus[parent.row];
    settings.damping_ratio = own.damping_ratio[parent.row];
    settings.length_factor = parent.has_layers() ? own.length_factor[parent.row] : 0;
    settings.area_energy = own.area_energy[parent.row];
    settings.volume_energy = own.volume_energy[parent.row];
    settings.time_step = own.time_step[parent.row];
    settings.is_slender = own.keeps_lengths[parent.row] & kIsSlender;
    const Result<Row<ShellSprings>> given = give_springs(s, shell, settings);
    if (!given) return false;
    const SpringView piece(s, *given);
    s.shell_springs.keeps_lengths[*given] |= kKeepsLengths;
    for (uint32_t e = part.first_element; e != kNone; e = s.elements.next[parent.shell.element(e)])
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t row = parent.shell.element(e), copy = s.elements.copy[row];
            copy_lengths(s, parent, e, piece, copy, k);
            if (!piece.has_layers()) continue;
            const uint32_t from = parent.twin(s.elements.corner[row][k]),
                           to = piece.twin(s.elements.corner[piece.shell.element(copy)][k]);
            s.twins.through.set(to, s.twins.through[from]);
            s.twins.inverse_rest[to] = s.twins.inverse_rest[from];
        }
    for (uint32_t i = 0; i < piece.spring_count(); ++i) measure_spring(piece, i, false);
    set_spring_step(piece, settings.time_step);
    return true;
}

}  // namespace

void soft_handoff(const SoftRows& s, Row<SoftBodies> soft, Fragments& f, Rows<Fragments> of) {
    const SpringView view(const_cast<SoftRows&>(s), springs_of(s, soft));
    const Quat back = conjugate(s.bodies.orientation[s.soft_bodies.body[soft]]);
    for_each_point(s, view, [&](uint32_t part, double mass, Vec3d place, Vec3 velocity) {
        const uint32_t row = of.first + part;
        f.moving_mass[row] += mass;
        f.centre.set(row, f.centre[row] + mass * place);
        f.momentum.set(row, f.momentum[row] + mass * Vec3d(rotate(back, velocity)));
    });
    for (const Row<Fragments> row : of)
        if (f.moving_mass[row] > 0) f.centre.set(row, (1 / f.moving_mass[row]) * f.centre[row]);
    for_each_point(s, view, [&](uint32_t part, double mass, Vec3d place, Vec3 velocity) {
        const uint32_t row = of.first + part;
        const Vec3d arm = place - f.centre[row], v(rotate(back, velocity));
        f.turning.set(row, f.turning[row] + mass * cross(arm, v));
        f.inertia[row] = f.inertia[row] + mass * inertia_of(outer(arm));
        f.radius[row] = std::max(f.radius[row], length(arm));
        f.hidden_energy[row] += mass / 2 * dot(v, v);
    });
    for (const Row<Fragments> row : of) {
        if (f.has_pins[row]) f.momentum.set(row, {});
        if (f.has_pins[row] || !(f.moving_mass[row] > 0)) continue;
        f.velocity.set(row, (1 / f.moving_mass[row]) * f.momentum[row]);
        if (can_turn(f.inertia[row])) f.spin.set(row, inverse(f.inertia[row]) * f.turning[row]);
    }
}

void give_pieces_springs(SoftRows& s, Row<SoftBodies> torn, const Break& of, const Fragments& fragments) {
    const SpringView parent(s, springs_of(s, torn));
    for (uint32_t i = 0; i < of.fragments.count; ++i) {
        const Row<Fragments> f = of.in_order(fragments, i);
        const Row<Bodies> child = fragments.child[f];
        if (!child.exists()) continue;
        if (!give_piece_springs(s, parent, part_of(fragments, f), s.bodies.structure[child])) continue;
        inherit_soft(s, torn, child);
    }
}

void keep_torn(SoftRows& s, RigidWorld& rigid, Row<SoftBodies> torn, Row<Bodies> body) {
    const SpringView view(s, springs_of(s, torn));
    drop_dead_springs(view);
    for (uint32_t v = 0; v < view.shell.vertex_count(); ++v) {
        const uint32_t row = view.shell.vertex(v);
        if (s.vertices.element[row] != kNone) continue;
        s.vertices.velocity.set(row, {});
        if (!view.has_layers()) continue;
        s.twins.velocity.set(view.twin(v), {});
        s.twins.inverse_mass[view.twin(v)] = 0;
        s.twins.mass_share[view.twin(v)] = 0;
    }
    rigid.set_soft(body, true);
}

}  // namespace cullet
