#include "engine/runs.hpp"

#include <gtest/gtest.h>

#include "engine/table.hpp"

namespace cullet {
namespace {

struct Cells : Table<Cells> {
    using Table::Table;
    static constexpr const char* kName = "cells";
    Column<uint32_t> calls{*this, "calls"};
};
struct Owners : Table<Owners> {
    using Table::Table;
    static constexpr const char* kName = "owners";
    Column<uint32_t> cells{*this, "cells"}, ends{*this, "ends"}, granted{*this, "granted"};
};

/// Owner k has `cells[k]` rows, one after the other's.
struct CellWorld {
    Cells cells{100'000};
    Owners owners{64};

    CellWorld(std::initializer_list<uint32_t> sizes, uint32_t granted) {
        for (const uint32_t size : sizes) {
            const uint32_t row = owners.append(1);
            owners.cells[row] = size, owners.ends[row] = 0, owners.granted[row] = granted;
            cells.append(size);
        }
    }
    template <class T>
    T& table() {
        if constexpr (std::is_same_v<T, Cells>)
            return cells;
        else
            return owners;
    }
    template <class T>
    Row<T> row_of(uint32_t owner) const {
        return Row<T>(owner);
    }
    template <class T>
    Rows<T> rows_of(uint32_t owner) const {
        uint32_t first = 0;
        for (uint32_t k = 0; k < owner; ++k) first += owners.cells[k];
        return {first, owners.cells[owner]};
    }
};

/// What a run keeps.
struct CellView {
    CellWorld& all;

    template <class T>
    T& table() {
        return all.table<T>();
    }
    template <class T>
    Row<T> row_of(uint32_t owner) const {
        return all.row_of<T>(owner);
    }
    template <class T>
    Rows<T> rows_of(uint32_t owner) const {
        return all.rows_of<T>(owner);
    }
};

void count_calls(Rows<Cells> rows, InOut<&Cells::calls> calls) {
    for (const uint32_t r : rows) calls.set(r, calls[r] + 1);
}
void count_ends(Of<Owners> owner, Owners& owners) {
    ++owners.ends[owner.row];
    --owners.granted[owner.row];
}
uint64_t units_left(CellView& view, uint32_t owner) {
    return 10 * view.all.owners.granted[owner];
}
bool goes_on(CellView& view, uint32_t owner) {
    return view.all.owners.ends[owner] < 7;
}

InnerLoop<CellView> make_loop() {
    InnerLoop<CellView> loop;
    loop.then<count_calls>().then<count_ends>().finish();
    return loop;
}

/// Runs three times what three workers can share at once, and small ones beside them; returns what was left over.
uint64_t run_all(CellWorld& world, JobSystem& jobs, Runs& runs, Profiler& profiler) {
    static const InnerLoop<CellView> loop = make_loop();
    const uint32_t zone = profiler.add_zone("run");
    runs.clear();
    for (uint32_t k = 0; k < world.owners.size(); ++k) {
        const uint32_t cells = world.owners.cells[k];
        runs.add(LoopRun(loop, CellView{world}, {k, 0, world.owners.granted[k], goes_on}, cells, cells > 2000, zone,
                         units_left));
    }
    return runs.advance(jobs, profiler);
}

TEST(Runs, EachRunsAsOftenAsItWasGrantedForAnyNumberOfWorkers) {
    for (const uint32_t workers : {1u, 2u, 3u, 8u}) {
        CellWorld world({10, 30'000, 5, 9'000, 700, 12'000}, 5);
        const auto jobs = make_jobs(JobBackend::Threads, workers);
        Runs runs(64);
        Profiler profiler;
        EXPECT_EQ(run_all(world, *jobs, runs, profiler), 0u);
        for (uint32_t k = 0; k < world.owners.size(); ++k) EXPECT_EQ(world.owners.ends[k], 5u) << workers << ", " << k;
        for (uint32_t r = 0; r < world.cells.size(); ++r) ASSERT_EQ(world.cells.calls[r], 5u) << workers << ", " << r;
    }
}

TEST(Runs, WhatARunDoesNotUseIsLeftOver) {
    for (const uint32_t workers : {1u, 3u}) {
        CellWorld world({30'000, 20, 40}, 10);  // they end after seven repetitions
        const auto jobs = make_jobs(JobBackend::Threads, workers);
        Runs runs(64);
        Profiler profiler;
        EXPECT_EQ(run_all(world, *jobs, runs, profiler), 3u * 3 * 10);
    }
}

TEST(Runs, NoneIsNothing) {
    CellWorld world({}, 0);
    const auto jobs = make_jobs(JobBackend::Threads, 2);
    Runs runs(64);
    Profiler profiler;
    EXPECT_EQ(run_all(world, *jobs, runs, profiler), 0u);
}

}  // namespace
}  // namespace cullet
