#include "systems/structures/shell/rigid_handoff.hpp"

#include <algorithm>

#include "systems/structures/shell/part_vertices.hpp"
#include "systems/structures/shell/vertex_sums.hpp"

namespace cullet {
namespace {

/// Calls visit(row, motion) for each live vertex of a described part, in stored order.
template <class Visit>
void for_each_vertex(const ShellView& shell, std::span<PartMotion> motions, Visit visit) {
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v), element = shell.state.vertices.element[row];
        if (element == kNone) continue;
        const uint32_t part = shell.state.elements.part[shell.element(element)];
        if (part < motions.size()) visit(row, motions[part]);
    }
}

/// Of the vertex in a row, body axes.
struct VertexVelocity {
    const ShellRows& state;
    const std::optional<RestMotion>& rest;

    bool is_still(uint32_t row) const { return rest && !state.vertex_blocks.moves[row / kVerticesPerBlock]; }
    Vec3d operator[](uint32_t row) const {
        if (!is_still(row)) return Vec3d(state.vertices.velocity[row]);
        return state.vertices.inverse_mass[row] > 0 ? rest->at(state.vertices.rest[row]) : Vec3d{};
    }
};

void add_linear(const VertexVelocity& velocity, uint32_t row, PartMotion& m) {
    const Vertices& vertices = velocity.state.vertices;
    const double mass = vertices.mass[row];
    const Vec3d v = velocity[row];
    m.mass += mass;
    m.centre += mass * Vec3d(vertices.rest[row]);  // divided by the mass later
    m.momentum += mass * v;
    m.hidden_energy += mass / 2 * dot(v, v);
}

void add_angular(const VertexVelocity& velocity, uint32_t row, PartMotion& m) {
    const Vertices& vertices = velocity.state.vertices;
    const double mass = vertices.mass[row];
    const Vec3d arm = Vec3d(vertices.rest[row]) - m.centre;
    m.angular_momentum += mass * cross(arm, velocity[row]);
    m.inertia = m.inertia + mass * inertia_of(outer(arm));
    m.radius = std::max(m.radius, length(arm));
}

void sum_momenta(const ShellView& shell, const VertexVelocity& velocity, std::span<PartMotion> motions) {
    for_each_vertex(shell, motions, [&](uint32_t row, PartMotion& m) { add_linear(velocity, row, m); });
    for (PartMotion& m : motions)
        if (m.mass > 0) m.centre = (1 / m.mass) * m.centre;
    for_each_vertex(shell, motions, [&](uint32_t row, PartMotion& m) { add_angular(velocity, row, m); });
}

/// Of vertices, about the body frame's origin. They add and subtract.
struct MotionSums {
    double mass = 0;
    Vec3d first, momentum, turning;  // sum of m p, m v, m p x v
    Sym3d second;                    // m p p^T
    double energy = 0;

    void add(double m, Vec3d p, Vec3d v) {
        const Vec3d impulse = m * v;
        mass += m;
        first += m * p;
        momentum += impulse;
        turning += cross(p, impulse);
        second = second + m * outer(p);
        energy += 0.5 * dot(impulse, v);
    }
    void add(const MotionSums& o) {
        mass += o.mass;
        first += o.first;
        momentum += o.momentum;
        turning += o.turning;
        second = second + o.second;
        energy += o.energy;
    }
};

/// Of vertices that move as one rigid body does: u = a + w x p with a = v - w x c, so that sum m u = m a + w x S and
/// sum m p x u = S x a + J w, where S = sum m p and J is the inertia about the origin.
MotionSums sums_of_rigid(const VertexSums& of, const RestMotion& rest) {
    const Vec3d w = rest.spin, a = rest.velocity - cross(w, rest.centre), turned = cross(w, of.first);
    const Vec3d spun = inertia_of(of.second) * w;
    MotionSums sums;
    sums.mass = of.mass;
    sums.first = of.first;
    sums.second = of.second;
    sums.momentum = of.mass * a + turned;
    sums.turning = cross(of.first, a) + spun;
    sums.energy = 0.5 * (of.mass * dot(a, a) + dot(w, spun)) + dot(a, turned);
    return sums;
}

