// A world as a scene's plan sets it up, stepped and counted.
#pragma once
#include <memory>
#include <vector>

#include "sample_game/report.hpp"
#include "sample_game/scene.hpp"

namespace cullet {

/// Mass, momentum and energy of all that moves, pinned bodies and debris included. The sums run over rows in order.
struct Matter {
    double mass = 0, debris_mass = 0, kinetic_energy = 0;
    Vector momentum{};
    uint64_t fragments = 0, asleep = 0, awake = 0, awake_cells = 0;
};
Matter measure_matter(const World& world);

class GameWorld {
 public:
    /// The plan must outlive it.
    static Result<GameWorld> create(const ScenePlan& plan, const Host& host = {});

    /// Spawns what this frame brings. Refusals become notes of refusals().
    void before_step();
    void step() { world_.step(); }
    /// Reads events; once a step.
    void after_step();

    World& world() { return world_; }
    const World& world() const { return world_; }
    const ScenePlan& plan() const { return *plan_; }
    uint64_t frame() const { return frame_; }
    double mass_put_in() const { return mass_put_in_; }
    /// Something cracked or came off in the last step.
    bool broke() const { return broke_; }
    const std::vector<std::string>& refusals() const { return refusals_; }

    /// Adds up over the run.
    std::map<std::string, uint64_t> events, refused;
    std::vector<std::string> faults;
    uint64_t born = 0, units_used = 0, most_units = 0;

 private:
    GameWorld(const ScenePlan& plan, World world) : plan_(&plan), world_(std::move(world)) {}
    Result<void> set_up();
    bool wants_more() const;

    const ScenePlan* plan_;
    World world_;
    std::vector<ModelId> models_;
    std::vector<std::string> refusals_;
    size_t next_spawn_ = 0;
    uint64_t frame_ = 0;
    double mass_put_in_ = 0;
    bool broke_ = false;
};

/// Counts of rows and shapes, tasks and sweeps at the end of a run.
void fill_counts(const World& world, Report& report);

}  // namespace cullet
