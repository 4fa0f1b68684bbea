// Dents beside a shell FEM: curves of CalculiX, measures, and the decks that made them.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "cullet/result.hpp"
#include "sample_game/metal/metal_bench.hpp"

namespace cullet {

/// A clamped sheet that a square patch of even pressure presses at its middle, and lets go.
struct FemCase {
    double width = 1.2, height = 0.8, thickness = 1e-3;  // m
    std::string material = "steel";
    double young_modulus = 205e9, poisson_ratio = 0.3, yield_stress = 250e6;  // Pa
    double patch = 0.1;                                                       // m, its side
    double pressure = 1e6;                                                    // Pa
};

/// How deep the mid-line stays dented, m, by the distance from the middle.
struct FemCurve {
    std::vector<double> x, depth;
    double work = 0;  // J, done by the press; 0: it is not said
    double at(double x) const;
};
/// Text as of `NAME unloaded`, then "x:mm" pairs, then "work ~ W J".
Result<FemCurve> read_fem_curve(const std::string& path);
/// What ccx prints of a deck of write_fem_deck (NAME.dat).
Result<FemCurve> read_fem_results(const std::string& path, const FemCase& of);
/// A deck as of the reference curves: S8R, a quarter of the sheet, up and down in two steps.
std::string fem_deck(const FemCase& of);

/// Of our mid-line y beside theirs F; y0 is the flat sheet.
struct FemMeasures {
    double a = 0;           // 1 - mean|y - F| / (max F - min F)
    double b = 0;           // 1 - mean|y - F| / mean|F - y0|: 0 for a sheet that did not move
    double peak_ratio = 0;  // ours over theirs
    double peak_off = 0;    // shares of the span
};
FemMeasures compare_with_fem(const MidLine& ours, const FemCurve& curve);

struct FemBlow {
    double work = 0;         // J
    double ball_radius = 0;  // m; 0: of the ball whose contact at this work is as large as the patch
    uint32_t columns = 120, rows = 80;
    uint32_t cells = 128;
    uint8_t published = 0;  // PublishedChoice
    uint32_t stations = 101;
};
struct FemDent {
    MidLine line;
    double ball_radius = 0, depth = 0, contact = 0;  // m
    Mesh mesh;                                       // as dented
};
Result<FemDent> dent_of(const FemCase& of, const FemBlow& blow);

}  // namespace cullet
