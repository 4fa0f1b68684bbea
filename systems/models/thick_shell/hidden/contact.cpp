#include "systems/models/thick_shell/hidden/contact.hpp"

#include <algorithm>

#include "systems/bodies/coupling.hpp"
#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/stiffness/pair_cells.hpp"
#include "systems/structures/shell/near_vertices.hpp"
#include "systems/structures/shell/patch_radius.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

// Of a patch's radius: the disc that bears a blow, 0.35 h where the patch is 3 h wide. Doubled, a brick wall of 0.1 m
// bears 620 kN instead of 155 and throws a ball of 30 kg at 10 m/s back at 2.7 m/s; halved, it bears 39 kN and does
// not break at all. It goes with the patch and not with h, because on a coarse mesh, where patches are wider,
// whole bodies crack later: with 0.35 h a coarse globe of glass did not break at 30 m/s.
constexpr double kBearingRadius = 0.117;

// A striker leaves the patch within a step, somewhere between two points of it: where k dt^2 / m is kappa that gives it
// up to kappa / (4 - kappa) of its energy. At 0.3, the bound of vertices, that is 8 %, and runs end as blown up at 5;
// at half of it, 4 %.
constexpr double kStrikerShare = 2;

struct Candidate {
    double weight;
    uint32_t vertex;
};
/// Heavier first, then the lower vertex: a heap's top is then the one to give up.
bool is_before(const Candidate& a, const Candidate& b) {
    return a.weight != b.weight ? a.weight > b.weight : a.vertex < b.vertex;
}

/// A patch as it grows: at most `most` candidates, the heaviest.
struct Patch {
    uint32_t count = 0, most;
    Candidate candidate[kMostPatchVertices];

    void add(const Candidate& c) {
        if (count == most) {
            if (!is_before(c, candidate[0])) return;
            std::pop_heap(candidate, candidate + count, is_before);
            --count;
        }
        candidate[count++] = c;
        std::push_heap(candidate, candidate + count, is_before);
    }
};

void find_candidates(const ShellView& shell, uint32_t centre, double radius, Patch& patch) {
    const Vertices& vertices = shell.state.vertices;
    const uint32_t c = shell.vertex(centre);
    const Vec3 from = vertices.rest[c], inward = vertices.inward[c];
    const float reach = static_cast<float>(radius * radius);
    visit_rows_near(shell, 0, shell.vertex_count(), from, reach, [&](uint32_t v, float square) {
        const uint32_t row = shell.vertex(v);
        if (v != centre && !(dot(vertices.inward[row], inward) > 0)) return;
        patch.add({vertices.mass[row] * (1 - double{square} / (radius * radius)), v});
    });
}

/// Leaves the candidates that hang together with the ball's footprint. A ball touches little more than a point; the
/// patch is wider because the wall's thickness spreads the load, which it does through whole material only. Without
/// this a ball that has cut a plug out goes on pressing the rim of the hole, and loses another 1 m/s to it.
/// Neighbours share an edge of the fan: across a crack both sides have vertices of their own. Candidates ascend.
void keep_connected(const ShellView& shell, uint32_t centre, double footprint, Patch& patch) {
    const Vertices& vertices = shell.state.vertices;
    const Vec3 middle = vertices.rest[shell.vertex(centre)];
    uint32_t queue[kMostPatchVertices], queued = 0;
    bool is_kept[kMostPatchVertices] = {};
    const auto keep = [&](uint32_t i) {
        if (is_kept[i]) return;
        is_kept[i] = true;
        queue[queued++] = i;
    };
    for (uint32_t i = 0; i < patch.count; ++i)
        if (length(vertices.rest[shell.vertex(patch.candidate[i].vertex)] - middle) <= footprint) keep(i);
    Ring ring;
    for (uint32_t at = 0; at < queued; ++at) {
        walk_ring(shell, patch.candidate[queue[at]].vertex, ring);
        for (uint32_t e = 0; e < ring.count; ++e)
            for (const uint32_t v : shell.state.elements.corner[shell.element(ring.element[e])]) {
                const Candidate *const first = patch.candidate, *const end = first + patch.count;
                const Candidate* found =
                    std::lower_bound(first, end, v, [](const Candidate& c, uint32_t w) { return c.vertex < w; });
                if (found != end && found->vertex == v) keep(static_cast<uint32_t>(found - first));
            }
    }
    uint32_t kept = 0;
    for (uint32_t i = 0; i < patch.count; ++i)
        if (is_kept[i]) patch.candidate[kept++] = patch.candidate[i];
    patch.count = kept;
}

