// The assembled stiffness: rows of blocks and links in packs of 8 vertices (thick shell note, section 10).
#include <algorithm>

#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "systems/models/thick_shell/stiffness/pair_cells.hpp"
#include "systems/models/thick_shell/stiffness/stiffness_slots.hpp"
#include "systems/structures/shell/elements_at.hpp"

namespace cullet {
namespace {

// Free slots of a pack that had to move. Packs of the intact model have none: gaps between packs are fetched in vain by
// the processor's own prefetchers, which cost a fifth of the step where the rows come from beyond L2.
constexpr uint32_t kSpareSlots = 2;
constexpr uint32_t kNewPackSlots = 8;  // a pack of new vertices fills lane by lane

bool has_grain(const ShellView& shell) {
    return material_traits(shell.state, shell.structures().material[shell.structure]).has_grain();
}

/// Slots that a vertex takes, without building its row: an open ring has one neighbour more than elements.
void count_slots(const ShellView& shell, uint32_t vertex, uint32_t& blocks, uint32_t& links) {
    uint32_t elements = 0;
    links = 0;
    const bool is_closed = for_each_element_at(shell, vertex, [&](uint32_t e) {
        ++elements;
        links += shell.state.elements.hinge[shell.element(e)][(corner_of(shell, e, vertex) + 1u) % 3] != kNone;
    });
    blocks = elements + (elements > 0 && !is_closed);
    if (has_grain(shell)) links = kGrainLinks * elements;
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

/// What count_slots finds of each vertex, in Vertices.copy: blocks, and above the lowest 16 bits links. From the
/// elements, one after another, which takes a tenth of what looking round each vertex does.
void count_all_slots(const ShellView& shell) {
    const Elements& elements = shell.state.elements;
    uint32_t* const slots = shell.state.vertices.copy.data() + shell.vertex(0);
    std::fill_n(slots, shell.vertex_count(), 0u);
    const bool is_grained = has_grain(shell);
    for (uint32_t e = shell.element(0); e < shell.element(0) + shell.element_count(); ++e) {
        if (elements.flags[e] & kDead) continue;
        for (uint32_t k = 0; k < 3; ++k) {
            slots[elements.corner[e][k]] +=
                slots_of_corner(elements.neighbour[e][k] == kNone, elements.hinge[e][(k + 1) % 3] != kNone, is_grained);
        }
    }
}

/// Of the widest of its vertices, blocks and links apart.
uint32_t slots_of_pack(std::span<const uint32_t> vertices) {
    uint32_t blocks = 0, links = 0;
    for (const uint32_t slots : vertices)
        blocks = std::max(blocks, slots & 0xffff), links = std::max(links, slots >> 16);
    return blocks | links << 16;
}

uint32_t packs_of(uint32_t vertices) {
    return (vertices + kLanes - 1) / kLanes;
}

void add_spare_slots(const ShellView& shell, uint32_t packs, uint32_t spare_packs, ShellRoom& room) {
    const uint32_t moved = packs / 3 + 1, links_a_triangle = has_grain(shell) ? kGrainLinks : 1;
    room.blocks += (spare_packs + moved) * (kNewPackSlots + 2 * kSpareSlots);
    room.links += links_a_triangle * (spare_packs + moved) * (kNewPackSlots + 2 * kSpareSlots);
}

bool write_row(const ShellView& shell, const PlaneStress& stress, uint32_t vertex, VertexRow& row) {
    row.block_count = row.link_count = 0;
    build_row(shell, stress, vertex, row);
    if (stores_pairs_once(shell.structures(), shell.structure)) drop_others_pairs(shell, vertex, row);
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
    add_spare_slots(shell, packs, spare_packs, room);
    return room;
}

ShellRoom stiffness_room(ShellView shell, std::span<const uint32_t> slots, uint32_t spare_vertices) {
    const auto vertices = static_cast<uint32_t>(slots.size());
    ShellRoom room;
    for (uint32_t v = 0; v < vertices; v += kLanes) {
        const uint32_t pack = slots_of_pack(slots.subspan(v, std::min(kLanes, vertices - v)));
        room.blocks += pack & 0xffff, room.links += pack >> 16;
    }
    add_spare_slots(shell, packs_of(vertices), packs_of(spare_vertices) + 1, room);
    return room;
}

uint32_t slots_of_corner(bool ends_ring, bool has_hinge_opposite, bool has_grain) {
    return 1u + ends_ring + ((has_grain ? kGrainLinks : has_hinge_opposite) << 16);
}

bool lay_packs(ShellView shell) {
    Shells& shells = shell.shells();
    shells.packs[shell.row].count = shells.blocks[shell.row].count = shells.links[shell.row].count = 0;
    const uint32_t packs = packs_of(shell.vertex_count());
    if (packs > shells.packs[shell.row].capacity) return false;
    if (!stores_pairs_once(shell.structures(), shell.structure)) count_all_slots(shell);
    for (uint32_t p = 0; p < packs; ++p) {
        shell.state.stiffness_packs.clear_rows(shells.packs[shell.row].first + p, 1);
        ++shells.packs[shell.row].count;
        if (stores_pairs_once(shell.structures(), shell.structure)) continue;
        const uint32_t first = p * kLanes,
                       slots = slots_of_pack({shell.state.vertices.copy.data() + shell.vertex(first),
                                              std::min(kLanes, shell.vertex_count() - first)});
        if (!block_slots(shell, p).reserve(slots & 0xffff, 0) || !link_slots(shell, p).reserve(slots >> 16, 0))
            return false;
    }
    return !stores_pairs_once(shell.structures(), shell.structure) || lay_pair_cells(shell);
}

bool assemble_packs(ShellView shell, uint32_t first, uint32_t end) {
    const PlaneStress stress = plane_stress(shell.state, shell.structure);
    const uint32_t last = std::min(end * kLanes, shell.vertex_count());
    [[maybe_unused]] const uint32_t blocks = shell.shells().blocks[shell.row].count,
                                    links = shell.shells().links[shell.row].count;
    const Scratch<VertexRow> row(shell.state.scratch);
    for (uint32_t v = first * kLanes; v < last; ++v)
        if (!write_row(shell, stress, v, *row)) return false;
    // Others may be writing other packs of the shell: none of them moves.
    CULLET_ASSERT(shell.shells().blocks[shell.row].count == blocks && shell.shells().links[shell.row].count == links,
                  "packs %u to %u of shell %u were laid too narrow", first, end, shell.row.index);
    return true;
}

bool assemble_stiffness(ShellView shell) {
    return lay_packs(shell) && assemble_packs(shell, 0, packs_of(shell.vertex_count()));
}

bool rebuild_rows(ShellView shell, std::span<const uint32_t> vertices) {
    if (!append_packs(shell)) return false;
    const PlaneStress stress = plane_stress(shell.state, shell.structure);
    const Scratch<VertexRow> row(shell.state.scratch);
    for (const uint32_t v : vertices)
        if (!write_row(shell, stress, v, *row)) return false;
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
