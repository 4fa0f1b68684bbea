// Large vases that are hit on cut-outs of their shells, and what must hold of any such hit.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "components/state.hpp"
#include "cullet/model.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {

/// make_vase, its edges as they come and no threshold measured; the rest of the settings is the caller's.
Result<Model> cook_vase(float height, float edge, CookSettings settings);
/// Of porcelain, 5 mm. Cracks of fine fracture stay near the hit.
Model porcelain_vase(float height, float edge, FractureKind kind);

/// Room for a large vase and the small pieces of fine fracture.
Settings large_settings(uint32_t threads, uint64_t units = 1'000'000'000);

/// After each of so many steps.
std::vector<uint64_t> hashes_of(World& world, uint32_t frames);

/// Empty, or what is wrong with some shell's rows; those of cut-outs may have borders that their bodies do not.
std::string trouble_of_shells(State& state);

/// On one, two, three and eight threads.
void expect_same_hashes(const std::function<Breakage(const Settings&)>& make, uint32_t frames);

/// Mass and momentum are the same behind each break as before it, and energy is not more.
void expect_matter_is_kept(Breakage& b, uint32_t frames);

/// A snapshot of the world as it is, restored, has the same future.
void expect_goes_on(World& world, const Settings& settings, uint32_t frames);

/// Steps allocate nothing of ours, and something comes off.
void expect_no_allocation(Breakage& b, uint32_t frames);

}  // namespace cullet::test
