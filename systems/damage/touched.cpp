#include "systems/damage/touched.hpp"

#include <algorithm>
#include <span>

#include "systems/damage/assemble.hpp"
#include "systems/damage/stress_check.hpp"

namespace cullet {

bool refresh_stiffness(ShellView shell, Touched& touched) {
    const uint32_t count = touched.count;
    touched.count = 0;
    link_slopes(shell, {touched.vertex, count});
    if (count == 0 || shell.shells().packs[shell.row].count == 0) return true;
    const Column<float>& scale = shell.state.vertices.stiffness_scale;
    float before[Touched::kMost];
    for (uint32_t i = 0; i < count; ++i) before[i] = scale[shell.vertex(touched.vertex[i])];
    limit_stiffness(shell, {touched.vertex, count});
    uint32_t changed[Touched::kMost];
    uint32_t changed_count = 0;
    for (uint32_t i = 0; i < count; ++i)
        if (touched.has_changed_rows[i] || scale[shell.vertex(touched.vertex[i])] != before[i])
            changed[changed_count++] = touched.vertex[i];
    // A vertex of a full ring has 2 * kMostRing + 1 rows; most have 13, shared among neighbours.
    constexpr uint32_t kBatch = 32;
    uint32_t rows[kBatch * (2 * kMostRing + 1)];
    for (uint32_t i = 0; i < changed_count; i += kBatch) {
        const std::span<const uint32_t> batch(changed + i, std::min(kBatch, changed_count - i));
        if (!rebuild_rows(shell, {rows, row_vertices(shell, batch, rows)})) return false;
    }
    return true;
}

}  // namespace cullet
