#include "systems/structures/shell/fragment_calls.hpp"

#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/structures/shell/crack_touches.hpp"
#include "systems/structures/shell/draw_shell.hpp"
#include "systems/structures/shell/fragment_parts.hpp"
#include "systems/structures/shell/group_fragments.hpp"
#include "systems/structures/shell/make_piece.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/structures/shell/piece_shape.hpp"
#include "systems/structures/shell/redraw_body.hpp"
#include "systems/structures/shell/rigid_handoff.hpp"
#include "systems/structures/shell/waiting_pieces.hpp"

namespace cullet {
namespace {

// ---- what hangs together

Rows<Fragments> list_found(RunRows& rows, Row<Tasks> task, Fragments& fragments) {
    return append_parts(fragments, rows.shell_parts.of_task(task).first(rows.tasks.part_count[task]));
}

Rows<Fragments> list_anew(RunRows& rows, Row<Structures> structure, Fragments& fragments) {
    const std::span<FragmentPart> parts = rows.shell_parts.of_none();
    const uint32_t count = group_fragments(ShellView(rows, structure), parts);
    return count > kMostParts ? Rows<Fragments>{} : append_parts(fragments, parts.first(count));
}

Rows<Fragments> list_whole(RunRows& rows, Row<Structures> structure, Fragments& fragments) {
    const FragmentPart whole[] = {whole_part(ShellView(rows, structure))};
    return append_parts(fragments, whole);
}

uint32_t number_of(const Break& of, Row<Fragments> fragment) {
    return fragment - of.fragments.first;
}

void join(RunRows& rows, const Break& of, Fragments& fragments, Row<Fragments> fragment) {
    FragmentPart from = part_of(fragments, fragment), to = part_of(fragments, of.largest);
    join_parts(ShellView(rows, of.broken), from, to, number_of(of, of.largest));
    set_part(fragments, fragment, from);
    set_part(fragments, of.largest, to);
}

Row<Fragments> nearest(const RunRows& rows, const Break& of, Vec3 place) {
    const Row<Shells> shell = rows.shell_of(of.broken);
    const Range vertices = rows.shells.vertices[shell];
    const uint32_t first_element = rows.shells.elements[shell].first;
    float least = 1e30f;
    Row<Fragments> owner = of.largest;
    for (uint32_t v = vertices.first; v < vertices.first + vertices.count; ++v) {
        if (rows.vertices.element[v] == kNone) continue;
        const Vec3 away = rows.vertices.rest[v] - place;
        if (dot(away, away) >= least) continue;
        least = dot(away, away);
        owner = Row<Fragments>(of.fragments.first + rows.elements.part[first_element + rows.vertices.element[v]]);
    }
    return owner;
}

void list_elements(RunRows& rows, const Break& of, Fragments& fragments, Row<Fragments> fragment) {
    FragmentPart part = part_of(fragments, fragment);
    if (is_listed(part)) return;
    list_part(ShellView(rows, of.broken), part, number_of(of, fragment));
    set_part(fragments, fragment, part);
}

void list_rest(RunRows& rows, const Break& of, Fragments& fragments) {
    list_elements(rows, of, fragments, of.largest);
}

// ---- their rows

Row<Structures> reserve(MetalShellRows rows, const Break& of, const Fragments& fragments, Row<Fragments> fragment,
                        uint8_t generation, const char** full) {
    return reserve_piece(rows, of.broken, part_of(fragments, fragment), generation, full);
}

// Which cells pieces may leave, beside those that cracked.
void mark_left_cells(const ShellView& shell, const Break& of, const Fragments& fragments) {
    const Elements& elements = shell.state.elements;
    const uint32_t first_cell = shell.cells().first;
    const Row<Fragments> rest = heaviest_of(fragments, of.fragments);
    for (const Row<Fragments> f : of.fragments)
        for (uint32_t e = f == rest ? kNone : fragments.first_element[f]; e != kNone;
             e = elements.next[shell.element(e)])
            shell.state.cells.is_changed[first_cell + elements.cell[shell.element(e)]] |= kLeft;
}

bool reserve_hulls(RunRows& rows, const Fragments& fragments, Break& plan) {
    const ShellView broken(rows, plan.broken);
    find_changed_cells(broken, ShellView(rows, plan.before));
    mark_left_cells(broken, plan, fragments);
    plan.chooses_shape = !plan.is_torn && broken.element_count() <= kMostWholeElements;
    plan.keeps_hulls = plan.broken == plan.before && !plan.is_torn && plan.had_cells && !plan.chooses_shape &&
                       has_room_to_renew(broken);
    return plan.keeps_hulls ||
           rows.hull_points.take(most_points(broken.cells().count, broken.element_count()), plan.points);
}

uint32_t piece_view_rows(RunRows& rows, const Break& of, Fragments& fragments, Row<Fragments> fragment) {
    list_elements(rows, of, fragments, fragment);
    return most_view_rows(ShellView(rows, of.broken), part_of(fragments, fragment));
}

uint32_t rows_to_redraw(BodyRows& rows, Row<Bodies> body, Row<Structures> structure, uint32_t part) {
    return rows_to_draw(rows, body, ShellView(rows, structure), part);
}

// ---- their motions

void sum(RunRows& rows, const Break& of, Fragments& fragments, const std::optional<RestMotion>& rest) {
    sum_momenta(ShellView(rows, of.broken), fragments, of.fragments, rest);
}

void weigh(RunRows& rows, const Break& of, Fragments& fragments) {
    const ShellView shell(rows, of.broken);
    for (const Row<Fragments> f : of.fragments) {
        list_elements(rows, of, fragments, f);
        Moments moments;
        for (uint32_t e = fragments.first_element[f]; e != kNone; e = rows.elements.next[shell.element(e)])
            moments = moments + element_moments(shell, e);
        const MassProperties own = mass_properties(moments);
        fragments.moving_mass[f] = own.mass;
        fragments.centre.set(f, own.centre);
        fragments.inertia[f] = own.inertia;
    }
}

Rows<Touches> find_touches(RunRows& rows, const Break& of, bool is_local, Touches& touches, Arena& arena) {
    return crack_touches(ShellView(rows, of.broken), Row<Fragments>(of.fragments.first), is_local, touches, arena);
}

// ---- pieces that wait

void forget_waiting(RunRows& rows, Row<Structures> structure) {
    forget_own_motions(ShellView(rows, structure));
}

void keep_waiting(RunRows& rows, const Break& of, const Fragments& fragments, Row<Fragments> fragment) {
    keep_own_motion(ShellView(rows, of.broken), fragments, fragment);
}

void subtract_body(RunRows& rows, const Break& of, const Fragments& fragments) {
    subtract_motion(ShellView(rows, of.broken), fragments, of.largest);
}

void take_waiting(RunRows& rows, const Break& of, Fragments& fragments) {
    take_own_motions(ShellView(rows, of.broken), fragments, of.fragments);
}

}  // namespace

void add_fragment_calls(StructureCalls& calls) {
    calls.list_found = call<list_found>;
    calls.list_anew = call<list_anew>;
    calls.list_whole = call<list_whole>;
    calls.join = call<join>;
    calls.nearest = call<nearest>;
    calls.list_rest = call<list_rest>;
    calls.reserve_piece = call<reserve>;
    calls.reserve_hulls = call<reserve_hulls>;
    calls.piece_view_rows = call<piece_view_rows>;
    calls.rows_to_redraw = call<rows_to_redraw>;
    calls.sum_momenta = call<sum>;
    calls.weigh = call<weigh>;
    calls.find_touches = call<find_touches>;
    calls.forget_waiting = call<forget_waiting>;
    calls.keep_waiting = call<keep_waiting>;
    calls.subtract_body = call<subtract_body>;
    calls.take_waiting = call<take_waiting>;
    calls.waiting_energy = call<waiting_energy>;
    calls.limit_waiting = call<limit_waiting>;
}

}  // namespace cullet
