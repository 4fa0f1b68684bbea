// The assembled stiffness: rows of blocks and links in packs of 8 vertices (thick shell note, section 10).
#include <algorithm>

#include "systems/damage/assemble.hpp"
#include "systems/damage/element_bending.hpp"
#include "systems/damage/element_stiffness.hpp"
#include "systems/damage/ring.hpp"

namespace cullet {
namespace {

constexpr uint32_t kMostNeighbours = kMostRing + 2;
constexpr uint32_t kGrainLinks = 4;  // a triangle of the ring, of materials with a grain; of others one
constexpr uint32_t kMostLinks = kGrainLinks * kMostRing;
// Free slots of a pack that had to move. Packs of the intact model have none: gaps between packs are fetched in vain by
// the processor's own prefetchers, which cost a fifth of the step where the rows come from beyond L2.
constexpr uint32_t kSpareSlots = 2;
constexpr uint32_t kNewPackSlots = 8;  // a pack of new vertices fills lane by lane

/// One vertex's share, before it is put into its lane. Summed in double over elements, then hinges, both ascending, so
/// that the pair's two blocks are transposes of each other and every way to this row gives the same bits.
struct VertexRow {
    struct Link {
        uint32_t neighbour;
        float row[3], column[3];
    };
    uint32_t block_count = 0, link_count = 0;
    uint32_t neighbour[kMostNeighbours];
    double k[kMostNeighbours][9];
    Link link[kMostLinks];

