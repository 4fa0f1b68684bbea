#include <algorithm>

#include "systems/structures/shell/cell_elements.hpp"
#include "systems/structures/shell/drawn_triangles.hpp"
#include "systems/structures/shell/redraw_body.hpp"

namespace cullet {
namespace {

/// The mesh while triangles leave and come. Between two runs there may be gaps.
class Mesh {
 public:
    Mesh(const ShellView& shell, BodyRows& rows, Row<Bodies> body, ViewBoxes* boxes)
        : shell_(shell), rows_(rows), bodies_(rows.bodies), body_(body), boxes_(boxes) {
        const Range vertices = bodies_.view_vertices[body], indices = bodies_.view_indices[body];
        vertex_ = rows.view_vertices.vertex.data() + vertices.first;
        source_ = rows.view_indices.source.data() + indices.first;
        room_ = std::min(vertices.capacity, indices.capacity) / 3;
        first_box_ = indices.first / kViewGranule;
        materials_.id = bodies_.drawn_materials[body];
        materials_.count = kMostDrawnMaterials;
        uint32_t next = 0;
        for (uint32_t r = 0; r < kMostRuns; ++r) {
            start_[r] = next;
            next += length_[r] = bodies_.run_indices[body][r] / 3;
        }
        end_ = next;
    }

    /// Where the triangle stands, or kNone.
    uint32_t find(uint32_t e, uint32_t which) const {
        const uint32_t at = shell_.state.elements.drawn[shell_.element(e)][which];
        return at < end_ && source_[3 * at] == source_of(e, which) ? at : kNone;
    }
    bool stands_in_its_run(uint32_t e, uint32_t which, uint32_t at) const {
        const uint32_t r = drawn_run(shell_, materials_, e, which);
        return at - start_[r] < length_[r];
    }
    /// The last of its run takes its place.
    void remove(uint32_t at) {
        uint32_t r = 0;
        while (r < kMostRuns && at - start_[r] >= length_[r]) ++r;
        CULLET_ASSERT(r < kMostRuns, "drawn triangle %u of body %u is in no run", at, body_.index);
        const uint32_t element = source_[3 * at] / kMostDrawnTriangles;
        shell_.state.elements.drawn[shell_.element(element)][source_[3 * at] % kMostDrawnTriangles] = kNone;
        move(start_[r] + --length_[r], at);
    }
    /// At the end of its run: where there is no gap behind that, the runs behind it put their first triangle last.
    /// kNone: no room.
    uint32_t add(uint32_t e, uint32_t which) {
        const uint32_t run = drawn_run(shell_, materials_, e, which);
        uint32_t gap = run;  // the first run from there on with a gap behind it
        while (gap < kMostRuns && start_[gap] + length_[gap] == next_start(gap)) ++gap;
        if (gap == kMostRuns) {
            if (end_ == room_) return kNone;
            ++end_;
            gap = kMostRuns - 1;
        }
        for (uint32_t r = gap; r > run; --r) {
            if (length_[r] > 0) move(start_[r], start_[r] + length_[r]);
            ++start_[r];
        }
        const uint32_t at = start_[run] + length_[run]++;
        name(at, source_of(e, which));
        return at;
    }
    ViewVertex* write(uint32_t at) {
        first_ = std::min(first_, at), last_ = std::max(last_, at + 1);
        if (boxes_) boxes_->is_outdated[first_box_ + at / kTrianglesPerBox] = 1;
        return vertex_ + 3 * at;
    }
    /// Runs follow each other again; what changed is written to the body's row.
    void finish() {
        Bodies& bodies = bodies_;
        uint32_t next = 0;
        for (uint32_t r = 0; r < kMostRuns; ++r) {
            const uint32_t way = start_[r] - next, moved = std::min(way, length_[r]);
            for (uint32_t i = 0; i < moved; ++i) move(start_[r] + length_[r] - moved + i, next + i);
            next += length_[r];
            bodies.run_indices[body_][r] = 3 * length_[r];
        }
        Range &vertices = bodies.view_vertices[body_], &indices = bodies.view_indices[body_];
        uint32_t* const index = rows_.view_indices.index.data() + indices.first;
        for (uint32_t i = indices.count; i < 3 * next; ++i) index[i] = i;
        if (boxes_ && next > 0 && 3 * next < indices.count)
            boxes_->is_outdated[first_box_ + (next - 1) / kTrianglesPerBox] = 1;
        const bool is_other = first_ != kNone || indices.count != 3 * next;
        vertices.count = indices.count = 3 * next;
        last_ = std::min(std::max(last_, first_ == kNone ? next : 0), next);
        // Where triangles only went, the last one stands for them.
        bodies.redrawn[body_] = {std::min(first_, last_ > 0 ? last_ - 1 : 0), last_};
        if (is_other)
            ++bodies.view_stamp[body_];
        else
            bodies.redrawn[body_] = {0, 0};
    }

 private:
    uint32_t next_start(uint32_t run) const { return run + 1 < kMostRuns ? start_[run + 1] : end_; }
    void name(uint32_t at, uint32_t source) {
        std::fill_n(source_ + 3 * at, 3, source);
        shell_.state.elements.drawn[shell_.element(source / kMostDrawnTriangles)][source % kMostDrawnTriangles] = at;
    }
    void move(uint32_t from, uint32_t to) {
        if (from == to) return;
        std::copy_n(vertex_ + 3 * from, 3, write(to));
        name(to, source_[3 * from]);
    }