/// Of a whole patch; its vertices share by their weights.
struct PatchLaw {
    double stiffness, crushed_stiffness, yield_force;
};

/// k_c = min(0.15 E h, 0.3 / (dt^2 max w_i / m_i)); twice the striker's own inverse mass joins the maximum, which
/// matters for strikers lighter than a gram, and in softened quick runs for those of some ten grams. Crushed: k_c / e^2
/// within the same bound. Yield force H A s: A is the bearing disc, no wider than the striker; s is the game's scale on
/// the strength. Brick of 0.1 m: 155 kN, which a ball of 30 kg reaches at 2.1 m/s on a wall that does not give way.
/// Panes of 4 mm (40 kN) and vases of 5 mm (58 kN) break first.
PatchLaw patch_law(const ShellView& shell, const Patch& patch, double total, const TaskContacts& contacts, uint32_t c,
                   double dt, double strength_scale, double softening) {
    const ShellRows& state = shell.state;
    const uint32_t material = shell.structures().material[shell.structure];
    double mobility = kStrikerShare * contacts.striker_inverse_mass[c];
    for (uint32_t i = 0; i < patch.count; ++i)
        mobility = std::max(mobility, patch.candidate[i].weight / total *
                                          state.vertices.inverse_mass[shell.vertex(patch.candidate[i].vertex)]);
    const double h = std::max(shell.shells().thickness[shell.row], shell.shells().depth_floor[shell.row]);
    const float across = material_traits(state, Row<Materials>(material)).across_young_modulus;
    const double modulus = across > 0 ? across : state.materials.young_modulus[material];  // the face is pushed across
    const double wall = 0.15 * modulus * h / softening;
    const double most = mobility > 0 && dt > 0 ? 0.3 / (dt * dt * mobility) : 1e30;
    const double e = state.materials.restitution[material], striker_radius = contacts.striker_radius[c];
    const double disc = kBearingRadius * contacts.radius[c];
    const double bearing = striker_radius > 0 ? std::min(disc, striker_radius) : disc;
    const double yield = state.materials.crush_strength[material] * 3.14159265 * bearing * bearing * strength_scale /
                         std::sqrt(softening);
    return {std::min(wall, most), std::min(wall / (e * e), most), std::min(yield, 1e30)};
}

/// Row of `vertex` in a contact's patch, whose vertices ascend, or kNone.
uint32_t find_in_patch(const RunRows& state, uint32_t contact, uint32_t vertex) {
    const uint32_t first = state.task_contacts.first_patch[contact];
    const uint32_t* begin = state.patch_vertices.vertex.data() + first;
    const uint32_t* end = begin + state.task_contacts.patch_count[contact];
    const uint32_t* at = std::lower_bound(begin, end, vertex);
    return at != end && *at == vertex ? first + static_cast<uint32_t>(at - begin) : kNone;
}

/// A vertex of several patches takes only the largest stiffness, ties go to the earlier contact.
void keep_stiffest(RunRows& state, uint32_t first, uint32_t count) {
    PatchVertices& patches = state.patch_vertices;
    for (uint32_t c = first; c < first + count; ++c) {
        const uint32_t begin = state.task_contacts.first_patch[c];
        for (uint32_t i = begin; i < begin + state.task_contacts.patch_count[c]; ++i)
            for (uint32_t other = c + 1; other < first + count; ++other) {
                const uint32_t j = find_in_patch(state, other, patches.vertex[i]);
                if (j == kNone) continue;
                patches.stiffness[patches.stiffness[i] >= patches.stiffness[j] ? j : i] = 0;
            }
    }
}

}  // namespace

