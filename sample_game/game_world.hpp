// A world as a script sets it up and drives it, stepped and counted.
#pragma once
#include <memory>
#include <vector>

#include "sample_game/report.hpp"
#include "sample_game/stage.hpp"

namespace cullet {

class Script;

/// Mass, momentum and energy of all that moves, pinned bodies and debris included. The sums run over rows in order.
struct Matter {
    double mass = 0, debris_mass = 0, kinetic_energy = 0;
    Vector momentum{};
    uint64_t fragments = 0, asleep = 0, awake = 0, awake_cells = 0;
};
Matter measure_matter(const World& world);

class GameWorld {
 public:
    /// Runs the script up to its first wait; cooks what the plan's shelf does not hold, which is slow.
    static Result<GameWorld> create(const ScenePlan& plan, const Host& host = {});
    GameWorld(GameWorld&&) noexcept;
    ~GameWorld();

    /// The script goes on where something is due in this frame.
    void before_step();
    void step() { stage_->world->step(); }
    /// Reads events; once a step.
    void after_step();
    /// A sentence once the script has gone wrong or an expectation was not met; nothing goes on after that.
    const std::string& failure() const { return failure_; }
    /// Where the script still waits, "vase.lua:12"; empty once it has come to its end.
    std::string waits_at() const;

    World& world() { return *stage_->world; }
    const World& world() const { return *stage_->world; }
    Stage& stage() { return *stage_; }
    const Stage& stage() const { return *stage_; }
    uint64_t frame() const { return stage_->frame; }
    RunSums& sums() { return stage_->sums; }
    double mass_put_in() const { return stage_->sums.mass_put_in; }
    /// Something cracked or came off in the last step.
    bool broke() const { return stage_->broke; }

 private:
    GameWorld(std::unique_ptr<Stage> stage, std::unique_ptr<Script> script);
    void take(const Result<void>& done);

    std::unique_ptr<Stage> stage_;  // the script points to it
    std::unique_ptr<Script> script_;
    std::string failure_;
};

/// Counts of rows and shapes, tasks and sweeps at the end of a run.
void fill_counts(const World& world, Report& report);

}  // namespace cullet
