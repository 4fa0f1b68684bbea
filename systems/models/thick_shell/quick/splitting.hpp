// One step's splits of a region.
#pragma once
#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/quick/region.hpp"
#include "systems/models/thick_shell/stiffness/refresh.hpp"
#include "systems/structures/shell/cut_ends.hpp"

namespace cullet {

struct Split {
    bool is_cut = false;
    Ends ends;
};

struct Splitting {
    RegionView region;
    FractureKind kind;
    float bump_angle;  // rad
    float run_length;  // m, how far from where it started a crack runs on; 0: not at all
    uint32_t step;     // of the run
    Touched touched{kStiffnessRepair};
    uint32_t cut_edges = 0, starts = 0;
    bool is_full = false;          // no room for more
    bool are_springs_old = false;  // there was none for the springs of what was cut: those there are hold on

    RunRows& state() const { return region.state; }
    const ShellView& shell() const { return region.shell; }
    uint32_t row(uint32_t v) const { return region.shell.vertex(v); }
    Vec3 rest(uint32_t v) const { return region.state.vertices.rest[row(v)]; }
    bool is_tip(uint32_t v) const {
        return region.state.vertices.crack[row(v)] == static_cast<uint8_t>(CrackState::Tip);
    }
};

/// Springs, masses and bounds of what changed in the region; the rest has none.
void flush(Splitting& s);

/// Rules 1 to 6 of C3 after the re-meshing of C5. A fan of one element, and a plane that has all of the ring on one
/// side, split nothing. Ends that were interior are tips then, of the crack that began at `root`.
Split split_along(Splitting& s, uint32_t vertex, Vec3 normal, uint32_t root);

/// C4, coarse: springs at the vertex, its copies from `first_copy` on and its neighbours crack no more, but those of
/// the crack's ends do.
void close_neighbours(const Splitting& s, uint32_t vertex, const Ends& ends, uint32_t first_copy);

}  // namespace cullet