void build_patches(RunRows& state, Row<Tasks> task) {
    const ShellView shell(state, state.tasks.working[task]);
    TaskContacts& contacts = state.task_contacts;
    PatchVertices& patches = state.patch_vertices;
    const uint32_t first = state.tasks.first_contact[task];
    const uint32_t count = std::min(state.tasks.contact_count[task], kMostContacts);
    if (count == 0) return;
    uint32_t at = task * kMostPatchVertices;
    const Scratch<Patch> room(state.scratch);
    Patch& patch = *room;
    patch.most = kMostPatchVertices / count;
    for (uint32_t c = first; c < first + count; ++c) {
        const double radius = patch_radius(state.shells, shell.row, contacts.striker_radius[c]);
        contacts.radius[c] = static_cast<float>(radius);
        patch.count = 0;
        find_candidates(shell, contacts.vertex[c], radius, patch);
        std::sort(patch.candidate, patch.candidate + patch.count,
                  [](const Candidate& a, const Candidate& b) { return a.vertex < b.vertex; });
        if (contacts.striker_radius[c] > 0)
            keep_connected(shell, contacts.vertex[c], kFootprint * contacts.striker_radius[c], patch);
        double total = 0;
        for (uint32_t i = 0; i < patch.count; ++i) total += patch.candidate[i].weight;
        const PatchLaw law = patch_law(shell, patch, total, contacts, c, state.hidden_runs.time_step[task],
                                       state.tasks.strength_scale[task], softening_of(state, task));
        contacts.first_patch[c] = at;
        contacts.patch_count[c] = patch.count;
        for (uint32_t i = 0; i < patch.count; ++i, ++at) {
            const double weight = total > 0 ? patch.candidate[i].weight / total : 0;
            patches.vertex[at] = patch.candidate[i].vertex;
            patches.stiffness[at] = static_cast<float>(law.stiffness * weight);
            patches.crushed_stiffness[at] = static_cast<float>(law.crushed_stiffness * weight);
            patches.yield_force[at] = static_cast<float>(law.yield_force * weight);
            patches.force[at] = 0;
        }
    }
    keep_stiffest(state, first, count);
}

PatchSpring patch_spring(const PatchVertices& patches, uint32_t p) {
    return {patches.stiffness[p], patches.crushed_stiffness[p], patches.yield_force[p]};
}

bool contact_forces(PatchTables state, Row<Tasks> task) {
    const ShellIn<PatchTables> shell(state, state.tasks.working[task]);
    PatchVertices& patches = state.patch_vertices;
    Vertices& vertices = state.vertices;
    const TaskContacts& contacts = state.task_contacts;
    bool touches = false;
    const uint32_t first = state.tasks.first_contact[task];
    for (uint32_t c = first; c < first + state.tasks.contact_count[task]; ++c) {
        const Vec3 n = contacts.normal[c];
        const float travel = static_cast<float>(contacts.striker_travel[c]);
        const uint32_t begin = contacts.first_patch[c];
        for (uint32_t p = begin; p < begin + contacts.patch_count[c]; ++p) {
            const uint32_t row = shell.vertex(patches.vertex[p]);
            const float depth = travel - dot(n, vertices.displacement[row]);
            patches.force[p] =
                patches.stiffness[p] > 0 ? patch_spring(patches, p).force(depth, vertices.crush[row]) : 0.0f;
            touches |= patches.force[p] > 0;
        }
    }
    return touches;
}

