// The three kinds of fracture, re-meshing along cracks, and ductile shells (figures 4, 5 and 6).
#include <fmt/format.h>

#include <algorithm>

#include "sample_game/hit_bench.hpp"
#include "sample_game/reproduce/claims.hpp"
#include "sample_game/reproduce/scene_run.hpp"

namespace cullet::reproduce {
namespace {

constexpr const char* kBrickWall = R"(
game.scene{shows = "a ball goes through a brick wall whose foot is held", seconds = 10}
local wall = game.cook{mesh = game.mesh.wall{width = 2.4, height = 1.8, edge = 0.078}, material = "brick", thickness = 0.1 @mode@}
game.camera{eye = {1.9, 1.5, 3.0}, target = {-0.05, 0.75, -0.1}, field_of_view = 0.72}
game.floor()
game.throw{radius = 0.14, mass = 30, at = {0.05, 0.98, 1.5}, velocity = {0, 1.2, -14}}
game.spawn{cooked = wall, at = {0, 0.002, 0} @how@, pins = {{low = {-2, -0.01, -0.2}, high = {2, 0.02, 0.2}}}}
)";

constexpr const char* kVase = R"(
game.scene{shows = "a vase falls on the ground", seconds = 10}
local vase = game.cook{mesh = game.mesh.vase{height = 0.3, edge = 0.0075}, material = "porcelain", thickness = 0.005 @mode@}
game.camera{eye = {0.55, 0.42, 0.85}, target = {0, 0.1, 0}, field_of_view = 0.5}
game.floor()
game.spawn{cooked = vase, at = {0, 0.24, 0}, turn = {axis = {0, 0, 1}, angle = 0.5}, velocity = {0, -4.5, 0} @how@}
)";

Result<void> add_pictures(Bench& bench, Claim& claim, const SceneRun& run,
                          std::initializer_list<const char*> captions) {
    size_t n = 0;
    for (const Picture& picture : run.pictures) {
        const char* caption = *(captions.begin() + std::min(n, captions.size() - 1));
        if (auto added = bench.add_picture(claim, picture, fmt::format("{}", ++n), caption); !added.ok()) return added;
    }
    return {};
}

/// In the default mode, or quickly with cracks of this kind.
std::string in_mode(const char* lua, const char* kind) {
    if (!kind) return filled(filled(lua, "mode", ""), "how", "");
    return filled(filled(lua, "mode", fmt::format(", fracture = \"{}\"", kind)), "how", ", fracture = \"quick\"");
}

Result<SceneRun> run_quickly(Bench& bench, const std::string& name, const char* lua, const char* kind,
                             uint32_t frames, std::vector<uint32_t> drawn) {
    const bool is_small = bench.settings().is_reduced;
    if (is_small) drawn = {40};
    return run_scene(bench, {name, in_mode(lua, kind), {}, is_small ? 40u : frames, std::move(drawn)});
}

/// Pieces of both, to be compared: the paper's figures show no numbers.
void add_counts(Claim& claim, const char* name, const SceneRun& run) {
    claim.numbers.push_back({fmt::format("pieces ({})", name), "", static_cast<double>(run.pieces), {}});
    claim.numbers.push_back({fmt::format("crumbs ({})", name), "", static_cast<double>(run.crumbs), {}});
    claim.numbers.push_back({fmt::format("largest piece ({})", name), "of the mass", run.largest, {}});
}

}  // namespace

Result<Claim> figure_4(Bench& bench) {
    Claim claim;
    claim.id = "figure_4";
    claim.where = "Figure 4, section 4.2.2";
    claim.title = "A brick wall breaks in fine grains";
    claim.paper =
        "Fine-grained fracture: many springs near the blow are too long at once, and many small fragments come off.";
    const Result<SceneRun> run =
        run_quickly(bench, "brick_wall, fine", kBrickWall, "fine", 90, {9, 16, 30, 90});
    if (!run.ok()) return Error{run.error()};
    claim.ours = fmt::format(
        "Paper's mode, fine: {} pieces and {} crumbs, the largest with {:.0f} % of the mass.", run->pieces, run->crumbs,
        100 * run->largest);
    add_counts(claim, "fine", run.value());
    claim.verdict = run->pieces + run->crumbs > 10 ? Verdict::Met : Verdict::FallsShort;
    if (auto added = add_pictures(bench, claim, run.value(),
                                  {"Paper's mode, fine, just after the blow", "", "", "After a second and a half"});
        !added.ok())
        return Error{added.error()};
    return claim;
}

