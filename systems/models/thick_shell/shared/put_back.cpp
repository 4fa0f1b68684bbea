// A cut-out's rows go back into the body's shell.
#include <algorithm>
#include <bit>

#include "components/body_id.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "systems/models/thick_shell/shared/cut_rows.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "systems/structures/shell/group_fragments.hpp"
#include "systems/structures/shell/ring.hpp"
#include "systems/structures/shell/vertex_sums.hpp"

namespace cullet {
namespace {

/// Rows of the cut-out as rows of the body's shell. What the run added comes behind all that the body has.
struct PutBack {
    BodyRows& state;
    const ShellView source, cut;
    CutRows rows;
    bool has_stiffness;  // of a hidden run, in the cut-out's elements and hinges
    CutMaps of_body;
    RowBits is_beside_cut;  // of the cut-out's vertices that the body has: those of touched elements

    PutBack(BodyRows& s, Row<Tasks> task)
        : state(s),
          source(s, s.tasks.source[task]),
          cut(s, s.tasks.working[task]),
          rows(source),
          has_stiffness(!is_quick_task(s, task)),
          of_body(cut, s.hidden_runs.cut_elements[task]),
          is_beside_cut{reinterpret_cast<uint32_t*>(s.elements.other_slope.data() + cut.elements().first)} {
        const uint32_t count = s.hidden_runs.cut_elements[task];
        std::copy_n(s.elements.part.data() + cut.elements().first, count, rows.list);
        rows.element_count = count;
        rows.hinge_count = of_body.hinge_count;
        rows.number_vertices({of_body.vertex, of_body.vertex_count});
#if CULLET_CHECKS_ON
        check_maps(count);
#endif
        is_beside_cut.clear(rows.vertex_count);
        for (uint32_t e = 0; e < cut.element_count(); ++e)
            if (is_touched(e))
                for (const uint32_t v : s.elements.corner[cut.element(e)])
                    if (v < rows.vertex_count) is_beside_cut.add(v);
    }

    /// They are those that the list of elements gives.
    [[maybe_unused]] void check_maps(uint32_t count) {
        const uint32_t vertices = rows.vertex_count;
        uint32_t v = 0, h = 0;
        rows.mark_and_number(count);
        CULLET_ASSERT(rows.vertex_count == vertices, "%u vertices of a cut-out, not %u", vertices, rows.vertex_count);
        rows.for_each_vertex(
            [&](uint32_t of) { CULLET_ASSERT(of_body.vertex[v++] == of, "vertex %u of a cut-out", of); });
        rows.for_each_hinge([&](uint32_t of) { CULLET_ASSERT(of_body.hinge[h++] == of, "hinge %u of a cut-out", of); });
        CULLET_ASSERT(h == rows.hinge_count, "%u hinges of a cut-out, not %u", rows.hinge_count, h);
    }

    bool is_touched(uint32_t e) const {
        return e >= rows.element_count || (state.elements.flags[cut.element(e)] & kIsTouched) != 0;
    }

