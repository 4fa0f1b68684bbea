// What a system and its helpers may not do. No program is made of this: forbidden_test compiles it, and the compiler
// must refuse each line that is marked, and no other.
#include "components/state.hpp"
#include "engine/frame_plan.hpp"

namespace cullet {

struct Nearby {
    Debris& debris;
    const Blows& blows;
};
struct Heard {
    Blows& blows;
};

void helper(ShellRows& rows, const MaterialRows& materials, Nearby near) {
    rows.cells.shape[0] = 1;
    near.debris.is_used[0] = near.blows.size() > 0;
    rows.bodies.is_asleep[Row<Bodies>(0)] = 1;  // forbidden: what edits shells reaches no bodies
    materials.materials.append(1);              // forbidden: materials are read
    near.blows.append(1);                       // forbidden: a table that is read
    rows.tasks.append(1);                       // forbidden: nor does it reach tasks
    RunRows& runs = rows;                       // forbidden: a set of tables does not grow
    State& state = rows;                        // forbidden: least of all to all of them
    narrow<Heard>(near);                        // forbidden: a narrower group writes to no more
}

void metal_helper(MetalRows rows, Read<SolidRows> solids) {
    rows.metal_shells.mean_edge[0] = 1;
    rows.quick_runs.append(1);                      // forbidden: metal reaches no runs of the thick shell
    rows.cooked_solids.append(1);                   // forbidden: nor solids
    solids.solids.append(1);                        // forbidden: a list that is read
    Tables<Solids> more = solids;                   // forbidden: nor does it become one that is written
    Tables<const Solids, const Cells> less = rows;  // forbidden: a list gives what it holds
}
void lattice_helper(LatticeRows rows) {
    rows.lattice_results.pieces[0] = 1;
    rows.vertices.append(1);   // forbidden: what breaks solids reaches no shell
    rows.springs.append(1);    // forbidden: nor springs
    MetalTables metal = rows;  // forbidden: nor metal
}

void falls(Rows<Debris>, InOut<&Debris::position> position, In<&Debris::mass> mass, Step step);
void counts_all(Rows<Debris>, Debris& debris);
void looks_around(Rows<Debris>, Out<&Debris::position> position, In<&Debris::position> others);
void looks_at_all(Rows<Debris>, Out<&Debris::position> position, const Debris& debris);
void never_called(const Debris& debris);
void hears_of_it(Serial, Debris& debris, const Blows& blows);

constexpr bool kFalls = Signature<decltype(&falls)>::kHasTwoSided;
constexpr bool kHears = Signature<decltype(&hears_of_it)>::kHasTwoSided;
constexpr bool kCounts = Signature<decltype(&counts_all)>::kHasTwoSided;   // forbidden: many threads change one table
constexpr bool kLooks = Signature<decltype(&looks_around)>::kHasTwoSided;  // forbidden: rows read what others write
constexpr bool kLooksAll = Signature<decltype(&looks_at_all)>::kHasTwoSided;  // forbidden: nor do they read tables
constexpr bool kCalled = Signature<decltype(&never_called)>::kHasTwoSided;  // forbidden: nothing says whose call it is

void kernel(Rows<Debris>, InOut<&Debris::position> position, In<&Debris::mass> mass) {
    position[0] = {};
    mass[0] = 0;  // forbidden: a column that is read
}

}  // namespace cullet
