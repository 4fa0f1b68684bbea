#include "systems/structures/shell/waiting_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "systems/structures/shell/fragment_parts.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/structures/shell/part_vertices.hpp"
#include "systems/structures/shell/vertex_sums.hpp"

namespace cullet {
namespace {

bool is_moving(Vec3 v) {
    return v.x != 0 || v.y != 0 || v.z != 0;
}

/// Of moving vertices, about the body frame's origin.
struct Sums {
    Moments moments;
    Vec3d momentum, turning;
    double energy = 0;

    void add(double mass, Vec3d p, Vec3d v) {
        moments.mass += mass;
        moments.first += mass * p;
        moments.second = moments.second + mass * outer(p);
        momentum += mass * v;
        turning += mass * cross(p, v);
        energy += 0.5 * mass * dot(v, v);
    }
};

Vec3d spin_by(const Sym3d& inertia, Vec3d turning) {
    const double scale = trace(inertia);
    return determinant(inertia) > 1e-12 * scale * scale * scale ? inverse(inertia) * turning : Vec3d{};
}

}  // namespace

void forget_own_motions(ShellView shell) {
    ShellRows& state = shell.state;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) state.vertices.velocity.set(shell.vertex(v), {});
    for (uint32_t b = 0; b < block_count(shell); ++b) state.vertex_blocks.moves[block_row(shell, b)] = 0;
}

void keep_own_motion(ShellView shell, const Fragments& fragments, Row<Fragments> of) {
    Vertices& vertices = shell.state.vertices;
    const Vec3d centre = fragments.centre[of], velocity = fragments.velocity[of], spin = fragments.spin[of];
    for_each_vertex_of(shell, part_of(fragments, of), [&](uint32_t row) {
        const Vec3d arm = Vec3d(vertices.rest[row]) - centre;
        vertices.velocity.set(row, (velocity + cross(spin, arm)).to_float());
    });
}

void subtract_motion(ShellView shell, const Fragments& fragments, Row<Fragments> of_body) {
    Vertices& vertices = shell.state.vertices;
    const Vec3d centre = fragments.centre[of_body], velocity = fragments.velocity[of_body],
                spin = fragments.spin[of_body];
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        if (!is_moving(vertices.velocity[row])) continue;
        const Vec3d arm = Vec3d(vertices.rest[row]) - centre;
        const Vec3d common = fragments.has_pins[of_body] ? Vec3d{} : velocity + cross(spin, arm);
        vertices.velocity.set(row, (Vec3d(vertices.velocity[row]) - common).to_float());
    }
}

void take_own_motions(ShellView shell, Fragments& f, Rows<Fragments> of) {
    Vertices& vertices = shell.state.vertices;
    Vec3d momentum, turning;  // of the pieces, the latter about the body frame's origin
    for (const Row<Fragments> row : of) {
        Sums sums;
        for_each_vertex_of(shell, part_of(f, row), [&](uint32_t v) {
            if (is_moving(vertices.velocity[v]))
                sums.add(vertices.mass[v], Vec3d(vertices.rest[v]), Vec3d(vertices.velocity[v]));
            vertices.velocity.set(v, {});
        });
        if (!(sums.moments.mass > 0) || f.has_pins[row]) continue;
        const MassProperties own = mass_properties(sums.moments);
        const Vec3d spin = spin_by(own.inertia, sums.turning - cross(own.centre, sums.momentum));
        const Vec3d centre = f.centre[row];
        const Vec3d velocity = (1 / own.mass) * sums.momentum + cross(spin, centre - own.centre);
        f.spin.set(row, f.spin[row] + spin);
        f.velocity.set(row, f.velocity[row] + velocity);
        momentum += f.moving_mass[row] * velocity;
        turning += f.inertia[row] * spin + f.moving_mass[row] * cross(centre, velocity);
    }
    const Row<Fragments> rest = heaviest_of(f, of);
    if (!f.has_pins[rest] && f.moving_mass[rest] > 0) {
        f.velocity.set(rest, f.velocity[rest] + (-1 / f.moving_mass[rest]) * momentum);
        f.spin.set(rest, f.spin[rest] + spin_by(f.inertia[rest], cross(f.centre[rest], momentum) - turning));
    }
    for (const Row<Fragments> row : of)
        if (!f.has_pins[row]) f.momentum.set(row, f.moving_mass[row] * f.velocity[row]);
}

double waiting_energy(const BodyRows& state, Row<Bodies> body) {
    const Bodies& bodies = state.bodies;
    const Row<Structures> shell = bodies.structure[body];
    if (bodies.is_owed_births[body] == 0 || !shell.exists()) return 0;
    const Vertices& vertices = state.vertices;
    const Range range = state.shells.vertices[state.shell_of(shell)];
    Sums sums;
    for (uint32_t row = range.first; row < range.first + range.count; ++row)
        if (vertices.element[row] != kNone && is_moving(vertices.velocity[row]))
            sums.add(vertices.mass[row], Vec3d(vertices.rest[row]), Vec3d(vertices.velocity[row]));
    if (!(sums.energy > 0) || static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Static) return sums.energy;
    const MassProperties whole{bodies.mass[body], bodies.centre[body], bodies.inertia[body]};
    const MassProperties rest = mass_properties(moments_of(whole) - sums.moments);
    if (!(rest.mass > 0)) return sums.energy;
    const Vec3d turning = cross(rest.centre, sums.momentum) - sums.turning;
    return sums.energy + 0.5 * (dot(sums.momentum, sums.momentum) / rest.mass +
                                std::max(0.0, dot(spin_by(rest.inertia, turning), turning)));
}

double limit_waiting(BodyRows& state, Row<Bodies> body, double allowed) {
    const double energy = waiting_energy(state, body);
    if (!(energy > allowed)) return energy;
    const auto share = static_cast<float>(std::sqrt(std::max(0.0, allowed) / energy));
    Vertices& vertices = state.vertices;
    const Range range = state.shells.vertices[state.shell_of(state.bodies.structure[body])];
    for (uint32_t row = range.first; row < range.first + range.count; ++row)
        vertices.velocity.set(row, share * vertices.velocity[row]);
    return std::max(0.0, allowed);
}

}  // namespace cullet
