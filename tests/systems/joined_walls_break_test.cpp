// Strangers' meshes that model both of their walls, broken: both skins break together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <set>

#include "components/state.hpp"
#include "cullet/query.hpp"
#include "engine/fp_mode.hpp"
#include "sample_game/import_model.hpp"
#include "sample_game/props.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/models/thick_shell/run_hit.hpp"
#include "tests/support/test_data.hpp"

namespace cullet {
namespace {

constexpr float kSpeed = 20;            // m/s: far above the first crack of both
constexpr double kLargerShare = 0.005;  // of the mass
constexpr float kNear = 0.2f;           // of the wall: the input's facets, and edges that cooking split
/// Share of a piece's vertices that is on both skins: of any larger piece (a lip turns round, and a cup's handle is a
/// rod, so that what keeps the handle has less), and of most that came off. Two sheets of half the thickness would have
/// none.
constexpr double kOfAnyPiece = 0.67, kOfACleanPiece = 0.95;
constexpr uint32_t kCleanPieces = 5;

/// The mesh as it came, asked for its nearest surface.
class Input {
 public:
    explicit Input(const Mesh& mesh) : world_(World::create({})) {
        EXPECT_TRUE(world_.ok()) << world_.error();
        const Result<BodyId> body = world_->add_static(view_of(mesh));
        EXPECT_TRUE(body.ok()) << body.error();
    }
    /// Whether a surface of it that looks the way of `outward` lies within `reach`.
    bool has_skin(Vec3 point, Vec3 outward, float reach) const {
        const SurfaceHit hit = closest(*world_, point, reach);
        return hit && dot(hit.normal, outward) > 0;
    }

 private:
    Result<World> world_;
};

/// A shell alone in its tables.
struct Bare {
    std::unique_ptr<State> state;
    Row<Structures> shell;

    explicit Bare(const Model& model)
        : state(std::make_unique<State>(cooking_limits(model.report().vertices, model.report().elements))) {
        const Workbench& cooked = model.contents->state;
        state->materials.append(cooked.materials.size());
        state->materials.copy_rows(cooked.materials, 0, 0, cooked.materials.size());
        state->material_traits.append(cooked.material_traits.size());
        state->material_traits.copy_rows(cooked.material_traits, 0, 0, cooked.material_traits.size());
        const char* full = "";
        shell = import_shell(*state, cooked, model.contents->shell, &full);
        EXPECT_TRUE(shell.exists()) << full;
    }

