// Fragments born and retired by the ten thousand, or as many as CULLET_SOAK_FRAGMENTS says (a million in
// scripts/test.sh --all): memory stays flat, stale handles stay refused, nothing is lost count of.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <vector>

#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

constexpr uint64_t kUsualFragments = 10'000;
constexpr double kMiB = 1024.0 * 1024.0;

uint64_t fragments_wanted() {
    const char* text = std::getenv("CULLET_SOAK_FRAGMENTS");
    const long long wanted = text ? std::atoll(text) : 0;
    return wanted > 0 ? static_cast<uint64_t>(wanted) : kUsualFragments;
}

/// Of the process, in MiB.
double resident_memory() {
    long long pages = 0, resident = 0;
    std::FILE* file = std::fopen("/proc/self/statm", "r");
    if (!file) return 0;
    const int read = std::fscanf(file, "%lld %lld", &pages, &resident);
    std::fclose(file);
    return read == 2 ? static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / kMiB : 0;
}

/// What the line of least squares through the values rises by from the first to the last.
double rise_of(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    double mean = 0, product = 0, square = 0;
    for (const double v : values) mean += v / n;
    for (size_t i = 0; i < values.size(); ++i) {
        const double x = static_cast<double>(i) - (n - 1) / 2;
        product += x * (values[i] - mean);
        square += x * x;
    }
    return square > 0 ? product / square * (n - 1) : 0;
}

double median_of(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Panes appear in a field of places, some a frame, and are cut to pieces; what is left of them goes after half a
/// second, and of the pieces the oldest, so that at most `alive` are there.
class Field {
 public:
    explicit Field(uint32_t alive) : alive_(alive), world_(make_world(settings(alive))) {
        model_ = world_.add_model(small_pane()).value();
        fill_profiler();
    }

    void step() {
        for (uint32_t n = 0; n < panes_a_frame(); ++n) cut_pane();
        while (rests_.size() > 30 * panes_a_frame()) {
            EXPECT_TRUE(world_.remove(rests_.front()).ok());
            keep_stale(rests_.front());
            rests_.pop_front();
        }
        retire_oldest();
        const auto begin = std::chrono::steady_clock::now();
        world_.step();
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
        frame_ms.push_back(took.count());
        memory.push_back(resident_memory());
        born += world_.events().fragments_born.count;
        refused += world_.events().refused.count;
        faults += world_.events().faults.count;
        most_alive = std::max(most_alive, world_.report().fragments);
        for (const BodyId id : stale_) is_stale_refused = is_stale_refused && !world_.pose(id).ok();
    }
    World& world() { return world_; }

    std::vector<double> frame_ms, memory;
    uint64_t born = 0, refused = 0, faults = 0;
    uint32_t most_alive = 0;
    bool is_stale_refused = true;

 private:
    uint32_t panes_a_frame() const { return alive_ / 512; }
    static Settings settings(uint32_t alive) {
        Settings settings = small_settings();
        settings.limits = {2 * alive + 256, 2, 1u << 18, 1u << 19, 16, 1u << 21, 4096, 256, alive};
        settings.generations = 0;
        settings.debris_seconds = 0.5f;
        settings.threads = 2;
        return settings;
    }
    // It keeps the times of the first 32,768 frames and half a million spans, and then of the last frame alone: 60 MiB
    // that it writes to in any world. Filled now, they are no growth.
    void fill_profiler() {
        Profiler& profiler = world_.contents().profiler;
        while (profiler.left_out() == 0) profiler.add_span(0, 0, 1);
        uint32_t frames = 0;
        do {
            frames = profiler.frame_count();
            profiler.begin_frame(0);
            profiler.end_frame();
        } while (profiler.frame_count() > frames);
    }
    // Places 1.5 m apart, each free again after 400 panes.
    void cut_pane() {
        const uint32_t place = panes_++ % 400;
        SpawnSettings pane;
        pane.motion = {{0.3f, 0.2f, -0.5f}, {3, 5, 12}};
        pane.pose.position = {1.5f * static_cast<float>(place % 20), 0, 1.5f * static_cast<float>(place / 20)};
        const Result<BodyId> body = world_.spawn(model_, pane);
        if (!body.ok()) return;
        rests_.push_back(*body);
        // Five cuts each way, all worked off at once; what turns flies apart.
        for (int k = 0; k < 10; ++k) {
            CutSettings cut;
            const float share = 0.05f * static_cast<float>(k % 5 + 1);
            cut.place = pane.pose.position + (k < 5 ? Vec3{share - 0.15f, 0, 0} : Vec3{0, share, 0});
            cut.normal = k < 5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
            EXPECT_TRUE(world_.cut(*body, cut).ok());
        }
    }
    void retire_oldest() {
        const uint32_t room = 40 * panes_a_frame();  // for what is born in a frame
        const uint32_t now = world_.report().fragments;
        if (now + room <= alive_) return;
        FragmentAge oldest;
        (void)world_.fragments(&oldest, 1);
        EXPECT_TRUE(world_.retire({.count = now + room - alive_}).ok());
        keep_stale(oldest.fragment);
    }
    void keep_stale(BodyId id) {
        if (stale_.size() < 64) stale_.push_back({});
        stale_[next_stale_++ % stale_.size()] = id;
    }

    uint32_t alive_, panes_ = 0;
    size_t next_stale_ = 0;
    World world_;
    ModelId model_;
    std::deque<BodyId> rests_;
    std::vector<BodyId> stale_;
};

TEST(Soak, FragmentsComeAndGoAndMemoryAndHandlesStayGood) {
    const uint64_t wanted = fragments_wanted();
    const uint32_t alive = wanted >= 100'000 ? 4096 : 512;
    Field field(alive);
    while (field.born < wanted && field.frame_ms.size() < 20 + wanted) field.step();
    ASSERT_GE(field.born, wanted);
    EXPECT_LE(field.most_alive, alive);
    EXPECT_GE(field.most_alive, alive / 2);
    EXPECT_TRUE(field.is_stale_refused);
    EXPECT_EQ(field.faults, 0u);
    EXPECT_EQ(field.world().contents().data.state.validate(), "");
    const size_t frames = field.frame_ms.size(), first = frames / 10;
    const std::vector<double> memory(field.memory.begin() + static_cast<std::ptrdiff_t>(first), field.memory.end());
    const auto middle = field.frame_ms.begin() + static_cast<std::ptrdiff_t>((first + frames) / 2);
    const double early = median_of({field.frame_ms.begin() + static_cast<std::ptrdiff_t>(first), middle});
    const double late = median_of({middle, field.frame_ms.end()});
    const double rise = rise_of(memory);
    std::printf("%llu born in %zu frames, at most %u alive, %llu retired, %llu crumbs faded, %llu refused\n",
                static_cast<unsigned long long>(field.born), frames, field.most_alive,
                static_cast<unsigned long long>(field.world().report().retired),
                static_cast<unsigned long long>(field.world().report().faded),
                static_cast<unsigned long long>(field.refused));
    std::printf("memory by tenths, MiB:");
    for (size_t tenth = 1; tenth <= 10; ++tenth) std::printf(" %.2f", field.memory[frames * tenth / 10 - 1]);
    std::printf("\nmemory %.1f MiB, rises by %.2f MiB over the last 90 %%; frames %.2f ms, then %.2f ms\n",
                memory.back(), rise, early, late);
    EXPECT_LT(rise, 1.0);
    if (wanted >= 100'000) {
        EXPECT_LT(late, 1.25 * early) << "frame times rise";
    }
}

}  // namespace
}  // namespace cullet::test
