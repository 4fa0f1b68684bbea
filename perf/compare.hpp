// Two files of figures, and what moved between them by more than the noise of both.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "cullet/result.hpp"

namespace cullet::perf {

struct ReadFigure {
    std::string scene, name, unit;
    double value = 0, noise = 0;
};

struct FigureFile {
    std::string machine;  // processor, threads and level of the kernels, as one text
    double passes = 0;
    std::vector<ReadFigure> figures;
};

/// Believes nothing: a text that is not what cullet_perf writes is refused with a sentence that begins with `name`.
Result<FigureFile> parse_figures(std::string_view text, const std::string& name);
Result<FigureFile> read_figures(const std::string& path);

/// A figure moved when it differs by more than 3 x the root of the summed squares of both noises, and by more than 2 %
/// of what it was.
constexpr double kNoises = 3, kLeastMove = 0.02;
bool has_moved(const ReadFigure& before, const ReadFigure& after);

struct Comparison {
    struct Move {
        ReadFigure before, after;
    };
    std::vector<Move> moved;                   // in the order of the new file
    std::vector<std::string> missing, gained;  // "scene: name", only in the old, only in the new file
};
Comparison compare(const FigureFile& before, const FigureFile& after);

/// One line each of what moved, is missing or is new. Empty when nothing did.
std::string describe(const Comparison& comparison);

}  // namespace cullet::perf
