#include "systems/models/thick_shell/shared/cut_out.hpp"

#include <algorithm>

#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/shared/cut_rows.hpp"
#include "systems/models/thick_shell/shared/forget_cracks.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/shared/working_room.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "systems/structures/shell/cut_edge.hpp"
#include "systems/structures/shell/elements_at.hpp"
#include "systems/structures/shell/struck_normal.hpp"

namespace cullet {
namespace {

/// Rows that a hit should find for what cracks add; a body with fewer is copied whole, which brings new ones.
constexpr uint32_t kLeastSpare = 512;

uint32_t spare_of(const Range& range) {
    return range.capacity - range.count;
}

/// The flood from the patches, whose vertices are chained through Vertices.copy.
struct Flood {
    const ShellView& shell;
    RowBits is_found, is_queued;  // elements, vertices
    uint32_t most;                // elements
    uint32_t count = 0;
    uint32_t first = kNone, last = kNone, queued = 0;

    uint32_t& next(uint32_t v) const { return shell.state.vertices.copy[shell.vertex(v)]; }
    void add(uint32_t v) {
        if (is_queued.has(v)) return;
        is_queued.add(v);
        next(v) = kNone;
        if (last != kNone) next(last) = v;
        if (first == kNone) first = v;
        last = v;
        ++queued;
    }
};

/// What hangs together with the contacts' vertices and lies within their patches.
void add_patches(RunRows& state, Row<Tasks> task, Flood& flood) {
    TaskContacts& contacts = state.task_contacts;
    const uint32_t begin = state.tasks.first_contact[task], end = begin + state.tasks.contact_count[task];
    for (uint32_t c = begin; c < end; ++c) {
        contacts.vertex[c] = nearest_vertex(flood.shell, contacts.point[c]);
        if (contacts.vertex[c] != kNone) flood.add(contacts.vertex[c]);
    }
    const auto rest = [&](uint32_t v) { return state.vertices.rest[flood.shell.vertex(v)]; };
    const auto is_in_patch = [&](uint32_t v) {
        for (uint32_t c = begin; c < end; ++c)
            if (contacts.vertex[c] != kNone && length(rest(v) - rest(contacts.vertex[c])) < contacts.radius[c])
                return true;
        return false;
    };
    for (uint32_t at = flood.first; at != kNone; at = flood.next(at))
        for_each_element_at(flood.shell, at, [&](uint32_t e) {
            for (const uint32_t v : state.elements.corner[flood.shell.element(e)])
                if (is_in_patch(v)) flood.add(v);
        });
}

/// Rings of vertices and all elements at them. An element of the next ring lies across an edge, of one found so far,
/// with an end that is no newer than the ring: each element is looked at once, not from each of its corners. The list
/// is the queue; Vertices.copy says in which ring a vertex came. False: more elements than flood.most.
bool spread(Flood& flood, const CutOutSize& size, uint32_t* list) {
    const Elements& elements = flood.shell.state.elements;
    uint32_t* const ring_of = flood.shell.state.vertices.copy.data() + flood.shell.vertex(0);
    const auto find = [&](uint32_t e, uint32_t ring) {
        if (flood.is_found.has(e)) return;
        flood.is_found.add(e);
        list[flood.count++] = e;
        __builtin_prefetch(&elements.neighbour[flood.shell.element(e)]);  // from memory; wanted in the next ring
        for (const uint32_t v : elements.corner[flood.shell.element(e)]) {
            if (flood.is_queued.has(v)) continue;
            flood.is_queued.add(v);
            ++flood.queued;
            ring_of[v] = ring + 1;
        }
    };
    for (uint32_t v = flood.first; v != kNone;) {
        const uint32_t next = flood.next(v);
        for_each_element_at(flood.shell, v, [&](uint32_t e) { find(e, 0); });
        ring_of[v] = 0;
        v = next;
    }
    uint32_t begin = 0;  // of those that the ring before found: all elements at its vertices border on one of them
    for (uint32_t ring = 1; ring <= size.rings && flood.queued < size.vertices; ++ring) {
        const uint32_t end = flood.count;
        for (uint32_t i = begin; i < flood.count && flood.count < flood.most; ++i) {
            const uint32_t row = flood.shell.element(list[i]);
            const auto &corner = elements.corner[row], &neighbour = elements.neighbour[row];
            const bool is_at[3] = {ring_of[corner[0]] <= ring, ring_of[corner[1]] <= ring, ring_of[corner[2]] <= ring};
            for (uint32_t k = 0; k < 3; ++k)
                if (neighbour[k] != kNone && (is_at[k] || is_at[(k + 1) % 3])) find(neighbour[k], ring);
        }
        if (flood.count == end || flood.count >= flood.most) break;
        begin = end;
    }
    return flood.count < flood.most;
}

/// Of rows that are assembled anew. Slots are counted behind the bits in Elements.other_slope: the cut-out has at most
/// half of the elements, and so three halves of a vertex an element, where there are nearly three words.
void add_stiffness_room(const CutRows& rows, ShellRoom& room) {
    const ShellView& source = rows.source;
    const Elements& elements = source.state.elements;
    const bool has_grain = material_traits(source.state, source.structures().material[source.structure]).has_grain();
    uint32_t* const slots = rows.has_vertex.words + RowBits::words_of(source.vertex_count());
    std::fill_n(slots, rows.vertex_count, 0u);
    for (uint32_t e = 0; e < rows.element_count; ++e) {
        const uint32_t row = source.element(rows.list[e]);
        bool is_linked[3], has_hinge[3];
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t n = elements.neighbour[row][k];
            is_linked[k] = n != kNone && rows.has_element.has(n);
            has_hinge[k] = is_linked[k] && elements.hinge[row][k] != kNone;
        }
        for (uint32_t k = 0; k < 3; ++k)
            slots[rows.place_of(elements.corner[row][k])] +=
                slots_of_corner(!is_linked[k], has_hinge[(k + 1) % 3], has_grain);
    }
    const ShellRoom stiffness = stiffness_room(source, {slots, rows.vertex_count}, room.vertices - rows.vertex_count);
    room.blocks = stiffness.blocks, room.links = stiffness.links;
}

void copy_vertices(const CutRows& rows, const ShellView& cut) {
    Vertices& vertices = cut.state.vertices;
    // Where they are and how they move is written when the run starts.
    const void* const of_runs[] = {vertices.velocity.data(), vertices.displacement.data(), vertices.probe.data(),
                                   vertices.crush.data()};
    AnyTable* const tables[] = {&vertices};
    RowRuns runs(cut, tables, of_runs);
    uint32_t next = 0;
    CutMaps of_body(cut, rows.element_count);
    of_body.clear();
    rows.for_each_vertex([&](uint32_t v) {
        of_body.add_vertex(v);
        runs.add(rows.source.vertex(v), cut.vertex(next++));
    });
    runs.copy();
    for (uint32_t v = 0; v < rows.vertex_count; ++v) {
        uint32_t& start = vertices.crack_start[cut.vertex(v)];
        if (start != kNone) start = rows.vertex(start);
    }
}

// Quick runs have springs of their own: what the hidden run's stiffness is made of stays in the body (put_back).
void copy_elements(const CutRows& rows, const ShellView& cut, bool with_stiffness) {
    ShellRows& state = cut.state;
    Elements& elements = state.elements;
    AnyTable* const tables[] = {&elements, &state.triangle_springs};
    const void* const of_lists[] = {elements.part.data()};  // which of the body it is
    RowRuns runs(cut, std::span(tables).first(with_stiffness ? 2 : 1), of_lists);
    for (uint32_t e = 0; e < rows.element_count; ++e) runs.add(rows.source.element(rows.list[e]), cut.element(e));
    runs.copy();
    for (uint32_t e = 0; e < rows.element_count; ++e) {
        const uint32_t row = cut.element(e);
        elements.part[row] = rows.list[e];
        for (uint32_t k = 0; k < 3; ++k) {
            elements.corner[row][k] = rows.place_of(elements.corner[row][k]);
            state.vertices.element[cut.vertex(elements.corner[row][k])] = e;
            uint32_t& n = elements.neighbour[row][k];
            if (n != kNone) {
                n = rows.element(n);
                if (n == kNone) elements.edge_kind[row][k] = static_cast<uint8_t>(EdgeKind::Border);
            }
            if (n == kNone) elements.hinge[row][k] = kNone;
        }
    }
}

void copy_hinges(const CutRows& rows, const ShellView& cut, bool with_stiffness) {
    ShellRows& state = cut.state;
    Elements& elements = state.elements;
    Hinges& hinges = state.hinges;
    AnyTable* const tables[] = {&hinges};
    const void* const of_stiffness[] = {hinges.gradient.data(), hinges.stiffness.data(), hinges.scale.data()};
    RowRuns runs(cut, tables, std::span(of_stiffness).first(with_stiffness ? 0 : 3));
    uint32_t next = 0;
    CutMaps of_body(cut, rows.element_count);
    // Elements name the body's hinges until both that have one name it as the cut-out does.
    for (uint32_t e = 0; e < rows.element_count; ++e) {
        const uint32_t row = cut.element(e);
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t other = elements.neighbour[row][k], hinge = elements.hinge[row][k];
            if (other == kNone || other < e || hinge == kNone) continue;
            const auto& corner = elements.corner[row];
            const uint8_t j = edge_between(cut, other, corner[(k + 1) % 3], corner[k]);
            elements.hinge[row][k] = next;
            if (j < 3) elements.hinge[cut.element(other)][j] = next;
            of_body.add_hinge(hinge);
            runs.add(rows.source.hinge(hinge), cut.hinge(next++));
        }
    }
    CULLET_ASSERT(next == rows.hinge_count, "%u hinges of a cut-out, %u were counted", next, rows.hinge_count);
    runs.copy();
    for (uint32_t h = 0; h < next; ++h)
        for (uint32_t& v : state.hinges.vertex[cut.hinge(h)])
            if (v != kNone) v = rows.vertex(v);
}

