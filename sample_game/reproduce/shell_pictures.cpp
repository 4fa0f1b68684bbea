// Figures 7 and 8: the inner surface of a pig, and of a cow's horn and ear.
#include <fmt/format.h>

#include <algorithm>

#include "sample_game/meshes.hpp"
#include "sample_game/reproduce/claims.hpp"
#include "sample_game/reproduce/generated_shell.hpp"

namespace cullet::reproduce {
namespace {

struct Made {
    Surface surface;
    GeneratedShell shell;
    std::vector<Vec3d> inner;
};

Result<Made> make(const Mesh& mesh, double share_of_diagonal) {
    Result<Surface> surface = prepare_surface(mesh);
    if (!surface.ok()) return Error{surface.error()};
    Result<GeneratedShell> shell =
        generate(surface.value(), share_of_diagonal * surface->diagonal, settings_of(propagation_modes().back()), 1);
    if (!shell.ok()) return Error{shell.error()};
    Made made{std::move(surface).value(), std::move(shell).value(), {}};
    made.inner = inner_positions(made.surface, made.shell.extrusion);
    return made;
}

/// Mean depth over the wanted one, of the vertices that `is_wanted` picks.
template <class IsWanted>
double mean_depth(const Made& made, double wanted, IsWanted is_wanted) {
    double sum = 0, count = 0;
    for (size_t v = 0; v < made.surface.positions.size(); ++v)
        if (is_wanted(made.surface.positions[v])) sum += made.shell.extrusion.depth[v], ++count;
    return count > 0 ? sum / (count * wanted) : 0;
}

}  // namespace

Result<Claim> figure_7(Bench& bench) {
    constexpr double eps = 0.05;
    Claim claim;
    claim.id = "figure_7";
    claim.where = "Figure 7";
    claim.title = "A pig: thick where there is room, thin in the tail";
    claim.paper =
        "The red surface is the inner one, the white mesh the original. At the tail and the legs the thickness could "
        "not be made maximal; nonetheless there are no intersections.";
    Result<Made> pig = make(make_pig(0.5f, bench.settings().is_reduced ? 2000 : 3500), eps);
    if (!pig.ok()) return Error{pig.error()};
    const double wanted = eps * pig->surface.diagonal;
    const double back = pig->surface.low.x;
    const double tail = mean_depth(*pig, wanted, [&](Vec3d p) { return p.x < back + 0.045; });
    const double legs = mean_depth(*pig, wanted, [](Vec3d p) { return p.y < 0.05; });
    const double trunk = mean_depth(*pig, wanted, [](Vec3d p) { return p.x > -0.08 && p.x < 0.03 && p.y > 0.12; });
    claim.ours = fmt::format(
        "Mean depth over the wanted one: {:.2f} at the trunk, {:.2f} in the legs, {:.2f} in the tail. {} pairs of "
        "triangles meet, {} elements are turned.",
        trunk, legs, tail, pig->shell.crossings, pig->shell.inverted);
    claim.numbers = {{"depth at the trunk", "of eps", trunk, {}},
                     {"depth in the legs", "of eps", legs, {}},
                     {"depth in the tail", "of eps", tail, {}},
                     {"pairs of triangles that meet", "", static_cast<double>(pig->shell.crossings), 0.0}};
    const bool is_good = tail < trunk && legs < trunk && trunk > 0.8 && pig->shell.crossings == 0;
    claim.verdict = is_good ? Verdict::Met : Verdict::FallsShort;
    Camera camera;
    camera.eye = {-0.42f, 0.36f, 0.66f}, camera.target = {-0.005f, 0.155f, 0}, camera.vertical_field_of_view = 0.5f;
    if (auto added = bench.add_picture(
            claim, draw_shell(pig->surface, pig->inner, camera, bench.picture_width(), bench.threads(), 0.0005f), "pig",
            "Inner surface (red) and original mesh (white) at a thickness of 5 % of the diagonal");
        !added.ok())
        return Error{added.error()};
    if (bench.settings().is_reduced) return claim;
    camera.eye = {-0.34f, 0.33f, 0.20f}, camera.target = {-0.20f, 0.24f, 0}, camera.vertical_field_of_view = 0.5f;
    if (auto added = bench.add_picture(
            claim, draw_shell(pig->surface, pig->inner, camera, bench.picture_width(), bench.threads(), 0.0003f),
            "tail", "The tail: the inner surface keeps away from itself");
        !added.ok())
        return Error{added.error()};
    return claim;
}

Result<Claim> figure_8(Bench& bench) {
    constexpr double eps = 0.02;
    Claim claim;
    claim.id = "figure_8";
    claim.where = "Figure 8";
    claim.title = "The horn and the ear of a cow";
    claim.paper = "Even in complex models the algorithm produces good results: the inner surface fits nicely.";
    const std::optional<Mesh> given = bench.strangers_mesh("thick_shell/spot_triangulated.obj", 0.6f);
    Result<Made> cow = make(make_cow(0.6f, bench.settings().is_reduced ? 2000 : 3000), eps);
    if (!cow.ok()) return Error{cow.error()};
    const double wanted = eps * cow->surface.diagonal, top = cow->surface.high.y;
    const double horns = mean_depth(*cow, wanted, [&](Vec3d p) { return p.y > top - 0.06; });
    claim.ours =
        fmt::format("Depth in the horns {:.2f} of the wanted one; {} pairs of triangles meet, {} elements are turned.",
                    horns, cow->shell.crossings, cow->shell.inverted);
    claim.numbers = {{"depth in the horns", "of eps", horns, {}},
                     {"pairs of triangles that meet", "", static_cast<double>(cow->shell.crossings), 0.0},
                     {"elements turned inside out", "", static_cast<double>(cow->shell.inverted), 0.0}};
    claim.verdict = cow->shell.crossings == 0 && cow->shell.inverted == 0 ? Verdict::Met : Verdict::FallsShort;
    Camera camera;
    camera.eye = {0.42f, 0.58f, 0.42f}, camera.target = {0.185f, 0.425f, 0.03f}, camera.vertical_field_of_view = 0.42f;
    if (auto added = bench.add_picture(
            claim, draw_shell(cow->surface, cow->inner, camera, bench.picture_width(), bench.threads(), 0.0004f),
            "head", "Horn and ear of the generated cow, thickness 2 % of the diagonal");
        !added.ok())
        return Error{added.error()};
    if (!given || bench.settings().is_reduced) return claim;
    const Result<Made> spot = make(*given, eps);
    if (!spot.ok()) return Error{spot.error()};
    claim.ours +=
        fmt::format(" The cow of the test data: {} pairs, {} turned.", spot->shell.crossings, spot->shell.inverted);
    if (spot->shell.crossings > 0 || spot->shell.inverted > 0) claim.verdict = Verdict::FallsShort;
    const Vec3d middle = 0.5 * (spot->surface.low + spot->surface.high), reach = spot->surface.high - middle;
    camera.target = (middle + Vec3d{0, 0.62 * reach.y, -0.62 * reach.z}).to_float();
    camera.eye = camera.target + Vec3{0.38f, 0.16f, -0.42f};
    camera.vertical_field_of_view = 0.5f;
    if (auto added = bench.add_picture(
            claim, draw_shell(spot->surface, spot->inner, camera, bench.picture_width(), bench.threads(), 0.0004f),
            "test_data", "The same of the test data's cow");
        !added.ok())
        return Error{added.error()};
    return claim;
}

}  // namespace cullet::reproduce
