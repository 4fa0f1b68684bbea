// Vertices around a place.
#pragma once
#include <algorithm>

#include "components/shell_rows.hpp"

namespace cullet {

/// Calls visit(vertex, square of its distance) for those of rows [first, end) that are nearer than the root of `reach`,
/// rising; visit may lower it. Nearly all are far away: blocks of a constant count vectorise.
template <class Visit>
void visit_rows_near(const ShellView& shell, uint32_t begin, uint32_t end, Vec3 place, const float& reach,
                     Visit&& visit) {
    constexpr uint32_t kBlock = 32;
    const Vertices& vertices = shell.state.vertices;
    const uint32_t first = shell.vertex(0);
    const float *x = vertices.rest.lane(0) + first, *y = vertices.rest.lane(1) + first,
                *z = vertices.rest.lane(2) + first;
    float square[kBlock];
    for (uint32_t block = begin; block < end; block += kBlock) {
        const uint32_t rows = std::min(kBlock, end - block);
        const float most = reach;
        int any = 0;
        const auto measure = [&](uint32_t i) {
            const float dx = x[block + i] - place.x, dy = y[block + i] - place.y, dz = z[block + i] - place.z;
            square[i] = dx * dx + dy * dy + dz * dz;
            any |= square[i] < most;
        };
        if (rows == kBlock)
            for (uint32_t i = 0; i < kBlock; ++i) measure(i);
        else
            for (uint32_t i = 0; i < rows; ++i) measure(i);
        if (!any) continue;
        for (uint32_t i = 0; i < rows; ++i)
            if (square[i] < reach && vertices.element[first + block + i] != kNone) visit(block + i, square[i]);
    }
}

}  // namespace cullet
