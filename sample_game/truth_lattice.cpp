// What theory says of solids: stress, loads, cracks, pieces (lattice fracture note, section 14; solid cooking note,
// section 10).
#include <algorithm>
#include <cmath>
#include <map>

#include "engine/random.hpp"
#include "engine/table.hpp"
#include "sample_game/elastic_solve.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/truth_cases.hpp"
#include "systems/models/lattice/crack/break_run.hpp"
#include "systems/structures/tetrahedra/cook/cut_pieces.hpp"

namespace cullet {
namespace {

constexpr ElasticSolid kStone{10e9, 0.2};
constexpr BrittleSolid kBrick{{12e9, 0.18}, 1900, 2.5e6, 25e6};
const Vec3d kBar{0.2, 0.05, 0.05}, kBrickHalf{0.12, 0.035, 0.0575};  // half extents, m

CookedSolid cooked_box(Vec3d half, double cells, uint32_t element_edges) {
    SolidSettings settings;
    settings.cells = cells, settings.element_edges = element_edges;
    Result<CookedSolid> cooked = cook_solid(make_box(half.to_float()), settings);
    CULLET_ASSERT(cooked.ok(), "a box is no solid");
    return std::move(cooked).value();
}

// A displacement that is linear in the place: the stress is one everywhere, in cells that are cut as in whole ones.
std::vector<Verdict> patch_test() {
    double worst = 0, size = 1;
    for (const uint32_t edges : {2u, 4u}) {
        const CookedSolid cooked = cooked_box(kBar, 400, edges);
        const SolidElements elements = make_elements(cooked.solid);
        ElasticSolve solve(elements, kStone);
        solve.displacements.assign(elements.places.size() * 3, 0.0);
        for (uint32_t n = 0; n < elements.places.size(); ++n) {
            double* const u = solve.displacements.data() + size_t{elements.plan.rank[n]} * 3;
            u[0] = 1e-4 * elements.places[n].x + 3e-5 * elements.places[n].y;
            u[1] = 2e-4 * elements.places[n].y;
        }
        differentiate(elements, solve.sums, solve.displacements, solve.gradients);
        const double mu = kStone.shear(), sum = kStone.first_lame() * 3e-4;
        const Sym3d wanted{sum + 2e-4 * mu, sum + 4e-4 * mu, sum, mu * 3e-5, 0, 0};
        size = wanted.yy;
        for (const ElementPlace& probe : elements.probes) {
            const Sym3d off = stress_at(solve.gradients[probe.element], probe.at, kStone) - wanted;
            for (const double s : {off.xx, off.yy, off.zz, off.xy, off.xz, off.yz})
                worst = std::max(worst, std::fabs(s));
        }
    }
    return {{"worst stress off, of the largest (V4)", worst / size, 0, 1e-9}};
}

std::vector<Verdict> pushed_bar() {
    const CookedSolid cooked = cooked_box(kBar, 1500, 2);
    const SolidElements elements = make_elements(cooked.solid);
    ElasticSolve solve(elements, kStone);
    constexpr double kPush = 1e6;
    pull_face(solve, kBar, -1, [](Vec3d) { return Vec3d{kPush, 0, 0}; });
    const PieceMass mass = mass_of(elements, solve.cells, 2000);
    relieve(elements, solve.cells, 2000, mass, {}, solve.loads);
    const TotalLoad left = total_of(elements, solve.loads, mass.centre);
    solve.solve();
    double off = 0;
    for (const uint32_t c : solve.cells) {
        const ElementPlace& probe = elements.probes[elements.first_probe[c]];
        const double stress = stress_at(solve.gradients[probe.element], probe.at, kStone).xx;
        off += std::fabs(stress + kPush * 0.5 * (1 - cooked.solid.cells[c].centroid.x / kBar.x)) / kPush;
    }
    const double force = kPush * 4 * kBar.y * kBar.z;
    return {{"mean stress off, of F/b2 (V5)", off / static_cast<double>(solve.cells.size()), 0, 0.02},
            {"force left after inertia relief, of F", length(left.force) / force, 0, 1e-9},
            {"reaction of the pins, of F", solve.pin_reaction() / force, 0, 1e-9}};
}

std::vector<Verdict> bent_bar() {
    std::vector<Verdict> verdicts;
    for (const uint32_t edges : {2u, 4u}) {
        const CookedSolid cooked = cooked_box(kBar, 1500, edges);
        const SolidElements elements = make_elements(cooked.solid);
        ElasticSolve solve(elements, kStone);
        constexpr double kMost = 1e6;  // at y = half.y
        for (const double side : {1.0, -1.0})
            pull_face(solve, kBar, side, [&](Vec3d p) { return Vec3d{side * kMost * p.y / kBar.y, 0, 0}; });
        solve.solve();
        const double theory = kMost * kMost / (6 * kStone.young) * cooked.solid.volume;
        const std::string name = "elements of " + std::to_string(edges) + " a: ";
        verdicts.push_back({name + "energy over M2 L/(2 E I) (V7)", solve.energy() / theory, 0.95, 1.02});
        double most = 0;
        for (const uint32_t c : solve.cells)
            if (std::fabs(cooked.solid.cells[c].centroid.x) < 0.1) most = std::max(most, solve.stress(c).first);
        verdicts.push_back({name + "largest stress over M c/I", most / kMost, 0.90, 1.05});
    }
    return verdicts;
}

std::vector<Verdict> hertz() {
    SolidBlow blow;
    blow.speed = 5, blow.effective_mass = 1, blow.radius = 0.031;
    blow.striker = {210e9, 0.3};
    const HertzContact contact = hertz_contact(blow, {70e9, 0.22});
    return {
        {"contact of a steel ball of 1 kg on glass at 5 m/s, ms (V12)", 1e3 * contact.duration, 0.2, 0.218},
        {"its force over 1.84 times 2 m v / t_c", contact.force * contact.duration / (1.84 * 2 * 5), 0.9999, 1.0001}};
}

struct Broken {
    Arena arena;
    BreakRun run;
    Broken(const BreakableSolid& body, const SolidBlow& blow, const CrackRules& rules = {})
        : arena(break_bytes(body)), run(take_break(arena, body)) {
        begin_break(body, kBrick, blow, rules, {}, run);
        while (!advance_break(body, run, uint64_t{1} << 24)) {
        }
    }
};
SolidBlow on_a_corner(double speed) {
    SolidBlow blow;
    blow.point = kBrickHalf, blow.push = normalised(Vec3d(-1, -1, -1));
    blow.speed = speed, blow.effective_mass = 1.5, blow.radius = 0.01;
    blow.striker = {30e9, 0.2};
    return blow;
}

std::vector<Verdict> loads() {
    CrackRules gate;
    gate.most_cracks = 0;
    const BreakableSolid body = make_breakable(cooked_box(kBrickHalf, 800, 4).solid);
    // How much of the force comes is a matter of energy; what is linear is the stress.
    const Broken slow(body, on_a_corner(1), gate), fast(body, on_a_corner(1.7), gate);
    const double forces = fast.run.contact.force * fast.run.share / (slow.run.contact.force * slow.run.share);
    // From 1,500 cells on the blow is spread over the same patch, whatever the lattice.
    const BreakableSolid coarse = make_breakable(cooked_box(kBrickHalf, 1500, 2).solid),
                         finer = make_breakable(cooked_box(kBrickHalf, 8000, 2).solid);
    SolidBlow on_a_face = on_a_corner(5);
    on_a_face.point = {0, kBrickHalf.y, 0}, on_a_face.push = {0, -1, 0};
    const Broken usual(coarse, on_a_face, gate), same(finer, on_a_face, gate);
    return {{"stress over force, at two speeds (T9)", fast.run.gate / slow.run.gate / forces, 1 - 1e-6, 1 + 1e-6},
            {"force of the first crack on a face, 8,000 cells over 1,500 (T9)",
             threshold_force(same.run) / threshold_force(usual.run), 0.75, 1.25}};
}

std::vector<Verdict> pieces_by_speed() {
    BreakableSolid body = make_breakable(cooked_box(kBrickHalf, 800, 4).solid);
    std::vector<Verdict> verdicts;
    double before = 1;
    for (const double speed : {1.0, 3.0, 6.0, 10.0, 20.0}) {
        double sum = 0;
        for (uint64_t seed = 0; seed < 20; ++seed) {
            scatter_strength(body, 8, seed);
            sum += Broken(body, on_a_corner(speed)).run.piece_count / 20.0;
        }
        verdicts.push_back(
            {"pieces of a brick on its corner at " + std::to_string(static_cast<int>(speed)) + " m/s (T12)", sum,
             before, 60});
        before = sum;
    }
    return verdicts;
}

uint32_t odd_edges(const PieceSkin& skin) {
    std::map<std::pair<uint32_t, uint32_t>, int> balance;
    for (const PieceTriangle& t : skin.triangles)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t a = t.corners[k], b = t.corners[(k + 1) % 3];
            balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    uint32_t odd = 0;
    for (const auto& [edge, sum] : balance) odd += sum != 0;
    return odd;
}

/// Cells by the nearest of six of them.
std::vector<uint32_t> six_parts(const Solid& solid) {
    constexpr uint32_t kParts = 6;
    const Random random{3};
    Vec3d seeds[kParts];
    for (uint32_t k = 0; k < kParts; ++k)
        seeds[k] =
            solid.cells[static_cast<size_t>(random.uniform(k) * static_cast<double>(solid.cells.size()))].centroid;
    std::vector<uint32_t> labels;
    for (const SolidCell& cell : solid.cells) {
        uint32_t nearest = 0;
        for (uint32_t k = 1; k < kParts; ++k)
            if (length(cell.centroid - seeds[k]) < length(cell.centroid - seeds[nearest])) nearest = k;
        labels.push_back(nearest);
    }
    return labels;
}

std::vector<Verdict> cut_skins() {
    double most_off = 0, odd = 0, different = 0;
    for (const Mesh& mesh : {make_cow(0.6f, 3000), make_solid_bowl(), make_box({0.5f, 0.006f, 0.3f})}) {
        const Result<CookedSolid> solid = cook_solid(mesh);
        if (!solid) return {{solid.error(), 1, 0, 0}};
        const std::vector<uint32_t> labels = six_parts(solid->solid);
        const Result<List<PieceSkin>> near = cut_pieces(*solid, {}, labels, 6),
                                      all = cut_pieces(*solid, {}, labels, 6, CutExtent::All);
        if (!near || !all) return {{"no cut", 1, 0, 0}};
        double six = 0;
        for (uint32_t p = 0; p < 6; ++p) {
            const PieceSkin& skin = (*near)[p];
            odd += odd_edges(skin);
            different +=
                !std::equal(skin.places.begin(), skin.places.end(), (*all)[p].places.begin(), (*all)[p].places.end());
            for (const PieceTriangle& t : skin.triangles)
                six += dot(skin.places[t.corners[0]], cross(skin.places[t.corners[1]], skin.places[t.corners[2]]));
        }
        most_off = std::max(most_off, std::fabs(six / 6 / solid->solid.volume - 1));
    }
    return {{"open edges of 18 pieces of a cow, a bowl and a plate (T4)", odd, 0, 0},
            {"their volume off the whole's", most_off, 0, 2e-5},
            {"pieces that differ from a cut of all triangles", different, 0, 0}};
}

// Weibull: 8 times the cells are weaker by 8^(1/m), in the mean of the weakest cell over seeds.
std::vector<Verdict> scattered_strength() {
    constexpr double kModulus = 8, kSeeds = 200;
    double strength[2] = {0, 0};
    for (int k = 0; k < 2; ++k) {
        BreakableSolid body = make_breakable(cooked_box(kBrickHalf, k == 0 ? 300 : 2400, 4).solid);
        for (uint64_t seed = 0; seed < static_cast<uint64_t>(kSeeds); ++seed) {
            scatter_strength(body, kModulus, seed);
            strength[k] += double{*std::min_element(body.strength.begin(), body.strength.end())} / kSeeds;
        }
    }
    return {
        {"weakest of 300 cells over that of 2,400, over 8^(1/8) (V11)", strength[0] / strength[1] / 1.2968, 0.9, 1.1}};
}

}  // namespace

std::span<const TruthCase> lattice_truth_cases() {
    static const TruthCase kCases[] = {{4, "patch test", patch_test},
                                       {5, "a free bar pushed at one end", pushed_bar},
                                       {7, "a bent bar", bent_bar},
                                       {9, "loads are linear, and the same on a finer lattice", loads},
                                       {11, "scattered strength", scattered_strength},
                                       {12, "Hertz", hertz},
                                       {13, "more pieces at more speed", pieces_by_speed},
                                       {14, "skins of pieces", cut_skins}};
    return kCases;
}

}  // namespace cullet
