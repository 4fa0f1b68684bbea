#include "systems/structures/shell/rigid_handoff.hpp"

#include <algorithm>

#include "systems/structures/shell/fragment_parts.hpp"
#include "systems/structures/shell/group_fragments.hpp"
#include "systems/structures/shell/part_vertices.hpp"
#include "systems/structures/shell/vertex_sums.hpp"

namespace cullet {
namespace {

/// What is summed of one fragment.
struct PartSums {
    double mass = 0;
    Vec3d centre;  // times the mass, until it is divided
    Sym3d inertia;
    double radius = 0;
    Vec3d momentum, turning;
    double energy = 0;
};

/// Calls visit(row, sums) for each live vertex of a described part, in stored order.
template <class Visit>
void for_each_vertex(const ShellView& shell, std::span<PartSums> sums, Visit visit) {
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v), element = shell.state.vertices.element[row];
        if (element == kNone) continue;
        const uint32_t part = shell.state.elements.part[shell.element(element)];
        if (part < sums.size()) visit(row, sums[part]);
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

void add_linear(const VertexVelocity& velocity, uint32_t row, PartSums& sums) {
    const Vertices& vertices = velocity.state.vertices;
    const double mass = vertices.mass[row];
    const Vec3d v = velocity[row];
    sums.mass += mass;
    sums.centre += mass * Vec3d(vertices.rest[row]);
    sums.momentum += mass * v;
    sums.energy += mass / 2 * dot(v, v);
}

void find_centre(PartSums& sums) {
    if (sums.mass > 0) sums.centre = (1 / sums.mass) * sums.centre;
}

void add_angular(const VertexVelocity& velocity, uint32_t row, PartSums& sums) {
    const Vertices& vertices = velocity.state.vertices;
    const double mass = vertices.mass[row];
    const Vec3d arm = Vec3d(vertices.rest[row]) - sums.centre;
    sums.turning += mass * cross(arm, velocity[row]);
    sums.inertia = sums.inertia + mass * inertia_of(outer(arm));
    sums.radius = std::max(sums.radius, length(arm));
}

void write_sums(Fragments& fragments, uint32_t row, const PartSums& sums) {
    fragments.moving_mass[row] = sums.mass;
    fragments.centre.set(row, sums.centre);
    fragments.inertia[row] = sums.inertia;
    fragments.radius[row] = sums.radius;
    fragments.momentum.set(row, sums.momentum);
    fragments.turning.set(row, sums.turning);
    fragments.hidden_energy[row] = sums.energy;
}

/// Where all parts are listed. Side by side, since vertices of all parts come in turn.
void sum_all(const ShellView& shell, const VertexVelocity& velocity, Fragments& fragments, Rows<Fragments> of) {
    const ScratchArray<PartSums> sums(shell.state.scratch, of.count);
    for_each_vertex(shell, sums.all(), [&](uint32_t row, PartSums& s) { add_linear(velocity, row, s); });
    for (PartSums& s : sums.all()) find_centre(s);
    for_each_vertex(shell, sums.all(), [&](uint32_t row, PartSums& s) { add_angular(velocity, row, s); });
    for (const Row<Fragments> f : of) write_sums(fragments, f, sums[f - of.first]);
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

/// Of vertices that move as one rigid body does: u = a + w x p with a = v - w x c. So sum m u = m a + w x S and sum m p
/// x u = S x a + J w, where S = sum m p and J is the inertia about the origin.
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
void subtract_listed(const ShellView& shell, const VertexVelocity& velocity, const Fragments& fragments,
                     Rows<Fragments> of, MotionSums& rest) {
    const Vertices& vertices = shell.state.vertices;
    MotionSums left;
    for (const Row<Fragments> f : of) {
        const FragmentPart part = part_of(fragments, f);
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

/// Where what is left of a body is not listed. Its radius counts the vertices of the pieces, too: they lie on the body
/// that it was.
void sum_pieces(const ShellView& shell, const VertexVelocity& velocity, Fragments& fragments, Rows<Fragments> of) {
    MotionSums rest = sums_of_all(shell, velocity);
    subtract_listed(shell, velocity, fragments, of, rest);
    for (const Row<Fragments> f : of) {
        const FragmentPart part = part_of(fragments, f);
        PartSums sums;
        if (is_listed(part)) {
            for_each_vertex_of(shell, part, [&](uint32_t row) { add_linear(velocity, row, sums); });
            find_centre(sums);
            for_each_vertex_of(shell, part, [&](uint32_t row) { add_angular(velocity, row, sums); });
        } else {
            sums.mass = rest.mass;
            sums.momentum = rest.momentum;
            sums.energy = rest.energy;
        }
        if (!is_listed(part) && rest.mass > 0) {
            sums.centre = (1 / rest.mass) * rest.first;
            sums.turning = rest.turning - cross(sums.centre, rest.momentum);
            sums.inertia = inertia_of(rest.second - rest.mass * outer(sums.centre));
            sums.radius = farthest_from(shell, sums.centre.to_float());
        }
        write_sums(fragments, f, sums);
    }
}

}  // namespace

void sum_momenta(ShellView shell, Fragments& fragments, Rows<Fragments> of, const std::optional<RestMotion>& rest) {
    const VertexVelocity velocity{shell.state, rest};
    bool are_listed = true;
    for (const Row<Fragments> f : of) are_listed = are_listed && is_listed(part_of(fragments, f));
    if (are_listed)
        sum_all(shell, velocity, fragments, of);
    else
        sum_pieces(shell, velocity, fragments, of);
}

HandoffReport rigid_handoff(ShellView shell, const HandoffStart& start, std::span<const FragmentPart> parts,
                            Fragments& fragments, Touches& touches, const std::optional<RestMotion>& rest) {
    fragments.truncate(0);
    const Rows<Fragments> of = append_parts(fragments, parts);
    CULLET_ASSERT(of.count == parts.size(), "no room for %zu fragments", parts.size());
    sum_momenta(shell, fragments, of, rest);
    return settle_momenta(fragments, of, touches, start, shell.state.scratch);
}

}  // namespace cullet
