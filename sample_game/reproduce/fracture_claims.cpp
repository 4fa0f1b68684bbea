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
local wall = game.cook{mesh = game.mesh.wall{width = 2.4, height = 1.8, edge = 0.078}, material = "brick", thickness = 0.1}
game.camera{eye = {1.9, 1.5, 3.0}, target = {-0.05, 0.75, -0.1}, field_of_view = 0.72}
game.floor()
game.throw{radius = 0.14, mass = 30, at = {0.05, 0.98, 1.5}, velocity = {0, 1.2, -14}}
game.spawn{cooked = wall, at = {0, 0.002, 0}, pins = {{low = {-2, -0.01, -0.2}, high = {2, 0.02, 0.2}}}}
)";

constexpr const char* kVase = R"(
game.scene{shows = "a vase falls on the ground", seconds = 10}
local vase = game.cook{mesh = game.mesh.vase{height = 0.3, edge = 0.0075}, material = "porcelain", thickness = 0.005}
game.camera{eye = {0.55, 0.42, 0.85}, target = {0, 0.1, 0}, field_of_view = 0.5}
game.floor()
game.spawn{cooked = vase, at = {0, 0.24, 0}, turn = {axis = {0, 0, 1}, angle = 0.5}, velocity = {0, -4.5, 0}}
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

}  // namespace

Result<Claim> figure_4(Bench& bench) {
    Claim claim;
    claim.id = "figure_4";
    claim.where = "Figure 4, section 4.2.2";
    claim.title = "A brick wall breaks in fine grains";
    claim.paper =
        "Fine-grained fracture: many springs near the blow are too long at once, and many small fragments come off.";
    const bool is_small = bench.settings().is_reduced;
    const Result<SceneRun> run =
        run_scene(bench, {"brick_wall",
                          kBrickWall,
                          {},
                          is_small ? 40u : 90u,
                          is_small ? std::vector<uint32_t>{40} : std::vector<uint32_t>{9, 16, 30, 90}});
    if (!run.ok()) return Error{run.error()};
    claim.ours = fmt::format(
        "Fine grain is not built yet. Instead the same wall with the default kind of fracture: {} pieces and {} "
        "crumbs, "
        "the largest with {:.0f} % of the mass.",
        run->pieces, run->crumbs, 100 * run->largest);
    claim.numbers = {{"pieces (default kind)", "", static_cast<double>(run->pieces), {}},
                     {"largest piece (default kind)", "of the mass", run->largest, {}}};
    if (auto added =
            add_pictures(bench, claim, run.value(),
                         {"Default kind of fracture, just after the blow", "", "", "After a second and a half"});
        !added.ok())
        return Error{added.error()};
    return claim;
}

Result<Claim> coarse_grained(Bench&) {
    Claim claim;
    claim.id = "coarse_grained";
    claim.where = "Section 4.2.2";
    claim.title = "Coarse-grained fracture keeps vertices together";
    claim.paper = "Springs round a split vertex may not start a crack any more: fragments become larger.";
    claim.ours = "Not built yet.";
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
                          kVase,
                          {},
                          is_small ? 40u : 150u,
                          is_small ? std::vector<uint32_t>{40} : std::vector<uint32_t>{0, 7, 20, 150}});
    if (!run.ok()) return Error{run.error()};
    claim.ours = fmt::format(
        "{} shards and {} crumbs, the largest shard with {:.0f} % of the mass, at 5 m/s. Nothing was prescribed: "
        "cracks "
        "follow the stress and stop where it no longer drives them. The paper's extension by a length: not built yet.",
        run->pieces, run->crumbs, 100 * run->largest);
    claim.numbers = {{"shards", "", static_cast<double>(run->pieces), {}},
                     {"crumbs", "", static_cast<double>(run->crumbs), {}},
                     {"largest shard", "of the mass", run->largest, {}},
                     {"mass put in", "kg", run->mass_put_in, {}},
                     {"mass at the end", "kg", run->mass_at_end, {}}};
    claim.verdict = run->pieces >= 3 && run->largest > 0.05 && run->largest < 0.9 ? Verdict::Met : Verdict::FallsShort;
    if (auto added = add_pictures(bench, claim, run.value(),
                                  {"A porcelain vase of 30 cm and 5 mm before the fall",
                                   "Just after it touches the ground", "A third of a second later", "At rest"});
        !added.ok())
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
        "edges, only where all four new triangles are well shaped. The plane form of the paper's mode: not built yet.",
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
