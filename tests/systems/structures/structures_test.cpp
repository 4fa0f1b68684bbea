// What each kind of structure has to give.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>

#include "components/state.hpp"
#include "systems/models.hpp"
#include "systems/structure_calls.hpp"

namespace cullet {
namespace {

// Calls are pointers to functions and nothing else: one that is missing is zero.
TEST(Structures, EachKindGivesEachCall) {
    using Words = std::array<uintptr_t, sizeof(StructureCalls) / sizeof(uintptr_t)>;
    State state;
    ASSERT_NE(state.structures.append(1), kNone);
    for (uint8_t kind = 0; kind < structures().size(); ++kind) {
        state.structures.kind[0] = kind;
        uint32_t missing = 0;
        for (const uintptr_t call : std::bit_cast<Words>(calls_of(state.structures, Row<Structures>(0))))
            missing += call == 0;
        EXPECT_EQ(missing, 0u) << structures()[kind].name();
    }
}

}  // namespace
}  // namespace cullet