    const ShellView& shell_;
    BodyRows& rows_;
    Bodies& bodies_;
    Row<Bodies> body_;
    ViewBoxes* boxes_;
    ViewVertex* vertex_;
    uint32_t* source_;
    uint32_t room_, end_, first_box_;
    uint32_t start_[kMostRuns], length_[kMostRuns];
    uint32_t first_ = kNone, last_ = 0;
    DrawnMaterials materials_;
};

bool is_same_place(Vec3 a, Vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

bool is_free(const ShellView& shell, uint32_t e, uint32_t k) {
    return shell.state.elements.neighbour[shell.element(e)][k] == kNone;
}

bool is_live(const ShellView& shell, uint32_t e) {
    return !(shell.state.elements.flags[shell.element(e)] & kDead);
}

/// Faces are drawn as they are while their corners stand where they stood: nothing else changes without them.
bool draw_faces(Mesh& mesh, const ShellView& shell, uint32_t e) {
    uint32_t outer = mesh.find(e, kOuterFace), inner = mesh.find(e, kInnerFace);
    if (outer == kNone) outer = mesh.add(e, kOuterFace);
    if (inner == kNone) inner = mesh.add(e, kInnerFace);
    if (outer == kNone || inner == kNone) return false;
    // Room for one may have been made by moving the other.
    write_faces(shell, e, mesh.write(mesh.find(e, kOuterFace)), mesh.write(mesh.find(e, kInnerFace)));
    return true;
}

bool stands(const Mesh& mesh, const ShellView& shell, const ViewVertex* vertex, uint32_t e) {
    for (const uint32_t which : {kOuterFace, kInnerFace}) {
        const uint32_t at = mesh.find(e, which);
        if (at == kNone) return false;
        const auto corners = drawn_corners(shell, e, which);
        for (uint32_t k = 0; k < 3; ++k)
            if (!is_same_place(vertex[3 * at + k].position, drawn_place(shell, corners[k]))) return false;
    }
    return true;
}

/// One border loop, from its first free edge in the order of elements, where a mesh drawn anew would begin.
bool draw_border(Mesh& mesh, const ShellView& shell, uint32_t e, uint32_t k) {
    const uint32_t begin_e = e, begin_k = k;
    uint32_t first_e = e, first_k = k;
    do {
        if (e < first_e || (e == first_e && k < first_k)) first_e = e, first_k = k;
        step_along_border(shell, e, k);
    } while (e != begin_e || k != begin_k);
    float along = 0;
    e = first_e, k = first_k;
    do {
        uint8_t& marks = shell.state.elements.drawn_edges[shell.element(e)];
        marks = static_cast<uint8_t>(marks | (1 << k));
        for (const uint32_t half : {0u, 1u}) {
            const uint32_t which = wall_triangle(k, half);
            if (!is_drawn(shell, e, which)) continue;
            uint32_t at = mesh.find(e, which);
            if (at == kNone) at = mesh.add(e, which);
            if (at == kNone) return false;
            write_wall(shell, e, which, along, mesh.write(at));
        }
        along += drawn_length(shell, e, k);
        step_along_border(shell, e, k);
    } while (e != first_e || k != first_k);
    return true;
}

}  // namespace

uint32_t rows_to_draw(const BodyRows& state, Row<Bodies> body, ShellView shell, uint32_t part) {
    const Mesh mesh(shell, const_cast<BodyRows&>(state), body, nullptr);
    uint32_t count = state.bodies.view_indices[body].count;
    for_each_element_of_changed_cells(shell, [&](uint32_t e) {
        if (!is_live(shell, e) || (part != kNone && state.elements.part[shell.element(e)] != part)) return;
        const auto& neighbour = state.elements.neighbour[shell.element(e)];
        const bool is_inside = neighbour[0] != kNone && neighbour[1] != kNone && neighbour[2] != kNone;
        for (uint32_t which = 0; which < (is_inside ? kFirstWall : kMostDrawnTriangles); ++which)
            if (mesh.find(e, which) == kNone && is_drawn(shell, e, which)) count += 3;
    });
    return count;
}

bool redraw_body(BodyRows& state, Row<Bodies> body, ViewBoxes& boxes) {
    const ShellView shell(state, state.bodies.structure[body]);
    Elements& elements = state.elements;
    Mesh mesh(shell, state, body, &boxes);
    const ViewVertex* const vertex = state.view_vertices.vertex.data() + state.bodies.view_vertices[body].first;
    for_each_element_of_changed_cells(shell, [&](uint32_t e) {
        elements.drawn_edges[shell.element(e)] = 0;
        for (uint32_t which = 0; which < kMostDrawnTriangles; ++which) {
            const uint32_t at = mesh.find(e, which);
            if (at != kNone && (!is_drawn(shell, e, which) || !mesh.stands_in_its_run(e, which, at))) mesh.remove(at);
        }
    });
    bool has_room = true;
    for_each_element_of_changed_cells(shell, [&](uint32_t e) {
        if (is_live(shell, e) && !stands(mesh, shell, vertex, e)) has_room = draw_faces(mesh, shell, e) && has_room;
    });
    for_each_element_of_changed_cells(shell, [&](uint32_t e) {
        for (uint32_t k = 0; k < 3 && has_room; ++k)
            if (is_live(shell, e) && is_free(shell, e, k) && !(elements.drawn_edges[shell.element(e)] & (1 << k)))
                has_room = draw_border(mesh, shell, e, k);
    });
    mesh.finish();
    return has_room;
}

}  // namespace cullet
