// What each kind of structure has to give.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "components/state.hpp"
#include "systems/models.hpp"
#include "systems/structure_calls.hpp"

namespace cullet {
namespace {

// Calls are pointers to functions: one that is missing is zero. Only bears_loads and is_filled are flags, in one word.
TEST(Structures, EachKindGivesEachCall) {
    using Words = std::array<uintptr_t, sizeof(StructureCalls) / sizeof(uintptr_t)>;
    State state;
    ASSERT_NE(state.structures.append(1), kNone);
    for (uint8_t kind = 0; kind < structures().size(); ++kind) {
        state.structures.kind[0] = kind;
        const auto calls = std::bit_cast<Words>(calls_of(state.structures, Row<Structures>(0)));
        uint32_t missing = 0;
        for (size_t word = 0; word < calls.size(); ++word)
            missing += calls[word] == 0 && word != offsetof(StructureCalls, bears_loads) / sizeof(uintptr_t);
        EXPECT_EQ(missing, 0u) << structures()[kind].name();
    }
}

}  // namespace
}  // namespace cullet