/// Four sums side by side, so that none waits for another. Of blocks that move with the rest what they weigh is known.
MotionSums sums_of_all(const ShellView& shell, const VertexVelocity& velocity) {
    const Vertices& vertices = shell.state.vertices;
    MotionSums lane[4];
    VertexSums still;
    for (uint32_t b = 0; b < block_count(shell); ++b) {
        const uint32_t begin = b * kVerticesPerBlock, end = std::min(begin + kVerticesPerBlock, shell.vertex_count());
        if (velocity.is_still(shell.vertex(begin))) {
            const VertexSums block = block_sums(shell, b);
            if (block.pinned == 0) {
                still.mass += block.mass;
                still.first += block.first;
                still.second = still.second + block.second;
                continue;
            }
        }
        for (uint32_t v = begin; v < end; ++v) {
            const uint32_t row = shell.vertex(v);
            lane[v % 4].add(vertices.mass[row], Vec3d(vertices.rest[row]), velocity[row]);
        }
    }
    MotionSums all = lane[0];
    for (int k = 1; k < 4; ++k) all.add(lane[k]);
    if (velocity.rest) all.add(sums_of_rigid(still, *velocity.rest));
    return all;
}

/// Of a part that is not listed: all, less the listed ones.
void subtract_listed(const ShellView& shell, const VertexVelocity& velocity, std::span<const FragmentPart> parts,
                     MotionSums& rest) {
    const Vertices& vertices = shell.state.vertices;
    MotionSums left;
    for (const FragmentPart& part : parts) {
        if (!is_listed(part)) continue;
        for_each_vertex_of(
            shell, part, [&](uint32_t row) { left.add(vertices.mass[row], Vec3d(vertices.rest[row]), velocity[row]); });
    }
    rest.mass -= left.mass;
    rest.first = rest.first - left.first;
    rest.momentum = rest.momentum - left.momentum;
    rest.turning = rest.turning - left.turning;
    rest.second = rest.second - left.second;
    rest.energy -= left.energy;
}

/// Of rows [begin, end).
float farthest_of(const ShellView& shell, uint32_t begin, uint32_t end, Vec3 centre) {
    constexpr uint32_t kWide = 4;
    const Vertices& vertices = shell.state.vertices;
    const uint32_t first = shell.vertex(0);
    const float *x = vertices.rest.lane(0) + first, *y = vertices.rest.lane(1) + first,
                *z = vertices.rest.lane(2) + first;
    const uint32_t* const element = vertices.element.data() + first;
    float most[kWide] = {};
    const auto look = [&](uint32_t v, uint32_t i) {
        const float dx = x[v] - centre.x, dy = y[v] - centre.y, dz = z[v] - centre.z;
        const float square = element[v] == kNone ? 0 : dx * dx + dy * dy + dz * dz;
        most[i] = square > most[i] ? square : most[i];
    };
    uint32_t v = begin;
    for (; v + kWide <= end; v += kWide)
        for (uint32_t i = 0; i < kWide; ++i) look(v + i, i);
    for (; v < end; ++v) look(v, 0);
    return *std::max_element(most, most + kWide);
}

double farthest_from(const ShellView& shell, Vec3 centre) {
    const uint32_t count = shell.vertex_count();
    if (!keeps_vertex_sums(shell)) return std::sqrt(static_cast<double>(farthest_of(shell, 0, count, centre)));
    float most = 0;
    for (uint32_t b = 0; b < block_count(shell); ++b) {
        const double reach = reach_of_block(shell, b, centre);
        if (reach * reach < static_cast<double>(most)) continue;
        const uint32_t begin = b * kVerticesPerBlock;
        most = std::max(most, farthest_of(shell, begin, std::min(begin + kVerticesPerBlock, count), centre));
    }
    return std::sqrt(static_cast<double>(most));
}

/// What sum_momenta finds where what is left of a body is not listed. Its radius counts the vertices of the pieces,
/// too: they lie on the body that it was.
void sum_momenta_of_pieces(const ShellView& shell, const VertexVelocity& velocity, std::span<const FragmentPart> parts,
                           std::span<PartMotion> motions) {
    MotionSums rest = sums_of_all(shell, velocity);
    subtract_listed(shell, velocity, parts, rest);
    for (uint32_t p = 0; p < motions.size(); ++p) {
        PartMotion& m = motions[p];
        if (!is_listed(parts[p])) {
            m.mass = rest.mass;
            m.momentum = rest.momentum;
            m.hidden_energy = rest.energy;
            if (!(rest.mass > 0)) continue;
            m.centre = (1 / rest.mass) * rest.first;
            m.angular_momentum = rest.turning - cross(m.centre, rest.momentum);
            m.inertia = inertia_of(rest.second - rest.mass * outer(m.centre));
            m.radius = farthest_from(shell, m.centre.to_float());
            continue;
        }
        for_each_vertex_of(shell, parts[p], [&](uint32_t row) { add_linear(velocity, row, m); });
        if (m.mass > 0) m.centre = (1 / m.mass) * m.centre;
        for_each_vertex_of(shell, parts[p], [&](uint32_t row) { add_angular(velocity, row, m); });
    }
}

