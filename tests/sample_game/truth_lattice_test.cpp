// The verification cases of solids, as `sample_game truth lattice` prints them.
#include "tests/support/truth_tests.hpp"

namespace cullet {
namespace {

class TruthOfSolids : public testing::TestWithParam<TruthCase> {};

TEST_P(TruthOfSolids, LiesWithinTheBounds) {
    test::expect_within_bounds(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Cases, TruthOfSolids, test::each_of(lattice_truth_cases()), test::name_of_case);

}  // namespace
}  // namespace cullet