    double* block(uint32_t v) {
        uint32_t at = 0;
        while (at < block_count && neighbour[at] != v) ++at;
        if (at == block_count) {
            if (block_count == kMostNeighbours) return k[kMostNeighbours - 1];
            neighbour[block_count++] = v;
            std::fill(k[at], k[at] + 9, 0.0);
        }
        return k[at];
    }
};

void add_triangle(const ShellView& shell, const PlaneStress& stress, uint32_t element, int i, VertexRow& row) {
    const uint32_t e = shell.element(element);
    const TriangleTerms terms(shell.state.triangle_springs, e, stress);
    for (int step = 1; step < 3; ++step) {
        const int j = (i + step) % 3;
        terms.add_block(i, j, shell.state.triangle_springs.scale[e],
                        row.block(shell.state.elements.corner[e][static_cast<size_t>(j)]));
    }
}

/// Pairs of the edge's ends and of an end with a corner opposite are neighbours; the two corners opposite are a link.
void add_hinge(const ShellView& shell, uint32_t vertex, uint32_t hinge, VertexRow& row) {
    const Hinges& hinges = shell.state.hinges;
    const uint32_t h = shell.hinge(hinge);
    const auto& v = hinges.vertex[h];
    const auto& g = hinges.gradient[h];
    const double stiffness = double{hinges.stiffness[h]} * hinges.scale[h];
    uint32_t i = 0;
    while (i < 4 && v[i] != vertex) ++i;
    if (i == 4) return;
    const float* gi = &g[3 * i];
    for (uint32_t j = 0; j < 4; ++j) {
        if (j == i) continue;
        const float* gj = &g[3 * j];
        if (i + j == 5) {  // 2 and 3
            if (row.link_count == kMostRing) continue;
            VertexRow::Link& link = row.link[row.link_count++];
            link.neighbour = v[j];
            for (int k = 0; k < 3; ++k) link.row[k] = static_cast<float>(-stiffness * gi[k]), link.column[k] = gj[k];
        } else {
            double* k = row.block(v[j]);
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c) k[3 * r + c] -= stiffness * (double{gi[r]} * gj[c]);
        }
    }
}

/// The coupled bending of `element`'s hinges, seen from one vertex that they hold. Pairs of neighbours go to blocks,
/// the others are rank one and go to links: a vertex opposite an edge is held by one hinge alone.
void add_bending(const ShellView& shell, const PlaneStress& stress, uint32_t vertex, uint32_t element, VertexRow& row) {
    const BendingTerms terms(shell, stress, element);
    const State& state = shell.state;
    const auto& corner = state.elements.corner[shell.element(element)];
    const auto gradient = [&](uint32_t k, uint32_t v) {
        const uint32_t h = shell.hinge(terms.hinge[k]);
        for (size_t i = 0; i < 4; ++i)
            if (state.hinges.vertex[h][i] == v) {
                const float* g = &state.hinges.gradient[h][3 * i];
                return Vec3d(g[0], g[1], g[2]);
            }
        return Vec3d();
    };
    // The six vertices: corners, then the ones across each edge.
    uint32_t held[6] = {corner[0], corner[1], corner[2], kNone, kNone, kNone};
    for (uint32_t k = 0; k < 3; ++k) {
        if (terms.hinge[k] == kNone) continue;
        for (const uint32_t v : state.hinges.vertex[shell.hinge(terms.hinge[k])])
            if (v != corner[0] && v != corner[1] && v != corner[2]) held[3 + k] = v;
    }
    uint32_t own = 0;
    while (own < 6 && held[own] != vertex) ++own;
    if (own == 6) return;
    Vec3d push[3];  // of the vertex, for an angle of each hinge
    for (uint32_t l = 0; l < 3; ++l)
        for (uint32_t k = 0; k < 3; ++k)
            if (terms.hinge[k] != kNone && terms.hinge[l] != kNone) push[l] += terms.h[k][l] * gradient(k, vertex);
    for (uint32_t j = 0; j < 6; ++j) {
        if (j == own || held[j] == kNone) continue;
        const uint32_t out = own >= 3 ? own : j, in = own >= 3 ? j : own;  // `out` is the one across an edge, if any is
        const bool is_neighbour = in < 3 && (out < 3 || in == out - 3 || in == (out - 3 + 1) % 3);
        if (is_neighbour) {
            double* const block = row.block(held[j]);
            for (uint32_t l = 0; l < 3; ++l) {
                if (terms.hinge[l] == kNone) continue;
                const Vec3d g = gradient(l, held[j]);
                for (int r = 0; r < 3; ++r)
                    for (int c = 0; c < 3; ++c) block[3 * r + c] -= push[l][r] * g[c];
            }
            continue;
        }
        if (row.link_count == kMostLinks) continue;
        VertexRow::Link& link = row.link[row.link_count++];
        link.neighbour = held[j];
        Vec3d to, from;
        if (own >= 3) {
            to = gradient(own - 3, vertex);
            for (uint32_t l = 0; l < 3; ++l)
                if (terms.hinge[l] != kNone) from += terms.h[own - 3][l] * gradient(l, held[j]);
        } else {
            to = push[j - 3];
            from = gradient(j - 3, held[j]);
        }
        for (int k = 0; k < 3; ++k) {
            link.row[k] = static_cast<float>(-to[k]);
            link.column[k] = static_cast<float>(from[k]);
        }
    }
}

/// Of all triangles that have a hinge at the vertex: its ring's, and those across from it.
void add_all_bending(const ShellView& shell, const PlaneStress& stress, uint32_t vertex, const Ring& ring,
                     VertexRow& row) {
    for (uint32_t i = 0; i < ring.count; ++i) add_bending(shell, stress, vertex, ring.element[i], row);
    for (uint32_t i = 0; i < ring.count; ++i) {
        const uint32_t e = shell.element(ring.element[i]), k = (ring.corner[i] + 1u) % 3;
        const uint32_t across = shell.state.elements.neighbour[e][k];
        if (across != kNone && shell.state.elements.hinge[e][k] != kNone)
            add_bending(shell, stress, vertex, across, row);
    }
}

void build_row(const ShellView& shell, const PlaneStress& stress, uint32_t vertex, VertexRow& row) {
    row.block_count = row.link_count = 0;
    Ring ring;
    collect_ring(shell, vertex, ring);
    for (uint32_t i = 0; i < ring.count; ++i) add_triangle(shell, stress, ring.element[i], ring.corner[i], row);
    if (stress.has_grain) return add_all_bending(shell, stress, vertex, ring, row);
    RingHinges hinges;
    collect_hinges(shell, ring, hinges);
    for (uint32_t i = 0; i < hinges.count; ++i) add_hinge(shell, vertex, hinges.hinge[i], row);
}

bool has_grain(const ShellView& shell) {
    return material_traits(shell.state, shell.shells().material[shell.row]).has_grain();
}

/// Slots that a vertex takes, without building its row: an open ring has one neighbour more than elements.
void count_slots(const ShellView& shell, uint32_t vertex, uint32_t& blocks, uint32_t& links) {
    Ring ring;
    collect_ring(shell, vertex, ring);
    bool is_open = false;
    links = 0;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const uint32_t e = shell.element(ring.element[i]);
        is_open |= shell.state.elements.neighbour[e][ring.corner[i]] == kNone;
        links += shell.state.elements.hinge[e][(ring.corner[i] + 1u) % 3] != kNone;
    }
    blocks = ring.count + is_open;
    if (has_grain(shell)) links = kGrainLinks * ring.count;
}