bool can_turn(const PartMotion& m) {
    const double scale = trace(m.inertia);
    return determinant(m.inertia) > 1e-12 * scale * scale * scale;
}

/// I^-1 L; zero for a part so thin that its inertia has no inverse in double, which only lowers the energy.
Vec3d spin_of(const PartMotion& m) {
    if (!can_turn(m)) return {};
    return inverse(m.inertia) * m.angular_momentum;
}

double energy_of(const PartMotion& m) {
    if (m.is_static || !(m.mass > 0)) return 0;
    return dot(m.momentum, m.momentum) / (2 * m.mass) + dot(m.spin, m.inertia * m.spin) / 2;
}

/// How far the motions may go towards those of `parts`: 1 as a rule, less where they have more energy than before
/// (see stop_approach). Energy is a quadratic of the share, a s^2 + 2 b s more than before.
double share_within_energy(std::span<const Touching> parts, std::span<const PartMotion> motions) {
    double a = 0, b = 0;
    for (uint32_t p = 0; p < motions.size(); ++p) {
        const PartMotion& m = motions[p];
        if (!(parts[p].inverse_mass > 0)) continue;
        const Vec3d impulse = m.mass * parts[p].velocity - m.momentum, turned = parts[p].spin - m.spin;
        a += dot(impulse, impulse) / (2 * m.mass) + dot(turned, m.inertia * turned) / 2;
        b += (dot(m.momentum, impulse) / m.mass + dot(m.spin, m.inertia * turned)) / 2;
    }
    return a + 2 * b > 0 ? std::clamp(-2 * b / a, 0.0, 1.0) : 1;
}

/// What a static part takes goes to the support.
void part_cracks(const HandoffStart& start, std::span<PartMotion> motions, HandoffReport& report) {
    const std::span<Touching> parts = start.touching.first(motions.size());
    for (uint32_t p = 0; p < motions.size(); ++p) {
        const PartMotion& m = motions[p];
        parts[p] = {m.centre, {}, m.spin, 0, {}};
        if (m.is_static || !(m.mass > 0)) continue;
        parts[p].velocity = (1 / m.mass) * m.momentum;
        parts[p].inverse_mass = 1 / m.mass;
        if (can_turn(m)) parts[p].inverse_inertia = inverse(m.inertia);
    }
    stop_approach(parts, start.touches, start.impact_speed);
    const double share = share_within_energy(parts, motions);
    double energy = 0;
    for (uint32_t p = 0; p < motions.size(); ++p) {
        PartMotion& m = motions[p];
        if (parts[p].inverse_mass > 0) {
            m.momentum += share * (m.mass * parts[p].velocity - m.momentum);
            m.spin += share * (parts[p].spin - m.spin);
        }
        m.free_momentum = m.momentum, m.free_spin = m.spin;
        energy += energy_of(m);
    }
    for (const Touch& t : start.touches) {
        if (motions[t.a].is_static) report.support_momentum += share * t.impulse;
        if (motions[t.b].is_static) report.support_momentum -= share * t.impulse;
    }
    report.energy_crushed = report.energy_unclamped - energy;
    report.energy_unclamped = energy;
}

/// Pulls the part's speed to the limit; returns the momentum that was cut off, so that the sum stays exact.
Vec3d clamp_speed(PartMotion& m, const HandoffStart& start) {
    const Vec3d before = start.velocity + cross(start.spin, m.centre - start.centre);
    const Vec3d relative = (1 / m.mass) * m.momentum - before;
    const double speed = length(relative), most = kMostRelativeSpeed * start.impact_speed;
    if (!(speed > most)) return {};
    const Vec3d kept = m.mass * (before + (most / speed) * relative);
    const Vec3d cut = m.momentum - kept;
    m.momentum = kept;
    m.is_speed_clamped = true;
    return cut;
}

Vec3d clamp_spin(PartMotion& m, const HandoffStart& start) {
    const Vec3d relative = m.spin - start.spin;
    const double rim = length(relative) * m.radius, most = kMostRelativeSpeed * start.impact_speed;
    if (!(rim > most)) return {};
    Vec3d kept = start.spin + (most / rim) * relative;
    // The body's own spin may have been the livelier one; then slow down about the part's own axis.
    if (dot(kept, m.inertia * kept) > dot(m.spin, m.inertia * m.spin))
        kept = std::min(1.0, most / (length(m.spin) * m.radius)) * m.spin;
    const Vec3d cut = m.inertia * (m.spin - kept);
    m.spin = kept;
    m.is_spin_clamped = true;
    return cut;
}

