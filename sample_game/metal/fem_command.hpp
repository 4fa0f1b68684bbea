// sample_game fem: one dent of ours beside a curve of a shell FEM, or the deck that makes such a curve.
#pragma once
#include "sample_game/metal/fem.hpp"

namespace cullet {

struct FemOptions {
    std::string curve;    // text of the reference; or
    std::string results;  // what ccx printed of a deck of these parameters
    std::string deck;     // a deck to write; then nothing is compared
    std::string out;      // a folder for mid_line.csv; empty: none
    FemCase sheet;
    FemBlow blow;  // work 0: as the curve says
    bool is_published = false;
};

/// The exit code: 0 when the measures are met (they are asked from 200 J up), or the deck is written; 1 when they are
/// not; 2 for what cannot be asked.
int run_fem(const FemOptions& options);

}  // namespace cullet
