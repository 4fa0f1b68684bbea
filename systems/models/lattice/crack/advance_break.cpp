#include <algorithm>

#include "systems/models/lattice/crack/begin_pieces.hpp"
#include "systems/models/lattice/crack/break_run.hpp"
#include "systems/models/lattice/crack/crack_level.hpp"
#include "systems/models/lattice/crack/crack_sheet.hpp"
#include "systems/models/lattice/crack/solve_piece.hpp"

namespace cullet {
namespace {

constexpr uint32_t kNoCell = 0xffffffffu;
constexpr double kLoadRatio = 2.5;      // of stress and strength under a load that is too much
constexpr double kLeastSolved = 2;      // times the least piece: a smaller one breaks no more
constexpr double kDurationPower = 0.4;  // of the mass, in Hertz' duration

// What stages take, in multiplications that are not made side by side (half a nanosecond each): a cell that is listed,
// laid into the field of a crack, a place of a load, a bond that a crack looks at. Factors make more at once.
constexpr uint64_t kCellListed = 6, kFieldWork = 60, kLoadWork = 20, kBondWork = 12, kProductsAWork = 3;

double least_volume(const BreakableSolid& body, const BreakRun& run) {
    return kLeastSolved * run.rules.least_cells * body.solid.volume / static_cast<double>(body.solid.cells.size());
}

// The weakest of the cells that may start a crack, or none.
uint32_t weakest(const BreakableSolid& body, const BreakRun& run) {
    uint32_t best = kNoCell;
    double most = 0;
    for (uint32_t i = 0; i < run.cell_count; ++i) {
        const uint32_t c = run.cells[i];
        if (run.marks[c] & (kCrushed | kBanned)) continue;
        if (run.volume[run.piece[c]] < least_volume(body, run)) continue;
        if (const double ratio = ratio_of(body, run, c); ratio > most) most = ratio, best = c;
    }
    return best;
}

void take_next_piece(BreakRun& run) {
    const bool is_enough = run.crack_count > 0 && run.crack_count >= run.rules.most_cracks;
    if (run.queue_first == run.queue_end || is_enough) {
        run.stage = BreakStage::Done;
        return;
    }
    const BreakRun::Waiting next = run.queue[run.queue_first++];
    run.at_piece = next.piece, run.at_round = next.round;
    list_cells(run);
    run.stage = BreakStage::Assemble;
}

// The pieces that the one at work has fallen into are solved again.
void close_piece(const BreakableSolid& body, BreakRun& run) {
    run.stage = BreakStage::NextPiece;
    if (run.crack_count == run.cracks_before || run.at_round + 1 >= run.rules.most_rounds) return;
    for (uint32_t p = 0; p < run.piece_count; ++p) {
        if (p != run.at_piece && p < run.pieces_before) continue;
        if (run.volume[p] >= least_volume(body, run) && run.queue_end < run.queue.size())
            run.queue[run.queue_end++] = {p, run.at_round + 1};
    }
}

void decide_on_cracks(const BreakableSolid& body, BreakRun& run) {
    const uint32_t c = weakest(body, run);
    double ratio = c == kNoCell ? 0 : ratio_of(body, run, c);
    if (run.rules.must_break && run.at_round == 0 && ratio > 0 && ratio < kLoadRatio) {
        run.brittle.tensile_strength *= ratio / kLoadRatio;
        ratio = kLoadRatio;
    }
    if (run.at_round == 0 && ratio > run.gate) {
        run.gate = ratio;
        run.first_crack = 1 / ratio;
    }
    run.pieces_before = run.piece_count;
    if (!(ratio >= 1) || run.crack_count >= run.rules.most_cracks) {
        run.stage = BreakStage::NextPiece;
        return;
    }
    const double volume = run.volume[run.at_piece];
    const double duration = run.contact.duration / run.share * power(volume / run.volume_before, kDurationPower);
    run.load = run.rules.must_break ? 1 : load_share(ratio, duration, volume, run.brittle);
    find_directions(run);
    run.stage = run.rules.is_curved ? BreakStage::Field : BreakStage::Crack;
}

void try_crack(const BreakableSolid& body, BreakRun& run) {
    const uint32_t c = weakest(body, run);
    if (c == kNoCell || !(run.load * ratio_of(body, run, c) > 1) || run.tries++ >= run.rules.most_tries ||
        run.crack_count >= run.rules.most_cracks) {
        close_piece(body, run);
        return;
    }
    // The cell that starts a crack is on its far side, whichever way axes run.
    if (dot(run.direction[c], body.solid.cells[c].centroid - run.blow.point) < 0) run.direction[c] = -run.direction[c];
    const Vec3d normal = run.direction[c];
    bool is_broken = false;
    if (run.rules.is_curved) {
        part_by_level(body, run, c);
        is_broken = break_sheet(body, run, c);
    }
    if (!is_broken) {
        part_by_plane(body, run, c, normal);
        is_broken = break_sheet(body, run, c);
        run.plane_count += is_broken;
    }
    run.marks[c] |= kBanned;
    if (!is_broken) return;
    ++run.crack_count;
    shield(body, run, c);
}

// At most about so much of the stage at work. Returns what it was, by counts of what it looked at.
uint64_t work_stage(const BreakableSolid& body, BreakRun& run, uint64_t work) {
    const uint64_t cells = run.cell_count, bonds = body.solid.bonds.size();
    switch (run.stage) {
        case BreakStage::NextPiece:
            take_next_piece(run);
            return kCellListed * run.piece.size();
        case BreakStage::Assemble: {
            bool is_loaded = false;
            const uint64_t before = run.next_element, loads = before == 0 ? kLoadWork * run.loads.size() : 0;
            if (assemble_some(body, run, work, is_loaded))
                run.stage = is_loaded ? BreakStage::Factor : BreakStage::NextPiece;
            return kElementWork * (run.next_element - before) + loads;
        }
        case BreakStage::Factor: {
            const uint64_t before = run.factor.work;
            if (advance_factor(body.elements.plan, run.factor, work * kProductsAWork))
                run.stage = run.factor.is_positive ? BreakStage::Stress : BreakStage::NextPiece;
            return (run.factor.work - before) / kProductsAWork + 1;
        }
        case BreakStage::Stress: {
            const uint64_t before = run.next_cell, solve = before == 0 ? run.factor.next_value : 0;
            if (find_some_stress(body, run, work)) decide_on_cracks(body, run);
            return kCellWork * (std::max<uint64_t>(run.next_cell, before) - before) + solve;
        }
        case BreakStage::Field: {
            const uint64_t before = run.is_field_made ? run.field.work : 0;
            const uint64_t laid = run.is_field_made ? 0 : kFieldWork * cells;
            if (factor_field(body, run, work * kProductsAWork)) run.stage = BreakStage::Crack;
            return (run.field.work - before) / kProductsAWork + laid + 1;
        }
        case BreakStage::Crack:
            try_crack(body, run);
            return kBondWork * bonds + kCellListed * cells;
        case BreakStage::Done:
            break;
    }
    return 0;
}

}  // namespace

void begin_break(const BreakableSolid& body, const BrittleSolid& brittle, const SolidBlow& blow,
                 const CrackRules& rules, std::span<const uint8_t> held, BreakRun& run, std::span<const uint8_t> own) {
    run.brittle = brittle, run.blow = blow, run.rules = rules;
    run.contact = hertz_contact(blow, brittle.elastic);
    run.work = 0;
    run.share = 1, run.gate = 0, run.first_crack = 0;
    begin_pieces(body, own, run);
    run.patch = patch_radius(run.contact, brittle, body.solid.lattice.edge, run.volume_before);
    run.brought = 0.5 * blow.effective_mass * blow.speed * blow.speed;
    for (uint32_t i = 0; i < run.is_held.size(); ++i) run.is_held[i] = held.empty() ? 0 : held[i];
    blow.blast.radius > 0 ? measure_blast(body, run) : move_to_surface(body, run);
    run.queue_first = run.queue_end = 0;
    for (uint32_t p = 0; p < body.part_count; ++p)
        if (weight_of(body, run, p) > 0) run.queue[run.queue_end++] = {p, 0};
    run.stage = run.contact.force > 0 ? BreakStage::NextPiece : BreakStage::Done;
}

bool advance_break(const BreakableSolid& body, BreakRun& run, uint64_t work) {
    const uint64_t end = run.work + work;
    while (run.stage != BreakStage::Done && run.work < end) run.work += work_stage(body, run, end - run.work);
    return run.stage == BreakStage::Done;
}

}  // namespace cullet
