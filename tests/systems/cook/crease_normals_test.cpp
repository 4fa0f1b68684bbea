// Normals that cooking makes: smooth where the mesh is smooth, sharp where it creases, and left alone by cracks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "systems/cook/crease_normals.hpp"
#include "tests/support/simple_meshes.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

/// A prism along y with `sides` sides, each turned from the next by 360 / sides degrees, with flat lids.
Mesh prism(uint32_t sides, double radius = 0.1, double height = 0.2) {
    Mesh mesh;
    for (const double y : {0.0, height})
        for (uint32_t s = 0; s < sides; ++s) {
            double sine, cosine;
            sine_cosine(2 * kPi * s / sides, sine, cosine);
            mesh.positions.push_back(Vec3d(radius * cosine, y, -radius * sine).to_float());
        }
    for (uint32_t s = 0; s < sides; ++s) {
        const uint32_t next = (s + 1) % sides;
        mesh.triangles.push_back({s, next, sides + next});
        mesh.triangles.push_back({s, sides + next, sides + s});
        if (s + 2 < sides) mesh.triangles.push_back({0, s + 2, s + 1});
        if (s + 2 < sides) mesh.triangles.push_back({sides, sides + s + 1, sides + s + 2});
    }
    return mesh;
}

Vec3 flat_of(const Mesh& mesh, size_t t) {
    const auto& c = mesh.triangles[t];
    return normalised(cross(mesh.positions[c[1]] - mesh.positions[c[0]], mesh.positions[c[2]] - mesh.positions[c[0]]));
}

Mesh with_normals(Mesh mesh) {
    const Result<Surface> surface = prepare_surface(mesh);
    EXPECT_TRUE(surface.ok()) << surface.error();
    give_crease_normals(mesh, *surface);
    return mesh;
}

TEST(CreaseNormals, OfABoxAreItsSixDirections) {
    const Mesh box = with_normals(prism(4));
    for (size_t c = 0; c < box.corner_normals.size(); ++c)
        EXPECT_GT(dot(box.corner_normals[c], flat_of(box, c / 3)), 1 - 1e-6f);
}

TEST(CreaseNormals, RunSmoothlyRoundAPrismWhoseSidesTurnByLessThanFortyDegrees) {
    for (const uint32_t sides : {8u, 10u}) {  // 45 and 36 degrees
        const Mesh mesh = with_normals(prism(sides));
        for (size_t c = 0; c < mesh.corner_normals.size(); ++c) {
            const Vec3 flat = flat_of(mesh, c / 3), n = mesh.corner_normals[c];
            const bool is_lid = std::fabs(flat.y) > 0.9f;
            const Vec3 p = mesh.positions[mesh.triangles[c / 3][c % 3]];
            const Vec3 outward = normalised(Vec3{p.x, 0, p.z});
            const Vec3 wanted = is_lid || sides == 8 ? flat : outward;
            EXPECT_GT(dot(n, wanted), 1 - 1e-5f) << sides << " sides, corner " << c;
        }
    }
}

TEST(CreaseNormals, CreaseFromFortyDegreesOn) {
    for (const double degrees : {39.9, 40.1}) {
        double sine, cosine;
        sine_cosine(degrees * kPi / 180, sine, cosine);
        Mesh bent;
        bent.positions = {{0, 0, 0}, {0, 0, 1}, {-1, 0, 0}, Vec3d(cosine, -sine, 0).to_float()};
        bent.triangles = {{0, 2, 1}, {0, 1, 3}};
        bent = with_normals(bent);
        const bool is_sharp = dot(bent.corner_normals[0], flat_of(bent, 0)) > 1 - 1e-6f;
        EXPECT_EQ(is_sharp, degrees > 40) << degrees;
    }
}

TEST(CreaseNormals, OfASpherePointOutwardAndDoNotDependOnItsNumbering) {
    const Mesh sphere = sphere_mesh(0.2, 3);
    const Mesh made = with_normals(sphere);
    for (size_t c = 0; c < made.corner_normals.size(); ++c)
        EXPECT_GT(dot(made.corner_normals[c], normalised(sphere.positions[sphere.triangles[c / 3][c % 3]])), 0.9995f);
    Mesh shuffled = sphere;
    std::mt19937 random(5);
    std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), random);
    shuffled = with_normals(shuffled);
    for (size_t t = 0; t < shuffled.triangles.size(); ++t) {
        const auto at = std::find(made.triangles.begin(), made.triangles.end(), shuffled.triangles[t]);
        for (size_t k = 0; k < 3; ++k) {
            const Vec3 a = shuffled.corner_normals[3 * t + k];
            const Vec3 b = made.corner_normals[3 * static_cast<size_t>(at - made.triangles.begin()) + k];
            EXPECT_TRUE(a == b) << "triangle " << t;
        }
    }
}

