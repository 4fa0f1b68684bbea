// What a function is given is all that it reaches.
#include "engine/table_group.hpp"

#include <gtest/gtest.h>

#include "engine/frame_plan.hpp"

namespace cullet {
namespace {

struct Wheels : Table<Wheels> {
    using Table::Table;
    static constexpr const char* kName = "wheels";
    Column<float> turn{*this, "turn"};
};
struct Doors : Table<Doors> {
    using Table::Table;
    static constexpr const char* kName = "doors";
    Column<uint8_t> is_open{*this, "is_open"};
};
struct Roofs : Table<Roofs> {
    using Table::Table;
    static constexpr const char* kName = "roofs";
    Column<float> load{*this, "load"};
};

struct Car {
    Wheels& wheels;
    Doors& doors;
    const Roofs& roofs;
};
struct Doorway {
    const Doors& doors;
};
struct Drive {
    Wheels& wheels;
    const Roofs& roofs;
};
struct Roofing {
    Roofs& roofs;
};
struct House {  // groups of groups
    Doorway doorway;
    Roofing roofing;
};
struct Street {
    Car car;
    House house;
};
struct Numbers {
    float a = 0;
    int b = 0;
};

static_assert(IsGroup<Car> && IsGroup<Doorway> && IsGroup<House> && IsGroup<Street>);
struct EveryTable {
    static constexpr bool kHoldsEveryTable = true;
};
struct Escape {
    EveryTable& all;
};
static_assert(!IsGroup<Escape>, "a group names its tables");
static_assert(!IsGroup<Wheels> && !IsGroup<Numbers> && !IsGroup<Step> && !IsGroup<Serial> && !IsGroup<float>);
static_assert(NarrowsTo<Drive, Car>, "fewer tables");
static_assert(NarrowsTo<Doorway, Car>, "written ones as read ones");
static_assert(NarrowsTo<Doorway, Doors> && NarrowsTo<Drive, Wheels, Roofs>, "tables by themselves");
static_assert(NarrowsTo<Drive, Wheels, const Roofs>);
// The forbidden: each of these would not compile as narrow<..>(..).
static_assert(!NarrowsTo<Roofing, Car>, "what is only read is not written");
static_assert(!NarrowsTo<Car, Drive>, "what was not given is not there");
static_assert(!NarrowsTo<Drive, const Wheels, Roofs>);
static_assert(NarrowsTo<House, Car, Roofs> && NarrowsTo<Roofing, House> && NarrowsTo<Drive, Street>);
static_assert(!NarrowsTo<House, Car> && !NarrowsTo<Car, House>);

TEST(TableGroup, AHelperSeesTheSameTablesThroughANarrowerGroup) {
    Wheels wheels(10);
    Doors doors(10);
    Roofs roofs(10);
    const Car car{wheels, doors, roofs};
    const Drive drive = narrow<Drive>(car);
    EXPECT_EQ(&drive.wheels, &wheels);
    EXPECT_EQ(&drive.roofs, &roofs);
    EXPECT_EQ(&narrow<Doorway>(drive, doors).doors, &doors);
    EXPECT_EQ(&narrow<Car>(drive, doors).doors, &doors);
    const House house = narrow<House>(car, roofs);
    EXPECT_EQ(&house.roofing.roofs, &roofs);
    EXPECT_EQ(&narrow<Roofing>(Street{car, house}).roofs, &roofs);
}

struct Garage {
    Wheels wheels{10};
    Doors doors{10};
    Roofs roofs{10};
    Step step;
    template <class T>
    T& table() {
        if constexpr (std::is_same_v<T, Wheels>)
            return wheels;
        else if constexpr (std::is_same_v<T, Doors>)
            return doors;
        else
            return roofs;
    }
    template <class T>
    T& resource() {
        return step;
    }
};

}  // namespace

// Systems have names of their own.
static void roll(Serial, Step step, Drive drive) {
    if (drive.roofs.size() == 0) drive.wheels.turn[0] += step.dt;
}
static void build(Serial, House) {}
static void knock(Serial, Doorway) {}
static void shut(Serial, Doors& doors) {
    doors.truncate(0);
}
static void paint(Serial, Roofing roofing) {
    roofing.roofs.append(1);
}

namespace {

TEST(TableGroup, TheFramePlanOrdersByTheTablesInIt) {
    Profiler profiler;
    FramePlan<Garage> plan;
    plan.stage("road").then<roll>().then<knock>().then<shut>().then<paint>();
    plan.finish(profiler);
    EXPECT_EQ(plan.describe(),
              "road\n"
              "    pass 1  roll  [serial]\n"
              "        reads  wheels, roofs\n"
              "        writes wheels\n"
              "    pass 1  knock  [serial]\n"
              "        reads  doors\n"
              "        writes -\n"
              "    pass 2  shut  [serial]\n"
              "        reads  doors\n"
              "        writes doors\n"
              "        after  knock\n"
              "    pass 2  paint  [serial]\n"
              "        reads  roofs\n"
              "        writes roofs\n"
              "        after  roll\n");
    EXPECT_EQ(plan.pass_count(), 2u);
    plan.then<build>().finish(profiler);
    EXPECT_NE(plan.describe().find("reads  doors, roofs\n        writes roofs\n"), std::string::npos);
    Garage garage;
    garage.wheels.append(1);
    plan.step(garage, *make_jobs(JobBackend::Threads, 1), profiler);
    EXPECT_EQ(garage.wheels.turn[0], garage.step.dt);
    EXPECT_EQ(garage.roofs.size(), 1u);
}

}  // namespace
}  // namespace cullet
