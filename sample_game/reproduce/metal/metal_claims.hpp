// The claims of the paper on metal shells, in its own order. A row is filled in where its function stands.
#pragma once
#include <span>

#include "sample_game/reproduce/bench.hpp"

namespace cullet::reproduce {

/// A simple method for real-time metal shell simulation.
std::span<const ClaimEntry> metal_shell_claims();

// cells_claims.cpp
Result<Claim> metal_figure_1(Bench& bench);
Result<Claim> metal_sum_falls(Bench& bench);
Result<Claim> metal_table_1(Bench& bench);
// spring_claims.cpp
Result<Claim> metal_figure_3(Bench& bench);
Result<Claim> metal_figure_4(Bench& bench);
Result<Claim> metal_switches(Bench& bench);
// crash_claims.cpp
Result<Claim> metal_figure_5(Bench& bench);
Result<Claim> metal_figure_6(Bench& bench);
Result<Claim> metal_fem(Bench& bench);
Result<Claim> metal_figure_7(Bench& bench);
// time_claims.cpp
Result<Claim> metal_figure_8(Bench& bench);
Result<Claim> metal_real_time(Bench& bench);

}  // namespace cullet::reproduce