struct Broken {
    World world;
    uint32_t born = 0;
};

/// Thrown on a floor, and on to rest for half a second.
Broken thrown(const Mesh& mesh, float thickness, float speed) {
    CookSettings settings;
    settings.thickness = thickness;
    settings.longest_edge = 0.02f;
    settings.thick_shell.measures_threshold = false;
    const Result<Model> model = cook(view_of_mesh(mesh), settings);
    EXPECT_TRUE(model.ok()) << model.error();
    Settings world_settings = small_settings();
    world_settings.gravity = {0, -9.81f, 0};
    Broken broken{make_world(world_settings)};
    (void)add_floor(broken.world);
    SpawnSettings spawn;
    spawn.pose = {{0, 0.3f, 0}, normalised(Quat{0.3f, 0.1f, 0.2f, 1})};
    spawn.motion.velocity = {0, -speed, 0};
    EXPECT_TRUE(broken.world.spawn(broken.world.add_model(*model).value(), spawn).ok());
    for (int frame = 0; frame < 30; ++frame) {
        broken.world.step();
        broken.born += static_cast<uint32_t>(broken.world.events().fragments_born.count);
    }
    return broken;
}

template <class F>
void for_each_outer_corner(const World& world, const F& visit) {
    for (const BodyId body : shells_of(world)) {
        const BodyView view = world.view(body).value();
        for (uint32_t r = 0; r < view.run_count; ++r) {
            if (view.runs[r].kind != SurfaceKind::Outer) continue;
            for (uint32_t i = 0; i < view.runs[r].index_count; i += 3) {
                const uint32_t* index = view.indices + view.runs[r].first_index + i;
                const Vec3 p = view.vertices[index[0]].position;
                const Vec3 flat =
                    normalised(cross(view.vertices[index[1]].position - p, view.vertices[index[2]].position - p));
                for (int k = 0; k < 3; ++k) visit(view.vertices[index[k]], flat);
            }
        }
    }
}

TEST(CreaseNormals, EdgesOfABoxStaySharpThroughSplitsAndCracksLeaveItsFacesFlat) {
    const Broken broken = thrown(prism(4), 0.006f, 12);
    EXPECT_GT(broken.born, 2u);
    uint32_t corners = 0;
    for_each_outer_corner(broken.world, [&](const ViewVertex& v, Vec3 flat) {
        ++corners;
        ASSERT_GT(dot(v.normal, flat), 1 - 1e-4f);
    });
    EXPECT_GT(corners, 3000u);
}

TEST(CreaseNormals, CracksDoNotChangeTheShadingOfTheOuterFaceBesideThem) {
    // The smooth field of the coarse mesh as it was given: where a drawn corner stands, whatever cut the surface since.
    const Mesh given = with_normals(sphere_mesh(0.12, 2));
    const Broken broken = thrown(sphere_mesh(0.12, 2), 0.004f, 12);
    EXPECT_GT(broken.born, 2u);
    const auto normal_at = [&](Vec3 at) {
        for (size_t t = 0; t < given.triangles.size(); ++t) {
            const auto& c = given.triangles[t];
            const Vec3d a(given.positions[c[0]]), b(given.positions[c[1]]), d(given.positions[c[2]]), p(at);
            const Vec3d n = cross(b - a, d - a);
            const double whole = dot(n, n), v = dot(n, cross(p - a, d - a)) / whole,
                         w = dot(n, cross(b - a, p - a)) / whole;
            if (v < -2e-3 || w < -2e-3 || v + w > 1 + 2e-3 || dot(n, p) < 0)
                continue;  // a smoothed crack leaves the facets
            return normalised(static_cast<float>(1 - v - w) * given.corner_normals[3 * t] +
                              static_cast<float>(v) * given.corner_normals[3 * t + 1] +
                              static_cast<float>(w) * given.corner_normals[3 * t + 2]);
        }
        return Vec3{};
    };
    float worst = 1;
    uint32_t corners = 0;
    for_each_outer_corner(broken.world, [&](const ViewVertex& v, Vec3) {
        worst = std::min(worst, dot(v.normal, normal_at(v.position)));
        ++corners;
    });
    EXPECT_GT(corners, 3000u);
    EXPECT_GT(worst, 0.9995f);  // 1.8 degrees: normalised steps on the way are not one normalised mean
}

}  // namespace
}  // namespace cullet::test
