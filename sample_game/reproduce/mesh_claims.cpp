// Re-meshing along cracks, and soft shells that show their mesh (figures 5 and 6).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "components/state.hpp"
#include "engine/fp_mode.hpp"
#include "sample_game/hit_bench.hpp"
#include "sample_game/reproduce/claims.hpp"
#include "sample_game/reproduce/generated_shell.hpp"
#include "sample_game/reproduce/scene_run.hpp"
#include "sample_game/scene.hpp"

namespace cullet::reproduce {
namespace {

/// A broken shell at rest, cracks closed, and which of its triangles hold a vertex that was put on an edge: copies at
/// cracks have the place of the vertex they come from, inserted ones have a new place.
struct Remeshed {
    Surface surface;
    std::vector<Vec3d> inner;
    std::vector<uint8_t> is_new;
    size_t inserted = 0;

    Remeshed(const ShellView& shell, uint32_t count_before) {
        const Vertices& vertices = shell.state.vertices;
        std::set<std::array<float, 3>> old_places, new_places;
        std::vector<uint8_t> is_inserted;
        for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
            const Vec3 p = vertices.rest[shell.vertex(v)];
            const std::array<float, 3> place{p.x, p.y, p.z};
            if (v < count_before) old_places.insert(place);
            is_inserted.push_back(!old_places.count(place));
            if (is_inserted.back()) new_places.insert(place);
            surface.positions.push_back(Vec3d(p));
            inner.push_back(Vec3d(p + vertices.depth[shell.vertex(v)] * vertices.inward[shell.vertex(v)]));
        }
        for (uint32_t e = 0; e < shell.element_count(); ++e) {
            if (shell.state.elements.flags[shell.element(e)] & kDead) continue;
            const auto& corner = shell.state.elements.corner[shell.element(e)];
            surface.triangles.push_back({corner[0], corner[1], corner[2]});
            is_new.push_back(is_inserted[corner[0]] || is_inserted[corner[1]] || is_inserted[corner[2]]);
        }
        inserted = new_places.size();
    }

    /// Of the marked triangle that has the most others within 5 cm: where a crack is seen best.
    Vec3 middle_of_new() const {
        std::vector<Vec3d> middles;
        for (size_t t = 0; t < is_new.size(); ++t) {
            const auto& corner = surface.triangles[t];
            if (is_new[t])
                middles.push_back((1.0 / 3) * (surface.positions[corner[0]] + surface.positions[corner[1]] +
                                               surface.positions[corner[2]]));
        }
        size_t most = 0;
        Vec3d best;
        for (const Vec3d& p : middles) {
            const auto near = static_cast<size_t>(
                std::count_if(middles.begin(), middles.end(), [&](const Vec3d& q) { return length(p - q) < 0.05; }));
            if (near > most) most = near, best = p;
        }
        return best.to_float();
    }
};

}  // namespace

Result<Claim> figure_5(Bench& bench) {
    Claim claim;
    claim.id = "figure_5";
    claim.where = "Figure 5, section 4.2.3";
    claim.title = "Local re-meshing makes cracks straight";
    claim.paper = "Elements that the splitting plane crosses are cut in two, if the new ones are well shaped enough.";
    const Result<HitSubject> vase = make_subject(Subject::Vase);
    if (!vase.ok()) return Error{vase.error()};
    const FpMode mode;
    HitBench hits(Subject::Vase, vase->model);
    State& state = hits.state();
    const uint32_t before = state.shells.vertices[state.shell_of(hits.shell())].count;
    const HitReport report = run_hit(state, hits.shell(), hits.blow(0, vase->hit_speed));
    const Remeshed broken(ShellView(state, state.tasks.working[0]), before);
    close_hit(state);
    claim.ours = fmt::format(
        "A vase of {} vertices at {} m/s: {} edges cut and {} vertices put on edges in a run of {} steps, where a "
        "crack leaves the edges and all four new triangles are well shaped.",
        before, vase->hit_speed, report.cuts, broken.inserted, report.steps);
    claim.numbers = {{"edges cut", "", static_cast<double>(report.cuts), {}},
                     {"vertices put on edges", "", static_cast<double>(broken.inserted), {}},
                     {"cracks started", "", static_cast<double>(report.starts), {}},
                     {"steps of the hidden run", "", static_cast<double>(report.steps), {}}};
    claim.verdict = report.cuts > 0 && broken.inserted > 0 ? Verdict::Shown : Verdict::FallsShort;
    Camera camera;
    camera.eye = {0.38f, 0.34f, 0.62f}, camera.target = {0, 0.15f, 0}, camera.vertical_field_of_view = 0.56f;
    const auto draw = [&](const char* name, const char* caption) {
        return bench.add_picture(claim,
                                 draw_shell(broken.surface, broken.inner, camera, bench.picture_width(),
                                            bench.threads(), 0.0003f, broken.is_new),
                                 name, caption);
    };
    if (auto added = draw("1", "The vase's mesh after the hit; triangles at vertices put on edges are yellow");
        !added.ok())
        return Error{added.error()};
    if (bench.settings().is_reduced || broken.inserted == 0) return claim;
    const Vec3 middle = broken.middle_of_new();
    camera.target = middle;
    camera.eye = middle + 0.2f * normalised(Vec3{middle.x, 0, middle.z}) + Vec3{0, 0.05f, 0};
    if (auto added = draw("2", "From near: each crack has straightened the triangles that it went through");
        !added.ok())
        return Error{added.error()};
    return claim;
}

Result<Claim> figure_6(Bench& bench) {
    Claim claim;
    claim.id = "figure_6";
    claim.where = "Figure 6, section 4.2.4";
    claim.title = "Ductile fracture: a soft shell stretches and tears";
    claim.paper = "The vertices show the mass-spring model itself; a piece of soft material is fractured.";
    const Scene* tear = find_scene("tear");
    if (!tear) return Error{"the program has no scene named tear; this is a bug of the page"};
    const bool is_small = bench.settings().is_reduced;
    const Result<SceneRun> run = run_scene(
        bench,
        {"tear", tear->text, is_small ? std::vector<std::string>{"scene.edge_m=0.07"} : std::vector<std::string>{},
         is_small ? 24u : 60u, is_small ? std::vector<uint32_t>{24} : std::vector<uint32_t>{4, 6, 12, 59}});
    if (!run.ok()) return Error{run.error()};
    claim.ours = fmt::format(
        "A ball of 8 kg at 16 m/s and a framed sheet of cloth, one layer of springs, {} vertices, drawn as they move: "
        "{} vertices split, {} piece{} in the end. The material flows beyond its yield strain where it has one, which "
        "the "
        "paper lacks.",
        run->vertices, run->tears, run->pieces, run->pieces == 1 ? "" : "s");
    claim.numbers = {{"vertices split", "", static_cast<double>(run->tears), {}},
                     {"pieces", "", static_cast<double>(run->pieces), {}},
                     {"median frame", "ms", percentile_of(run->frame_ms, 0.5), {}}};
    claim.verdict = run->tears > 0 ? Verdict::Met : Verdict::FallsShort;
    if (auto added = bench.add_pictures(claim, run->pictures, "",
                                        {"The ball before the sheet", "It has gone through and left a tear",
                                         "A tenth of a second later the sheet swings", "One second in, at rest"});
        !added.ok())
        return Error{added.error()};
    return claim;
}

}  // namespace cullet::reproduce
