// The paper's claims in its own order. A row is filled in where its function stands.
#pragma once
#include <span>

#include "sample_game/reproduce/bench.hpp"

namespace cullet::reproduce {

/// D. Steinemann and others, thick shells: generation, deformation and fracture in real time.
std::span<const ClaimEntry> thick_shell_claims();

// generation_claims.cpp
Result<Claim> figure_1(Bench& bench);
Result<Claim> table_1(Bench& bench);
Result<Claim> consistent_shells(Bench& bench);
Result<Claim> front_against_single(Bench& bench);
// shell_pictures.cpp
Result<Claim> figure_7(Bench& bench);
Result<Claim> figure_8(Bench& bench);
// strength_claim.cpp
Result<Claim> figure_2(Bench& bench);
Result<Claim> figure_3(Bench& bench);
// fracture_claims.cpp
Result<Claim> figure_4(Bench& bench);
Result<Claim> coarse_grained(Bench& bench);
Result<Claim> large_fragments(Bench& bench);
// mesh_claims.cpp
Result<Claim> figure_5(Bench& bench);
Result<Claim> figure_6(Bench& bench);
// speed_claims.cpp
Result<Claim> table_2(Bench& bench);
Result<Claim> rigid_share(Bench& bench);
Result<Claim> figure_9(Bench& bench);
Result<Claim> figure_10(Bench& bench);

}  // namespace cullet::reproduce
