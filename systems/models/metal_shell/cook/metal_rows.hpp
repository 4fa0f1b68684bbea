// The rows that a cooked shell has as metal.
#pragma once
#include "components/metal_rows.hpp"
#include "cullet/result.hpp"
#include "systems/models/metal_shell/cook/sub_shells.hpp"

namespace cullet {

struct MetalCookSettings {
    DualSettings dual;
    SubShellSettings cells;
    float crush_pressure = 0;  // Pa; 0: as below
    float body_pressure = 0;   // Pa, of bodies; 0: of an empty closed shell of this width; open sheets have none
    uint8_t published = 0;     // PublishedChoice
    float impulse_time = 0;    // s, tau of the published depth; 0: by the depth of ours
    float tear_strain = 0;     // 0: by the material's
};

/// What was made of it.
struct MetalReport {
    uint32_t cells = 0, ties = 0, components = 0;
    double sum = 0, radius = 0;  // of distances to representatives
};

/// Sub-shells, springs, ties and weights of a shell that has none. An error names the limit that is full.
Result<MetalReport> make_metal_rows(MetalShellRows rows, Row<Structures> shell, const MetalCookSettings& settings);

/// Fills MetalVertices.pin_distance from the shell's pinned vertices.
void measure_pins(MetalShellRows rows, Row<Structures> shell);

}  // namespace cullet
