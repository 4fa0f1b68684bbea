// A working copy of the neighbourhood of a hit, for bodies that are too large to be copied whole: what a hit costs then
// goes with its region and not with the body.
#pragma once
#include <string>

#include "engine/events.hpp"
#include "systems/models/thick_shell/shared/body_motion.hpp"
#include "systems/structures/shell/rest_of_body.hpp"
#include "systems/world_data.hpp"

namespace cullet {

/// Hidden ones of more: a cut-out has kWholeCopyVertices at first (thick shell note, 6.2), and is at most half of a
/// body.
inline constexpr uint32_t kWholeHiddenVertices = 2 * kWholeCopyVertices;

/// Bodies of so many vertices and this kind of fracture have a shell of their own for cut-outs: cracks of large
/// fracture do not stay near the hit.
bool is_for_cut_outs(const ShellRows& state, Row<Structures> shell, bool is_quick);

/// Whether hits on the body may run on cut-outs: it is for them, has its shell to itself, and rows to spare for what
/// cracks add.
bool may_cut_out(const BodyRows& state, Row<Bodies> body);

inline bool is_cut_out(Tables<const HiddenRuns> state, uint32_t task) {
    return state.hidden_runs.cut_elements[task] > 0;
}

/// Rings round the patches, or what the hidden run may have: whole rings until there are so many vertices.
struct CutOutSize {
    uint32_t rings = kNone, vertices = kNone;
};
/// Rings next to the border of a cut-out in which nothing may be cut.
inline constexpr uint32_t kCutOutBorderRings = 5;

enum class CutOutResult : uint8_t { Reserved, TooWide, NoRoom };

/// Takes rows for the neighbourhood of the task's contacts and lists its elements. TooWide: it is more than half of the
/// body. Serial; fill_cut_out follows in the same step.
CutOutResult reserve_cut_out(RunRows& state, Row<Tasks> task, const CutOutSize& size, const char** full);
/// Before a second fill_cut_out, of a run that begins again: what the first one found in scratch.
void list_cut_out(RunRows& state, Row<Tasks> task);
/// Copies the rows. The edges on the border of the cut-out are borders in it.
void fill_cut_out(RunRows& state, Row<Tasks> task);

/// What put_back needs in scratch, from State: after a load, in the middle of a run.
void remember_cut_out(RunRows& state, Row<Tasks> task);

/// Writes what the run changed into the body's shell, gives the cut-out back and makes the body's shell the task's, as
/// it was where nothing broke or the run is dropped. Vertices.velocity is then what pieces start with, in the blocks
/// that move (VertexBlocks::moves); all other vertices move by `motion`, the body's own. Tells of each new start of a
/// crack. Serial.
void put_back(BodyRows& state, Row<Tasks> task, const BodyMotion& motion, Events<CrackStartedEvent>& cracks);

/// Empty, or what is wrong with the rows of a cut-out that came from a file.
std::string trouble_of_cut_out(RunRows& state, uint32_t task);

}  // namespace cullet
