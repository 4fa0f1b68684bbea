// What the rest of the program asks of what things are made of. A kind of structure gives plain functions over sets of
// tables; the slots that it fills (slots.hpp) are where its own systems stand.
#pragma once
#include <algorithm>
#include <optional>
#include <span>
#include <string>

#include "components/workbench.hpp"
#include "components/world_rows.hpp"
#include "cullet/events.hpp"
#include "engine/arena.hpp"
#include "engine/events.hpp"
#include "systems/births/break.hpp"
#include "systems/narrow_call.hpp"

namespace cullet {

struct Blows;
struct Explosion;
struct ExplosionSums;
class HeldParts;
struct LoadedSection;

/// How those parts of a large body move that its run left alone. Body axes.
struct RestMotion {
    Vec3d centre, velocity, spin;
    Vec3d at(Vec3 place) const { return velocity + cross(spin, Vec3d(place) - centre); }
};

/// How far a body goes along a direction, from its centre of mass, m.
struct Reach {
    double low = 1e30, high = -1e30;
    void add(double at) { low = std::min(low, at), high = std::max(high, at); }
};

using CrackLine = void (*)(void* user, Vec3 from, Vec3 to);

/// What a run leaves in a structure, and is to be cleared.
struct RunTraces {
    bool is_whole;             // no piece left: any crack counts as one, not only those that go on
    bool has_run;              // on these very rows
    bool has_waiting = false;  // pieces without room keep what they have of their own
};

/// All of one kind of structure. Rows of Fragments are those of the break that is given with them.
struct StructureCalls {
    // ---- Its rows

    /// A copy of what was cooked, with one user; none: there is no room, and `full` names the limit.
    Row<Structures> (*import)(WorldRows&, const Workbench& from, Row<Structures>, const char** full) = nullptr;
    /// One user less; the rows go back when there are none.
    void (*release)(WorldRows&, Row<Structures>) = nullptr;
    /// No point of it is farther from its centre, m.
    float (*radius)(WorldRows&, Row<Structures>) = nullptr;
    /// Points that are gone through when its pieces are born: units are counted by them.
    uint32_t (*points_at_birth)(const WorldRows&, Row<Structures>) = nullptr;
    /// Rows, of vertices and of indices alike, that its drawn mesh may take.
    uint32_t (*view_rows)(WorldRows&, Row<Structures>) = nullptr;
    /// Writes mass, centre, inertia and area, as it is shaped now.
    void (*measure)(WorldRows&, Row<Structures>) = nullptr;
    /// Its rows are nobody's any more, but for what is told of a body that is only drawn.
    void (*empty)(WorldRows&, Row<Structures>) = nullptr;
    /// What is wrong with rows that came from a file, of ranges that have been looked at; or nothing.
    std::string (*trouble)(Read<StructuresOfAllKinds>, Row<Structures>) = nullptr;
    /// Cracks that a task started on its working copy are told, each once.
    void (*tell_cracks)(WorldRows&, Row<Tasks>, Events<CrackStartedEvent>&) = nullptr;

    // ---- Its surface. Places and directions in the body's frame

    /// m: how far around the point of a blow it is felt; `radius`: of a ball that strikes, or 0.
    float (*patch_radius)(const WorldRows&, Row<Structures>, float radius) = nullptr;
    /// The way a ball's blow goes that is met there under this normal.
    Vec3 (*struck_normal)(WorldRows&, Row<Structures>, Vec3 place, Vec3 normal, float radius) = nullptr;
    Vec3 (*nearest_point)(WorldRows&, Row<Structures>, Vec3 place) = nullptr;
    ExplosionSums (*measure_explosion)(WorldRows&, Row<Structures>, const Explosion&, Vec3d about) = nullptr;
    /// The cut in this row of Blows goes through it.
    bool (*is_cut_by)(WorldRows&, Row<Structures>, const Blows&, uint32_t row) = nullptr;

    // ---- What it bears, and how it gives way to it

    /// It gives way to what presses on it for long.
    bool bears_loads = false;
    /// There is something between its walls: it bears squeezing through all of it, and a load parts it whether the game
    /// may cut it or not.
    bool is_filled = false;
    /// m, of its walls; of what is filled the mean thickness.
    double (*wall)(const WorldRows&, Row<Bodies>) = nullptr;
    /// How far its surface goes each of these ways, unit, body axes. Adds to what is there.
    void (*reach)(const WorldRows&, Row<Bodies>, std::span<const Vec3d> ways, std::span<Reach> along) = nullptr;
    /// Adds what pins hold of it along the axis, body frame.
    void (*add_held)(const WorldRows&, Row<Bodies>, Vec3d axis, HeldParts&) = nullptr;
    /// Of the smallest parts that it can come apart into, those that a run on all of it goes through.
    uint32_t (*elements_of_run)(const WorldRows&, Row<Structures>) = nullptr;
    /// Asks for a cut that parts it there. False: no row of Blows is free.
    bool (*part_by_load)(const WorldRows&, Blows&, Row<Bodies>, const LoadedSection&) = nullptr;
    /// Units of the cut in this row of Blows, made whole in the step that opens its task, with the opening. 0: it is
    /// parted step by step, as it breaks.
    uint64_t (*units_of_cut)(const WorldRows&, Row<Structures>, const Blows&, uint32_t row) = nullptr;

    // ---- What is drawn of it

