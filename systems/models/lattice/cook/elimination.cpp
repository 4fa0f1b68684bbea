#include "systems/models/lattice/cook/elimination.hpp"

#include <algorithm>

#include "engine/assert.hpp"

namespace cullet {
namespace {

constexpr uint32_t kNoParent = 0xffffffffu;
constexpr uint32_t kMostUnknowns = 48;  // columns of a panel: more are cut, so that a unit of work stays small
constexpr double kMostZeros = 0.2;      // of a panel's numbers, for fewer and wider panels
constexpr uint32_t kFewColumns = 12;    // unknowns: so narrow panels take more zeros
constexpr double kMostZerosOfNarrow = 0.5;

using MatrixRows = std::vector<std::vector<uint32_t>>;  // of each column, ascending, below the diagonal

// What each column holds once those before it are eliminated.
MatrixRows filled(const NodeGraph& graph, const std::vector<uint32_t>& node, const std::vector<uint32_t>& rank) {
    const uint32_t count = graph.count();
    MatrixRows rows(count);
    std::vector<std::vector<uint32_t>> children(count);
    std::vector<uint32_t> seen(count, kNoParent);
    for (uint32_t j = 0; j < count; ++j) {
        seen[j] = j;
        const auto add = [&](uint32_t i) {
            if (i > j && seen[i] != j) seen[i] = j, rows[j].push_back(i);
        };
        for (const uint32_t n : graph.of(node[j])) add(rank[n]);
        for (const uint32_t c : children[j])
            for (const uint32_t i : rows[c]) add(i);
        std::sort(rows[j].begin(), rows[j].end());
        if (!rows[j].empty()) children[rows[j][0]].push_back(j);
    }
    return rows;
}

// Children before parents, and each subtree without gaps: the fill stays the same, and panels are whole.
std::vector<uint32_t> in_tree_order(const MatrixRows& rows) {
    const uint32_t count = static_cast<uint32_t>(rows.size());
    std::vector<uint32_t> child(count, kNoParent), sibling(count, kNoParent), order, stack;
    uint32_t roots = kNoParent;
    for (uint32_t j = count; j-- > 0;) {
        uint32_t& head = rows[j].empty() ? roots : child[rows[j][0]];
        sibling[j] = head, head = j;
    }
    for (uint32_t r = roots; r != kNoParent; r = sibling[r]) {
        stack.push_back(r);
        while (!stack.empty()) {
            const uint32_t j = stack.back();
            if (child[j] != kNoParent) {
                stack.push_back(child[j]);
                child[j] = sibling[child[j]];
            } else {
                order.push_back(j);
                stack.pop_back();
            }
        }
    }
    return order;
}

struct WidePanel {
    uint32_t first = 0, columns = 0;
    uint64_t zeros = 0;                  // blocks that hold nothing
    const std::vector<uint32_t>* below;  // of the last column
    uint64_t blocks() const { return uint64_t{columns} * (columns + 1) / 2 + uint64_t{columns} * below->size(); }
};

// Columns whose rows are the next one's and the next one itself stand together; then whole panels join their parents
// as long as few zeros come in.
std::vector<WidePanel> join_columns(const MatrixRows& rows, uint32_t width) {
    std::vector<WidePanel> stack;
    const uint32_t count = static_cast<uint32_t>(rows.size());
    for (uint32_t j = 0; j < count; ++j) {
        WidePanel panel{j, 1, 0, &rows[j]};
        while (j + 1 < count && !rows[j].empty() && rows[j][0] == j + 1 && rows[j].size() == rows[j + 1].size() + 1)
            ++j, ++panel.columns, panel.below = &rows[j];
        while (!stack.empty()) {
            const WidePanel& before = stack.back();
            const uint32_t end = panel.first + panel.columns;
            if (before.below->empty() || (*before.below)[0] < panel.first || (*before.below)[0] >= end) break;
            const uint64_t missing = panel.columns + panel.below->size() - before.below->size();
            WidePanel joined{before.first, before.columns + panel.columns,
                             before.zeros + panel.zeros + before.columns * missing, panel.below};
            const double most = joined.columns * width <= kFewColumns ? kMostZerosOfNarrow : kMostZeros;
            if (static_cast<double>(joined.zeros) > most * static_cast<double>(joined.blocks())) break;
            panel = joined;
            stack.pop_back();
        }
        stack.push_back(panel);
    }
    return stack;
}

}  // namespace

uint32_t EliminationPlan::entry(uint32_t row, uint32_t column) const {
    const auto begin = entry_row.begin() + first_entry[column], end = entry_row.begin() + first_entry[column + 1];
    const auto at = std::lower_bound(begin, end, row);
    CULLET_ASSERT(at != end && *at == row, "block (%u, %u) is none of the matrix", row, column);
    return static_cast<uint32_t>(at - entry_row.begin());
}

EliminationPlan plan_elimination(const NodeGraph& graph, const std::vector<Vec3d>& places, uint32_t width) {
    EliminationPlan plan;
    plan.width = width;
    const uint32_t count = graph.count();
    const std::vector<uint32_t> first = dissect(graph, places);
    plan.rank.resize(count), plan.node = first;
    for (uint32_t r = 0; r < count; ++r) plan.rank[first[r]] = r;
    const std::vector<uint32_t> order = in_tree_order(filled(graph, plan.node, plan.rank));
    for (uint32_t r = 0; r < count; ++r) plan.node[r] = first[order[r]];
    for (uint32_t r = 0; r < count; ++r) plan.rank[plan.node[r]] = r;
    const MatrixRows rows = filled(graph, plan.node, plan.rank);

    plan.first_entry.push_back(0);
    for (uint32_t j = 0; j < count; ++j) {
        std::vector<uint32_t> own{j};
        for (const uint32_t n : graph.of(plan.node[j]))
            if (plan.rank[n] > j) own.push_back(plan.rank[n]);
        std::sort(own.begin(), own.end());
        plan.entry_row.insert(plan.entry_row.end(), own.begin(), own.end());
        plan.first_entry.push_back(static_cast<uint32_t>(plan.entry_row.size()));
    }

    plan.panel_of.resize(count);
    const uint32_t most = std::max(kMostUnknowns / width, 1u);
    for (const WidePanel& wide : join_columns(rows, width)) {
        const uint32_t parts = (wide.columns + most - 1) / most, last = wide.first + wide.columns;
        for (uint32_t p = 0, start = wide.first; p < parts; ++p) {
            const uint32_t end = wide.first + wide.columns * (p + 1) / parts;
            EliminationPanel panel{start, end - start, static_cast<uint32_t>(plan.panel_rows.size()), 0};
            for (uint32_t r = end; r < last; ++r) plan.panel_rows.push_back(r);
            plan.panel_rows.insert(plan.panel_rows.end(), wide.below->begin(), wide.below->end());
            panel.rows = static_cast<uint32_t>(plan.panel_rows.size()) - panel.first_row;
            for (uint32_t r = start; r < end; ++r) plan.panel_of[r] = static_cast<uint32_t>(plan.panels.size());
            const uint32_t tall = padded((panel.columns + panel.rows) * width), broad = panel.columns * width;
            plan.factor_values += uint64_t{tall} * broad;
            plan.most_rows = std::max(plan.most_rows, tall);
            plan.most_columns = std::max(plan.most_columns, padded(broad));
            plan.panels.push_back(panel);
            start = end;
        }
    }
    plan.most_update = uint64_t{plan.most_rows} * plan.most_columns;
    return plan;
}

}  // namespace cullet
