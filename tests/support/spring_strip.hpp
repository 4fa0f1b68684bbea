// A strip with springs of each layout, for tests of them.
#pragma once
#include "sample_game/spring_bench.hpp"

namespace cullet::test {

inline constexpr SpringLayout kLayouts[] = {SpringLayout::OneLayer, SpringLayout::Sandwich, SpringLayout::Crossed};

inline SpringSettings settings_of(SpringLayout layout) {
    SpringSettings settings;
    settings.layout = layout;
    return settings;
}

inline constexpr double kEdge = 0.01, kDepth = 0.004, kYoung = 1e7;

inline SpringBench make_strip(SpringLayout layout, uint32_t spare = 0) {
    return SpringBench(bench_strip(6, 6, kEdge), kDepth, {}, settings_of(layout), {}, spare);
}

}  // namespace cullet::test