    /// A ball against the outer wall, a little above half of the body's height, where it looks this way. Of the
    /// vertices there the middle one by its distance: a handle, which is farther out, has few.
    HitDescription blow(Vec3 way, float height, float mass) const {
        std::vector<std::pair<float, uint32_t>> facing;
        const Range rows = state->shells.vertices[state->shell_of(shell)];
        float low = 1e30f, high = -1e30f;
        for (uint32_t v = rows.first; v < rows.first + rows.count; ++v)
            low = std::min(low, state->vertices.rest[v].y), high = std::max(high, state->vertices.rest[v].y);
        for (uint32_t v = rows.first; v < rows.first + rows.count; ++v) {
            const Vec3 p = state->vertices.rest[v];
            if (dot(state->vertices.inward[v], way) < 0.9f) continue;
            if (std::fabs((p.y - low) / (high - low) - height) < 0.1f) facing.push_back({dot(p, way), v});
        }
        EXPECT_FALSE(facing.empty());
        if (facing.empty()) return {};
        std::sort(facing.begin(), facing.end());
        const uint32_t struck = facing[facing.size() / 2].second;
        HitDescription hit;
        hit.point = state->vertices.rest[struck];
        hit.normal = state->vertices.inward[struck];
        hit.striker_speed = kSpeed;
        hit.striker_inverse_mass = 1 / mass;
        hit.striker_radius = 0.1f * (high - low);
        return hit;
    }
};

struct Skins {
    uint32_t vertices = 0, on_both = 0;
    double share() const { return vertices == 0 ? 0 : static_cast<double>(on_both) / vertices; }
};

/// Of one part of the shell: vertices whose outer point lies on a skin of the input and whose inner point lies on
/// another, that looks the other way.
Skins skins_of(const ShellView& shell, uint32_t part, const Input& input, float near) {
    const ShellRows& s = shell.state;
    std::set<uint32_t> seen;
    Skins skins;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t element = shell.element(e);
        if ((s.elements.flags[element] & kDead) != 0 || s.elements.part[element] != part) continue;
        for (const uint32_t corner : s.elements.corner[element]) {
            if (!seen.insert(corner).second) continue;
            const uint32_t v = shell.vertex(corner);
            const Vec3 outer = s.vertices.rest[v], inward = s.vertices.inward[v];
            const Vec3 inner = outer + s.vertices.depth[v] * inward;
            ++skins.vertices;
            skins.on_both += input.has_skin(outer, -inward, near) && input.has_skin(inner, inward, near);
        }
    }
    return skins;
}

/// `thickness`, m, as cooking is asked for it: that of its walls or so.
void expect_both_skins_break(const char* file, float thickness) {
    const Result<Mesh> mesh = import_model(test::test_data() / "thick_shell" / file);
    ASSERT_TRUE(mesh.ok()) << mesh.error();
    CookSettings settings;
    settings.thickness = thickness;
    settings.thick_shell.measures_threshold = false;
    const Result<Model> model = cook(view_of(*mesh), settings);
    ASSERT_TRUE(model.ok()) << model.error();
    ASSERT_NE(model->report().walls, "") << "its walls were not joined";
    const Input input(*mesh);
    Bare bare(*model);
    State& state = *bare.state;
    const FpMode mode;
    const auto wall = static_cast<float>(model->report().mean_thickness);
    const HitDescription hit =
        bare.blow(normalised(Vec3{1, 0, 1}), 0.6f, 0.3f * static_cast<float>(model->report().mass));
    HitDescription harmless = hit;
    harmless.strength_scale = 1e9f;
    const uint32_t whole =
        run_hit(state, bare.shell, harmless).parts;  // a saucer is one more, and so are loose bits of a mesh
    close_hit(state);
    std::vector<FragmentPart> parts(kMostParts);
    const HitReport report = run_hit(state, bare.shell, hit, nullptr, parts);
    ASSERT_FALSE(report.dropped);
    EXPECT_GE(report.parts, whole + 3) << "pieces come off";
    const ShellView shell(state, state.tasks.working[Row<Tasks>(0)]);
    double mass = 0;
    for (uint32_t p = 0; p < report.parts; ++p) mass += parts[p].mass;
    uint32_t clean = 0;
    for (uint32_t p = 0; p < report.parts; ++p) {
        const FragmentPart& part = parts[p];
        if (!(part.mass > kLargerShare * mass)) continue;
        const Skins skins = skins_of(shell, p, input, kNear * wall);
        std::printf("%s: piece %u, %.1f %% of the mass, %u of %u vertices on both skins\n", file, p,
                    100 * part.mass / mass, skins.on_both, skins.vertices);
        EXPECT_GE(skins.share(), kOfAnyPiece) << file << ", piece " << p;
        clean += skins.share() >= kOfACleanPiece;
    }
    EXPECT_GE(clean, kCleanPieces);
    close_hit(state);
}

TEST(JoinedWalls, OfTheVaseBreakTogether) {
    CULLET_SKIP_WITHOUT_DATA();
    expect_both_skins_break("vase_thick.ply", 0.005f);
}

TEST(JoinedWalls, OfTheEspressoCupBreakTogether) {
    CULLET_SKIP_WITHOUT_DATA();
    expect_both_skins_break("espresso_cup.gltf", 0.011f);
}

}  // namespace
}  // namespace cullet
