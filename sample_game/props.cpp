#include "sample_game/props.hpp"

#include <algorithm>
#include <cmath>

#include "engine/math.hpp"
#include "engine/random.hpp"
#include "sample_game/meshes.hpp"

namespace cullet {

MeshView view_of(const Mesh& mesh) {
    MeshView view;
    view.positions = mesh.positions.data();
    view.position_count = mesh.positions.size();
    view.indices = mesh.triangles.empty() ? nullptr : mesh.triangles[0].data();
    view.triangle_count = mesh.triangles.size();
    view.corner_normals = mesh.corner_normals.empty() ? nullptr : mesh.corner_normals.data();
    view.corner_uvs = mesh.corner_uvs.empty() ? nullptr : mesh.corner_uvs.data();
    view.materials = mesh.materials.empty() ? nullptr : mesh.materials.data();
    view.name = mesh.name.c_str();
    return view;
}

Mesh moved(Mesh mesh, Vec3 by) {
    for (Vec3& p : mesh.positions) p += by;
    return mesh;
}

Prop box_prop(Vec3 low, Vec3 high, Vec3 colour) {
    Prop prop;
    prop.mesh = moved(make_box(0.5f * (high - low)), 0.5f * (low + high));
    prop.colour = colour;
    return prop;
}

Prop floor_prop(float half_side, float height) {
    // Half a metre thick, so that nothing that the sweep leaves in it comes out below.
    Prop prop =
        box_prop({-half_side, height - 0.5f, -half_side}, {half_side, height, half_side}, {0.30f, 0.29f, 0.27f});
    prop.is_ground = true;
    return prop;
}

MeshExtent extent_of(const Mesh& mesh) {
    if (mesh.positions.empty()) return {};
    Vec3 low = mesh.positions[0], high = low;
    for (const Vec3 p : mesh.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return {low, high};
}

float largest_side(const Mesh& mesh) {
    const auto [low, high] = extent_of(mesh);
    return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

bool fit(Mesh& mesh, float size) {
    const auto [low, high] = extent_of(mesh);
    const float largest = largest_side(mesh);
    if (!(largest > 0)) return false;
    const Vec3 middle = 0.5f * (low + high);
    for (Vec3& p : mesh.positions) p = (size / largest) * (p - middle);
    return true;
}

double seeded(uint64_t seed, uint32_t number) {
    return 2 * Random{seed}.uniform(0x5ce9e, number) - 1;
}

Quat turn(Vec3 axis, double angle) {
    double sine = 0, cosine = 1;
    sine_cosine(0.5 * angle, sine, cosine);
    const Vec3 a = static_cast<float>(sine) * normalised(axis);
    return {a.x, a.y, a.z, static_cast<float>(cosine)};
}

Quat any_turn(uint64_t seed, uint32_t first_number) {
    // K. Shoemake, "Uniform random rotations", 1992.
    constexpr double kTurn = 6.283185307179586477;
    const double u = 0.5 * (seeded(seed, first_number) + 1);
    double s1 = 0, c1 = 0, s2 = 0, c2 = 0;
    sine_cosine(0.5 * kTurn * (seeded(seed, first_number + 1) + 1), s1, c1);
    sine_cosine(0.5 * kTurn * (seeded(seed, first_number + 2) + 1), s2, c2);
    const double a = std::sqrt(1 - u), b = std::sqrt(u);
    return normalised(Quat{static_cast<float>(a * s1), static_cast<float>(a * c1), static_cast<float>(b * s2),
                           static_cast<float>(b * c2)});
}

}  // namespace cullet
