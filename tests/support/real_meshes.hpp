// Meshes of the data folder, read as the game reads any model.
#pragma once
#include <gtest/gtest.h>

#include <unistd.h>

#include <string>

#include "engine/import/import_mesh.hpp"
#include "systems/cook/surface.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_data.hpp"

namespace cullet::test {

/// `name` is a path in the folder, "thick_shell/husky.glb". Empty, and the test has failed, when it cannot be read.
inline Mesh read_real_mesh(const std::string& name) {
    const std::filesystem::path cache =
        std::filesystem::path(testing::TempDir()) / ("cullet_real_meshes." + std::to_string(getpid()));
    std::filesystem::create_directories(cache);
    Result<Mesh> mesh = import_mesh(test_data() / name, build_folder() + "/cullet_import", cache);
    std::filesystem::remove_all(cache);
    if (!mesh) ADD_FAILURE() << mesh.error();
    return mesh ? std::move(mesh).value() : Mesh{};
}

/// One component of a surface as a mesh of its own.
inline Mesh component_mesh(const Surface& surface, uint32_t component) {
    Mesh mesh;
    mesh.name = "component " + std::to_string(component);
    for (const Vec3d p : surface.positions) mesh.positions.push_back(p.to_float());
    for (uint32_t t = 0; t < surface.triangles.size(); ++t)
        if (surface.component_of[t] == component) {
            const Triangle& c = surface.triangles[t];
            mesh.triangles.push_back({c[0], c[1], c[2]});
        }
    return mesh;
}

}  // namespace cullet::test
