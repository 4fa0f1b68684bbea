// Shells as generation makes them, timed and then checked by means of their own: what Table 1 and its pictures are of.
#pragma once
#include <functional>
#include <span>
#include <string>

#include "sample_game/picture.hpp"
#include "systems/structures/shell/cook/extrude.hpp"

namespace cullet::reproduce {

/// One way to propagate. Another mode is one more line in propagation_modes(); the default is the last.
struct PropagationMode {
    const char* name;
    void (*choose)(ExtrusionSettings&);
};
std::span<const PropagationMode> propagation_modes();
ExtrusionSettings settings_of(const PropagationMode& mode);

struct GeneratedShell {
    Extrusion extrusion;
    double ms = 0;  // of the processor: extrusion and crossing test of the input, least of the rounds
    // Found afterwards, not by the extrusion: pairs of triangles of both surfaces that meet, elements with a
    // tetrahedron that is not positive although its corner has depth, mean depth by area over the wanted one.
    size_t crossings = 0, inverted = 0;
    double mean_depth = 0;
};
/// Thickness in metres.
Result<GeneratedShell> generate(const Surface& surface, double thickness, const ExtrusionSettings& settings,
                                uint32_t rounds);

/// Both surfaces in one mesh: the outer one, then the inner one turned round.
Mesh both_surfaces(const Surface& surface, std::span<const Vec3d> inner);
std::vector<Vec3d> inner_positions(const Surface& surface, const Extrusion& extrusion);

/// The figures' look: the inner surface red, the edges of the outer one as white wires, seen through. Triangles that
/// are marked (one byte each, or none) are yellow.
Picture draw_shell(const Surface& surface, std::span<const Vec3d> inner, const Camera& camera, uint32_t width,
                   uint32_t threads, float wire_radius, std::span<const uint8_t> marked = {});

}  // namespace cullet::reproduce
