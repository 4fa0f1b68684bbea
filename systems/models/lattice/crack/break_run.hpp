// A solid breaks under one blow: the state of the run, and its steps. A run may stop between any two steps and go on in
// a later frame; it allocates nothing, for its room follows from the solid.
#pragma once
#include <cstdint>
#include <span>

#include "systems/models/lattice/cook/breakable_solid.hpp"
#include "systems/models/lattice/crack/blow.hpp"
#include "systems/models/lattice/solve/cell_stress.hpp"
#include "systems/models/lattice/solve/inertia.hpp"

namespace cullet {

struct CrackRules {
    double level_weight = 0.1;  // w_0: how much a curved crack wants to be a plane
    double shield = 0.5;        // of a crack's reach: no other starts there in the same solve
    double least_cells = 6;     // mean cells: a smaller piece does not come off
    uint32_t most_cracks = 24;  // 0: the gate alone is wanted
    uint32_t most_rounds = 6, most_tries = 40;
    bool is_curved = true;  // false: along planes, which is quicker and plainer
    /// A load is more than it bears, as who weighed it says: it cracks where it is weakest, if anything of it is
    /// pulled.
    bool must_break = false;
};

enum class BreakStage : uint8_t { NextPiece, Assemble, Factor, Stress, Field, Crack, Done };

/// Of a cell, in `BreakRun::marks`.
enum CellMark : uint8_t { kSolved = 1, kCrushed = 2, kBanned = 4 };

struct BreakRun {
    BrittleSolid brittle;
    SolidBlow blow;
    CrackRules rules;
    BreakStage stage = BreakStage::Done;

    // Of the whole blow.
    HertzContact contact;
    double volume_before = 0;  // m3, of the body: all of the solid, or what earlier breaks left of it
    double patch = 0;          // m, radius
    double brought = 0;        // J, that the blow brings
    double share = 1;          // of the contact's force
    double gate = 0;           // the largest ratio of stress and strength before any crack: below 1 nothing breaks
    double first_crack = 0;    // share of the load at which the first one starts
    uint64_t work = 0;         // done so far
    uint32_t piece_count = 1, crack_count = 0, solve_count = 0, plane_count = 0;

    // By cell.
    std::span<uint32_t> piece;
    std::span<uint8_t> marks, side;
    std::span<Sym3d> stress;  // at the whole load
    std::span<double> first;  // its largest principal value
    std::span<double> trust;  // W: how sure the direction of a crack is
    std::span<Vec3d> direction;
    std::span<uint32_t> cells;       // of the piece at work, ascending
    std::span<uint32_t> part, open;  // where it falls apart; cells still to be looked at
    // By bond.
    std::span<uint32_t> sheet;  // of the crack at work
    std::span<uint8_t> is_sheet;
    uint32_t sheet_count = 0;
    // By patch.
    std::span<uint8_t> is_held;  // what stands on the ground does not give way there
    // By piece and part.
    std::span<double> volume;  // m3, of pieces
    std::span<double> part_volume, part_area;
    std::span<uint32_t> part_piece;
    struct Waiting {
        uint32_t piece = 0, round = 0;
    };
    std::span<Waiting> queue;
    uint32_t queue_first = 0, queue_end = 0;
    // The ways that signs spread.
    struct Step {
        double trust = 0;
        uint32_t cell = 0, from = 0;
    };
    std::span<Step> heap;
    uint32_t heap_count = 0;

    // The piece at work.
    uint32_t at_piece = 0, at_round = 0, cell_count = 0, next_element = 0, next_cell = 0, tries = 0;
    uint32_t cracks_before = 0, pieces_before = 1;
    bool has_ground = false;
    double load = 1;  // lambda: the share of the load that comes
    bool is_field_made = false;
    std::span<Moments> sums;
    std::span<double> loads, forces;  // by rank: loads become displacements
    std::span<double> weights, sorted, gathered;
    std::span<ElementGradient> gradients;
    Pins pins;
    Factor factor;
    Factor field;
    std::span<double> level;  // of the crack's scalar, by rank
};

/// Stress over strength, at the whole load.
inline double ratio_of(const BreakableSolid& body, const BreakRun& run, uint32_t cell) {
    return run.first[cell] / (run.brittle.tensile_strength * double{body.strength[cell]});
}
/// The force at which the first crack starts, N, however fast the blow is: both are linear. Infinite if nothing is
/// pulled.
inline double threshold_force(const BreakRun& run) {
    return run.contact.force * run.share / run.gate;
}
/// What comes of the load is enough to crack the cell, and nothing bars it.
inline bool may_start(const BreakableSolid& body, const BreakRun& run, uint32_t cell) {
    return !(run.marks[cell] & (kCrushed | kBanned)) && run.load * ratio_of(body, run, cell) > 1;
}

uint64_t break_bytes(const BreakableSolid& body);
/// No span is empty if the arena had break_bytes().
BreakRun take_break(Arena& arena, const BreakableSolid& body);

/// `held`: rows of the surface that cannot move; empty: the body is free. `own`: cells that the body has, of a solid
/// that broke before; empty: all. What others have is the piece of number body.part_count then, of no volume.
void begin_break(const BreakableSolid& body, const BrittleSolid& brittle, const SolidBlow& blow,
                 const CrackRules& rules, std::span<const uint8_t> held, BreakRun& run,
                 std::span<const uint8_t> own = {});
/// True: it is done. Returns after about so many multiplications.
bool advance_break(const BreakableSolid& body, BreakRun& run, uint64_t work);

}  // namespace cullet
