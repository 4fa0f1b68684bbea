#include "systems/models/lattice/crack/solve_piece.hpp"

#include <algorithm>

namespace cullet {
namespace {

constexpr uint32_t kNoPatch = 0xffffffffu;
constexpr double kBed = 100;          // of E / a: what a held patch stands on
constexpr uint32_t kFewestCells = 4;  // of a piece that is solved
constexpr double kForcePower = 0.6;   // of the mass, in Hertz' force

double weight_of(const BreakRun& run, const SurfacePatch& patch) {
    const Vec3d from = patch.centroid - run.blow.point;
    const double share = 1 - dot(from, from) / (run.patch * run.patch);
    return share > 0 ? patch.area * std::sqrt(share) : 0;
}

// Of those that the body has; kNoPatch: none.
uint32_t nearest_patch(const BreakableSolid& body, const BreakRun& run, Vec3d point) {
    double nearest = 1e300;
    uint32_t best = kNoPatch;
    for (uint32_t i = 0; i < body.solid.patches.size(); ++i) {
        if (run.piece[body.solid.patches[i].cell] >= body.part_count) continue;
        const Vec3d from = body.solid.patches[i].centroid - point;
        if (dot(from, from) < nearest) nearest = dot(from, from), best = i;
    }
    return best;
}

Vec3d impulse_on(const BreakableSolid& body, const BreakRun& run, uint32_t patch) {
    const SurfacePatch& p = body.solid.patches[patch];
    return run.blow.blast.impulse(p.centroid, body.patch_normals[patch], p.area);
}

// Pressure on all that faces it: a piece of the body gets no less of it than the whole.
bool lay_blast(const BreakableSolid& body, BreakRun& run) {
    const auto& patches = body.solid.patches;
    const double scale = run.share / run.blow.blast.duration();
    bool is_any = false;
    for (uint32_t i = 0; i < patches.size(); ++i) {
        if (run.piece[patches[i].cell] != run.at_piece) continue;
        const Vec3d impulse = impulse_on(body, run, i);
        if (!(dot(impulse, impulse) > 0)) continue;
        is_any = true;
        add_force(body.elements, body.elements.patches[i], scale * impulse, run.loads);
    }
    return is_any;
}

bool lay_blow(const BreakableSolid& body, BreakRun& run, double force) {
    if (run.blow.blast.radius > 0) return lay_blast(body, run);
    const double sum = weight_of(body, run, run.at_piece);
    if (!(sum > 0)) return false;
    const auto& patches = body.solid.patches;
    for (uint32_t i = 0; i < patches.size(); ++i) {
        if (run.piece[patches[i].cell] != run.at_piece) continue;
        if (const double weight = weight_of(run, patches[i]); weight > 0)
            add_force(body.elements, body.elements.patches[i], force * weight / sum * run.blow.push, run.loads);
    }
    return true;
}

// Springs under each held patch: shape times shape, the same in all directions.
void add_bed(const BreakableSolid& body, BreakRun& run) {
    const double stiffness = kBed * run.brittle.elastic.young / body.solid.lattice.edge;
    for (uint32_t i = 0; i < run.is_held.size(); ++i) {
        if (!run.is_held[i] || run.piece[body.solid.patches[i].cell] != run.at_piece) continue;
        run.has_ground = true;
        const ElementPlace& at = body.elements.patches[i];
        const std::array<double, 10> shape = shapes_at(at.at);
        for (uint32_t a = 0; a < 10; ++a)
            for (uint32_t b = 0; b <= a; ++b) {
                double* block =
                    run.factor.entries.data() + size_t{body.elements.entries[at.element][pair_of(a, b)]} * 9;
                const double value = stiffness * body.solid.patches[i].area * shape[a] * shape[b];
                for (uint32_t k = 0; k < 3; ++k) block[k * 4] += value;
            }
    }
}

bool lay_loads(const BreakableSolid& body, BreakRun& run) {
    if (run.cell_count < kFewestCells) return false;
    const std::span<const uint32_t> cells = run.cells.first(run.cell_count);
    const PieceMass mass = mass_of(body.elements, cells, run.brittle.density);
    std::fill(run.loads.begin(), run.loads.end(), 0.0);
    const double part_of_force = power(mass.mass / (run.brittle.density * run.volume_before), kForcePower);
    if (!lay_blow(body, run, run.contact.force * run.share * part_of_force)) return false;
    run.has_ground = false;
    add_bed(body, run);
    if (run.has_ground) return true;
    if (!(determinant(mass.inertia) > 0)) return false;
    relieve(body.elements, cells, run.brittle.density, mass, run.blow.spin, run.loads);
    weigh_nodes(body.elements, run.sums, run.weights);
    if (!choose_pins(body.elements, run.factor, run.weights, mass.centre, run.sorted, run.pins)) return false;
    hold(body.elements.plan, run.pins, run.factor);
    hold(run.pins, run.loads);
    return true;
}

void displace(const BreakableSolid& body, BreakRun& run) {
    ++run.solve_count;
    std::copy(run.loads.begin(), run.loads.end(), run.forces.begin());
    solve_with(body.elements.plan, run.factor, run.loads, run.gathered);
    differentiate(body.elements, run.sums, run.loads, run.gradients);
}

// Half of the work of all loads: blow, inertia, and nothing at pins.
double strain_energy(const BreakRun& run) {
    double energy = 0;
    for (size_t i = 0; i < run.loads.size(); ++i)
        if (run.factor.is_used[i / 3]) energy += 0.5 * run.loads[i] * run.forces[i];
    return energy;
}

}  // namespace

void move_to_surface(const BreakableSolid& body, BreakRun& run) {
    for (uint32_t p = 0; p < body.part_count; ++p)
        if (weight_of(body, run, p) > 0) return;
    const uint32_t nearest = nearest_patch(body, run, run.blow.point);
    if (nearest != kNoPatch) run.blow.point = body.solid.patches[nearest].centroid;
}

void measure_blast(const BreakableSolid& body, BreakRun& run) {
    const double wall = 0.5 * run.brittle.density * body.solid.thickness;  // kg/m2, that is pushed at first
    run.contact = {0, run.blow.blast.duration(), 0};
    run.brought = 0;
    for (uint32_t i = 0; i < body.solid.patches.size(); ++i) {
        if (run.piece[body.solid.patches[i].cell] >= body.part_count) continue;
        const Vec3d impulse = impulse_on(body, run, i);
        run.contact.force += length(impulse) / run.contact.duration;
        run.brought += 0.5 * dot(impulse, impulse) / (wall * body.solid.patches[i].area);
    }
    run.patch = 0;
}

double weight_of(const BreakableSolid& body, const BreakRun& run, uint32_t piece) {
    double sum = 0;
    if (run.blow.blast.radius > 0) {
        for (uint32_t i = 0; i < body.solid.patches.size(); ++i)
            if (run.piece[body.solid.patches[i].cell] == piece) sum += length(impulse_on(body, run, i));
        return sum;
    }
    for (const SurfacePatch& patch : body.solid.patches)
        if (run.piece[patch.cell] == piece) sum += weight_of(run, patch);
    return sum;
}

void list_cells(BreakRun& run) {
    run.cell_count = run.next_element = run.next_cell = run.tries = 0;
    run.cracks_before = run.crack_count;
    run.is_field_made = false;
    for (uint32_t c = 0; c < run.piece.size(); ++c) {
        run.marks[c] = 0;
        if (run.piece[c] != run.at_piece) continue;
        run.marks[c] = kSolved;
        run.cells[run.cell_count++] = c;
    }
}

bool assemble_some(const BreakableSolid& body, BreakRun& run, uint64_t work, bool& is_loaded) {
    const uint32_t count = static_cast<uint32_t>(body.elements.elements.size());
    if (run.next_element == 0) {
        clear_factor(run.factor);
        sum_moments(body.elements, run.cells.first(run.cell_count), run.sums);
    }
    const uint32_t end = static_cast<uint32_t>(std::min<uint64_t>(count, run.next_element + work / kElementWork + 1));
    add_stiffness(body.elements, run.sums, run.brittle.elastic, run.next_element, end, run.factor);
    run.next_element = end;
    if (end < count) return false;
    is_loaded = lay_loads(body, run);
    return true;
}

bool find_some_stress(const BreakableSolid& body, BreakRun& run, uint64_t work) {
    if (run.next_cell == 0) {
        displace(body, run);
        if (run.solve_count == 1) run.share = force_share(run.brought, strain_energy(run));
    }
    // Loads were laid with the contact's whole force in the first solve, and with the share of it afterwards.
    const double scale = run.solve_count == 1 ? run.share : 1;
    const uint32_t end =
        static_cast<uint32_t>(std::min<uint64_t>(run.cell_count, run.next_cell + work / kCellWork + 1));
    for (; run.next_cell < end; ++run.next_cell) {
        const uint32_t c = run.cells[run.next_cell];
        const CellStress most = largest_stress(body.elements, run.gradients, c, run.brittle.elastic);
        run.stress[c] = scale * most.stress;
        run.first[c] = scale * most.first;
        if (length(body.solid.cells[c].centroid - run.blow.point) < run.patch) run.marks[c] |= kCrushed;
    }
    return end == run.cell_count;
}

}  // namespace cullet
