// A working copy of the neighbourhood of a hit, for bodies that are too large to be copied whole: what a hit costs then
// goes with its region and not with the body.
#pragma once
#include <string>

#include "engine/events.hpp"
#include "systems/quick/region_motion.hpp"
#include "systems/world_data.hpp"

namespace cullet {

/// Quick bodies of more vertices have a shell of their own from the start and are hit on cut-outs of it. A whole copy
/// of so many rows takes 0.4 ms.
inline constexpr uint32_t kWholeCopyVertices = 4000;

/// Whether hits on the body may run on cut-outs: it is quick and large, has its shell to itself with rows to spare for
/// what cracks add, and its cracks stay near the hit, which those of large fracture do not.
bool may_cut_out(const State& state, Row<Bodies> body);

inline bool is_cut_out(const State& state, uint32_t task) {
    return is_quick_task(state, task) && state.quick_runs.cut_elements[task] > 0;
}

enum class CutOutResult : uint8_t { Reserved, TooWide, NoRoom };

/// Takes rows for the neighbourhood of the task's contacts and lists its elements: all that the region can wake, and so
/// many rings round it that no cut changes the outermost elements. TooWide: it is more than half of the body. Serial;
/// fill_cut_out follows in the same step.
CutOutResult reserve_cut_out(State& state, Row<Tasks> task, const char** full);
/// Copies the rows. The edges on the border of the cut-out are borders in it.
void fill_cut_out(State& state, Row<Tasks> task);

/// Of a quick run's copy: packs that cracks will begin are read whole. Rows to spare of its other tables are written
/// when they are taken.
void clear_spare_vertices(const ShellView& copy);

/// Writes what the run changed into the body's shell, gives the cut-out back and makes the body's shell the task's, as
/// it was where nothing broke or the run is dropped. Vertices.velocity is then what pieces start with: outside of the
/// cut-out that of the body's own motion. Tells of each new start of a crack. Serial.
void put_back(State& state, Row<Tasks> task, const BodyMotion& motion, Events<CrackStartedEvent>& cracks);

/// Empty, or what is wrong with the rows of a cut-out that came from a file.
std::string trouble_of_cut_out(State& state, uint32_t task);

}  // namespace cullet
