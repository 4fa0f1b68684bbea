#include "sample_game/elastic_solve.hpp"

#include <algorithm>

namespace cullet {

ElasticSolve::ElasticSolve(const SolidElements& elements, const ElasticSolid& material, std::vector<uint32_t> piece)
    : solid(elements),
      elastic(material),
      cells(std::move(piece)),
      sums(elements.elements.size()),
      arena(std::make_unique<Arena>(factor_bytes(elements.plan))),
      factor(take_factor(*arena, elements.plan)),
      loads(elements.places.size() * 3, 0.0),
      gathered(elements.plan.most_rows),
      gradients(elements.elements.size()) {
    if (cells.empty())
        for (uint32_t c = 0; c + 1 < elements.first_part.size(); ++c) cells.push_back(c);
    clear_factor(factor);
    sum_moments(solid, cells, sums);
    add_stiffness(solid, sums, elastic, 0, static_cast<uint32_t>(sums.size()), factor);
    entries_.assign(factor.entries.begin(), factor.entries.end());
}

void ElasticSolve::solve() {
    std::vector<double> weights(solid.places.size()), sorted(solid.places.size());
    weigh_nodes(solid, sums, weights);
    choose_pins(solid, factor, weights, mass_of(solid, cells, 1).centre, sorted, pins);
    hold(solid.plan, pins, factor);
    while (!advance_factor(solid.plan, factor, 1'000'000)) continue;
    displacements = loads;
    hold(pins, displacements);
    solve_with(solid.plan, factor, displacements, gathered);
    differentiate(solid, sums, displacements, gradients);
}

std::vector<double> ElasticSolve::times(const std::vector<double>& x) const {
    std::vector<double> y(x.size(), 0.0);
    const EliminationPlan& plan = solid.plan;
    for (uint32_t column = 0; column < plan.count(); ++column)
        for (uint32_t e = plan.first_entry[column]; e < plan.first_entry[column + 1]; ++e) {
            const uint32_t row = plan.entry_row[e];
            for (uint32_t i = 0; i < 3; ++i)
                for (uint32_t k = 0; k < 3; ++k) {
                    const double value = entries_[size_t{e} * 9 + i * 3 + k];
                    y[row * 3 + i] += value * x[column * 3 + k];
                    if (row != column) y[column * 3 + k] += value * x[row * 3 + i];
                }
        }
    return y;
}

double ElasticSolve::energy() const {
    const std::vector<double> forces = times(displacements);
    double sum = 0;
    for (size_t i = 0; i < forces.size(); ++i) sum += 0.5 * forces[i] * displacements[i];
    return sum;
}

double ElasticSolve::pin_reaction() const {
    const std::vector<double> forces = times(displacements);
    double most = 0;
    for (const Pin& pin : pins)
        for (uint32_t i = 0; i < 3; ++i)
            if (pin.components >> i & 1)
                most = std::max(most, std::fabs(forces[pin.rank * 3 + i] - loads[pin.rank * 3 + i]));
    return most;
}

}  // namespace cullet
