// What the rest of the program asks damage models, and what it tells them.
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "cullet/result.hpp"
#include "cullet/world.hpp"
#include "systems/checks/wear.hpp"
#include "systems/checks/world_energy.hpp"
#include "systems/cook/cooking.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/structure_calls.hpp"
#include "systems/world_data.hpp"

namespace cullet {

/// A blow of the game's at one place of a body.
struct PointPush {
    Vec3 point;         // body frame, m
    Vec3 impulse;       // N s, body axes
    float radius = 0;   // m, that it is shared out over
    float fastest = 0;  // m/s, at most, that it gives to any point
};

/// A blow that a task may be opened for, body frame and axes.
struct Knock {
    Row<Bodies> body, striker;        // none: the game's
    Vec3d point, push;                // m; unit, the way the body is pushed
    double speed = 0;                 // m/s, that they close with
    double striker_inverse_mass = 0;  // 1/kg, effective along the push
    double radius = 0;                // m, of a round striker
    uint64_t frame = 0;               // of the touch
    float step_seconds = 0;           // s
    bool is_sure = true;              // it comes in this step, and is not only foreseen
};

/// What presses on a body slowly.
struct Press {
    double depth = 0;  // m, that who presses lies in it
    double ahead = 0;  // m, that it comes until the body has given way
    double force = 0;  // N, of who makes way itself; 0: who presses comes as far as it is in, whatever bears it
};

/// A working copy of what a body is made of, for a task that opens.
struct WorkingCopy {
    Row<Structures> structure;   // none: it waits, or there is no room
    bool waits = false;          // for the task's contacts: its rows are given when they are known
    const char* full = nullptr;  // the limit that left no room
};

/// What models are told about a body that the game spawns.
struct Spawning {
    const SpawnSettings& settings;
    bool is_breakable;    // the game wants it, and its strength is finite
    bool knows_surfaces;  // the rigid world tells what a body meets
    float step_seconds;   // s
    uint64_t units_a_frame;
};

/// How long a run takes that works on a whole body.
struct RunLength {
    float seconds = 0, step_seconds = 0;  // of its own clock, s
    uint64_t units_a_step = 0;
};

/// What a damage model can be asked: plain functions over sets of tables, each of bodies that it breaks. A model
/// without one has nothing to do with it. DamageModel says what each is for.
struct ModelCalls {
    // Cooking and spawning.
    Result<std::shared_ptr<Model::Contents>> (*cook)(Cooking&) = nullptr;
    float (*edge_share)(const CookSettings&) = nullptr;
    Result<Row<Structures>> (*spawn_structure)(WorldRows&, Row<Structures> source, const Spawning&) = nullptr;
    Result<ShellRoom> (*spawn_body)(WorldRows&, Row<Bodies>, const Spawning&) = nullptr;
    // Tasks.
    bool (*leaves_nothing)(WorldRows&, const Knock&, float& bounce) = nullptr;
    WorkingCopy (*working_copy)(WorldRows&, Row<Bodies>) = nullptr;
    void (*begin)(WorldRows&, Row<Tasks>) = nullptr;
    bool (*give_late)(WorldRows&, const Blows&, Row<Tasks>, const char** full) = nullptr;
    bool (*may_find_room)(const WorldRows&, Row<Bodies>) = nullptr;
    bool (*is_full)(const WorldRows&) = nullptr;
    bool breaks_at_any_speed = false;
    bool (*is_pressed)(WorldRows&, Row<Bodies>, const Press&) = nullptr;
    double (*least_width)(const WorldRows&, Row<Bodies>) = nullptr;
    std::optional<RunLength> (*length)(const WorldRows&, Row<Bodies>) = nullptr;
    ShellRoom (*room)(WorldRows&, Row<Bodies>) = nullptr;
    bool (*is_part)(const WorldRows&, uint32_t task) = nullptr;
    void (*cancel)(WorldRows&, Row<Tasks>) = nullptr;
    // Births.
    RestMotion (*motion_of_rest)(const WorldRows&, Row<Tasks>) = nullptr;
    void (*inherit)(WorldRows&, Row<Bodies> parent, Row<Bodies> piece) = nullptr;
    bool (*keeps_cell_names)(const WorldRows&, Row<Bodies>) = nullptr;
    // What a model moves by itself, in each frame.
    uint32_t (*most_moving)(const WorldRows&) = nullptr;
    uint64_t (*wanted)(const WorldRows&) = nullptr;
    uint64_t (*grant)(WorldRows&, uint64_t units, uint64_t& slow_frames) = nullptr;
    std::optional<MechanicalEnergy> (*energy)(WorldRows&, Row<Bodies>, Vec3 gravity) = nullptr;
    bool (*push)(WorldRows&, RigidWorld&, Row<Bodies>, const PointPush&) = nullptr;
    bool (*explode)(WorldRows&, RigidWorld&, Row<Bodies>, const Explosion&) = nullptr;
    bool (*call_up)(WorldRows&, Row<Bodies>) = nullptr;
    bool (*is_driven_into)(const WorldRows&) = nullptr;
    bool (*is_moving)(const WorldRows&, Row<Bodies>) = nullptr;
    void (*look_for_pieces)(WorldRows&, Row<Bodies>) = nullptr;
    Row<Bodies> (*take_torn)(WorldRows&) = nullptr;
    void (*hand_off_torn)(const WorldRows&, const Break&, Fragments&) = nullptr;
    void (*give_torn)(WorldRows&, const Break&, const Fragments&) = nullptr;
    void (*keep_torn)(WorldRows&, RigidWorld&, Row<Bodies>) = nullptr;
    void (*follow)(WorldRows&, Row<Bodies>) = nullptr;
    void (*release)(WorldRows&, Row<Bodies>) = nullptr;
    // The game's calls.
    const char* (*why_not_cut)(const WorldRows&, Row<Bodies>) = nullptr;
    // Files.
    void (*restore_run)(WorldRows&, Row<Tasks>) = nullptr;
    void (*restore_body)(WorldRows&, Row<Bodies>) = nullptr;
    Result<void> (*check_shell)(MetalShellRows, Row<Structures>, Wear, const std::string& name,
                                const char* advice) = nullptr;
    std::string (*trouble_of_task)(const WorldRows&, uint32_t task) = nullptr;
    Result<void> (*check_rows)(const WorldRows&, uint8_t own, const std::string& name, const char* advice) = nullptr;
};

}  // namespace cullet