void clamp(const HandoffStart& start, std::span<PartMotion> motions, HandoffReport& report) {
    for (uint32_t p = 0; p < motions.size(); ++p) {
        PartMotion& m = motions[p];
        if (m.is_static || !(m.mass > 0)) continue;
        const Vec3d lost = clamp_spin(m, start);
        report.spin_clamp_loss += lost;
        report.spin_clamps += m.is_spin_clamped;
        if (p == report.largest) continue;
        const Vec3d cut = clamp_speed(m, start);
        report.speed_clamps += m.is_speed_clamped;
        PartMotion& largest = motions[report.largest];
        (largest.is_static ? report.support_momentum : largest.momentum) += cut;
    }
}

double energy_of_all(std::span<const PartMotion> motions) {
    double sum = 0;
    for (const PartMotion& m : motions) sum += energy_of(m);
    return sum;
}

/// All parts at `share` of the way from their free motion to the clamped one.
void go_back(std::span<PartMotion> motions, double share) {
    for (PartMotion& m : motions) {
        m.momentum = m.free_momentum + share * (m.momentum - m.free_momentum);
        m.spin = m.free_spin + share * (m.spin - m.free_spin);
    }
}

/// Energy is a quadratic of the way, E(0) <= E_hidden < E(1): the largest share of it with E <= E_hidden. Momentum is
/// the same all along.
void keep_energy(std::span<PartMotion> motions, HandoffReport& report) {
    if (!(energy_of_all(motions) > report.energy_hidden)) return;
    double a = 0, b = 0;
    for (const PartMotion& m : motions) {
        if (m.is_static || !(m.mass > 0)) continue;
        const Vec3d p = m.momentum - m.free_momentum, w = m.spin - m.free_spin;
        a += dot(p, p) / (2 * m.mass) + dot(w, m.inertia * w) / 2;
        b += dot(m.free_momentum, p) / m.mass + dot(m.free_spin, m.inertia * w);
    }
    constexpr double kRounded = 1 - 1e-9;
    const double room = std::max(report.energy_hidden - report.energy_unclamped, 0.0);
    const double share = a > 0 ? kRounded * std::clamp((std::sqrt(b * b + 4 * a * room) - b) / (2 * a), 0.0, 1.0) : 0;
    go_back(motions, share);
    report.support_momentum = report.free_support + share * (report.support_momentum - report.free_support);
    report.spin_clamp_loss = share * report.spin_clamp_loss;
    if (energy_of_all(motions) > report.energy_hidden) {
        go_back(motions, 0);
        report.support_momentum = report.free_support;
        report.spin_clamp_loss = {};
    }
}

}  // namespace

HandoffReport gather_momenta(ShellView shell, const HandoffStart& start, std::span<const FragmentPart> parts,
                             std::span<PartMotion> all_motions) {
    CULLET_ASSERT(all_motions.size() >= parts.size(), "%zu motions for %zu parts", all_motions.size(), parts.size());
    const std::span<PartMotion> motions = all_motions.first(parts.size());
    std::fill(motions.begin(), motions.end(), PartMotion{});
    const VertexVelocity velocity{shell.state, start.rest};
    if (std::all_of(parts.begin(), parts.end(), [](const FragmentPart& part) { return is_listed(part); }))
        sum_momenta(shell, velocity, motions);
    else
        sum_momenta_of_pieces(shell, velocity, parts, motions);
    HandoffReport report;
    report.largest = largest_part(parts);
    for (uint32_t p = 0; p < motions.size(); ++p) {
        PartMotion& m = motions[p];
        report.energy_hidden += m.hidden_energy;
        report.momentum_before += m.momentum;
        m.is_static = parts[p].has_pins;
        if (m.is_static) {
            report.support_momentum += m.momentum;
            m.momentum = {};
        } else {
            m.spin = spin_of(m);
        }
        m.free_momentum = m.momentum, m.free_spin = m.spin;
        report.energy_unclamped += energy_of(m);
    }
    return report;
}

void settle_momenta(const HandoffStart& start, std::span<PartMotion> motions, HandoffReport& report) {
    if (!start.touches.empty() && start.touching.size() >= motions.size()) part_cracks(start, motions, report);
    report.free_support = report.support_momentum;
    clamp(start, motions, report);
    keep_energy(motions, report);
    for (PartMotion& m : motions) {
        if (m.mass > 0) m.velocity = (1 / m.mass) * m.momentum;
        report.momentum_after += m.momentum;
        report.energy_after += energy_of(m);
    }
}

HandoffReport rigid_handoff(ShellView shell, const HandoffStart& start, std::span<const FragmentPart> parts,
                            std::span<PartMotion> motions) {
    HandoffReport report = gather_momenta(shell, start, parts, motions);
    settle_momenta(start, motions.first(parts.size()), report);
    return report;
}

}  // namespace cullet
