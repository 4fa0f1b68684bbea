#include "systems/models/lattice/crack/crack_level.hpp"

#include <algorithm>

#include "systems/models/lattice/solve/principal_stress.hpp"

namespace cullet {
namespace {

constexpr double kHoldMean = 1e-6;  // of the diagonal: parts of the field that hang on nothing keep to the plane
constexpr double kUnsure = 1e-3;    // trust below which a cell takes most of its neighbour's direction
constexpr double kNeighbour = 3;    // times its own

// The surest is on top; of equal ones the lower cell, then the lower neighbour.
bool is_below(const BreakRun::Step& p, const BreakRun::Step& q) {
    if (p.trust != q.trust) return p.trust < q.trust;
    if (p.cell != q.cell) return p.cell > q.cell;
    return p.from > q.from;
}

void push_neighbours(const BreakableSolid& body, BreakRun& run, uint32_t cell) {
    for (const uint32_t b : body.paths.of_cell(cell)) {
        const SolidBond& bond = body.solid.bonds[b];
        const uint32_t other = bond.a == cell ? bond.b : bond.a;
        if (run.side[other] != 0 || run.piece[other] != run.piece[cell]) continue;
        const double along = std::fabs(dot(run.direction[cell], run.direction[other]));
        run.heap[run.heap_count++] = {along * run.trust[other], other, cell};
        std::push_heap(run.heap.begin(), run.heap.begin() + run.heap_count, is_below);
    }
}

// From cell to cell, the surest first, directions get the sign of the one they come from. `side` marks who has been
// met.
void agree_on_signs(const BreakableSolid& body, BreakRun& run, uint32_t start) {
    std::fill(run.side.begin(), run.side.end(), uint8_t{0});
    run.heap_count = 0;
    run.side[start] = 1;
    push_neighbours(body, run, start);
    while (run.heap_count > 0) {
        std::pop_heap(run.heap.begin(), run.heap.begin() + run.heap_count, is_below);
        const BreakRun::Step step = run.heap[--run.heap_count];
        if (run.side[step.cell] != 0) continue;
        run.side[step.cell] = 1;
        const Vec3d from = run.direction[step.from];
        Vec3d& own = run.direction[step.cell];
        if (dot(own, from) < 0) own = -own;
        if (run.trust[step.cell] < kUnsure) own = normalised(own + kNeighbour * from);
        push_neighbours(body, run, step.cell);
    }
}

}  // namespace

void find_directions(BreakRun& run) {
    const double strength = run.brittle.tensile_strength;
    for (uint32_t i = 0; i < run.cell_count; ++i) {
        const uint32_t c = run.cells[i];
        const PrincipalStress p = principal_stress(run.stress[c]);
        const double lead = run.load * (p.first - std::max(p.second, 0.0)) / strength;
        run.trust[c] = p.first > 0 ? std::min(1.0, lead * lead) : 0;
        run.direction[c] = first_direction(run.stress[c], p);
    }
}

bool factor_field(const BreakableSolid& body, BreakRun& run, uint64_t work) {
    Factor& field = run.field;
    const EliminationPlan& plan = body.field.plan;
    if (!run.is_field_made) {
        run.is_field_made = true;
        clear_factor(field);
        for (uint32_t i = 0; i < run.cell_count; ++i) {
            const CrackFieldCell& cell = body.field.cells[run.cells[i]];
            const double weight =
                body.solid.cells[run.cells[i]].volume * (run.trust[run.cells[i]] + run.rules.level_weight);
            for (uint32_t a = 0, at = 0; a < 4; ++a) {
                field.is_used[cell.rank[a]] = 1;
                for (uint32_t b = 0; b <= a; ++b, ++at)
                    field.entries[cell.entries[at]] +=
                        weight * dot(cell.gradient[a], cell.gradient[b]) * (a == b ? 1 + kHoldMean : 1);
            }
        }
    }
    return advance_factor(plan, field, work);
}

void part_by_level(const BreakableSolid& body, BreakRun& run, uint32_t start) {
    const Vec3d normal = run.direction[start], middle = body.solid.cells[start].centroid;
    agree_on_signs(body, run, start);
    std::fill(run.level.begin(), run.level.end(), 0.0);
    for (uint32_t i = 0; i < run.cell_count; ++i) {
        const uint32_t c = run.cells[i];
        if (run.piece[c] != run.piece[start]) continue;
        const CrackFieldCell& cell = body.field.cells[c];
        const Vec3d pull = body.solid.cells[c].volume * run.trust[c] * (run.direction[c] - normal);
        for (uint32_t a = 0; a < 4; ++a) run.level[cell.rank[a]] += dot(pull, cell.gradient[a]);
    }
    solve_with(body.field.plan, run.field, run.level, run.gathered);
    const auto level_of = [&](uint32_t c) {
        const CrackFieldCell& cell = body.field.cells[c];
        double sum = dot(normal, body.solid.cells[c].centroid - middle);
        for (uint32_t a = 0; a < 4; ++a) sum += cell.centroid[a] * run.level[cell.rank[a]];
        return sum;
    };
    const double own = level_of(start);
    for (uint32_t i = 0; i < run.cell_count; ++i) run.side[run.cells[i]] = level_of(run.cells[i]) >= own;
}

void part_by_plane(const BreakableSolid& body, BreakRun& run, uint32_t start, Vec3d normal) {
    const Vec3d middle = body.solid.cells[start].centroid;
    for (uint32_t i = 0; i < run.cell_count; ++i)
        run.side[run.cells[i]] = dot(normal, body.solid.cells[run.cells[i]].centroid - middle) >= 0;
}

}  // namespace cullet
