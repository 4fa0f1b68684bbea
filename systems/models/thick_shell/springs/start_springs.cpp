#include "systems/models/thick_shell/springs/start_springs.hpp"

#include <algorithm>

#include "systems/models/thick_shell/springs/best_turn.hpp"
#include "systems/models/thick_shell/springs/spring_lists.hpp"

namespace cullet {
namespace {

bool is_live(const SpringView& view, uint32_t v) {
    return view.state.vertices.mass[view.shell.vertex(v)] > 0;
}

/// Where the vertex stands in the body frame.
Vec3 shape(const SpringView& view, uint32_t v) {
    const uint32_t row = view.shell.vertex(v);
    return view.state.vertices.rest[row] + view.state.vertices.displacement[row];
}
Vec3 inner_shape(const SpringView& view, uint32_t v) {
    return shape(view, v) + through_at_rest(view, v);
}

struct Centres {
    double mass = 0;
    Vec3d shape, rest, now;
};

/// Calls f(mass, rest place, place now, velocity) for each point of both layers.
template <class F>
void for_each_point(const SpringView& view, F&& f) {
    const ShellRows& s = view.state;
    for (uint32_t v = 0; v < view.shell.vertex_count(); ++v) {
        if (!is_live(view, v)) continue;
        const uint32_t row = view.shell.vertex(v);
        const double mass = s.vertices.mass[row];
        if (!view.has_layers()) {
            f(mass, Vec3d(s.vertices.rest[row]), Vec3d(view.position(v)), Vec3d(s.vertices.velocity[row]));
            continue;
        }
        f(mass / 2, Vec3d(s.vertices.rest[row]), Vec3d(view.position(v)), Vec3d(s.vertices.velocity[row]));
        f(mass / 2, Vec3d(s.vertices.rest[row] + through_at_rest(view, v)), Vec3d(view.twin_position(v)),
          Vec3d(s.twins.velocity[view.twin(v)]));
    }
}

Centres centres_of(const SpringView& view) {
    Centres c;
    for_each_point(view, [&](double m, Vec3d rest, Vec3d now, Vec3d) {
        c.mass += m;
        c.rest += m * rest;
        c.now += m * now;
    });
    if (c.mass > 0) c.rest = (1 / c.mass) * c.rest, c.now = (1 / c.mass) * c.now;
    return c;
}

/// Of the shape that the springs start from: of the vertices' masses, as the hidden run has it.
Vec3d start_centre(const SpringView& view) {
    double mass = 0;
    Vec3d sum;
    for (uint32_t v = 0; v < view.shell.vertex_count(); ++v) {
        if (!is_live(view, v)) continue;
        const double m = view.state.vertices.mass[view.shell.vertex(v)];
        const Vec3d middle =
            view.has_layers() ? 0.5 * (Vec3d(shape(view, v)) + Vec3d(inner_shape(view, v))) : Vec3d(shape(view, v));
        mass += m;
        sum += m * middle;
    }
    return mass > 0 ? (1 / mass) * sum : Vec3d{};
}

Sym3d tensor_about(const SpringView& view, Vec3d centre) {
    Sym3d second;
    for_each_point(view, [&](double m, Vec3d, Vec3d now, Vec3d) { second = second + m * outer(now - centre); });
    return inertia_of(second);
}

/// I^-1 L; across the line where all points lie on one (u: I = t/2 (1 - u u^T) has no inverse, and nothing turns about
/// u), 0 of a single point.
Vec3d spin_of(Sym3d inertia, Vec3d angular) {
    const double scale = trace(inertia);
    if (!(scale > 0)) return {};
    if (determinant(inertia) > 1e-12 * scale * scale * scale) return inverse(inertia) * angular;
    const Sym3d second = 0.5 * scale * Sym3d{1, 1, 1, 0, 0, 0} - inertia;  // t/2 u u^T: any column of it is along u
    Vec3d along(second.xx, second.xy, second.xz);
    if (second.yy > along.x) along = {second.xy, second.yy, second.yz};
    if (second.zz > std::max(second.xx, second.yy)) along = {second.xz, second.yz, second.zz};
    along = normalised(along);
    return (2 / scale) * (angular - dot(angular, along) * along);
}

}  // namespace

Vec3 through_at_rest(const SpringView& view, uint32_t v) {
    const Vec3 through = view.state.twins.through[view.twin(v)];
    if (dot(through, through) > 0) return through;
    const uint32_t row = view.shell.vertex(v);
    const float reach = view.own().length_factor[view.row] * view.state.vertices.depth[row];
    return reach * view.state.vertices.inward[row];
}

void start_springs(const SpringView& view, const RigidMotion& motion) {
    ShellRows& state = view.state;
    view.own().origin.set(view.row, motion.pose.position);
    view.own().steps[view.row] = 0;
    const Vec3 centre = start_centre(view).to_float();
    const auto turned = [&](Vec3 p) { return rotate(motion.pose.orientation, p); };
    for (uint32_t v = 0; v < view.shell.vertex_count(); ++v) {
        const uint32_t row = view.shell.vertex(v);
        const auto speed = [&](Vec3 p, float inverse_mass) {
            return inverse_mass > 0 ? motion.velocity + cross(motion.spin, turned(p - centre)) : Vec3{};
        };
        view.place(v, turned(shape(view, v)));
        state.vertices.velocity.set(row, speed(shape(view, v), state.vertices.inverse_mass[row]));
        if (!view.has_layers()) continue;
        const Vec3 inner = inner_shape(view, v);
        view.place_twin(v, turned(inner));
        state.twins.velocity.set(view.twin(v), speed(inner, state.twins.inverse_mass[view.twin(v)]));
    }
    measure_lengths(view);
}

SpringMotion motion_of(const SpringView& view) {
    SpringMotion motion;
    const Centres c = centres_of(view);
    motion.mass = c.mass;
    motion.centre = c.now;
    for_each_point(view, [&](double m, Vec3d, Vec3d now, Vec3d velocity) {
        motion.momentum += m * velocity;
        motion.angular += m * cross(now - c.now, velocity);
        motion.kinetic += 0.5 * m * dot(velocity, velocity);
    });
    return motion;
}

RigidMotion stop_springs(const SpringView& view) {
    ShellRows& state = view.state;
    const Centres c = centres_of(view);
    double products[3][3] = {};
    for_each_point(view, [&](double m, Vec3d rest, Vec3d now, Vec3d) {
        const Vec3d r = rest - c.rest, x = now - c.now;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) products[i][j] += m * r[i] * x[j];
    });
    const SpringMotion moving = motion_of(view);
    RigidMotion motion;
    motion.pose.orientation = best_turn(products);
    const Vec3 middle = rotate(motion.pose.orientation, c.rest.to_float());
    motion.pose.position = view.own().origin[view.row] + c.now.to_float() - middle;
    motion.velocity = (moving.mass > 0 ? (1 / moving.mass) * moving.momentum : Vec3d{}).to_float();
    motion.spin = spin_of(tensor_about(view, c.now), moving.angular).to_float();
    for (uint32_t v = 0; v < view.shell.vertex_count(); ++v) {
        const uint32_t row = view.shell.vertex(v);
        const Vec3 body = rotate(conjugate(motion.pose.orientation), view.position(v) - c.now.to_float());
        state.vertices.displacement.set(row, body + c.rest.to_float() - state.vertices.rest[row]);
        state.vertices.velocity.set(row, {});
        if (!view.has_layers()) continue;
        state.twins.velocity.set(view.twin(v), {});
        state.twins.through.set(view.twin(v),
                                rotate(conjugate(motion.pose.orientation), view.twin_position(v) - view.position(v)));
    }
    return motion;
}

