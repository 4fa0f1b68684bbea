// What the claims of metal shells draw, and the shells that they speak of.
#pragma once
#include <optional>

#include "sample_game/metal/metal_bench.hpp"
#include "sample_game/picture.hpp"
#include "sample_game/reproduce/bench.hpp"
#include "sample_game/reproduce/metal/plot.hpp"

namespace cullet::reproduce {

/// As it is now; one colour a sub-shell, or all in one. A panel is drawn with its +z upward.
Picture draw_metal(Bench& bench, const MetalBench& metal, const Camera& camera, bool shows_cells = false);
Camera camera_at(Vec3 eye, Vec3 target, float field_of_view = 0.5f);
Result<void> add_plot(Bench& bench, Claim& claim, const Plot& plot, const std::string& name,
                      const std::string& caption);

/// The panel of the paper's second example: 19,200 triangles, 128 sub-shells, clamped.
Result<MetalBench> paper_panel(Bench& bench, uint8_t published);
/// A car body; nothing, with a note, where there is none.
std::optional<MetalBench> paper_car(Bench& bench, uint8_t published);

/// A plane, a pole or a ball that comes along `push` and meets the shell first where it does.
Striker coming(const MetalBench& metal, StrikerShape shape, Vec3d push, double radius, Vec3d through);

inline constexpr double kMostStretch = 0.25, kMostShortening = 0.4;  // of steel

}  // namespace cullet::reproduce