// The body's rows that the cut-out's first `count` elements, which name them in Elements.part, are copies of.
void number_again(CutRows& rows, const ShellView& cut, uint32_t count) {
    std::copy_n(cut.state.elements.part.data() + cut.elements().first, count, rows.list);
    rows.mark_and_number(count);
}

}  // namespace

bool is_for_cut_outs(const ShellRows& state, Row<Structures> shell, bool is_quick) {
    if (state.shells.vertices[state.shell_of(shell)].count <= (is_quick ? kWholeCopyVertices : kWholeHiddenVertices))
        return false;
    return material_traits(state, state.structures.material[shell]).fracture != FractureKind::Large;
}

bool may_cut_out(const BodyRows& state, Row<Bodies> body) {
    const Row<Structures> shell = state.bodies.structure[body];
    if (!is_for_cut_outs(state, shell, is_quick_body(state, body)) || state.structures.users[shell] != 1) return false;
    const ShellView view(const_cast<BodyRows&>(state), shell);
    return CutRows::has_room(view) && spare_of(view.vertices()) >= kLeastSpare &&
           spare_of(view.elements()) >= 2 * kLeastSpare && spare_of(view.hinges()) >= 3 * kLeastSpare;
}

CutOutResult reserve_cut_out(RunRows& state, Row<Tasks> task, const CutOutSize& size, const char** full) {
    const ShellView source(state, state.tasks.source[task]);
    CutRows rows(source);
    Flood flood{source, rows.has_element, rows.has_vertex, source.element_count() / 2};
    flood.is_found.clear(source.element_count());
    flood.is_queued.clear(source.vertex_count());
    add_patches(state, task, flood);
    if (!spread(flood, size, rows.list) || flood.count == 0) return CutOutResult::TooWide;
    uint32_t listed = 0;
    flood.is_found.for_each(source.element_count(), [&](uint32_t e) { rows.list[listed++] = e; });
    rows.number(flood.count);
    rows.count_hinges();
    const Range vertices = source.vertices(), elements = source.elements(), hinges = source.hinges();
    const bool is_quick = is_quick_task(state, task);
    const Row<Materials> material = state.structures.material[source.structure];
    ShellRoom room = is_quick ? quick_room(state, material, rows.vertex_count, rows.element_count, rows.hinge_count)
                              : hidden_room(state, material, rows.vertex_count, rows.element_count, rows.hinge_count);
    // What is added must find room in the body's shell, too.
    room.vertices = std::min(room.vertices, round_to_packs(rows.vertex_count) + spare_of(vertices));
    room.elements = std::min(room.elements, rows.element_count + spare_of(elements));
    room.hinges = std::min(room.hinges, rows.hinge_count + spare_of(hinges));
    if (is_quick)
        room.cells = state.structures.cells[source.structure].count;
    else
        add_stiffness_room(rows, room);
    const Row<Structures> cut = make_shell_unclear(state, room, full);
    if (!cut.exists()) return CutOutResult::NoRoom;
    state.tasks.working[task] = cut;
    state.hidden_runs.cut_elements[task] = rows.element_count;
    const ShellView made(state, cut);
    made.vertices().count = rows.vertex_count;
    made.elements().count = rows.element_count;
    made.hinges().count = rows.hinge_count;
    return CutOutResult::Reserved;
}

