#include "systems/structures/tetrahedra/fragment_calls.hpp"

#include <algorithm>

#include "systems/births/part_motion.hpp"
#include "systems/bodies/coupling.hpp"
#include "systems/bodies/thresholds.hpp"
#include "systems/structures/tetrahedra/skin.hpp"
#include "systems/structures/tetrahedra/solid_pieces.hpp"
#include "systems/structures/tetrahedra/solid_rooms.hpp"

namespace cullet {
namespace {

BrokenSolid& broken_of(RoomsOfTasks rows, Row<Tasks> task) {
    BreakingRoom* const room = room_of_task(rows, task);
    CULLET_ASSERT(room, "task %u has no room for what it broke", task.index);
    return room->broken;
}
const BrokenPiece& piece_of(RoomsOfTasks rows, const Break& of, Row<Fragments> fragment) {
    return broken_of(rows, of.task).pieces[fragment - of.fragments.first];
}

// ---- what hangs together

Rows<Fragments> list_found(WorldRows& rows, Row<Tasks> task, Fragments& fragments) {
    const BrokenSolid& broken = broken_of(rows, task);
    const Row<Structures> structure = rows.tasks.working[task];
    const double density = double{rows.materials.density[rows.structures.material[structure]]};
    const Rows<Fragments> made = append_fragments(fragments, static_cast<uint32_t>(broken.pieces.size()));
    for (const Row<Fragments> f : made) {
        const BrokenPiece& piece = broken.pieces[f - made.first];
        fragments.first_element[f] = fragments.last_element[f] = broken.cells[piece.cells.first];
        fragments.element_count[f] = piece.cells.count;
        fragments.mass[f] = density * piece.volume;
        fragments.has_pins[f] = piece.has_pins;
    }
    return made;
}

void join(WorldRows& rows, const Break& of, Fragments& fragments, Row<Fragments> fragment) {
    broken_of(rows, of.task).pieces[fragment - of.fragments.first].one_with = of.largest - of.fragments.first;
    fragments.element_count[of.largest] += fragments.element_count[fragment];
    fragments.mass[of.largest] += fragments.mass[fragment];
    fragments.has_pins[of.largest] |= fragments.has_pins[fragment];
    fragments.element_count[fragment] = 0;
    fragments.mass[fragment] = 0;
    fragments.first_element[fragment] = fragments.last_element[fragment] = kNone;
}

// By the middles of cells.
Row<Fragments> nearest(const WorldRows& rows, const Break& of, Vec3 place) {
    const BrokenSolid& broken = broken_of(rows, of.task);
    const Range cells = rows.cooked_solids.cells[rows.solids.cooked[solid_of(rows.structures, of.broken)]];
    double least = 1e300;
    uint32_t piece = of.largest - of.fragments.first;
    for (uint32_t c = 0; c < broken.piece_of.size(); ++c) {
        if (broken.piece_of[c] == kNone) continue;
        const Vec3d away = Vec3d(rows.solid_cells.centroid[cells.first + c]) - Vec3d(place);
        if (dot(away, away) < least) least = dot(away, away), piece = broken.piece_of[c];
    }
    return Row<Fragments>(of.fragments.first + broken.pieces[piece].one_with);
}

// ---- their rows

Row<Structures> reserve_piece(WorldRows& rows, const Break& of, [[maybe_unused]] const Fragments& fragments,
                              Row<Fragments> fragment, uint8_t generation, const char** full) {
    const BrokenSolid& broken = broken_of(rows, of.task);
    const Row<CookedSolids> cooked = rows.solids.cooked[solid_of(rows.structures, of.broken)];
    const Row<Structures> piece =
        make_solid(rows, cooked, room_for_pieces(broken, {&piece_of(rows, of, fragment), 1}), full);
    if (!piece.exists()) return piece;
    copy_structure(rows.structures, of.broken, piece);
    rows.structures.generation[piece] = generation;
    return piece;
}

// Rows for all pieces, since nobody knows yet which of them leave; the rest goes back when it is known.
bool reserve_hulls(WorldRows& rows, [[maybe_unused]] const Fragments& fragments, Break& plan) {
    const BrokenSolid& broken = broken_of(rows, plan.task);
    bool is_full = false;
    for_each_solid_range(rows, plan.broken, room_for_pieces(broken, broken.pieces),
                         [&](Range& range, auto& table, uint32_t wanted, const char*) {
                             table.give_back(range);
                             is_full = !table.take(wanted, range) || is_full;
                         });
    return !is_full;
}

uint32_t piece_view_rows(WorldRows& rows, const Break& of, [[maybe_unused]] Fragments& fragments,
                         Row<Fragments> fragment) {
    uint32_t triangles = 0;
    for (const BrokenPiece& piece : broken_of(rows, of.task).pieces)
        if (piece.one_with == fragment - of.fragments.first) triangles += piece.triangles.count;
    return 3 * triangles;
}

// What breaks is drawn anew.
template <class... Asked>
uint32_t too_many(Asked...) {
    return kNone;
}

// ---- their motions

void weigh(WorldRows& rows, const Break& of, Fragments& fragments) {
    const BrokenSolid& broken = broken_of(rows, of.task);
    const double density = double{rows.materials.density[rows.structures.material[of.broken]]};
    for (const Row<Fragments> f : of.fragments) {
        const BrokenPiece& piece = broken.pieces[f - of.fragments.first];
        fragments.moving_mass[f] = density * piece.volume;
        fragments.centre.set(f, piece.centre);
        fragments.inertia[f] = density * piece.inertia;
        fragments.radius[f] = piece.radius;
    }
}

/// Of what is too thin to turn none.
Vec3d spin_of(const Fragments& f, Row<Fragments> row, Vec3d turning) {
    return can_turn(f.inertia[row]) ? inverse(f.inertia[row]) * turning : Vec3d{};
}

/// Where contacts meet the fragments, and what these set against a push there.
struct Struck {
    Row<Fragments> fragment;
    Vec3d arm, normal;
    double inverse_mass = 0;
};

double speed_at(const Fragments& f, const Struck& at) {
    const Vec3d spin = spin_of(f, at.fragment, f.turning[at.fragment]);
    const Vec3d moving = (1 / f.moving_mass[at.fragment]) * f.momentum[at.fragment] + cross(spin, at.arm);
    return dot(moving, at.normal);
}

// The piece that is struck and the striker go on as one there; the others do not know of it, but for what crack faces
// pass on when motions are settled. Contacts of one striker know of each other, and those of one piece.
void strike(const WorldRows& all, Tables<const Tasks, TaskContacts> rows, const Break& of, Fragments& f) {
    constexpr int kRounds = 8;
    TaskContacts& contacts = rows.task_contacts;
    const uint32_t first = rows.tasks.first_contact[of.task], count = rows.tasks.contact_count[of.task];
    std::array<Struck, kMostContacts> struck;
    for (uint32_t i = 0; i < count; ++i) {
        Struck& at = struck[i];
        at.fragment = nearest(all, of, contacts.point[first + i]);
        at.normal = Vec3d(contacts.normal[first + i]);
        at.arm = Vec3d(contacts.point[first + i]) - f.centre[at.fragment];
        const Vec3d turn = cross(at.arm, at.normal);
        if (!f.has_pins[at.fragment])
            at.inverse_mass = 1 / f.moving_mass[at.fragment] + dot(turn, spin_of(f, at.fragment, turn));
        contacts.impulse[first + i] = 0;
    }
    for (int round = 0; round < kRounds; ++round)
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t c = first + i;
            const Struck& at = struck[i];
            double speed = double{contacts.start_speed[c]} -
                           double{contacts.striker_inverse_mass[c]} * contacts.impulse[c] - speed_at(f, at);
            for (uint32_t b = first; b < first + count; ++b)
                if (share_a_striker(contacts, c, b)) speed -= coupling(contacts, c, b) * contacts.impulse[b];
            const double inverse_mass = at.inverse_mass + double{contacts.striker_inverse_mass[c]};
            const double before = contacts.impulse[c];
            const double after = std::max(0.0, before + speed / inverse_mass);
            contacts.impulse[c] = after;
            if (f.has_pins[at.fragment]) continue;
            const Vec3d given = (after - before) * at.normal;
            f.momentum.set(at.fragment, f.momentum[at.fragment] + given);
            f.turning.set(at.fragment, f.turning[at.fragment] + cross(at.arm, given));
        }
    for (uint32_t c = first; c < first + count; ++c)
        contacts.striker_speed[c] =
            double{contacts.start_speed[c]} - double{contacts.striker_inverse_mass[c]} * contacts.impulse[c];
}

void sum_momenta(WorldRows& rows, const Break& of, Fragments& fragments,
                 [[maybe_unused]] const std::optional<RestMotion>& rest) {
    weigh(rows, of, fragments);
    for (const Row<Fragments> f : of.fragments) {
        const Vec3d velocity = of.start.velocity + cross(of.start.spin, fragments.centre[f] - of.start.centre);
        fragments.momentum.set(f, fragments.moving_mass[f] * velocity);
        fragments.turning.set(f, fragments.inertia[f] * of.start.spin);
        // What came late has moved the body already.
        if (rows.tasks.is_late[of.task] || fragments.has_pins[f]) continue;
        const BrokenPiece& piece = piece_of(rows, of, f);
        fragments.momentum.set(f, Vec3d(fragments.momentum[f]) + piece.impulse);
        fragments.turning.set(f, Vec3d(fragments.turning[f]) + piece.turning);
    }
    strike(rows, rows, of, fragments);
    for (const Row<Fragments> f : of.fragments) {
        const Vec3d momentum = fragments.momentum[f], turning = fragments.turning[f];
        fragments.hidden_energy[f] =
            dot(momentum, momentum) / (2 * fragments.moving_mass[f]) + dot(turning, spin_of(fragments, f, turning)) / 2;
    }
}

Rows<Touches> find_touches(WorldRows& rows, const Break& of, bool, Touches& touches, [[maybe_unused]] Arena& arena) {
    const BrokenSolid& broken = broken_of(rows, of.task);
    const auto count = static_cast<uint32_t>(broken.touches.size());
    const uint32_t made = count > 0 ? touches.append(count) : kNone;
    if (made == kNone) return {};
    for (uint32_t i = 0; i < count; ++i) {
        const BrokenTouch& touch = broken.touches[i];
        const double size = length(touch.normal);
        touches.a[made + i] = Row<Fragments>(of.fragments.first + touch.a);
        touches.b[made + i] = Row<Fragments>(of.fragments.first + touch.b);
        touches.point.set(made + i, (1 / touch.area) * touch.point);
        touches.normal.set(made + i, size > 0 ? (1 / size) * touch.normal : Vec3d{});
        touches.reach[made + i] = std::sqrt(touch.area);
    }
    return {made, count};
}

// ---- what stays

void adopt(WorldRows& rows, Row<Bodies> body, Row<Structures> structure) {
    const Row<Structures> before = rows.bodies.structure[body];
    if (before == structure) return;
    ++rows.structures.users[structure];
    rows.bodies.structure[body] = structure;
    release_solid(rows, before);
}

void keep_rest(WorldRows& rows, const Break& of, [[maybe_unused]] const Fragments& fragments) {
    give_back_spare(rows, of.broken);
    uint8_t& generation = rows.structures.generation[of.broken];
    if (generation < kMostGenerations) ++generation;
    adopt(rows, of.body, of.broken);
}

/// Nothing, none, 0: of calls that a solid has no use for.
template <class Told, class... Asked>
Told nothing(Asked...) {
    return Told();
}

}  // namespace

void add_solid_fragment_calls(StructureCalls& calls) {
    calls.list_found = list_found;
    calls.join = join;
    calls.nearest = nearest;
    calls.reserve_piece = reserve_piece;
    calls.reserve_hulls = reserve_hulls;
    calls.piece_view_rows = piece_view_rows;
    calls.rows_to_redraw = too_many;
    calls.sum_momenta = sum_momenta;
    calls.weigh = weigh;
    calls.find_touches = find_touches;
    calls.adopt = adopt;
    calls.keep_rest = keep_rest;
    // What found no room stays with the largest until the next hit, and has no motion of its own.
    calls.list_anew = calls.list_whole = nothing;
    calls.forget_waiting = nothing;
    calls.keep_waiting = nothing;
    calls.subtract_body = nothing;
    calls.take_waiting = nothing;
    calls.waiting_energy = nothing;
    calls.limit_waiting = nothing;
    // A solid that only cracked stays as it was; runs leave nothing in its rows.
    calls.keep_hulls = nothing;
    calls.find_changes = nothing;
    calls.list_rest = nothing;
    calls.clear_run = nothing;
    calls.stop = nothing;
    calls.pack_hulls = nothing;
    calls.tell_cracks = nothing;
}

}  // namespace cullet
