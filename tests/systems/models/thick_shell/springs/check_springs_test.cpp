// Springs from files that somebody changed.
#include "systems/models/thick_shell/springs/check_springs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/spring_strip.hpp"

namespace cullet::test {
namespace {

TEST(CheckSprings, RefusesIndicesThatLeadOutside) {
    using Spoil = void (*)(SpringBench&);
    const Spoil spoils[] = {
        [](SpringBench& b) { b.state().springs.a[b.view().spring(3)] = 100000; },
        [](SpringBench& b) { b.state().springs.b[b.view().spring(3)] = b.state().springs.a[b.view().spring(3)]; },
        [](SpringBench& b) { b.state().springs.place[b.view().spring(3)][1] = 1u << 30; },
        [](SpringBench& b) { b.state().springs.element[b.view().spring(3)] = 5000; },
        [](SpringBench& b) { b.state().spring_slots.slot[b.view().slot(2)].neighbour[5] = 4096; },
        [](SpringBench& b) { b.state().spring_slots.slot[b.view().slot(2)].damping[1] = std::nanf(""); },
        [](SpringBench& b) { b.state().layer_slots.slot[b.view().layer_slot(2)].second_inverse[1] = HUGE_VALF; },
        [](SpringBench& b) { b.state().spring_packs.first_slot[b.view().pack(1)] = 1u << 20; },
        [](SpringBench& b) { b.state().spring_packs.slot_count[b.view().pack(1)] = 60000; },
        [](SpringBench& b) { b.state().element_springs.spring[b.view().edges(1)][2] = 77777; },
        // Rows that there are, but others than the right ones.
        [](SpringBench& b) { ++b.state().springs.element[b.view().spring(3)]; },
        [](SpringBench& b) { b.state().springs.element[b.view().spring(3)] = 20; },
        [](SpringBench& b) {
            auto& of = b.state().element_springs.spring;
            of[b.view().edges(1)][2] = of[b.view().edges(9)][0];
        },
        [](SpringBench& b) {
            auto& place = b.state().springs.place[b.view().spring(3)][0];
            place += kLanes * (place < kLanes * b.state().spring_packs.first_slot[b.view().pack(1)] ? 12 : -12);
        },
        [](SpringBench& b) {
            auto& place = b.state().springs.place[b.view().spring(3)];
            place[0] += place[0] % 2 ? -1 : 1;
        },
        [](SpringBench& b) {
            uint32_t& n = b.state()
                              .spring_slots.slot[b.state().springs.place[b.view().spring(3)][0] / kLanes]
                              .neighbour[b.state().springs.place[b.view().spring(3)][0] % kLanes];
            n = n == 0 ? 1 : 0;
        },
        [](SpringBench& b) { --b.state().spring_packs.first_slot[b.view().pack(1)]; },
        [](SpringBench& b) { ++b.state().spring_packs.slot_capacity[b.view().pack(1)]; },
        [](SpringBench& b) { b.state().shell_springs.structure[b.springs()] = Row<Structures>(5); },
        [](SpringBench& b) { b.state().shell_springs.layout[b.springs()] = 9; },
        [](SpringBench& b) { b.state().shell_springs.layout[b.springs()] = 0; },
        [](SpringBench& b) { b.state().shell_springs.time_step[b.springs()] = -1; },
        [](SpringBench& b) { --b.state().shell_springs.twins[b.springs()].count; },
        [](SpringBench& b) { b.state().shell_springs.is_used[b.springs()] = 7; }};
    for (size_t s = 0; s < std::size(spoils); ++s) {
        SpringBench bench = make_strip(SpringLayout::Sandwich);
        ASSERT_TRUE(check_springs(bench.state(), "good", "").ok());
        spoils[s](bench);
        const auto refused = check_springs(bench.state(), "bad.csnap", "Take it again.");
        ASSERT_FALSE(refused.ok()) << s;
        EXPECT_EQ(refused.error().rfind("bad.csnap: ", 0), 0u) << refused.error();
    }
}

}  // namespace
}  // namespace cullet::test
