#include "systems/structures/shell/rest_calls.hpp"

#include "components/body_id.hpp"
#include "systems/bodies/thresholds.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/structures/shell/cell_elements.hpp"
#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/structures/shell/draw_shell.hpp"
#include "systems/structures/shell/fragment_parts.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/structures/shell/piece_shape.hpp"
#include "systems/structures/shell/rest_of_body.hpp"
#include "systems/structures/shell/vertex_sums.hpp"

namespace cullet {
namespace {

// ---- its rows

Row<Structures> import(WorldRows& rows, const Workbench& from, Row<Structures> structure, const char** full) {
    const Row<Structures> copy = import_shell(rows, from, structure, full);
    if (copy.exists()) (void)sorted_elements(ShellView(rows, copy));  // its bodies' copies know, too
    return copy;
}

void release(WorldRows& rows, Row<Structures> structure) {
    release_metal_shell(rows, structure);
}

float radius(RunRows& rows, Row<Structures> structure) {
    return radius_of(ShellView(rows, structure));
}

uint32_t points_at_birth(const RunRows& rows, Row<Structures> structure) {
    return rows.shells.vertices[rows.shell_of(structure)].count;
}

uint32_t view_rows(RunRows& rows, Row<Structures> structure) {
    return most_view_rows(ShellView(rows, structure));
}

void measure(RunRows& rows, Row<Structures> structure) {
    measure_shell(ShellView(rows, structure));
}

// A crack starts at a vertex that names itself. Vertices keep their numbers in the working shell, so those that did so
// in the body's before the hit are old.
void tell_cracks(BodyRows& rows, Row<Tasks> task, Events<CrackStartedEvent>& cracks) {
    if (rows.tasks.working[task] == rows.tasks.source[task]) return;  // put_back has told
    const Row<Bodies> body = rows.tasks.body[task];
    const ShellView now(rows, rows.tasks.working[task]), before(rows, rows.tasks.source[task]);
    const auto is_start = [&](const ShellView& shell, uint32_t v) {
        const uint32_t row = shell.vertex(v);
        return rows.vertices.crack_start[row] == v &&
               rows.vertices.crack[row] == static_cast<uint8_t>(CrackState::Cracked);
    };
    const bool is_fragment = rows.structures.generation[before.structure] > 0;  // it has forgotten its old starts (6.1)
    for (uint32_t v = 0; v < now.vertex_count(); ++v) {
        if (!is_start(now, v) || (!is_fragment && v < before.vertex_count() && is_start(before, v))) continue;
        cracks.push({body_id(rows.bodies, body), rows.bodies.user_data[body],
                     to_world(pose_of(rows.bodies, body), rows.vertices.rest[now.vertex(v)])});
    }
}

// ---- what stays

void find_changes(RunRows& rows, Row<Structures> now, Row<Structures> before) {
    find_changed_cells(ShellView(rows, now), ShellView(rows, before));
}

bool take_hulls(RunRows& rows, Row<Structures> now, Row<Structures> before) {
    return keep_hulls(ShellView(rows, now), ShellView(rows, before));
}

void clear(RunRows& rows, Row<Structures> structure, RunTraces traces) {
    clear_run(ShellView(rows, structure), traces.is_whole, traces.has_run, traces.has_waiting);
}

void stop(RunRows& rows, Row<Structures> structure) {
    stop_blocks(ShellView(rows, structure));
}

// What leaves, and the hulls of its piece. Children first: their hulls are found among the body's.
void take_leave(BodyRows& rows, const Break& of, const Fragments& fragments, Row<Fragments> f, ShellSums& left) {
    const ShellView shell(rows, of.broken), before(rows, of.before);
    outdate_blocks(shell, part_of(fragments, f));
    if (fragments.child[f].exists()) {
        const ShellView piece(rows, rows.bodies.structure[fragments.child[f]]);
        if (shape_of(piece) == ShapeKind::Cells)
            copy_piece_hulls(piece, before, of.margin, of.had_cells);
        else
            empty_piece_cells(piece);
        left = left + sums_of(piece);
        return;
    }
    for (uint32_t e = fragments.first_element[f]; e != kNone; e = rows.elements.next[shell.element(e)])
        left = left + element_sums(shell, e);
}

// The smaller sides have moved (design section 3): the rest keeps its rows, those of the pieces are dead. What rows the
// body had before tell which hulls are as they were.
void keep_rest(WorldRows& rows, const Break& of, const Fragments& fragments) {
    const ShellView shell(rows, of.broken), before(rows, of.before);
    ShellSums left;
    for (const Row<Fragments> f : of.fragments)
        if (leaves(fragments, f)) take_leave(rows, of, fragments, f, left);
    if (!of.is_rest_smaller(rows.structures)) write_sums(shell, sums_of(shell) - left);
    rows.shells.dead_elements[shell.row] += of.left_elements;
    rows.structures.live_elements[shell.structure] -= of.left_elements;
    uint8_t& generation = rows.structures.generation[shell.structure];
    // A dent is no break, and metal with a hole in it is dented and torn as often as it is struck.
    const bool is_broken = !of.is_reshaped && !metal_of(rows, shell.structure).exists();
    if (is_broken && generation < kMostGenerations) ++generation;
    if (!of.is_torn) clear_run(shell, false, of.broken != of.before, of.is_refused);
    if (of.keeps_hulls) return renew_rest_hulls(shell);
    const Range points = rows.structures.points[before.structure], old_points = rows.structures.points[shell.structure];
    rows.structures.points[shell.structure] = of.points;
    if (shape_of(shell) != ShapeKind::Cells && of.chooses_shape)
        empty_rest_cells(shell);
    else
        copy_rest_hulls(shell, points, before, of.had_cells);
    rows.hull_points.pool.give_back(old_points.first, old_points.capacity);
    adopt_shell(rows, rows, of.body, shell.structure);
}

void adopt(WorldRows& rows, Row<Bodies> body, Row<Structures> structure) {
    adopt_shell(rows, rows, body, structure);
}

void close_up_hulls(RunRows& rows, Row<Structures> structure, bool are_renewed) {
    if (are_renewed)
        pack_renewed_hulls(ShellView(rows, structure));
    else
        pack_hulls(ShellView(rows, structure));
}

}  // namespace

void add_rest_calls(StructureCalls& calls) {
    calls.import = call<import>;
    calls.release = call<release>;
    calls.radius = call<radius>;
    calls.points_at_birth = call<points_at_birth>;
    calls.view_rows = call<view_rows>;
    calls.measure = call<measure>;
    calls.tell_cracks = call<tell_cracks>;
    calls.find_changes = call<find_changes>;
    calls.keep_hulls = call<take_hulls>;
    calls.clear_run = call<clear>;
    calls.stop = call<stop>;
    calls.adopt = adopt;
    calls.keep_rest = call<keep_rest>;
    calls.pack_hulls = call<close_up_hulls>;
}

}  // namespace cullet