namespace {

/// Both points of a vertex on one side of the positions; the inner one means nothing without layers.
struct Points {
    Vec3d outer, inner;
};

Points points_of(const SpringView& view, uint32_t v, int side) {
    const auto place = [](const Float4& p) { return Vec3d(Vec3{p.x, p.y, p.z}); };
    return {place(view.state.vertices.probe.get(view.shell.vertex(v), side)),
            view.has_layers() ? place(view.state.twins.position.get(view.twin(v), side)) : Vec3d{}};
}

// Of each spring half of its stiffness times what it is longer now and on the other side of the positions.
double energy_between(const SpringView& view, int now, int then) {
    const ShellRows& s = view.state;
    double sum = 0;
    const auto longer = [](Vec3d a, Vec3d b, double rest) { return length(b - a) - rest; };
    for (uint32_t i = 0; i < view.spring_count(); ++i) {
        const uint32_t row = view.spring(i);
        if (s.springs.a[row] == kNone) continue;
        const auto both = [&](double stiffness, auto&& elongation) {
            const auto at = [&](int side) {
                return elongation(points_of(view, s.springs.a[row], side), points_of(view, s.springs.b[row], side));
            };
            const double e = at(now);
            sum += 0.5 * stiffness * e * (now == then ? e : at(then));
        };
        both(s.springs.stiffness[row],
             [&](const Points& a, const Points& b) { return longer(a.outer, b.outer, s.springs.plastic_length[row]); });
        if (!view.has_layers()) continue;
        const LayerSprings& layers = s.layer_springs;
        const uint32_t layer = view.layer(i);
        const auto flowed = [](double length, double rest) { return rest > 0 ? length / rest : 1; };
        const double flow = 0.5 * (flowed(s.springs.plastic_length[row], s.springs.rest_length[row]) +
                                   flowed(layers.inner_plastic[layer], layers.inner_length[layer]));
        both(layers.inner_stiffness[layer],
             [&](const Points& a, const Points& b) { return longer(a.inner, b.inner, layers.inner_plastic[layer]); });
        const double first = flow * layers.cross_length[layer][0], second = flow * layers.cross_length[layer][1];
        if (view.layout() == SpringLayout::Crossed) {
            both(layers.cross_stiffness[layer],
                 [&](const Points& a, const Points& b) { return longer(a.outer, b.inner, first); });
            both(layers.cross_stiffness[layer],
                 [&](const Points& a, const Points& b) { return longer(b.outer, a.inner, second); });
            continue;
        }
        both(layers.mid_stiffness[layer], [&](const Points& a, const Points& b) {
            return longer(0.5 * (a.outer + a.inner), 0.5 * (b.outer + b.inner), flow * layers.mid_length[layer]);
        });
        const double l = 0.5 * (first + second);
        if (!(l > 0)) continue;
        both(layers.cross_stiffness[layer], [&](const Points& a, const Points& b) {
            const Vec3d one = b.outer - a.inner, other = b.inner - a.outer;
            return (dot(one, one) - dot(other, other) - (second * second - first * first)) / (2 * l);
        });
    }
    if (!view.has_layers()) return sum;
    for (uint32_t v = 0; v < view.shell.vertex_count(); ++v) {
        const double inverse = s.twins.inverse_rest[view.twin(v)];
        if (!(inverse > 0)) continue;
        const auto at = [&](int side) {
            const Points points = points_of(view, v, side);
            return longer(points.outer, points.inner, 1 / inverse);
        };
        sum += 0.5 * s.twins.stiffness_rest[view.twin(v)] * inverse * at(now) * at(then);
    }
    return sum;
}

}  // namespace

double spring_energy(const SpringView& view) {
    return energy_between(view, view.side(), view.side());
}

double kept_spring_energy(const SpringView& view) {
    return energy_between(view, view.side(), 1 - view.side());
}

}  // namespace cullet
