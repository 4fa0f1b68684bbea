#include "systems/models.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "components/state.hpp"
#include "systems/models/thick_shell/hidden/brittle_loop.hpp"

namespace cullet {
namespace {

std::string asked;  // of the calls below, in order

template <char Name>
void cancel(RunRows& rows, Row<Tasks> task) {
    rows.tasks.units_owed[task] += 1;
    asked += Name;
}
std::optional<MechanicalEnergy> energy_of_odd(SoftRows& rows, Row<Bodies> body, Vec3) {
    if (rows.bodies.size() <= body || body % 2 == 0) return {};
    return MechanicalEnergy{3, 0, 0, 0, 1, 1};
}
uint32_t most(const SoftRows&) {
    return 3;
}
template <char Name>
uint64_t wanted(const SoftRows&) {
    asked += Name;
    return 40;
}
/// Uses what it gets up to 40.
template <char Name>
uint64_t grant(SoftRows&, uint64_t units, uint64_t& slow_frames) {
    asked += Name + std::to_string(units) + " ";
    slow_frames += units < 40;
    return std::min<uint64_t>(units, 40);
}
bool is_even(const RunRows&, uint32_t task) {
    return task % 2 == 0;
}
bool is_any(const RunRows&, uint32_t) {
    return true;
}
template <uint64_t Step>
RunCost cost(const RunRows&, uint32_t) {
    return {Step, 0};
}
InnerLoop<LoopWorld> empty_loop() {
    InnerLoop<LoopWorld> loop;
    loop.finish();
    return loop;
}

/// Of 4 shells, bodies and tasks: shell k is of model k / 2, body k has it, task k is of body k.
std::unique_ptr<State> small_state() {
    Limits limits;
    limits.bodies = limits.structures = limits.tasks = limits.models = limits.debris = 8;
    limits.vertices = limits.elements = limits.view_vertices = 4096;
    auto state = std::make_unique<State>(limits);
    if (state->tasks.size() < 4) state->tasks.append(4);
    state->bodies.append(4);
    state->shells.append(4);
    for (uint32_t k = 0; k < 4; ++k) {
        state->structures.damage_model[k] = static_cast<uint8_t>(k / 2);
        state->bodies.structure[k] = state->tasks.source[k] = Row<Structures>(k);
        state->tasks.body[k] = Row<Bodies>(k);
    }
    asked.clear();
    return state;
}

TEST(Models, ATasksModelIsThatOfItsBody) {
    const auto state = small_state();
    DamageModel a("a"), b("b");
    a.cancels<cancel<'a'>>();
    b.cancels<cancel<'b'>>();
    const DamageModels models({a, b});
    for (uint32_t t = 0; t < 4; ++t) models.cancel(*state, Row<Tasks>(t));
    EXPECT_EQ(asked, "aabb");
    EXPECT_EQ(state->tasks.units_owed[1], 1u);
}

TEST(Models, EnergyIsOfTheModelThatMovesTheBody) {
    const auto state = small_state();
    DamageModel silent("silent"), odd("odd");
    odd.has_energy<energy_of_odd>();
    const DamageModels models({silent, odd});
    ASSERT_TRUE(models.energy(*state, Row<Bodies>(3), {}).has_value());
    EXPECT_EQ(models.energy(*state, Row<Bodies>(3), {})->kinetic, 3);
    EXPECT_FALSE(models.energy(*state, Row<Bodies>(2), {}).has_value()) << "a rigid one";
    EXPECT_FALSE(models.energy(*state, Row<Bodies>(1), {}).has_value()) << "of the other model";
}

TEST(Models, WhatHasNoShellHasNoModel) {
    const auto state = small_state();
    DamageModel odd("odd");
    odd.has_energy<energy_of_odd>();
    state->bodies.structure[1] = {};
    EXPECT_FALSE(DamageModels({odd}).energy(*state, Row<Bodies>(1), {}).has_value());
}

TEST(Models, AModelIsFoundByItsNameAndItsNumberIsItsPlace) {
    const DamageModels models({DamageModel("a"), DamageModel("b")});
    EXPECT_EQ(models.find("a"), 0);
    EXPECT_EQ(models.find("b"), 1);
    EXPECT_FALSE(models.find("c").has_value());
    EXPECT_EQ(models.names(), "a, b");
}

TEST(Models, WhatMovesInEachFrameIsGrantedWhatTheModelsBeforeItLeft) {
    const auto state = small_state();
    DamageModel a("a"), silent("silent"), b("b");
    a.moves_each_frame<most, wanted<'a'>, grant<'a'>>("a");
    b.moves_each_frame<most, wanted<'b'>, grant<'b'>>("b");
    const DamageModels models({a, silent, b});
    EXPECT_EQ(models.most_moving(*state), 6u);
    EXPECT_EQ(models.units_wanted(*state), 80u);
    uint64_t slow_frames = 0;
    EXPECT_EQ(models.grant_frame(*state, 50, slow_frames), 50u);
    EXPECT_EQ(asked, "aba50 b10 ");
    EXPECT_EQ(slow_frames, 1u);
}

TEST(Models, ATaskIsOfTheFirstLoopOfItsModelThatWorksOnIt) {
    const auto state = small_state();
    DamageModel first("first"), second("second");
    first.loop<cost<3>>("even tasks", empty_loop(), {call<is_even>, call<is_any>})
        .loop<cost<5>>("the others", empty_loop(), {call<is_any>, call<is_any>});
    second.loop<cost<7>>("all tasks", empty_loop(), {call<is_any>, call<is_even>, true});
    const DamageModels models({first, second});
    EXPECT_EQ(models.loop_of(*state, 0).title(), "even tasks");
    EXPECT_EQ(models.loop_of(*state, 0).cost(*state, 0).step, 3u);
    EXPECT_FALSE(models.loop_of(*state, 0).is_brief());
    EXPECT_EQ(models.loop_of(*state, 1).title(), "the others");
    EXPECT_EQ(models.loop_of(*state, 2).title(), "all tasks");
    EXPECT_EQ(models.loop_of(*state, 2).cost(*state, 2).step, 7u);
    EXPECT_TRUE(models.loop_of(*state, 2).is_brief());
}

TEST(Models, WhoHasNoCallsLeavesEverythingAsItIs) {
    const auto state = small_state();
    const uint64_t before = state->hash();
    const DamageModels models({DamageModel("silent")});
    uint64_t slow_frames = 0;
    models.cancel(*state, Row<Tasks>(0));
    models.inherit(*state, Row<Bodies>(0), Row<Bodies>(1));
    models.follow(*state, Row<Bodies>(0));
    models.release(*state, Row<Bodies>(0));
    EXPECT_EQ(models.units_wanted(*state), 0u);
    EXPECT_EQ(models.grant_frame(*state, 100, slow_frames), 0u);
    EXPECT_FALSE(models.may_find_room(*state, Row<Bodies>(0)));
    EXPECT_FALSE(models.motion_of_rest(*state, Row<Tasks>(0)).has_value());
    EXPECT_TRUE(models.check_rows(*state, "rows", "").ok());
    EXPECT_EQ(state->hash(), before);
}

TEST(Models, ThePrintedFrameSaysWhoFillsEachSlot) {
    const std::string frame = World::describe_frame();
    const auto expect_filled = [&](Slot slot, const char* model) {
        EXPECT_NE(frame.find(std::string(", slot ") + name_of(slot) + ": " + model + "\n    pass "), std::string::npos)
            << name_of(slot) << frame;
    };
    for (const Slot slot : {Slot::Rest, Slot::Wake, Slot::Pass, Slot::Close, Slot::Group, Slot::Show})
        expect_filled(slot, "thick_shell");
    for (const Slot slot : {Slot::Wake, Slot::Group}) expect_filled(slot, "metal_shell");
    for (const Slot slot : {Slot::Fill, Slot::Hull, Slot::Draw, Slot::Compact})
        EXPECT_NE(frame.find(std::string(", slot ") + name_of(slot) + ": shell\n"), std::string::npos) << frame;
    EXPECT_NE(frame.find("start\n    pass 1  remember_poses"), std::string::npos) << frame;
}

}  // namespace
}  // namespace cullet