    /// All of it, into the body's own rows.
    void (*draw)(WorldRows&, Row<Bodies>) = nullptr;
    /// What follows from the drawn mesh of the body, after a load.
    void (*remember_drawn)(WorldRows&, Row<Structures>, Row<Bodies>) = nullptr;
    /// Drawn triangles name one of so many parts of it.
    uint32_t (*drawn_parts)(const WorldRows&, Row<Structures>) = nullptr;
    /// `line(user, from, to)` for each edge that is cracked, body frame: for debugging.
    void (*show_cracks)(const WorldRows&, Row<Structures>, CrackLine line, void* user) = nullptr;

    // ---- Fragments

    /// New rows for what the model of the task found to hang together (slot Group); none: there is no room.
    Rows<Fragments> (*list_found)(WorldRows&, Row<Tasks>, Fragments&) = nullptr;
    /// The same of what hangs together now; none as well where there are more than kMostParts.
    Rows<Fragments> (*list_anew)(WorldRows&, Row<Structures>, Fragments&) = nullptr;
    /// All of it as one, also what does not hang together: a dent frees no piece.
    Rows<Fragments> (*list_whole)(WorldRows&, Row<Structures>, Fragments&) = nullptr;
    /// The fragment becomes one with the largest, and its row empty.
    void (*join)(WorldRows&, const Break&, Fragments&, Row<Fragments>) = nullptr;
    /// Which fragment owns what is nearest to a place, body frame; the largest where nothing is left.
    Row<Fragments> (*nearest)(const WorldRows&, const Break&, Vec3 place) = nullptr;

    // ---- Their rows

    /// A structure for a fragment, with the rows that births are filled into; none: `full` names the limit.
    Row<Structures> (*reserve_piece)(WorldRows&, const Break&, const Fragments&, Row<Fragments>, uint8_t generation,
                                     const char** full) = nullptr;
    /// Finds what changed of the hulls, and room for those of what is left, whatever leaves: chooses_shape, keeps_hulls
    /// and points of the break. False: there is none, and nothing else is to change.
    bool (*reserve_hulls)(WorldRows&, const Fragments&, Break&) = nullptr;
    /// As view_rows, of one fragment.
    uint32_t (*piece_view_rows)(WorldRows&, const Break&, Fragments&, Row<Fragments>) = nullptr;
    /// Rows that the drawn mesh of a body may need in between when only cells that changed are drawn anew: what it has,
    /// and what is to come of the part of that number, or of any (kNone).
    uint32_t (*rows_to_redraw)(WorldRows&, Row<Bodies>, Row<Structures>, uint32_t part) = nullptr;
    /// Elements of the largest are listed, for who is to go through them on any thread.
    void (*list_rest)(WorldRows&, const Break&, Fragments&) = nullptr;

    // ---- Their motions

    /// Mass, centre, inertia, momenta and energy of each, of the hidden state.
    void (*sum_momenta)(WorldRows&, const Break&, Fragments&, const std::optional<RestMotion>&) = nullptr;
    /// Mass, centre and inertia alone, of the solids.
    void (*weigh)(WorldRows&, const Break&, Fragments&) = nullptr;
    /// New rows for where they lie at each other. `is_local`: along cracks of this run alone.
    Rows<Touches> (*find_touches)(WorldRows&, const Break&, bool is_local, Touches&, Arena&) = nullptr;

    // ---- Pieces that wait for room, and go on with the body meanwhile

    /// What they had of their own.
    void (*forget_waiting)(WorldRows&, Row<Structures>) = nullptr;
    /// The fragment's motion is kept for when it leaves.
    void (*keep_waiting)(WorldRows&, const Break&, const Fragments&, Row<Fragments>) = nullptr;
    /// When all are kept: what the largest moves like is not their own.
    void (*subtract_body)(WorldRows&, const Break&, const Fragments&) = nullptr;
    /// They get it back, and the heaviest fragment what is left for it.
    void (*take_waiting)(WorldRows&, const Break&, Fragments&) = nullptr;
    /// J that the body's waiting pieces and its rest have beyond the body's own motion.
    double (*waiting_energy)(const WorldRows&, Row<Bodies>) = nullptr;
    /// Where that is more than `allowed`, all of them slow down to it. What they have then.
    double (*limit_waiting)(WorldRows&, Row<Bodies>, double allowed) = nullptr;

    // ---- What stays

    /// Marks cells that are not as they are in `before` (Cells::is_changed).
    void (*find_changes)(WorldRows&, Row<Structures> now, Row<Structures> before) = nullptr;
    /// A structure that only cracked has the hulls of `before`. False: no room.
    bool (*keep_hulls)(WorldRows&, Row<Structures> now, Row<Structures> before) = nullptr;
    void (*clear_run)(WorldRows&, Row<Structures>, RunTraces) = nullptr;
    /// What a run on a part of it left moving stands still.
    void (*stop)(WorldRows&, Row<Structures>) = nullptr;
    /// It is the body's own from here on, without what only a task needs.
    void (*adopt)(WorldRows&, Row<Bodies>, Row<Structures>) = nullptr;
    /// Births are filled: measures what is left of a body, whose own it becomes. Hulls of cells that moved as they were
    /// are copied, to the pieces and here.
    void (*keep_rest)(WorldRows&, const Break&, const Fragments&) = nullptr;
    /// When all hulls are chosen: their points stand close together. `are_renewed`: of cells that changed alone.
    void (*pack_hulls)(WorldRows&, Row<Structures>, bool are_renewed) = nullptr;
};

/// By its kind.
const StructureCalls& calls_of(const Structures& structures, Row<Structures> structure);

inline ShapeKind shape_of(const Structures& structures, Row<Structures> structure) {
    return static_cast<ShapeKind>(structures.shape[structure]);
}

}  // namespace cullet
