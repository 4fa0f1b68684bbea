#include "systems/damage/touched.hpp"

#include <algorithm>
#include <span>

#include "systems/damage/assemble.hpp"

namespace cullet {

bool refresh_stiffness(ShellView shell, Touched& touched) {
    const std::span<const uint32_t> all(touched.vertex, touched.count);
    touched.count = 0;
    if (all.empty() || shell.shells().packs[shell.row].count == 0) return true;
    limit_stiffness(shell, all);
    // A vertex of a full ring has 2 * kMostRing + 1 rows; most have 13, shared among neighbours.
    constexpr size_t kBatch = 32;
    uint32_t rows[kBatch * (2 * kMostRing + 1)];
    for (size_t i = 0; i < all.size(); i += kBatch) {
        const auto batch = all.subspan(i, std::min(kBatch, all.size() - i));
        const uint32_t count = row_vertices(shell, batch, rows);
        if (!rebuild_rows(shell, {rows, count})) return false;
    }
    return true;
}

}  // namespace cullet
