// Strips of two-dimensional lattice against the theory of beams, for the cases of truth and for tests.
#pragma once
#include <cmath>

#include "sample_game/spring_bench.hpp"

namespace cullet {

/// A strip of equilateral triangles along x, free in space, symmetric about x = 0.
struct StripSize {
    uint32_t half_edges = 20, rows = 8;  // rows even: both borders are alike
    double edge = 0.01, thickness = 0.002;
    double row_height() const { return edge * std::sqrt(0.75); }
    double width() const { return row_height() * rows; }
};

/// Pulled at both ends to a strain of 1e-3 by theory.
struct Stretch {
    double elongation;   // over F L / (E w h)
    double contraction;  // over the elongation: Poisson's ratio
};
Stretch measure_stretch(const StripSize& strip, const BenchMaterial& material, const SpringSettings& settings);

/// Pushed up in the middle and down at both ends: two cantilevers back to back, so that nothing has to be clamped.
/// Deflection over F L^3 / (3 E I), I = w h^3 / 12; the paper's layout over 1 / (3 gamma^2) of it.
double measure_bending(const StripSize& strip, const BenchMaterial& material, const SpringSettings& settings);

}  // namespace cullet