void count_pack(const ShellView& shell, uint32_t pack, uint32_t& blocks, uint32_t& links) {
    blocks = links = 0;
    const uint32_t end = std::min((pack + 1) * kLanes, shell.vertex_count());
    for (uint32_t v = pack * kLanes; v < end; ++v) {
        uint32_t b = 0, l = 0;
        count_slots(shell, v, b, l);
        blocks = std::max(blocks, b), links = std::max(links, l);
    }
}

uint32_t packs_of(uint32_t vertices) {
    return (vertices + kLanes - 1) / kLanes;
}

void clear_slot(StiffnessBlock& slot, uint32_t lane, uint32_t vertex) {
    slot.neighbour[lane] = vertex;
    for (auto& k : slot.k) k[lane] = 0;
}
void clear_slot(StiffnessLink& slot, uint32_t lane, uint32_t vertex) {
    slot.neighbour[lane] = vertex;
    for (int k = 0; k < 3; ++k) slot.row[k][lane] = slot.column[k][lane] = 0;
}
void write_slot(StiffnessBlock& slot, uint32_t lane, const VertexRow& row, uint32_t i) {
    slot.neighbour[lane] = row.neighbour[i];
    for (int k = 0; k < 9; ++k) slot.k[k][lane] = static_cast<float>(row.k[i][k]);
}
void write_slot(StiffnessLink& slot, uint32_t lane, const VertexRow& row, uint32_t i) {
    slot.neighbour[lane] = row.link[i].neighbour;
    for (int k = 0; k < 3; ++k) slot.row[k][lane] = row.link[i].row[k], slot.column[k][lane] = row.link[i].column[k];
}

/// One kind of slot of one pack: where it is, how many are in use and how many it may have.
template <class Slot>
struct Slots {
    Range& range;     // of the shell
    Slot* data;       // of the table
    uint32_t& first;  // relative to the range
    uint16_t& count;
    uint16_t& capacity;

    Slot& at(uint32_t i) const { return data[range.first + first + i]; }

    /// Room for `wanted` slots, moved to the end of the range where there is not.
    bool reserve(uint32_t wanted, uint32_t spare) {
        if (wanted <= capacity) return true;
        const uint32_t room = wanted + spare;
        if (range.count + room > range.capacity) return false;
        const uint32_t from = range.first + first, to = range.first + range.count;
        std::copy(data + from, data + from + count, data + to);
        first = range.count;
        range.count += room;
        capacity = static_cast<uint16_t>(room);
        return true;
    }
    void write_lane(uint32_t pack, uint32_t lane, const VertexRow& row, uint32_t used) {
        for (; count < used; ++count)
            for (uint32_t l = 0; l < kLanes; ++l) clear_slot(at(count), l, pack * kLanes + l);
        for (uint32_t i = 0; i < count; ++i)
            if (i < used)
                write_slot(at(i), lane, row, i);
            else
                clear_slot(at(i), lane, pack * kLanes + lane);
        while (count > 0 && is_unused(pack, count - 1u)) --count;
    }
    bool is_unused(uint32_t pack, uint32_t i) const {
        for (uint32_t l = 0; l < kLanes; ++l)
            if (at(i).neighbour[l] != pack * kLanes + l) return false;
        return true;
    }
};

Slots<StiffnessBlock> block_slots(const ShellView& shell, uint32_t pack) {
    StiffnessPacks& packs = shell.state.stiffness_packs;
    const uint32_t p = shell.shells().packs[shell.row].first + pack;
    return {shell.shells().blocks[shell.row], shell.state.stiffness_blocks.block.data(), packs.first_block[p],
            packs.block_count[p], packs.block_capacity[p]};
}
Slots<StiffnessLink> link_slots(const ShellView& shell, uint32_t pack) {
    StiffnessPacks& packs = shell.state.stiffness_packs;
    const uint32_t p = shell.shells().packs[shell.row].first + pack;
    return {shell.shells().links[shell.row], shell.state.stiffness_links.link.data(), packs.first_link[p],
            packs.link_count[p], packs.link_capacity[p]};
}

