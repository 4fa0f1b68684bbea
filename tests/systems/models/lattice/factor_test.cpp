// The factorisation of our own against Eigen's.
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <cstring>

#include "engine/random.hpp"
#include "engine/simd.hpp"
#include "systems/structures/tetrahedra/cook/cover_lattice.hpp"
#include "sample_game/elastic_solve.hpp"
#include "tests/support/lattice_solids.hpp"

namespace cullet {
namespace {

constexpr ElasticSolid kStone{10e9, 0.2};

SolidElements box_elements(double cells, int size) {
    const Vec3d half{0.1, 0.06, 0.04};
    return make_elements(
        fill_convex(box_planes(half), half, {.edge = edge_for(8 * half.x * half.y * half.z, cells), .elements = size}));
}

Eigen::SparseMatrix<double> matrix_of(const EliminationPlan& plan, const Factor& factor) {
    std::vector<Eigen::Triplet<double>> all;
    const uint32_t w = plan.width;
    for (uint32_t column = 0; column < plan.count(); ++column) {
        if (!factor.is_used[column])
            for (uint32_t i = 0; i < w; ++i) all.emplace_back(column * w + i, column * w + i, 1.0);
        for (uint32_t e = plan.first_entry[column]; e < plan.first_entry[column + 1]; ++e)
            for (uint32_t i = 0; i < w; ++i)
                for (uint32_t k = 0; k < w; ++k) {
                    const uint32_t row = plan.entry_row[e];
                    if (row * w + i >= column * w + k)
                        all.emplace_back(row * w + i, column * w + k, factor.entries[size_t{e} * w * w + i * w + k]);
                }
    }
    Eigen::SparseMatrix<double> matrix(plan.count() * w, plan.count() * w);
    matrix.setFromTriplets(all.begin(), all.end());
    return matrix;
}

void load_by_chance(ElasticSolve& solve) {
    const Random random{3};
    for (size_t i = 0; i < solve.loads.size(); ++i)
        solve.loads[i] = solve.factor.is_used[i / 3] ? random.uniform(i) - 0.5 : 0.0;
}

void expect_solution(ElasticSolve& solve) {
    std::vector<double> weights(solve.solid.places.size()), sorted(solve.solid.places.size());
    weigh_nodes(solve.solid, solve.sums, weights);
    ASSERT_TRUE(choose_pins(solve.solid, solve.factor, weights, {}, sorted, solve.pins));
    hold(solve.solid.plan, solve.pins, solve.factor);
    const Eigen::SparseMatrix<double> matrix = matrix_of(solve.solid.plan, solve.factor);
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> yardstick;
    yardstick.compute(matrix);
    while (!advance_factor(solve.solid.plan, solve.factor, 100'000)) continue;
    load_by_chance(solve);
    hold(solve.pins, solve.loads);
    std::vector<double> x = solve.loads;
    solve_with(solve.solid.plan, solve.factor, x, solve.gathered);
    const Eigen::VectorXd wanted =
        yardstick.solve(Eigen::Map<Eigen::VectorXd>(solve.loads.data(), static_cast<Eigen::Index>(x.size())));
    double most = 0, off = 0;
    for (size_t i = 0; i < x.size(); ++i) {
        most = std::max(most, std::fabs(wanted[static_cast<Eigen::Index>(i)]));
        off = std::max(off, std::fabs(x[i] - wanted[static_cast<Eigen::Index>(i)]));
    }
    EXPECT_TRUE(solve.factor.is_positive);
    EXPECT_LT(off, 1e-8 * most);
}

TEST(Factor, SolvesAsEigenDoes) {
    for (const double cells : {400.0, 800.0, 1500.0}) {
        const SolidElements elements = box_elements(cells, 2);
        ElasticSolve solve(elements, kStone);
        expect_solution(solve);
    }
    for (const double cells : {1500.0, 4000.0}) {
        const SolidElements elements = box_elements(cells, 4);
        ElasticSolve solve(elements, kStone);
        expect_solution(solve);
    }
}

TEST(Factor, APieceGoesByTheBodysPlan) {
    const Vec3d half{0.1, 0.06, 0.04};
    const Solid solid = fill_convex(box_planes(half), half, {.edge = edge_for(8 * half.x * half.y * half.z, 800)});
    const SolidElements elements = make_elements(solid);
    std::vector<uint32_t> piece;
    for (uint32_t c = 0; c < solid.cells.size(); ++c)
        if (solid.cells[c].centroid.x + 0.3 * solid.cells[c].centroid.y > 0.02) piece.push_back(c);
    ElasticSolve solve(elements, kStone, piece);
    expect_solution(solve);
}

TEST(Factor, SlicesAndLanesChangeNoBit) {
    const SolidElements elements = box_elements(500, 2);
    std::vector<double> first;
    for (const SimdLevel level :
         {SimdLevel::Best, SimdLevel::Scalar, SimdLevel::Sse4, SimdLevel::Avx2, SimdLevel::Avx512})
        for (const uint64_t work : {uint64_t{1}, uint64_t{1'000'000'000}}) {
            if (!set_simd_level(level)) continue;
            ElasticSolve solve(elements, kStone);
            std::vector<double> weights(elements.places.size()), sorted(elements.places.size());
            weigh_nodes(elements, solve.sums, weights);
            choose_pins(elements, solve.factor, weights, {}, sorted, solve.pins);
            hold(elements.plan, solve.pins, solve.factor);
            while (!advance_factor(elements.plan, solve.factor, work)) continue;
            load_by_chance(solve);
            std::vector<double> x = solve.loads;
            solve_with(elements.plan, solve.factor, x, solve.gathered);
            if (first.empty()) first = x;
            EXPECT_EQ(std::memcmp(x.data(), first.data(), x.size() * sizeof(double)), 0);
        }
    set_simd_level(SimdLevel::Best);
}

TEST(Factor, APivotThatIsNoneIsReported) {
    const SolidElements elements = box_elements(300, 2);
    ElasticSolve solve(elements, kStone);
    while (!advance_factor(elements.plan, solve.factor, 1'000'000)) continue;  // without pins: six motions are free
    EXPECT_FALSE(solve.factor.is_positive);
    load_by_chance(solve);
    std::vector<double> x = solve.loads;
    solve_with(elements.plan, solve.factor, x, solve.gathered);
    for (const double value : x) ASSERT_TRUE(std::isfinite(value));
}

}  // namespace
}  // namespace cullet