void apply_contact(PassedTables state, Row<Tasks> task, uint32_t side) {
    const ShellIn<PassedTables> shell(state, state.tasks.working[task]);
    TaskContacts& contacts = state.task_contacts;
    Vertices& vertices = state.vertices;
    const int next = static_cast<int>(~side & 1);
    const float dt = state.hidden_runs.time_step[task], beta = state.hidden_runs.damping_time[task];
    const uint32_t first = state.tasks.first_contact[task], count = state.tasks.contact_count[task];
    double forces[kMostContacts] = {};
    for (uint32_t c = first; c < first + count; ++c) {
        const Vec3 n = contacts.normal[c];
        double& force = forces[c - first];
        const uint32_t begin = contacts.first_patch[c];
        for (uint32_t p = begin; p < begin + contacts.patch_count[c]; ++p) {
            const float f = state.patch_vertices.force[p];
            if (f == 0) continue;
            force += f;
            const uint32_t row = shell.vertex(state.patch_vertices.vertex[p]);
            const Vec3 dv = (dt * vertices.inverse_mass[row] * f) * n;
            const Vec3 du = dt * dv, dw = du + beta * dv;
            vertices.velocity.set(row, vertices.velocity[row] + dv);
            vertices.displacement.set(row, vertices.displacement[row] + du);
            Float4& w = vertices.probe.data(next)[row];
            w = {w.x + dw.x, w.y + dw.y, w.z + dw.z, 0};
        }
        contacts.striker_speed[c] -= double{dt} * contacts.striker_inverse_mass[c] * force;
        contacts.impulse[c] += double{dt} * force;
    }
    for (uint32_t c = first; c < first + count; ++c) {
        for (uint32_t other = first; other < first + count; ++other)
            if (share_a_striker(contacts, c, other))
                contacts.striker_speed[c] -= double{dt} * coupling(contacts, c, other) * forces[other - first];
        contacts.striker_travel[c] += double{dt} * contacts.striker_speed[c];
    }
}

Vec3d pin_force(ShellView shell, uint32_t side) {
    const ShellRows& state = shell.state;
    const StiffnessPacks& packs = state.stiffness_packs;
    const Float4* w = state.vertices.probe.data(static_cast<int>(side & 1)) + shell.vertices().first;
    const uint8_t* is_pinned = state.vertices.is_pinned.data() + shell.vertices().first;
    const bool once = stores_pairs_once(shell.structures(), shell.structure);
    Vec3d sum;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t p = shell.shells().packs[shell.row].first + v / kLanes, l = v % kLanes;
        const auto away = [&](uint32_t j) {
            return Vec3d(double{w[j].x} - w[v].x, double{w[j].y} - w[v].y, double{w[j].z} - w[v].z);
        };
        const auto is_other_pinned = [&](uint32_t j) { return once && is_pinned[j] && are_in_one_pair_cell(v, j); };
        for (uint32_t s = 0; s < packs.block_count[p]; ++s) {
            const StiffnessBlock& b =
                state.stiffness_blocks.block[shell.shells().blocks[shell.row].first + packs.first_block[p] + s];
            const Vec3d d = away(b.neighbour[l]);
            const auto along = [&](int i, int step) {
                return dot(Vec3d(b.k[i][l], b.k[i + step][l], b.k[i + 2 * step][l]), d);
            };
            if (is_pinned[v]) sum += {along(0, 1), along(3, 1), along(6, 1)};
            if (is_other_pinned(b.neighbour[l])) sum -= {along(0, 3), along(1, 3), along(2, 3)};
        }
        for (uint32_t s = 0; s < packs.link_count[p]; ++s) {
            const StiffnessLink& k =
                state.stiffness_links.link[shell.shells().links[shell.row].first + packs.first_link[p] + s];
            const Vec3d d = away(k.neighbour[l]), row(k.row[0][l], k.row[1][l], k.row[2][l]),
                        column(k.column[0][l], k.column[1][l], k.column[2][l]);
            if (is_pinned[v]) sum += dot(column, d) * row;
            if (is_other_pinned(k.neighbour[l])) sum -= dot(row, d) * column;
        }
    }
    return sum;
}

Vec3d momentum(ShellView shell) {
    const Vertices& vertices = shell.state.vertices;
    Vec3d sum;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        if (vertices.inverse_mass[row] > 0) sum += vertices.mass[row] * Vec3d(vertices.velocity[row]);
    }
    return sum;
}

}  // namespace cullet
