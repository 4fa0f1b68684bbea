// The bodies of the paper's tables.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "sample_game/meshes.hpp"
#include "systems/cook/surface.hpp"

namespace cullet {
namespace {

struct Wanted {
    const char* name;
    Mesh mesh;
    size_t vertices, triangles, places;
    uint32_t holes;  // handles of the surface: 1 for a ring
};

/// Made once: figures are remeshed, which takes a second each.
const std::vector<Wanted>& bodies() {
    static std::vector<Wanted> all;
    if (!all.empty()) return all;
    all.push_back({"pig", make_pig(), 3500, 6996, 3500, 0});
    all.push_back({"cow", make_cow(), 3000, 5700, 2852, 0});
    all.push_back({"castle", make_castle(3, 6500), 6500, 13'000, 6500, 1});
    all.push_back({"fine castle", make_castle(3, 11'000), 11'000, 22'000, 11'000, 1});
    all.push_back({"slab", make_slab(), 600, 1196, 600, 0});
    return all;
}

/// Edges by position, each with how often it is walked one way and the other.
std::map<std::pair<uint32_t, uint32_t>, std::pair<int, int>> edges_of(const Surface& s) {
    std::map<std::pair<uint32_t, uint32_t>, std::pair<int, int>> edges;
    for (const Triangle& t : s.triangles)
        for (size_t c = 0; c < 3; ++c) {
            const uint32_t a = s.position_ids[t[c]], b = s.position_ids[t[(c + 1) % 3]];
            auto& uses = edges[std::minmax(a, b)];
            (a < b ? uses.first : uses.second) += 1;
        }
    return edges;
}

TEST(PaperMeshes, HaveTheCountsOfThePapersTables) {
    for (const Wanted& body : bodies()) {
        SCOPED_TRACE(body.name);
        EXPECT_EQ(body.mesh.positions.size(), body.vertices);
        EXPECT_EQ(body.mesh.triangles.size(), body.triangles);
        std::set<std::array<float, 3>> places;
        for (const Vec3 p : body.mesh.positions) places.insert({p.x, p.y, p.z});
        EXPECT_EQ(places.size(), body.places);
        std::printf("%-12s %6zu vertices %6zu triangles\n", body.name, body.mesh.positions.size(),
                    body.mesh.triangles.size());
    }
}

TEST(PaperMeshes, AreClosedManifoldsInOnePieceThatFaceOutward) {
    for (const Wanted& body : bodies()) {
        SCOPED_TRACE(body.name);
        const Result<Surface> surface = prepare_surface(body.mesh);
        ASSERT_TRUE(surface.ok()) << surface.error();
        EXPECT_EQ(surface->components.size(), 1u);
        EXPECT_EQ(surface->repairs.open_borders, 0u);
        EXPECT_EQ(surface->repairs.split_vertices, 0u);
        EXPECT_EQ(surface->repairs.crowded_edges, 0u);
        EXPECT_EQ(surface->repairs.flipped_triangles, 0u);
        EXPECT_EQ(surface->repairs.zero_area_triangles, 0u);
        EXPECT_EQ(surface->positions.size(), body.places);
        EXPECT_TRUE(surface->components[0].is_closed);
        EXPECT_GT(surface->components[0].volume, 0);
        const auto edges = edges_of(*surface);
        for (const auto& [ends, uses] : edges) ASSERT_TRUE(uses.first == 1 && uses.second == 1);
        const long euler =
            static_cast<long>(body.places) - static_cast<long>(edges.size()) + static_cast<long>(body.triangles);
        EXPECT_EQ(euler, 2 - 2 * static_cast<long>(body.holes));
    }
}

TEST(PaperMeshes, DoNotCrossThemselves) {
    std::vector<Mesh> meshes{make_castle(3, 4500, 2), make_castle(1, 30'000, 3),
                             make_slab({2.4f, 1.8f, 0.05f}, 900, 2)};
    for (const Wanted& body : bodies()) meshes.push_back(body.mesh);
    for (const Mesh& mesh : meshes) {
        const Result<Surface> surface = prepare_surface(mesh);
        ASSERT_TRUE(surface.ok()) << surface.error();
        EXPECT_EQ(surface->crossings.size(), 0u) << mesh.name << " of " << mesh.positions.size();
    }
}

TEST(PaperMeshes, HaveFewThinTriangles) {
    for (const Wanted& body : bodies()) {
        size_t thin = 0;
        double least = 180;
        for (const auto& t : body.mesh.triangles) {
            double smallest = 180;
            for (size_t c = 0; c < 3; ++c) {
                const Vec3d p(body.mesh.positions[t[c]]);
                const Vec3d u = normalised(Vec3d(body.mesh.positions[t[(c + 1) % 3]]) - p);
                const Vec3d v = normalised(Vec3d(body.mesh.positions[t[(c + 2) % 3]]) - p);
                smallest = std::min(smallest, std::acos(dot(u, v)) * 57.29577951308232);
            }
            thin += smallest < 15;
            least = std::min(least, smallest);
        }
        EXPECT_LT(static_cast<double>(thin), 0.03 * static_cast<double>(body.triangles)) << body.name;
        EXPECT_GT(least, 3) << body.name;
    }
}

TEST(PaperMeshes, ThePigHasTheVolumeThatItsPartsAddUpTo) {
    // Between the trunk alone and all parts as if none lay within another (4/3 pi abc each), at a length of 0.5 m.
    const Result<Surface> surface = prepare_surface(bodies()[0].mesh);
    const double scale = 0.125, trunk = 4.18879 * 0.335 * 0.205 * 0.195;
    EXPECT_GT(surface->components[0].volume, 0.7 * scale * trunk);
    EXPECT_LT(surface->components[0].volume, 2.2 * scale * trunk);
}

TEST(PaperMeshes, ACastleHasFlatWallsAndStandsOnTheGround) {
    const Mesh castle = make_castle(3, 6500);
    float low = 1, width = 0;
    size_t on_ground = 0;
    for (const Vec3 p : castle.positions) {
        low = std::min(low, p.y), width = std::max(width, p.x);
        on_ground += p.y == 0;
    }
    EXPECT_EQ(low, 0);
    EXPECT_NEAR(width, 1.5, 1e-6);
    EXPECT_GT(on_ground, 200u);
}

TEST(PaperMeshes, AreFoundByTheirNames) {
    for (const char* name : {"vase", "wall", "pane", "pig", "castle_fine", "slab"})
        EXPECT_FALSE(make_mesh_named(name).triangles.empty()) << name;
    EXPECT_TRUE(make_mesh_named("dragon").triangles.empty());
}

}  // namespace
}  // namespace cullet