void list_cut_out(RunRows& state, Row<Tasks> task) {
    const ShellView source(state, state.tasks.source[task]), cut(state, state.tasks.working[task]);
    CutRows rows(source);
    number_again(rows, cut, state.hidden_runs.cut_elements[task]);
    rows.count_hinges();
    cut.vertices().count = rows.vertex_count;
    cut.elements().count = rows.element_count;
    cut.hinges().count = rows.hinge_count;
}

void remember_cut_out(RunRows& state, Row<Tasks> task) {
    const ShellView source(state, state.tasks.source[task]), cut(state, state.tasks.working[task]);
    CutRows rows(source);
    number_again(rows, cut, state.hidden_runs.cut_elements[task]);
    CutMaps of_body(cut, rows.element_count);
    of_body.clear();
    rows.for_each_vertex([&](uint32_t v) { of_body.add_vertex(v); });
    rows.for_each_hinge([&](uint32_t h) { of_body.add_hinge(h); });
}

void fill_cut_out(RunRows& state, Row<Tasks> task) {
    const ShellView source(state, state.tasks.source[task]), cut(state, state.tasks.working[task]);
    const CutRows rows(source, cut);
    copy_values(state, state, source.structure, cut.structure);
    Range& cells = cut.cells();
    cells.count = cells.capacity > 0 ? source.cells().count : 0;  // the number says how stiffness is stored
    state.shells.sorted_elements[cut.row] = state.shells.dead_elements[cut.row] = 0;
    state.structures.live_elements[cut.structure] = cut.element_count();
    state.cells.copy_rows(state.cells, source.cells().first, cells.first, cells.count);
    copy_vertices(rows, cut);
    const bool is_quick = is_quick_task(state, task);
    copy_elements(rows, cut, !is_quick);
    copy_hinges(rows, cut, !is_quick);
    clear_pack_ends(state, cut.structure);
    // What cracks add has packs of its own.
    cut.vertices().count = round_to_packs(rows.vertex_count);
    forget_cracks(cut, state.structures.generation[source.structure] > 0);
}

}  // namespace cullet
