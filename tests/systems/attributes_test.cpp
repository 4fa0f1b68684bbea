// The game's normals, texture coordinates and material ids, from the mesh that it gives to the mesh that it draws.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "cullet/world.hpp"
#include "engine/math.hpp"

namespace cullet {
namespace {

constexpr uint32_t kRings = 12, kSegments = 20;  // between poles; north of the middle smooth, south of it in facets
constexpr float kRadius = 0.1f;
constexpr uint16_t kNorth = 300, kSouth = 7;

struct Globe {
    std::vector<Vec3> positions;  // three a triangle: cooking welds
    std::vector<Vec3> normals;
    std::vector<Vec2> uvs;
    std::vector<uint16_t> materials;
    std::vector<uint32_t> indices;

    explicit Globe(const std::function<uint16_t(uint32_t ring)>& material) {
        for (uint32_t ring = 0; ring < kRings; ++ring)
            for (uint32_t s = 0; s < kSegments; ++s) {
                const bool is_south = ring < kRings / 2;
                if (ring > 0) add({{{ring, s}, {ring + 1, s}, {ring, s + 1}}}, is_south, material(ring));
                if (ring + 1 < kRings)
                    add({{{ring, s + 1}, {ring + 1, s}, {ring + 1, s + 1}}}, is_south, material(ring));
            }
    }
    void add(std::array<std::array<uint32_t, 2>, 3> at, bool is_flat, uint16_t material) {
        Vec3 p[3];
        for (size_t k = 0; k < 3; ++k) {
            double ls, lc, ss, sc;
            sine_cosine(3.14159265358979 * (double(at[k][0]) / kRings - 0.5), ls, lc);
            sine_cosine(6.28318530717959 * double(at[k][1] % kSegments) / kSegments, ss, sc);
            if (at[k][0] == 0 || at[k][0] == kRings) lc = 0;
            p[k] = (kRadius * Vec3d(lc * sc, ls, -lc * ss)).to_float();
        }
        const Vec3 facet = normalised(cross(p[1] - p[0], p[2] - p[0]));
        const bool is_turned = dot(facet, p[0] + p[1] + p[2]) < 0;
        for (size_t i = 0; i < 3; ++i) {
            const size_t k = is_turned ? 2 - i : i;
            indices.push_back(static_cast<uint32_t>(positions.size()));
            positions.push_back(p[k]);
            normals.push_back(is_flat ? (is_turned ? -facet : facet) : normalised(p[k]));
            // The seam: the last segment ends at 1, not at 0.
            uvs.push_back({float(at[k][1]) / kSegments, float(at[k][0]) / kRings});
        }
        materials.push_back(material);
    }
    MeshView view() const {
        MeshView mesh;
        mesh.positions = positions.data();
        mesh.position_count = positions.size();
        mesh.indices = indices.data();
        mesh.triangle_count = indices.size() / 3;
        mesh.corner_normals = normals.data();
        mesh.corner_uvs = uvs.data();
        mesh.materials = materials.data();
        mesh.name = "globe";
        return mesh;
    }
    /// Shares of the corners of triangle t at a point of its plane.
    std::array<float, 3> shares(size_t t, Vec3 at) const {
        const Vec3* p = &positions[3 * t];
        const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
        const float whole = dot(n, n);
        const float b = dot(n, cross(at - p[0], p[2] - p[0])) / whole,
                    c = dot(n, cross(p[1] - p[0], at - p[0])) / whole;
        return {1 - b - c, b, c};
    }
    /// The triangle on which a point stands, by the least of its shares.
    size_t triangle_at(Vec3 at) const {
        size_t best = 0;
        float most = -1e9f;
        for (size_t t = 0; t < materials.size(); ++t) {
            if (dot(positions[3 * t], at) < 0) continue;  // the other side of the globe
            const auto s = shares(t, at);
            const float least = std::min({s[0], s[1], s[2]});
            if (least > most) most = least, best = t;
        }
        return best;
    }
};

uint16_t half(uint32_t ring) {
    return ring < kRings / 2 ? kSouth : kNorth;
}

void expect_runs_cover(const BodyView& view) {
    uint32_t first = 0;
    for (uint32_t r = 0; r < view.run_count; ++r) {
        const MaterialRun& run = view.runs[r];
        EXPECT_EQ(run.first_index, first);
        EXPECT_GT(run.index_count, 0u);
        EXPECT_EQ(run.index_count % 3, 0u);
        const MaterialRun& before = view.runs[r > 0 ? r - 1 : 0];
        EXPECT_TRUE(r == 0 || std::pair(before.kind, before.material) < std::pair(run.kind, run.material));
        first += run.index_count;
    }
    EXPECT_EQ(first, view.index_count);
}

struct Seen {
    std::map<uint16_t, double> area;  // of the outer side, m2
    uint32_t corners = 0, crack_runs = 0;
    float worst_uv = 0;
};

/// Each drawn outer triangle stands on one of the globe's and has its uv, normal and material there.
void look_at(const Globe& globe, const BodyView& view, Seen& seen) {
    expect_runs_cover(view);
    for (uint32_t r = 0; r < view.run_count; ++r) {
        const MaterialRun& run = view.runs[r];
        EXPECT_TRUE(run.material == kNorth || run.material == kSouth) << run.material;
        seen.crack_runs += run.kind == SurfaceKind::Crack;
        if (run.kind != SurfaceKind::Outer) continue;
        for (uint32_t i = run.first_index; i < run.first_index + run.index_count; i += 3) {
            const ViewVertex* v[3];
            for (uint32_t k = 0; k < 3; ++k) v[k] = &view.vertices[view.indices[i + k]];
            const Vec3 normal = cross(v[1]->position - v[0]->position, v[2]->position - v[0]->position);
            seen.area[run.material] += 0.5 * length(normal);
            const Vec3 middle = (1.0f / 3) * (v[0]->position + v[1]->position + v[2]->position);
            const size_t t = globe.triangle_at(middle);
            ASSERT_EQ(globe.materials[t], run.material);
            for (const ViewVertex* vertex : v) {
                const auto share = globe.shares(t, vertex->position);
                Vec2 uv;
                Vec3 wanted;
                for (size_t k = 0; k < 3; ++k) {
                    uv.x += share[k] * globe.uvs[3 * t + k].x, uv.y += share[k] * globe.uvs[3 * t + k].y;
                    wanted += share[k] * globe.normals[3 * t + k];
                }
                ++seen.corners;
                seen.worst_uv =
                    std::max({seen.worst_uv, std::fabs(uv.x - vertex->uv.x), std::fabs(uv.y - vertex->uv.y)});
                ASSERT_NEAR(length(vertex->normal), 1, 1e-4f);
                ASSERT_GT(dot(vertex->normal, normalised(wanted)), run.material == kSouth ? 0.9999f : 0.995f);
                ASSERT_GT(dot(vertex->normal, normal), 0);
            }
        }
    }
}

Result<Model> cook_globe(const Globe& globe) {
    CookSettings settings;
    settings.thickness = 0.004f;
    settings.longest_edge = 0.02f;  // the facets are up to 0.031 m wide, so tessellation has work
    settings.thick_shell.measures_threshold = false;
    return cook(globe.view(), settings);
}

Settings small_world() {
    Settings settings;
    settings.units_a_frame = 1'000'000'000;
    settings.limits = {256, 4, 1u << 16, 1u << 17, 4, 1u << 19, 256};
    return settings;
}

TEST(Attributes, AnIntactBodyIsDrawnWithTheGamesNormalsUvsAndMaterials) {
    const Globe globe(half);
    const Result<Model> model = cook_globe(globe);
    ASSERT_TRUE(model.ok()) << model.error();
    Result<World> world = World::create(small_world());
    ASSERT_TRUE(world.ok()) << world.error();
    const BodyId body = world->spawn(world->add_model(*model).value()).value();
    const BodyView view = world->view(body).value();
    ASSERT_EQ(view.run_count, 4u);  // outer and inner, each south and north
    Seen seen;
    look_at(globe, view, seen);
    EXPECT_LT(seen.worst_uv, 1e-4f);
    EXPECT_GT(seen.corners, 3 * globe.materials.size());  // some were cut smaller
    std::map<uint16_t, double> area;
    for (size_t t = 0; t < globe.materials.size(); ++t) {
        const Vec3* p = &globe.positions[3 * t];
        area[globe.materials[t]] += 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
    }
    for (const auto& [material, whole] : area) EXPECT_NEAR(seen.area[material], whole, 1e-4 * whole) << material;
}

TEST(Attributes, FragmentsKeepThemThroughInsertsAndSplits) {
    const Globe globe(half);
    const Result<Model> model = cook_globe(globe);
    ASSERT_TRUE(model.ok()) << model.error();
    Result<World> world = World::create(small_world());
    ASSERT_TRUE(world.ok()) << world.error();
    const Vec3 corners[] = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    MeshView floor;
    floor.positions = corners, floor.position_count = 4, floor.indices = quad, floor.triangle_count = 2;
    ASSERT_TRUE(world->add_static(floor).ok());
    SpawnSettings spawn;
    spawn.pose = {{0, 0.25f, 0}, normalised(Quat{0.5f, 0.1f, 0.2f, 1})};
    spawn.motion.velocity = {0, -12, 0};
    ASSERT_TRUE(world->spawn(world->add_model(*model).value(), spawn).ok());
    uint32_t born = 0;
    for (int frame = 0; frame < 30; ++frame) {
        world->step();
        born += static_cast<uint32_t>(world->events().fragments_born.count);
    }
    EXPECT_GT(born, 3u);
    std::vector<BodyId> bodies(256);
    bodies.resize(world->bodies(bodies.data(), 256));
    Seen seen;
    for (const BodyId body : bodies) look_at(globe, world->view(body).value(), seen);
    RecordProperty("corners", static_cast<int>(seen.corners));
    EXPECT_GT(seen.crack_runs, 3u);
    EXPECT_LT(seen.worst_uv, 1e-4f);
    EXPECT_GT(seen.area[kNorth], 0.02);
    EXPECT_GT(seen.area[kSouth], 0.02);
}

TEST(Attributes, MoreMaterialsThanABodyHasRunsShareTheLast) {
    const Globe globe([](uint32_t ring) { return static_cast<uint16_t>(1000 - 10 * ring); });  // 12, falling
    const Result<Model> model = cook_globe(globe);
    ASSERT_TRUE(model.ok()) << model.error();
    Result<World> world = World::create(small_world());
    ASSERT_TRUE(world.ok()) << world.error();
    const BodyId body = world->spawn(world->add_model(*model).value()).value();
    const BodyView view = world->view(body).value();
    expect_runs_cover(view);
    ASSERT_EQ(view.run_count, 2 * kMostDrawnMaterials);
    for (uint32_t r = 0; r < view.run_count; ++r) {
        EXPECT_EQ(view.runs[r].kind, r < kMostDrawnMaterials ? SurfaceKind::Outer : SurfaceKind::Inner);
        EXPECT_EQ(view.runs[r].material, 890 + 10 * (r % kMostDrawnMaterials));
    }
    // The eighth, 960, holds 960 to 1000.
    EXPECT_GT(view.runs[7].index_count, 2 * view.runs[6].index_count);
}

TEST(Attributes, AMeshWithoutMaterialsHasOneRunAKind) {
    const Globe globe(half);
    MeshView mesh = globe.view();
    mesh.materials = nullptr;
    CookSettings settings;
    settings.thickness = 0.004f;
    settings.thick_shell.measures_threshold = false;
    const Result<Model> model = cook(mesh, settings);
    ASSERT_TRUE(model.ok()) << model.error();
    Result<World> world = World::create(small_world());
    ASSERT_TRUE(world.ok()) << world.error();
    const BodyView view = world->view(world->spawn(world->add_model(*model).value()).value()).value();
    expect_runs_cover(view);
    ASSERT_EQ(view.run_count, 2u);
    EXPECT_EQ(view.runs[0].material, 0);
}

}  // namespace
}  // namespace cullet
