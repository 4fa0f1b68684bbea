// Fragments born and retired by the ten thousand, or as many as CULLET_SOAK_FRAGMENTS says (a million in
// scripts/test.sh --all): memory stays flat, stale handles stay refused, nothing is lost count of.
#include "sample_game/soak.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

namespace cullet::test {
namespace {

constexpr uint64_t kUsualFragments = 10'000;

uint64_t fragments_wanted() {
    const char* text = std::getenv("CULLET_SOAK_FRAGMENTS");
    const long long wanted = text ? std::atoll(text) : 0;
    return wanted > 0 ? static_cast<uint64_t>(wanted) : kUsualFragments;
}

TEST(Soak, FragmentsComeAndGoAndMemoryAndHandlesStayGood) {
    const uint64_t wanted = fragments_wanted();
    const bool is_long = wanted >= 100'000;
    const uint32_t alive = is_long ? 4096 : 512;
    Result<Soak> soak =
        Soak::create({.fragments = wanted, .alive = alive, .panes_a_frame = is_long ? 16u : 1u, .threads = 2});
    ASSERT_TRUE(soak.ok()) << soak.error();
    while (!soak->is_done()) soak->step();
    const SoakReport r = soak->report();
    EXPECT_EQ(r.wrong, "");
    EXPECT_GE(r.born, wanted);
    EXPECT_LE(r.most_alive, alive);
    EXPECT_GE(r.most_alive, alive / 2);
    EXPECT_TRUE(r.is_stale_refused);
    EXPECT_EQ(r.faults, 0u);
    std::printf("%llu born in %llu frames, at most %u alive, %llu retired, %llu debris faded, %llu refused\n",
                static_cast<unsigned long long>(r.born), static_cast<unsigned long long>(r.frames), r.most_alive,
                static_cast<unsigned long long>(r.retired), static_cast<unsigned long long>(r.faded),
                static_cast<unsigned long long>(r.refused));
    std::printf("memory by tenths, MiB:");
    for (const double memory : r.memory_mib) std::printf(" %.2f", memory);
    std::printf("\nmemory %.1f MiB, rises by %.2f MiB over the last 90 %%; frames %.2f ms, then %.2f ms\n",
                r.memory_mib.back(), r.memory_rise_mib, r.early_ms, r.late_ms);
    EXPECT_LT(r.memory_rise_mib, 1.0);
    if (is_long) {
        EXPECT_LT(r.late_ms, 1.25 * r.early_ms) << "frame times rise";
    }
}

}  // namespace
}  // namespace cullet::test
