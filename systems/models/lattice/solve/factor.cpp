#include "systems/models/lattice/solve/factor.hpp"

#include <algorithm>

#include "systems/models/lattice/solve/panel_kernels.hpp"

namespace cullet {
namespace {

constexpr uint32_t kNobody = 0xffffffffu;
constexpr uint32_t kBlock = kPanelStep;  // columns that are eliminated before the ones after them hear of it
constexpr double kLeastPivot = 1e-13;    // of the diagonal as it came in

// The panel's nodes that the piece has, where they stand in it, and the matrix' numbers.
FactorPanel open_panel(const EliminationPlan& plan, Factor& factor, uint32_t p) {
    const EliminationPanel& whole = plan.panels[p];
    FactorPanel panel;
    panel.first_value = factor.next_value;
    for (uint32_t r = whole.first_column; r < whole.first_column + whole.columns; ++r) {
        if (!factor.is_used[r]) continue;
        factor.place[r] = panel.columns;
        factor.columns[whole.first_column + panel.columns++] = r;
    }
    if (panel.columns == 0) return panel;
    for (uint32_t i = whole.first_row; i < whole.first_row + whole.rows; ++i) {
        const uint32_t r = plan.panel_rows[i];
        if (!factor.is_used[r]) continue;
        factor.place[r] = panel.columns + panel.rows;
        factor.rows[whole.first_row + panel.rows++] = r;
    }
    const uint32_t w = plan.width;
    panel.tall = padded((panel.columns + panel.rows) * w);
    factor.next_value += uint64_t{panel.tall} * panel.columns * w;
    double* values = factor.values.data() + panel.first_value;
    std::fill_n(values, size_t{panel.tall} * panel.columns * w, 0.0);
    for (uint32_t c = 0; c < panel.columns; ++c) {
        const uint32_t rank = factor.columns[whole.first_column + c];
        for (uint32_t e = plan.first_entry[rank]; e < plan.first_entry[rank + 1]; ++e) {
            if (!factor.is_used[plan.entry_row[e]]) continue;
            const double* block = factor.entries.data() + size_t{e} * w * w;
            double* to = values + size_t{c} * w * panel.tall + size_t{factor.place[plan.entry_row[e]]} * w;
            for (uint32_t i = 0; i < w; ++i)
                for (uint32_t k = 0; k < w; ++k) to[k * size_t{panel.tall} + i] = block[i * w + k];
        }
    }
    return panel;
}

// What `from`, which is done, has for the columns of panel p.
void take_share(const EliminationPlan& plan, Factor& factor, FactorPanel& from, uint32_t from_panel,
                const FactorPanel& to, uint32_t p) {
    const uint32_t w = plan.width, first = plan.panels[from_panel].first_row;
    uint32_t end = from.done;
    while (end < from.rows && plan.panel_of[factor.rows[first + end]] == p) ++end;
    const uint32_t columns = (end - from.done) * w, depth = from.columns * w;
    const size_t above = (size_t{from.columns} + from.done) * w;
    // Whole steps of rows, from one that may lie above: what is too much is computed and not used.
    const size_t start = std::min(above, size_t{from.tall} - padded(from.tall - static_cast<uint32_t>(above)));
    const uint32_t rows = from.tall - static_cast<uint32_t>(start);
    const DenseColumns a{factor.values.data() + from.first_value, from.tall};
    for (uint32_t k = 0; k < depth; ++k) {
        const double* column = a.values + k * a.tall;
        for (uint32_t c = 0; c < columns; ++c) factor.scaled[k * columns + c] = column[above + c] * column[k];
    }
    const DenseColumns update{factor.update.data(), rows};
    subtract_product(rows, columns, depth, {a.values + start, a.tall}, factor.scaled.data(), update, true);
    factor.work += uint64_t{rows} * columns * depth;
    double* values = factor.values.data() + to.first_value;
    for (uint32_t c = 0; c < columns; ++c) {
        const uint32_t rank = factor.rows[first + from.done + c / w];
        double* column = values + (size_t{factor.place[rank]} * w + c % w) * to.tall;
        const double* share = update.values + c * update.tall + (above - start);
        for (uint32_t r = from.done; r < from.rows; ++r) {
            double* at = column + size_t{factor.place[factor.rows[first + r]]} * w;
            for (uint32_t i = 0; i < w; ++i) at[i] += *share++;
        }
    }
    from.done = end;
}

void wait_for_next(const EliminationPlan& plan, Factor& factor, uint32_t p) {
    FactorPanel& panel = factor.panels[p];
    if (panel.done == panel.rows) return;
    uint32_t& head = factor.waiting[plan.panel_of[factor.rows[plan.panels[p].first_row + panel.done]]];
    panel.next = head, head = p;
}

// In blocks of few columns: the columns before a block have their share in it as one product.
void eliminate_panel(const EliminationPlan& plan, Factor& factor, const FactorPanel& panel) {
    const uint32_t columns = panel.columns * plan.width;
    double* values = factor.values.data() + panel.first_value;
    double most = 0;
    for (uint32_t c = 0; c < columns; ++c) most = std::max(most, values[c * size_t{panel.tall} + c]);
    for (uint32_t first = 0; first < columns; first += kBlock) {
        const uint32_t count = std::min(kBlock, columns - first), rows = panel.tall - first;
        for (uint32_t k = 0; k < first; ++k) {
            const double* column = values + k * size_t{panel.tall};
            for (uint32_t c = 0; c < count; ++c) factor.scaled[k * count + c] = column[first + c] * column[k];
        }
        const DenseColumns own{values + first * size_t{panel.tall} + first, panel.tall};
        if (first > 0)
            subtract_product(rows, count, first, {values + first, panel.tall}, factor.scaled.data(), own, false);
        factor.is_positive &= eliminate_columns(rows, count, own, kLeastPivot * most);
        factor.work += uint64_t{rows} * count * (first + count);
    }
}

}  // namespace

Factor take_factor(Arena& arena, const EliminationPlan& plan) {
    Factor factor;
    factor.entries = arena.take<double>(plan.entry_row.size() * plan.width * plan.width);
    factor.is_used = arena.take<uint8_t>(plan.count());
    factor.panels = arena.take<FactorPanel>(plan.panels.size());
    factor.columns = arena.take<uint32_t>(plan.count());
    factor.rows = arena.take<uint32_t>(plan.panel_rows.size() + 1);
    factor.values = arena.take<double>(plan.factor_values);
    factor.place = arena.take<uint32_t>(plan.count());
    factor.waiting = arena.take<uint32_t>(plan.panels.size());
    factor.update = arena.take<double>(plan.most_update);
    factor.scaled = arena.take<double>(uint64_t{plan.most_columns} * plan.most_columns);
    return factor;
}

uint64_t factor_bytes(const EliminationPlan& plan) {
    constexpr uint64_t kSlack = 16 * 64;  // what alignment may take
    return kSlack +
           sizeof(double) * (plan.entry_row.size() * plan.width * plan.width + plan.factor_values + plan.most_update +
                             uint64_t{plan.most_columns} * plan.most_columns) +
           plan.count() * (sizeof(uint8_t) + 2 * sizeof(uint32_t)) +
           plan.panels.size() * (sizeof(FactorPanel) + sizeof(uint32_t)) +
           (plan.panel_rows.size() + 1) * sizeof(uint32_t);
}

void clear_factor(Factor& factor) {
    std::fill(factor.entries.begin(), factor.entries.end(), 0.0);
    std::fill(factor.is_used.begin(), factor.is_used.end(), uint8_t{0});
    std::fill(factor.waiting.begin(), factor.waiting.end(), kNobody);
    factor.next_panel = 0, factor.next_value = 0, factor.work = 0, factor.is_positive = true;
}

bool advance_factor(const EliminationPlan& plan, Factor& factor, uint64_t work) {
    const uint64_t end = factor.work + work;
    while (factor.next_panel < plan.panels.size() && factor.work < end) {
        const uint32_t p = factor.next_panel++;
        factor.panels[p] = open_panel(plan, factor, p);
        for (uint32_t from = factor.waiting[p]; from != kNobody;) {
            const uint32_t next = factor.panels[from].next;
            take_share(plan, factor, factor.panels[from], from, factor.panels[p], p);
            wait_for_next(plan, factor, from);
            from = next;
        }
        if (factor.panels[p].columns == 0) continue;
        eliminate_panel(plan, factor, factor.panels[p]);
        wait_for_next(plan, factor, p);
    }
    return factor.next_panel == plan.panels.size();
}

void solve_with(const EliminationPlan& plan, const Factor& factor, std::span<double> x, std::span<double> gathered) {
    const uint32_t w = plan.width;
    const auto each_row = [&](uint32_t p, auto use) {
        const FactorPanel& panel = factor.panels[p];
        const EliminationPanel& whole = plan.panels[p];
        uint32_t at = 0;
        for (uint32_t c = 0; c < panel.columns; ++c)
            for (uint32_t i = 0; i < w; ++i)
                use(x[size_t{factor.columns[whole.first_column + c]} * w + i], gathered[at++]);
        for (uint32_t r = 0; r < panel.rows; ++r)
            for (uint32_t i = 0; i < w; ++i) use(x[size_t{factor.rows[whole.first_row + r]} * w + i], gathered[at++]);
        return at;
    };
    for (uint32_t p = 0; p < plan.panels.size(); ++p) {
        const FactorPanel& panel = factor.panels[p];
        const uint32_t columns = panel.columns * w;
        const uint32_t rows = each_row(p, [](double& own, double& held) { held = own; });
        for (uint32_t c = 0; c < columns; ++c)
            add_column(rows - c - 1, -gathered[c],
                       factor.values.data() + panel.first_value + c * size_t{panel.tall} + c + 1,
                       gathered.data() + c + 1);
        each_row(p, [](double& own, double& held) { own = held; });
    }
    for (uint32_t p = static_cast<uint32_t>(plan.panels.size()); p-- > 0;) {
        const FactorPanel& panel = factor.panels[p];
        const uint32_t rows = each_row(p, [](double& own, double& held) { held = own; });
        for (uint32_t c = panel.columns * w; c-- > 0;) {
            const double* column = factor.values.data() + panel.first_value + c * size_t{panel.tall} + c;
            gathered[c] = gathered[c] / column[0] - dot_column(rows - c - 1, column + 1, gathered.data() + c + 1);
        }
        each_row(p, [](double& own, double& held) { own = held; });
    }
}

}  // namespace cullet
