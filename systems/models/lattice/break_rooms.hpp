// What breaks of solids work in: what follows from a cooked solid, and a few rooms for runs. Made when something that
// may break comes into a world or a world is loaded, never in a frame.
#pragma once
#include <optional>
#include <vector>

#include "components/lattice.hpp"
#include "engine/room.hpp"
#include "systems/models/lattice/cook/breakable_solid.hpp"
#include "systems/models/lattice/cook/lattice_points.hpp"
#include "systems/models/lattice/crack/break_run.hpp"
#include "systems/models/lattice/crack/crack_faces.hpp"
#include "systems/structures/tetrahedra/solid_rooms.hpp"

namespace cullet::lattice {

/// Of one cooked solid.
struct Breakable {
    BreakableSolid body;
    LatticePoints points;
};

enum class RunStage : uint8_t { Solve, Faces, Cut, Skins, Hulls, Done };

/// Of one run.
struct RoomOfRun {
    RoomOfRun(uint64_t bytes, uint64_t bytes_of_lists)
        : arena(bytes), lists(bytes_of_lists), run_bytes(bytes), list_bytes(bytes_of_lists) {}
    ~RoomOfRun() { forget_lists(); }
    RoomOfRun(const RoomOfRun&) = delete;
    RoomOfRun& operator=(const RoomOfRun&) = delete;
    /// What stands among the lists, if a run was cancelled there.
    void forget_lists() {
        const RoomScope scope(lists, RoomScope::GoesOn());
        cut.reset(), halving.reset();
    }
    Arena arena;
    Room lists;  // of the cut, and of hulls
    uint64_t run_bytes, list_bytes;
    RunStage stage = RunStage::Done;
    BreakRun run;
    CrackFaces faces;
    std::vector<uint8_t> own;   // by cell: the body has it
    std::vector<uint8_t> held;  // by patch: pins hold it; empty: none do
    std::vector<uint32_t> labels;
    std::optional<PieceCut> cut;
    std::optional<ConvexHalving> halving;
    uint32_t piece_count = 0;
    uint32_t piece = 0;  // whose skin comes next, and then whose hulls
};

/// Makes ready for breaks of this structure.
void prepare_rooms(Read<LatticeRows> rows, Row<Structures> structure);
/// The task's run begins, in the room that the task has taken: its blow stands in LatticeRuns.
void begin_run(Read<LatticeRows> rows, Row<Tasks> task);
/// One step of the task's run, which changes nothing but its room. True: it is done. `units`: what it cost beyond
/// kUnitsAStep.
bool advance_run(Read<LatticeRows> rows, Row<Tasks> task, uint64_t& units);

/// Whether pins of the body hold anything of it.
bool is_pinned_anywhere(Read<LatticeRows> rows, Row<Bodies> body);

const RoomOfRun& run_of(Read<LatticeRows> rows, Row<Tasks> task);

}  // namespace cullet::lattice