bool write_row(const ShellView& shell, const PlaneStress& stress, uint32_t vertex) {
    VertexRow row;
    build_row(shell, stress, vertex, row);
    const uint32_t pack = vertex / kLanes, lane = vertex % kLanes;
    auto blocks = block_slots(shell, pack);
    auto links = link_slots(shell, pack);
    if (!blocks.reserve(row.block_count, kSpareSlots) || !links.reserve(row.link_count, kSpareSlots)) return false;
    blocks.write_lane(pack, lane, row, row.block_count);
    links.write_lane(pack, lane, row, row.link_count);
    return true;
}

/// Packs up to the one of the last vertex, with room for vertices of usual valence.
bool append_packs(const ShellView& shell) {
    Range& packs = shell.shells().packs[shell.row];
    while (packs.count < packs_of(shell.vertex_count())) {
        if (packs.count == packs.capacity) return false;
        shell.state.stiffness_packs.clear_rows(packs.first + packs.count, 1);
        const uint32_t pack = packs.count++;
        if (!block_slots(shell, pack).reserve(kNewPackSlots, 0) || !link_slots(shell, pack).reserve(kNewPackSlots, 0)) {
            --packs.count;
            return false;
        }
    }
    return true;
}

}  // namespace

// An assembled shell that was not touched since has the slots that were counted for it.
ShellRoom stiffness_room(ShellView shell, uint32_t spare_vertices) {
    const Shells& shells = shell.shells();
    ShellRoom room;
    room.vertices = shell.vertex_count() + spare_vertices;
    const uint32_t packs = packs_of(shell.vertex_count()), spare_packs = packs_of(spare_vertices) + 1;
    if (shells.packs[shell.row].count == packs) {
        room.blocks = shells.blocks[shell.row].count, room.links = shells.links[shell.row].count;
    } else {
        for (uint32_t p = 0; p < packs; ++p) {
            uint32_t blocks = 0, links = 0;
            count_pack(shell, p, blocks, links);
            room.blocks += blocks, room.links += links;
        }
    }
    const uint32_t moved = packs / 3 + 1;
    const uint32_t links_a_triangle = has_grain(shell) ? kGrainLinks : 1;
    room.blocks += (spare_packs + moved) * (kNewPackSlots + 2 * kSpareSlots);
    room.links += links_a_triangle * (spare_packs + moved) * (kNewPackSlots + 2 * kSpareSlots);
    return room;
}

bool lay_packs(ShellView shell) {
    Shells& shells = shell.shells();
    shells.packs[shell.row].count = shells.blocks[shell.row].count = shells.links[shell.row].count = 0;
    const uint32_t packs = packs_of(shell.vertex_count());
    if (packs > shells.packs[shell.row].capacity) return false;
    for (uint32_t p = 0; p < packs; ++p) {
        shell.state.stiffness_packs.clear_rows(shells.packs[shell.row].first + p, 1);
        ++shells.packs[shell.row].count;
        uint32_t blocks = 0, links = 0;
        count_pack(shell, p, blocks, links);
        if (!block_slots(shell, p).reserve(blocks, 0) || !link_slots(shell, p).reserve(links, 0)) return false;
    }
    return true;
}

bool assemble_packs(ShellView shell, uint32_t first, uint32_t end) {
    const PlaneStress stress = plane_stress(shell.state, shell.row);
    const uint32_t last = std::min(end * kLanes, shell.vertex_count());
    for (uint32_t v = first * kLanes; v < last; ++v)
        if (!write_row(shell, stress, v)) return false;
    return true;
}

bool assemble_stiffness(ShellView shell) {
    return lay_packs(shell) && assemble_packs(shell, 0, packs_of(shell.vertex_count()));
}

bool rebuild_rows(ShellView shell, std::span<const uint32_t> vertices) {
    if (!append_packs(shell)) return false;
    const PlaneStress stress = plane_stress(shell.state, shell.row);
    for (const uint32_t v : vertices)
        if (!write_row(shell, stress, v)) return false;
    return true;
}

void rename_neighbour(ShellView shell, uint32_t vertex, uint32_t from, uint32_t to) {
    const uint32_t pack = vertex / kLanes, lane = vertex % kLanes;
    if (pack >= shell.shells().packs[shell.row].count) return;  // it has no row yet
    const auto blocks = block_slots(shell, pack);
    const auto links = link_slots(shell, pack);
    for (uint32_t i = 0; i < blocks.count; ++i)
        if (blocks.at(i).neighbour[lane] == from) blocks.at(i).neighbour[lane] = to;
    for (uint32_t i = 0; i < links.count; ++i)
        if (links.at(i).neighbour[lane] == from) links.at(i).neighbour[lane] = to;
}

}  // namespace cullet