Result<Claim> coarse_grained(Bench& bench) {
    Claim claim;
    claim.id = "coarse_grained";
    claim.where = "Section 4.2.2";
    claim.title = "Coarse-grained fracture keeps vertices together";
    claim.paper = "Springs round a split vertex may not start a crack any more: fragments become larger.";
    const Result<SceneRun> fine = run_quickly(bench, "brick_wall, fine", kBrickWall, "fine", 90, {90}),
                           coarse = run_quickly(bench, "brick_wall, coarse", kBrickWall, "coarse", 90, {16, 90});
    if (!fine.ok()) return Error{fine.error()};
    if (!coarse.ok()) return Error{coarse.error()};
    const auto lumps = [](const SceneRun& run) { return static_cast<double>(run.pieces + run.crumbs); };
    claim.ours = fmt::format(
        "The same ball at the same wall, both in the paper's mode: {} pieces and {} crumbs coarse, {} and {} fine.",
        coarse->pieces, coarse->crumbs, fine->pieces, fine->crumbs);
    add_counts(claim, "coarse", coarse.value());
    add_counts(claim, "fine", fine.value());
    claim.verdict = lumps(*coarse) > 1 && lumps(*coarse) < lumps(*fine) ? Verdict::Met : Verdict::FallsShort;
    if (auto added = add_pictures(bench, claim, coarse.value(),
                                  {"Paper's mode, coarse, just after the blow", "After a second and a half"});
        !added.ok())
        return Error{added.error()};
    return claim;
}

Result<Claim> large_fragments(Bench& bench) {
    Claim claim;
    claim.id = "large_fragments";
    claim.where = "Section 4.2.2";
    claim.title = "A vase falls into a few large shards and some small ones";
    claim.paper =
        "In reality a vase does not break into many small pieces. Cracks are extended along the splitting plane by a "
        "user-defined distance, independent of any criterion.";
    const bool is_small = bench.settings().is_reduced;
    const Result<SceneRun> run =
        run_scene(bench, {"vase",
                          in_mode(kVase, nullptr),
                          {},
                          is_small ? 40u : 150u,
                          is_small ? std::vector<uint32_t>{40} : std::vector<uint32_t>{0, 7, 20, 150}});
    if (!run.ok()) return Error{run.error()};
    const Result<SceneRun> quick = run_quickly(bench, "vase, large fragments", kVase, "large", 150, {7, 20, 150});
    if (!quick.ok()) return Error{quick.error()};
    claim.ours = fmt::format(
        "{} shards and {} crumbs, the largest shard with {:.0f} % of the mass, at 5 m/s in the default mode, where "
        "cracks follow the stress and stop where it no longer drives them. In the paper's mode, which runs each crack on "
        "by half the diagonal: {} shards and {} crumbs, the largest with {:.0f} %.",
        run->pieces, run->crumbs, 100 * run->largest, quick->pieces, quick->crumbs, 100 * quick->largest);
    claim.numbers = {{"shards", "", static_cast<double>(run->pieces), {}},
                     {"crumbs", "", static_cast<double>(run->crumbs), {}},
                     {"largest shard", "of the mass", run->largest, {}},
                     {"mass put in", "kg", run->mass_put_in, {}},
                     {"mass at the end", "kg", run->mass_at_end, {}}};
    add_counts(claim, "paper's mode", quick.value());
    claim.verdict = run->pieces >= 3 && run->largest > 0.05 && run->largest < 0.9 ? Verdict::Met : Verdict::FallsShort;
    if (auto added = add_pictures(bench, claim, run.value(),
                                  {"A porcelain vase of 30 cm and 5 mm before the fall",
                                   "Just after it touches the ground", "A third of a second later", "At rest"});
        !added.ok())
        return Error{added.error()};
    size_t n = 0;
    for (const Picture& picture : quick->pictures)
        if (auto added = bench.add_picture(claim, picture, fmt::format("quick_{}", ++n), "Paper's mode"); !added.ok())
            return Error{added.error()};
    return claim;
}

Result<Claim> figure_5(Bench&) {
    Claim claim;
    claim.id = "figure_5";
    claim.where = "Figure 5, section 4.2.3";
    claim.title = "Local re-meshing makes cracks straight";
    claim.paper = "Elements that the splitting plane crosses are cut in two, if the new ones are well shaped enough.";
    const Result<HitSubject> vase = make_subject(Subject::Vase);
    if (!vase.ok()) return Error{vase.error()};
    HitBench hits(Subject::Vase, vase->model);
    const uint32_t before = vase->model.report().vertices;
    const HitReport report = hits.run(hits.blow(0, vase->hit_speed));
    claim.ours = fmt::format(
        "A vase of {} vertices at {} m/s: {} edges cut in a run of {} steps, new vertices put where a crack leaves the "
        "edges, only where all four new triangles are well shaped. The paper's mode puts them where its splitting plane crosses the edges round a vertex.",
        before, vase->hit_speed, report.cuts, report.steps);
    claim.numbers = {{"edges cut", "", static_cast<double>(report.cuts), {}},
                     {"cracks started", "", static_cast<double>(report.starts), {}},
                     {"steps of the hidden run", "", static_cast<double>(report.steps), {}}};
    claim.verdict = report.cuts > 0 ? Verdict::Shown : Verdict::FallsShort;
    return claim;
}

Result<Claim> figure_6(Bench&) {
    Claim claim;
    claim.id = "figure_6";
    claim.where = "Figure 6, section 4.2.4";
    claim.title = "Ductile fracture: a soft shell stretches and tears";
    claim.paper = "The vertices show the mass-spring model itself; a piece of soft material is fractured.";
    claim.ours = "Not built yet: bodies of soft material do not show their mesh in this version. No picture.";
    return claim;
}

}  // namespace cullet::reproduce
