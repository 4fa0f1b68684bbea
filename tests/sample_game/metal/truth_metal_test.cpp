// The verification cases of metal shells, as `sample_game truth metal_shell` prints them. Those of a car need the test
// data.
#include "sample_game/metal/truth_metal.hpp"

#include "tests/support/truth_tests.hpp"

namespace cullet {
namespace {

class TruthOfMetal : public testing::TestWithParam<TruthCase> {};

TEST_P(TruthOfMetal, LiesWithinTheBounds) {
    test::expect_within_bounds(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Cases, TruthOfMetal, test::each_of(metal_truth_cases()), test::name_of_case);

}  // namespace
}  // namespace cullet
