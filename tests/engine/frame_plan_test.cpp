#include "engine/frame_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "engine/random.hpp"

namespace cullet {

struct Birds : Table<Birds> {
    using Table::Table;
    static constexpr const char* kName = "birds";
    Column<Vec3> position{*this, "position", "m"};
    Column<Vec3> velocity{*this, "velocity", "m/s"};
    Column<float> hunger{*this, "hunger"};
    Column<uint32_t> flock{*this, "flock"};
};
template <>
inline constexpr uint32_t kRowsPerChunk<Birds> = 32;

struct BirdsEggs : Table<BirdsEggs> {  // its name starts like the other table's
    using Table::Table;
    static constexpr const char* kName = "birds_eggs";
    Column<float> warmth{*this, "warmth"};
};

struct Cried {
    uint32_t bird, cry;
    uint32_t owner = bird % 3;
};
struct Weather {
    float wind = 2;
    uint32_t storms = 0;
};

struct Sky {
    Birds birds{5000};
    BirdsEggs birds_eggs{100};
    Weather weather;
    Step step{.dt = 0.5f, .gravity = {}, .frame = 41};
    Arena arena{1 << 20};
    Events<Cried> cries{100000};

    static constexpr bool kHoldsEveryTable = true;
    template <class T>
    T& table() {
        if constexpr (std::is_same_v<T, Birds>)
            return birds;
        else
            return birds_eggs;
    }
    template <class T>
    T& resource() {
        if constexpr (std::is_same_v<T, Weather>)
            return weather;
        else if constexpr (std::is_same_v<T, Step>)
            return step;
        else if constexpr (std::is_same_v<T, Arena>)
            return arena;
        else if constexpr (std::is_same_v<T, Events<Cried>>)
            return cries;
        else
            return *this;
    }
};

void steer(Rows<Birds> rows, const Weather& weather, In<&Birds::position> position, InOut<&Birds::velocity> velocity) {
    for (const auto b : rows) velocity.set(b, velocity[b] + weather.wind * position[b]);
}
void fly(Rows<Birds> rows, Step step, In<&Birds::velocity> velocity, InOut<&Birds::position> position) {
    for (const auto b : rows) position.set(b, position[b] + step.dt * velocity[b]);
}
void starve(Rows<Birds> rows, InOut<&Birds::hunger> hunger) {
    for (const auto b : rows) hunger.set(b, hunger[b] + 1);
}
void brood(Rows<BirdsEggs> rows, Out<&BirdsEggs::warmth> warmth) {
    for (const auto e : rows) warmth.set(e, 37);
}
void feed(Serial, Birds& birds) {
    for (uint32_t b = 0; b < birds.size(); ++b) birds.hunger[b] = 0;
}
void blow(Serial, Weather& weather) {
    ++weather.storms;
}
void forecast(Serial, const Weather&, Arena& arena) {
    arena.take<int>(10);
}
void plan_route(Serial, Arena& arena) {
    arena.take<int>(10);
}
void audit(Serial, const Sky&) {}
void rebuild(Serial, Sky& sky) {
    sky.birds.clear_rows(0, 1);
}
// Bird b cries b % 4 times.
void cry(Serial, const Birds& birds, Events<Cried>& cries) {
    for (uint32_t b = 0; b < birds.size(); ++b)
        for (uint32_t n = 0; n < b % 4; ++n) cries.push({b, n});
}
void listen(Serial, const Events<Cried>& cries, Weather& weather) {
    weather.storms += cries.size();
}
void answer(Each<Cried> cried, Birds& birds) {
    birds.hunger[cried->bird * 4 + cried->cry] += 1;
}
template <int n>
void count_own(EachOwn<Cried> cried, Birds& birds) {
    const uint32_t row = cried->bird * 4 + cried->cry;
    if (row < birds.size()) birds.flock[row] += n;
}
template <int n>
void list_own(Serial, Own<Cried> cries, Weather& weather) {
    for (const Cried& c : cries) weather.storms += n * (c.bird + 1);
}
template <int n>
void independent(Serial) {}
void tiny(Serial, Weather& weather) {
    volatile float small = 1e-25f;
    weather.wind = small * 1e-20f;
}

namespace {

using Plan = FramePlan<Sky>;
using Names = std::vector<std::string>;

template <auto... System>
Plan make_plan(Profiler& profiler) {
    Plan plan;
    (plan.stage("fly").then<System>(), ...);
    plan.finish(profiler);
    return plan;
}

// Names of what the last system of the list comes after.
template <auto... System>
Names after_last() {
    Profiler profiler(1, 1);
    const Plan plan = make_plan<System...>(profiler);
    Names names;
    for (const uint32_t s : plan.systems().back().after) names.push_back(plan.systems()[s].name);
    return names;
}
template <auto... System>
uint32_t passes() {
    Profiler profiler(1, 1);
    return make_plan<System...>(profiler).pass_count();
}

TEST(FramePlan, AReaderComesAfterTheWriter) {
    EXPECT_EQ((after_last<steer, fly>()), Names{"steer"});
    EXPECT_EQ((after_last<blow, steer>()), Names{"blow"});
}

TEST(FramePlan, AWriterComesAfterTheReader) {
    EXPECT_EQ((after_last<fly, steer>()), Names{"fly"});
    EXPECT_EQ((after_last<steer, blow>()), Names{"steer"});
}

TEST(FramePlan, TwoReadersShareAPass) {
    EXPECT_EQ((after_last<steer, forecast>()), Names{});
    EXPECT_EQ((passes<steer, forecast>()), 1u);
}

TEST(FramePlan, AWholeTableMeetsEachOfItsColumns) {
    EXPECT_EQ((after_last<starve, feed>()), Names{"starve"});
    EXPECT_EQ((after_last<feed, starve>()), Names{"feed"});
}

TEST(FramePlan, ATableWhoseNameStartsLikeAnotherIsAnother) {
    EXPECT_EQ((after_last<feed, brood>()), Names{});
    EXPECT_EQ((passes<feed, brood>()), 1u);
}

TEST(FramePlan, DifferentColumnsOfATableShareAPass) {
    EXPECT_EQ((after_last<starve, steer>()), Names{});
    EXPECT_EQ((passes<starve, steer, brood>()), 1u);
}

TEST(FramePlan, WhatHoldsEveryTableMeetsAllColumns) {
    EXPECT_EQ((after_last<starve, brood, rebuild>()), (Names{"brood", "starve"}));
    EXPECT_EQ((after_last<rebuild, brood>()), Names{"rebuild"});
    EXPECT_EQ((after_last<brood, audit>()), Names{"brood"});
    EXPECT_EQ((after_last<rebuild, audit>()), Names{"rebuild"});
    EXPECT_EQ((after_last<audit, blow>()), Names{}) << "a resource is not a table";
}

TEST(FramePlan, TwoUsersOfTheArenaNeverRunAtOnce) {
    EXPECT_EQ((after_last<forecast, plan_route>()), Names{"forecast"});
}

TEST(FramePlan, WhoFillsAQueueAndEachMeetAtIt) {
    EXPECT_EQ((after_last<cry, listen>()), Names{"cry"});
    EXPECT_EQ((after_last<cry, answer>()), Names{"cry"});
    EXPECT_EQ((after_last<answer, cry>()), Names{"answer"});
}

TEST(FramePlan, AnEdgeThatFollowsFromOthersIsLeftOut) {
    EXPECT_EQ((after_last<steer, fly, steer>()), Names{"fly"});
    EXPECT_EQ((passes<steer, fly, steer>()), 3u);
}

TEST(FramePlan, OnlyNeighboursShareAPass) {
    EXPECT_EQ((passes<steer, starve, fly, brood>()), 2u);  // steer, starve | fly, brood
    EXPECT_EQ((passes<steer, fly, starve, brood>()), 2u);  // steer | fly, starve, brood
}

template <int... n>
Plan plan_of_many(Profiler& profiler, std::integer_sequence<int, n...>) {
    return make_plan<independent<n>...>(profiler);
}
TEST(FramePlan, MoreSystemsThanAPassHoldsOpenAnother) {
    Profiler profiler;
    Plan plan = plan_of_many(profiler, std::make_integer_sequence<int, 40>());
    EXPECT_EQ(plan.pass_count(), 3u);
    Sky sky;
    const auto jobs = make_jobs(JobBackend::Threads, 2);
    plan.step(sky, *jobs, profiler);
}

struct Hum {
    static std::string describe() { return "        inside\n"; }
};

TEST(FramePlan, ItDescribesItself) {
    Profiler profiler;
    Plan plan;
    const Hum hum;
    plan.stage("move").then<steer>().then<fly>();
    plan.stage("speak").then<cry>().shows("a loop", hum).then<brood>();
    plan.finish(profiler);
    EXPECT_EQ(plan.describe(),
              "move\n"
              "    pass 1  steer  [rows]\n"
              "        reads  Weather, birds.position, birds.velocity\n"
              "        writes birds.velocity\n"
              "    pass 2  fly  [rows]\n"
              "        reads  birds.velocity, birds.position\n"
              "        writes birds.position\n"
              "        after  steer\n"
              "speak\n"
              "    pass 3  cry  [serial]\n"
              "        reads  birds, Events<Cried>\n"
              "        writes Events<Cried>\n"
              "        after  fly\n"
              "      repeats: a loop\n"
              "        inside\n"
              "    pass 3  brood  [rows]\n"
              "        reads  -\n"
              "        writes birds_eggs.warmth\n");
    EXPECT_EQ(profiler.zone_count(), 4u);
    EXPECT_EQ(profiler.zone_name(2), "cry");
}

std::vector<std::unique_ptr<JobSystem>> all_jobs() {
    std::vector<std::unique_ptr<JobSystem>> list;
    for (const uint32_t threads : {1u, 2u, 3u, 8u}) list.push_back(make_jobs(JobBackend::Threads, threads));
    list.push_back(make_jobs(JobBackend::Tbb, 2));
    HostJobs backwards;
    backwards.worker_count = [](void*) { return 3u; };
    backwards.parallel_for = [](void*, uint32_t count, void (*job)(void*, uint32_t), void* context) {
        while (count-- > 0) job(context, count);
    };
    list.push_back(make_host_jobs(backwards));
    return list;
}

TEST(FramePlan, AnEmptyWorldTakesAStep) {
    Profiler profiler;
    Plan plan = make_plan<steer, fly, starve, cry, answer, brood>(profiler);
    Sky sky;
    plan.step(sky, *make_jobs(JobBackend::Threads, 2), profiler);
    EXPECT_EQ(sky.cries.size(), 0u);
}

TEST(FramePlan, EachEventIsAnsweredOnce) {
    for (const auto& jobs : all_jobs()) {
        Profiler profiler;
        Plan plan = make_plan<cry, answer>(profiler);
        Sky sky;
        sky.birds.append(400);
        for (uint32_t b = 100; b < 400; ++b) sky.birds.flock[b] = 1;
        // Only 100 birds' cries fit the answers' table: 4 rows a bird.
        sky.birds.truncate(100);
        plan.step(sky, *jobs, profiler);
        sky.birds.append(300);
        for (uint32_t b = 0; b < 100; ++b)
            for (uint32_t c = 0; c < 4; ++c)
                if (b * 4 + c < 100) {
                    ASSERT_EQ(sky.birds.hunger[b * 4 + c], c < b % 4 ? 1.0f : 0.0f);
                }
    }
}

TEST(FramePlan, AnOwnersSystemsSeeItsEventsAlone) {
    Sky sky;
    Profiler profiler(1, 1);
    sky.birds.append(400);
    Plan plan;
    plan.then<cry>().owner(1).then<count_own<1>>().then<list_own<1>>().owner(2).then<count_own<100>>();
    plan.owner(7).then<list_own<1000000>>();
    plan.finish(profiler);
    plan.step(sky, *make_jobs(JobBackend::Tbb, 4), profiler);
    uint32_t wanted = 0;
    for (uint32_t b = 0; b < 400; ++b)
        for (uint32_t n = 0; n < b % 4; ++n) {
            if (b < 100) {
                EXPECT_EQ(sky.birds.flock[4 * b + n], b % 3 == 1 ? 1u : b % 3 == 2 ? 100u : 0u) << b << " " << n;
            }
            wanted += b % 3 == 1 ? b + 1 : 0;
        }
    EXPECT_EQ(sky.weather.storms, wanted);
}

TEST(FramePlan, AStepGivesTheSameBytesOnAnyBackend) {
    uint64_t first = 0;
    for (const auto& jobs : all_jobs()) {
        Profiler profiler;
        Plan plan = make_plan<steer, starve, fly, brood, blow, rebuild, fly>(profiler);
        Sky sky;
        sky.birds.append(777);
        sky.birds_eggs.append(50);
        for (uint32_t b = 0; b < 777; ++b) sky.birds.position.set(b, {static_cast<float>(Random{4}.uniform(b)), 1, 2});
        for (int frame = 0; frame < 20; ++frame) plan.step(sky, *jobs, profiler);
        const uint64_t hash = sky.birds_eggs.hash(sky.birds.hash(0));
        if (!first) first = hash;
        EXPECT_EQ(hash, first);
    }
}

TEST(FramePlan, ASystemThatRunsOnTheCallerHasOurFloatingPointModeToo) {
    Profiler profiler;
    Plan plan = make_plan<tiny>(profiler);
    Sky sky;
    plan.step(sky, *make_jobs(JobBackend::Threads, 2), profiler);
    EXPECT_EQ(sky.weather.wind, 0.0f);
    volatile float small = 1e-25f;
    EXPECT_GT(small * 1e-20f, 0.0f) << "and the caller keeps its own";
}

TEST(FramePlan, TheValidatorSeesEachSystemOnce) {
    Profiler profiler;
    Plan plan = make_plan<steer, starve, fly>(profiler);
    Sky sky;
    Names seen;
    const std::function<void(const PlannedSystem<Sky>&)> note = [&](const auto& system) {
        seen.push_back(system.name);
    };
    plan.step(sky, *make_jobs(JobBackend::Threads, 1), profiler, &note);
    EXPECT_EQ(seen, (Names{"steer", "starve", "fly"}));
}

TEST(FramePlan, RunCallsOneSystemOverAllRows) {
    Sky sky;
    sky.birds.append(100);
    run<starve>(sky);
    EXPECT_EQ(sky.birds.hunger[99], 1.0f);
    run<cry>(sky);
    EXPECT_EQ(sky.cries.size(), 150u);
}

}  // namespace
}  // namespace cullet
