// The four ways of pushing the inner surface inward, as tests ask for them.
#pragma once
#include <gtest/gtest.h>

#include "systems/structures/shell/cook/extrude.hpp"

namespace cullet::test {

inline constexpr Propagation kWays[] = {Propagation::GuardedFront, Propagation::Front, Propagation::SingleVertex,
                                        Propagation::SingleVertexTets};

/// Empty, and the test has failed, where the mesh is refused.
inline Surface prepared(const Mesh& mesh) {
    Result<Surface> surface = prepare_surface(mesh);
    EXPECT_TRUE(surface.ok()) << surface.error();
    return surface.ok() ? std::move(surface).value() : Surface{};
}

inline Extrusion extruded(const Surface& surface, double thickness, const ExtrusionSettings& settings) {
    Result<Extrusion> shell = extrude(surface, thickness, settings);
    EXPECT_TRUE(shell.ok()) << shell.error();
    return shell.ok() ? std::move(shell).value() : Extrusion{};
}

/// 0.5 to 15 % of the diagonal, thin ones more often.
inline double random_thickness(const Surface& surface, uint64_t number) {
    const double part = static_cast<double>(number % 1000) / 1000;
    return surface.diagonal * 0.005 * (1 + 29 * part * part);
}

}  // namespace cullet::test
