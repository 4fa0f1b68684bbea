#include "engine/jobs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <numeric>
#include <thread>
#include <vector>

#include "engine/fp_mode.hpp"
#include "engine/random.hpp"

namespace cullet {
namespace {

// Jobs of a host: one order or another, on this thread or on many.
enum class Order { Forwards, Backwards, Random, Threads };

HostJobs host_jobs(Order& order) {
    HostJobs jobs;
    jobs.user = &order;
    jobs.worker_count = [](void*) { return 3u; };
    jobs.parallel_for = [](void* user, uint32_t count, void (*job)(void*, uint32_t), void* context) {
        const Order kind = *static_cast<Order*>(user);
        std::vector<uint32_t> list(count);
        std::iota(list.begin(), list.end(), 0u);
        if (kind == Order::Backwards) std::reverse(list.begin(), list.end());
        if (kind == Order::Random)
            for (uint32_t i = count; i > 1; --i) std::swap(list[i - 1], list[Random{i}.bits(count) % i]);
        if (kind != Order::Threads) {
            for (const uint32_t i : list) job(context, i);
            return;
        }
        std::vector<std::thread> threads;
        for (uint32_t t = 0; t < 3; ++t)
            threads.emplace_back([=] {
                for (uint32_t i = t; i < count; i += 3) job(context, i);
            });
        for (std::thread& thread : threads) thread.join();
    };
    return jobs;
}

struct Backend {
    const char* name;
    std::unique_ptr<JobSystem> jobs;
};

std::vector<Backend> all_backends() {
    static Order orders[] = {Order::Forwards, Order::Backwards, Order::Random, Order::Threads};
    std::vector<Backend> list;
    list.push_back({"caller", make_jobs(JobBackend::Tbb, 1)});
    for (const uint32_t threads : {2u, 3u, 8u}) list.push_back({"threads", make_jobs(JobBackend::Threads, threads)});
    for (const uint32_t threads : {2u, 8u}) list.push_back({"TBB", make_jobs(JobBackend::Tbb, threads)});
    for (Order& order : orders) list.push_back({"host", make_host_jobs(host_jobs(order))});
    return list;
}

TEST(Jobs, EachIndexRunsExactlyOnce) {
    for (const Backend& backend : all_backends())
        for (const uint32_t count : {0u, 1u, 2u, 7u, 1000u, 20000u}) {
            std::vector<std::atomic<uint32_t>> runs(count);
            parallel_for(*backend.jobs, count, [&](uint32_t i) { ++runs[i]; });
            for (uint32_t i = 0; i < count; ++i) ASSERT_EQ(runs[i], 1u) << backend.name << " job " << i;
        }
}

TEST(Jobs, WhatAJobWroteIsSeenWhenAllAreDone) {
    for (const Backend& backend : all_backends()) {
        std::vector<uint32_t> values(64);
        for (uint32_t round = 0; round < 500; ++round) {
            parallel_for(*backend.jobs, 64, [&](uint32_t i) { values[i] += i; });
            ASSERT_EQ(std::accumulate(values.begin(), values.end(), 0u), (round + 1) * 2016) << backend.name;
        }
    }
}

TEST(Jobs, EveryBackendSaysHowManyRunAtOnce) {
    EXPECT_EQ(make_jobs(JobBackend::Tbb, 0)->worker_count(), 1u);
    EXPECT_EQ(make_jobs(JobBackend::Threads, 3)->worker_count(), 3u);
    EXPECT_EQ(make_jobs(JobBackend::Tbb, 3)->worker_count(), 3u);
    HostJobs silent;
    silent.parallel_for = [](void*, uint32_t, void (*)(void*, uint32_t), void*) {};
    EXPECT_EQ(make_host_jobs(silent)->worker_count(), 1u);
    silent.worker_count = [](void*) { return 0u; };
    EXPECT_EQ(make_host_jobs(silent)->worker_count(), 1u);
}

// The first `threads` jobs end once all of them have begun, or after a minute.
uint32_t jobs_at_once(JobSystem& jobs, uint32_t threads) {
    std::atomic<uint32_t> begun{0}, met{0};
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    parallel_for(jobs, threads, [&](uint32_t) {
        ++begun;
        while (begun < threads && std::chrono::steady_clock::now() < end) std::this_thread::yield();
        met += begun == threads;
    });
    return met;
}

TEST(Jobs, MoreThreadsThanCoresAreThatManyThreads) {
    const uint32_t more = std::max(std::thread::hardware_concurrency() + 1, 8u);
    for (const JobBackend backend : {JobBackend::Tbb, JobBackend::Threads})
        for (const uint32_t threads : {more, more + 5})
            EXPECT_EQ(jobs_at_once(*make_jobs(backend, threads), threads), threads);
}

constexpr unsigned kFlags = 0x3f;  // of exceptions that happened: not a mode

TEST(Jobs, JobsRunInOurFloatingPointModeAndTheCallerGetsItsOwnBack) {
    const unsigned before = _mm_getcsr();
    const unsigned upwards = 0x1f80u | 0x4000u;  // all traps masked, round up, denormals kept
    for (const Backend& backend : all_backends()) {
        _mm_setcsr(upwards);
        std::vector<unsigned> modes(300);
        std::vector<float> tiny(300), third(300);
        parallel_for(*backend.jobs, 300, [&](uint32_t i) {
            modes[i] = _mm_getcsr();
            volatile float small = 1e-25f, one = 1;
            tiny[i] = small * 1e-20f;  // 1e-45 would be denormal
            third[i] = one / 3;
        });
        const unsigned after = _mm_getcsr();
        _mm_setcsr(before);
        EXPECT_EQ(after & ~kFlags, upwards) << backend.name;
        for (const unsigned mode : modes) ASSERT_EQ(mode & ~kFlags, FpMode::kOurs) << backend.name;
        for (const float value : tiny) ASSERT_EQ(value, 0.0f) << backend.name;
        for (const float value : third) ASSERT_EQ(value, 1.0f / 3) << backend.name;
    }
}

TEST(Jobs, AJobMayStartJobsOfTheSameSystem) {
    for (const Backend& backend : all_backends()) {
        std::vector<std::atomic<uint32_t>> runs(40 * 30);
        parallel_for(*backend.jobs, 40, [&](uint32_t outer) {
            parallel_for(*backend.jobs, 30, [&](uint32_t inner) { ++runs[outer * 30 + inner]; });
        });
        for (const auto& count : runs) ASSERT_EQ(count, 1u) << backend.name;
    }
}

TEST(Jobs, AWorldMayBeSteppedInsideAJobOfAnother) {
    const auto outer = make_jobs(JobBackend::Threads, 3);
    for (const Backend& backend : all_backends()) {
        std::atomic<uint32_t> runs{0};
        parallel_for(*outer, 6, [&](uint32_t) {
            const auto own = make_jobs(JobBackend::Threads, 2);
            parallel_for(*own, 50, [&](uint32_t) { ++runs; });
            parallel_for(*backend.jobs, 50, [&](uint32_t) { ++runs; });
        });
        EXPECT_EQ(runs, 600u) << backend.name;
    }
}

TEST(Jobs, TwoThreadsMayShareOneJobSystem) {
    for (const Backend& backend : all_backends()) {
        std::atomic<uint32_t> runs[2] = {};
        const auto call = [&](int t) {
            for (int n = 0; n < 200; ++n) parallel_for(*backend.jobs, 20, [&](uint32_t) { ++runs[t]; });
        };
        std::thread other(call, 1);
        call(0);
        other.join();
        EXPECT_EQ(runs[0], 4000u) << backend.name;
        EXPECT_EQ(runs[1], 4000u) << backend.name;
    }
}

TEST(Jobs, ManyShortPassesEnd) {
    const auto jobs = make_jobs(JobBackend::Threads, 4);
    std::atomic<uint32_t> runs{0};
    for (int n = 0; n < 5000; ++n) parallel_for(*jobs, 3, [&](uint32_t) { ++runs; });
    EXPECT_EQ(runs, 15000u);
}

}  // namespace
}  // namespace cullet