    /// Behind the old vertices there are dead ones up to a whole pack.
    uint32_t first_new_vertex() const {
        return round_to_packs(rows.vertex_count);
    }
    uint32_t vertex(uint32_t v) const {
        if (v == kNone) return v;
        return v < rows.vertex_count ? of_body.vertex[v] : source.vertex_count() + (v - first_new_vertex());
    }
    uint32_t element(uint32_t e) const {
        if (e == kNone) return e;
        return e < rows.element_count ? rows.list[e] : source.element_count() + (e - rows.element_count);
    }
    uint32_t hinge(uint32_t h) const {
        if (h == kNone) return h;
        return h < rows.hinge_count ? of_body.hinge[h] : source.hinge_count() + (h - rows.hinge_count);
    }
    template <class F>
    void for_each_vertex(F&& f) const {
        for (uint32_t v = 0; v < rows.vertex_count; ++v) f(v);
        for (uint32_t v = first_new_vertex(); v < cut.vertex_count(); ++v) f(v);
    }
};

bool is_start(const ShellView& shell, uint32_t v) {
    const Vertices& vertices = shell.state.vertices;
    return vertices.crack_start[shell.vertex(v)] == v &&
           vertices.crack[shell.vertex(v)] == static_cast<uint8_t>(CrackState::Cracked);
}

/// A fragment has forgotten its old starts (6.1).
void tell_starts(const PutBack& p, Row<Bodies> body, Events<CrackStartedEvent>& cracks) {
    const BodyRows& state = p.state;
    const bool is_fragment = state.structures.generation[p.source.structure] > 0;
    p.for_each_vertex([&](uint32_t v) {
        const bool is_old = !is_fragment && v < p.rows.vertex_count && is_start(p.source, p.vertex(v));
        if (!is_start(p.cut, v) || is_old) return;
        cracks.push({body_id(state.bodies, body), state.bodies.user_data[body],
                     to_world(pose_of(state.bodies, body), state.vertices.rest[p.cut.vertex(v)])});
    });
}

/// Of a vertex, as the body counts. That of a crack whose start lies outside is not known in the cut-out.
uint32_t start_now(const PutBack& p, uint32_t v) {
    const Vertices& vertices = p.state.vertices;
    const uint32_t row = p.cut.vertex(v);
    if (vertices.crack_start[row] != kNone) return p.vertex(vertices.crack_start[row]);
    if (v >= p.rows.vertex_count || vertices.crack[row] == 0) return kNone;
    const uint32_t old = vertices.crack_start[p.source.vertex(p.vertex(v))];
    return old != kNone && p.rows.vertex(old) == kNone ? old : kNone;
}

bool has_same_crack(const PutBack& p, uint32_t v) {
    const Vertices& vertices = p.state.vertices;
    const uint32_t now = p.cut.vertex(v), then = p.source.vertex(p.vertex(v));
    return vertices.crack[then] == vertices.crack[now] && vertices.crack_start[then] == start_now(p, v) &&
           vertices.heading[then] == vertices.heading[now];
}

// Cuts and inserted vertices change rows round the cracks alone: to copy all of them costs ten times as much. Runs with
// two layers weigh all of their vertices, which rounds. A fragment has forgotten old cracks anywhere.
void put_vertices(const PutBack& p) {
    Vertices& vertices = p.state.vertices;
    const bool is_fragment = p.state.structures.generation[p.source.structure] > 0;
    p.for_each_vertex([&](uint32_t v) {
        const bool is_old = v < p.rows.vertex_count, may_differ = is_fragment || !is_old || p.is_beside_cut.has(v);
        const uint32_t from = p.cut.vertex(v), to = p.source.vertex(p.vertex(v));
        CULLET_ASSERT(may_differ || has_same_crack(p, v), "a run has changed vertex %u and no element at it", v);
        const bool is_same =
            !may_differ || (is_old && vertices.mass[to] == vertices.mass[from] && has_same_crack(p, v));
        if (is_same) return vertices.velocity.set(to, vertices.velocity[from]);
        const uint32_t start = start_now(p, v);
        outdate_block(p.source, p.vertex(v));
        const uint32_t element = p.element(vertices.element[from]);
        const uint32_t place = vertices.copy[to];                             // in the cut-out
        const float strength = vertices.strength_factor[is_old ? to : from];  // a hidden run lowers it at its border
        vertices.copy_rows(vertices, from, to, 1);
        vertices.copy[to] = place;
        vertices.element[to] = element;
        vertices.crack_start[to] = start;
        vertices.strength_factor[to] = strength;
        vertices.is_start_banned[to] = 0;
        vertices.ready_time[to] = 0;
        vertices.crush[to] = 0;
        vertices.displacement.set(to, {});
        for (const int side : {0, 1}) vertices.probe.set(to, {}, side);
    });
}

/// What an element of the cut-out names, in the body's shell. Corners say whether anything else in its row changed.
struct Links {
    std::array<uint32_t, 3> corner, neighbour, hinge;
    std::array<uint8_t, 3> edge_kind;
    friend bool operator==(const Links& a, const Links& b) = default;
};

Links links_of(const Elements& elements, uint32_t row) {
    return {elements.corner[row], elements.neighbour[row], elements.hinge[row], elements.edge_kind[row]};
}

/// `then`: as it is in the body, where it is there.
Links links_now(const PutBack& p, uint32_t e, const Links* then) {
    Links links = links_of(p.state.elements, p.cut.element(e));
    for (uint32_t k = 0; k < 3; ++k) {
        links.corner[k] = p.vertex(links.corner[k]);
        links.neighbour[k] = p.element(links.neighbour[k]);
        links.hinge[k] = p.hinge(links.hinge[k]);
        // The border of the cut-out, which is none of the body's.
        if (!then || links.edge_kind[k] != static_cast<uint8_t>(EdgeKind::Border) || then->neighbour[k] == kNone)
            continue;
        CULLET_ASSERT(p.rows.element(then->neighbour[k]) == kNone, "a run has made a border at element %u",
                      p.element(e));
        links.neighbour[k] = then->neighbour[k];
        links.hinge[k] = then->hinge[k];
        links.edge_kind[k] = static_cast<uint8_t>(EdgeKind::Interior);
    }
    return links;
}

/// Hulls of cells whose elements have other corners or borders are chosen anew at the next break.
void mark_cell(const PutBack& p, uint32_t e, const Links& now, const Links* then) {
    Cells& cells = p.state.cells;
    const uint32_t cell = p.state.structures.cells[p.source.structure].first + p.state.elements.cell[p.cut.element(e)];
    if (!then || now.corner != then->corner || now.edge_kind != then->edge_kind) cells.is_stale[cell] = 1;
    cells.element_count[cell] += !then;
}

/// What must be so of an element that is not marked: it has the same corners in the body, and at each edge the same
/// neighbour, or the border of the cut-out.
[[maybe_unused]] bool is_as_before(const PutBack& p, uint32_t e) {
    if (e >= p.rows.element_count) return false;
    const Elements& elements = p.state.elements;
    const uint32_t from = p.cut.element(e), to = p.source.element(p.rows.list[e]);
    const auto &corner = elements.corner[from], &neighbour = elements.neighbour[from], &hinge = elements.hinge[from];
    const auto &old_neighbour = elements.neighbour[to], &old_hinge = elements.hinge[to];
    bool is_same = true;
    for (uint32_t k = 0; k < 3; ++k) {
        is_same &= p.vertex(corner[k]) == elements.corner[to][k];
        const uint8_t kind = elements.edge_kind[from][k];
        const bool is_cut_border = kind == static_cast<uint8_t>(EdgeKind::Border) && old_neighbour[k] != kNone;
        if (is_cut_border && p.rows.element(old_neighbour[k]) == kNone) continue;
        is_same &= kind == elements.edge_kind[to][k] && p.element(neighbour[k]) == old_neighbour[k] &&
                   p.hinge(hinge[k]) == old_hinge[k];
    }
    return is_same;
}

/// Vertices that name an element which a cut, or a vertex put on its edge, has taken from them name another.
void leave_element(const PutBack& p, uint32_t e, const Links& now, const Links& then) {
    Vertices& vertices = p.state.vertices;
    for (const uint32_t v : then.corner) {
        uint32_t& element = vertices.element[p.source.vertex(v)];
        if (element == p.element(e) && std::find(now.corner.begin(), now.corner.end(), v) == now.corner.end())
            element = p.element(vertices.element[p.cut.vertex(p.rows.vertex(v))]);
    }
}

/// Whether a corner, or an end of a hinge, lies elsewhere than it did: not of one that a split only gave a copy.
template <size_t count>
bool has_moved(const PutBack& p, const std::array<uint32_t, count>& now, const std::array<uint32_t, count>& then) {
    for (size_t k = 0; k < count; ++k) {
        if (now[k] == then[k]) continue;
        if (now[k] == kNone || then[k] == kNone) return true;
        const Column<Vec3>& rest = p.state.vertices.rest;
        if (!(rest[p.source.vertex(now[k])] == rest[p.source.vertex(then[k])])) return true;
    }
    return false;
}

void put_element(const PutBack& p, uint32_t e) {
    BodyRows& state = p.state;
    Elements& elements = state.elements;
    const bool is_old = e < p.rows.element_count;
    if (!p.is_touched(e)) {
        CULLET_ASSERT(is_as_before(p, e), "a run has changed element %u of a cut-out and did not mark it", e);
        return;
    }
    const uint32_t from = p.cut.element(e), to = p.source.element(p.element(e));
    const Links before = links_of(elements, to), now = links_now(p, e, is_old ? &before : nullptr);
    if (is_old && now == before) return;
    mark_cell(p, e, now, is_old ? &before : nullptr);
    if (is_old) leave_element(p, e, now, before);
    const uint32_t part = elements.part[is_old ? to : p.source.element(p.rows.list[0])];
    copy_kept_rows(elements, from, to, 1);
    elements.part[to] = part;
    elements.flags[to] = static_cast<uint8_t>(elements.flags[to] & ~kIsTouched);
    elements.corner[to] = now.corner;
    elements.neighbour[to] = now.neighbour;
    elements.hinge[to] = now.hinge;
    elements.edge_kind[to] = now.edge_kind;
    if (p.has_stiffness)
        state.triangle_springs.copy_rows(state.triangle_springs, from, to, 1);
    else if (!is_old || has_moved(p, now.corner, before.corner))
        assemble_element(p.source, p.element(e));
}

/// What it is made of follows from where the four stand; a cut takes all of its stiffness.
void name_hinge(const PutBack& p, uint32_t h, const std::array<uint32_t, 4>& vertex) {
    Hinges& hinges = p.state.hinges;
    const uint32_t row = p.source.hinge(p.hinge(h));
    const auto then = hinges.vertex[row];
    const bool is_old = h < p.rows.hinge_count;
    if (is_old && then == vertex) return;
    hinges.vertex[row] = vertex;
    if (!is_old || (vertex[0] != kNone && has_moved(p, vertex, then))) assemble_hinge(p.source, p.hinge(h));
    if (vertex[0] == kNone) hinges.stiffness[row] = 0;
}

void put_hinge(const PutBack& p, uint32_t h) {
    Hinges& hinges = p.state.hinges;
    const uint32_t from = p.cut.hinge(h), to = p.source.hinge(p.hinge(h));
    auto vertex = hinges.vertex[from];
    for (uint32_t& v : vertex) v = p.vertex(v);
    if (!p.has_stiffness) return name_hinge(p, h, vertex);
    // Its gradient follows from where the four stand at rest.
    const bool is_same = h < p.rows.hinge_count && hinges.vertex[to] == vertex &&
                         hinges.stiffness[to] == hinges.stiffness[from] && hinges.scale[to] == hinges.scale[from];
    if (is_same) return;
    hinges.copy_rows(hinges, from, to, 1);
    hinges.vertex[to] = vertex;
}

/// Those that died, those of elements that changed, and new ones.
void put_hinges(const PutBack& p) {
    const Hinges& hinges = p.state.hinges;
    const uint32_t old = p.rows.hinge_count;
    for (uint32_t h = 0; h < old; ++h)
        if (hinges.vertex[p.cut.hinge(h)][0] == kNone) put_hinge(p, h);
    for (uint32_t e = 0; e < p.cut.element_count(); ++e) {
        if (!p.is_touched(e)) continue;
        for (const uint32_t h : p.state.elements.hinge[p.cut.element(e)])
            if (h < old) put_hinge(p, h);
    }
    for (uint32_t h = old; h < p.cut.hinge_count(); ++h) put_hinge(p, h);
#ifdef CULLET_CHECKED
    for (uint32_t h = 0; h < old; ++h) {
        auto vertex = hinges.vertex[p.cut.hinge(h)];
        for (uint32_t& v : vertex) v = p.vertex(v);
        CULLET_ASSERT(hinges.vertex[p.source.hinge(p.hinge(h))] == vertex, "hinge %u of a cut-out is not put back", h);
    }
#endif
}

/// Which blocks have vertices of the cut-out, or new ones: those move (VertexBlocks::moves).
void mark_moving_blocks(const PutBack& p) {
    const uint32_t count = p.source.vertex_count(), words = RowBits::words_of(count);
    const uint32_t end = count + p.cut.vertex_count() - p.first_new_vertex();
    uint8_t* const moves = p.state.vertex_blocks.moves.data() + block_row(p.source, 0);
    static_assert(kVerticesPerBlock == 64);
    for (uint32_t b = 0; b * kVerticesPerBlock < end; ++b) {
        const bool has_new = (b + 1) * kVerticesPerBlock > count && end > count;
        const uint32_t low = 2 * b < words ? p.rows.has_vertex.words[2 * b] : 0,
                       high = 2 * b + 1 < words ? p.rows.has_vertex.words[2 * b + 1] : 0;
        moves[b] = has_new || (low | high) != 0;
    }
}

/// The other vertices of these blocks move as the body does. All others do, too, and nobody writes it down.
void move_the_rest(const PutBack& p, const BodyMotion& motion) {
    Vertices& vertices = p.state.vertices;
    const uint32_t first = p.source.vertex(0), count = p.source.vertex_count();
    const uint8_t* const moves = p.state.vertex_blocks.moves.data() + block_row(p.source, 0);
    const float *const x = vertices.rest.lane(0) + first, *const y = vertices.rest.lane(1) + first,
                       *const z = vertices.rest.lane(2) + first;
    const float* const inverse_mass = vertices.inverse_mass.data() + first;
    float *const to_x = vertices.velocity.lane(0) + first, *const to_y = vertices.velocity.lane(1) + first,
                 *const to_z = vertices.velocity.lane(2) + first;
    // What the run gave the vertices of a word, while all of the word's are written: no branch in the loop.
    constexpr uint32_t kWord = 32;
    for (uint32_t word = 0; word < count; word += kWord) {
        const uint32_t rows = std::min(kWord, count - word), in_cut = p.rows.has_vertex.words[word / kWord];
        if (in_cut == ~0u || !moves[word / kVerticesPerBlock]) continue;
        float own[3][kWord];
        for (uint32_t left = in_cut; left != 0; left &= left - 1) {
            const auto i = static_cast<uint32_t>(std::countr_zero(left));
            own[0][i] = to_x[word + i], own[1][i] = to_y[word + i], own[2][i] = to_z[word + i];
        }
        for (uint32_t v = word; v < word + rows; ++v) {
            const Vec3 moved = motion.at({x[v], y[v], z[v]}).to_float();
            const bool is_free = inverse_mass[v] > 0;
            to_x[v] = is_free ? moved.x : 0, to_y[v] = is_free ? moved.y : 0, to_z[v] = is_free ? moved.z : 0;
        }
        for (uint32_t left = in_cut; left != 0; left &= left - 1) {
            const auto i = static_cast<uint32_t>(std::countr_zero(left));
            to_x[word + i] = own[0][i], to_y[word + i] = own[1][i], to_z[word + i] = own[2][i];
        }
    }
}

void put_rows(RunRows& state, Row<Tasks> task, const PutBack& p, const BodyMotion& motion,
              Events<CrackStartedEvent>& cracks) {
    tell_starts(p, state.tasks.body[task], cracks);
    put_vertices(p);
    for (uint32_t e = 0; e < p.cut.element_count(); ++e) put_element(p, e);
    put_hinges(p);
#ifdef CULLET_CHECKED
    p.for_each_vertex([&](uint32_t v) {
        CULLET_ASSERT(corner_of(p.source, state.vertices.element[p.source.vertex(p.vertex(v))], p.vertex(v)) < 3,
                      "vertex %u names an element that is not at it", p.vertex(v));
    });
#endif
    mark_moving_blocks(p);
    move_the_rest(p, motion);
    const uint32_t vertices = p.cut.vertex_count() - p.first_new_vertex(),
                   elements = p.cut.element_count() - p.rows.element_count,
                   hinges = p.cut.hinge_count() - p.rows.hinge_count;
    p.source.vertices().count += vertices;
    p.source.elements().count += elements;
    state.structures.live_elements[p.source.structure] += elements;
    p.source.hinges().count += hinges;
    if (state.tasks.crack_count[task] > 0) state.structures.has_cracks[p.source.structure] = 1;
    drop_stiffness(state, p.source.structure);
}

/// At first each contact has at most a part of its own, and no cut edge makes more than one of another.
bool has_too_many_parts(const PutBack& p, Row<Tasks> task) {
    const uint32_t most = kMostContacts + p.state.tasks.crack_count[task];
#ifndef CULLET_CHECKED
    if (most <= kMostParts) return false;
#endif
    const Scratch<std::array<FragmentPart, kMostParts>> parts(p.state.scratch);
    const uint32_t count = group_fragments(p.cut, *parts);
    CULLET_ASSERT(count <= most, "%u parts of a cut-out, of which no more than %u edges were cut", count, most);
    return count > kMostParts && most > kMostParts;
}

}  // namespace

void put_back(BodyRows& state, Row<Tasks> task, const BodyMotion& motion, Events<CrackStartedEvent>& cracks) {
    Tasks& tasks = state.tasks;
    // A mesh of several parts comes apart without a crack (find_parts).
    const bool has_changed = tasks.crack_count[task] > 0 || !is_of_one_part(ShellView(state, tasks.source[task]));
    if (static_cast<TaskState>(tasks.state[task]) != TaskState::Dropped && has_changed) {
        const PutBack p(state, task);
        // Later there is no way back. The body has no more pieces than the cut-out by itself.
        if (has_too_many_parts(p, task))
            tasks.state[task] = static_cast<uint8_t>(TaskState::Dropped);
        else
            put_rows(state, task, p, motion, cracks);
    }
    const Row<Structures> source = tasks.source[task];
    release_shell(state, tasks.working[task]);
    ++state.structures.users[source];
    tasks.working[task] = source;
    state.hidden_runs.cut_elements[task] = 0;
}

// Whoever counts here must find what fill_cut_out made: put_back writes by it.
std::string trouble_of_cut_out(RunRows& state, uint32_t task) {
    const Row<Structures> source_row = state.tasks.source[task], cut_row = state.tasks.working[task];
    const ShellView source(state, source_row), cut(state, cut_row);
    const uint32_t count = state.hidden_runs.cut_elements[task];
    const std::string where = "hidden_runs.cut_elements[" + std::to_string(task) + "]";
    if (count > cut.element_count() || count > source.element_count())
        return where + " is " + std::to_string(count) + ", more than its shells have";
    if (state.structures.users[source_row] != 2) return where + ": the body shares its shell";
    const uint32_t* listed = state.elements.part.data() + cut.elements().first;
    for (uint32_t e = 0; e < count; ++e)
        if (listed[e] >= source.element_count() || (e > 0 && listed[e] <= listed[e - 1]) ||
            (state.elements.flags[source.element(listed[e])] & kDead))
            return where + ": its elements are not rising ones of the body";
    if (!CutRows::has_room(source)) return where + ": the body has vertices that belong to no element";
    CutRows rows(source);
    std::copy_n(listed, count, rows.list);
    rows.mark_and_number(count);
    rows.count_hinges();
    const uint32_t first_new = round_to_packs(rows.vertex_count);
    const auto fits = [](uint32_t now, uint32_t before, const Range& body) {
        return now >= before && now - before <= body.capacity - body.count;
    };
    if (!fits(cut.vertex_count(), first_new, source.vertices()) ||
        !fits(cut.element_count(), count, source.elements()) ||
        !fits(cut.hinge_count(), rows.hinge_count, source.hinges()))
        return where + ": what cracks added finds no room in the body's shell";
    const uint32_t cells = state.structures.cells[source_row].count;
    if (state.structures.cells[cut_row].count != (is_quick_task(state, task) ? cells : 0))
        return where + ": its cells are not those of the body";
    for (uint32_t e = 0; e < cut.element_count(); ++e)
        if (state.elements.cell[cut.element(e)] >= cells) return where + ": an element is in none of the body's cells";
    return {};
}

}  // namespace cullet
