// A frame plan whose story has slots.
#pragma once
#include "systems/models.hpp"

namespace cullet {

/// A plan whose story has slots.
class SlottedPlan {
 public:
    SlottedPlan(const DamageModels& models, std::vector<SlotList> structures)
        : models_(models), structures_(std::move(structures)) {}

    SlottedPlan& stage(std::string name) {
        plan_.stage(stage_ = std::move(name));
        return *this;
    }
    template <auto System>
    SlottedPlan& then() {
        plan_.then<System>();
        return *this;
    }
    /// The inner loops of all models, which the system named last runs.
    SlottedPlan& loops() {
        for (const DamageModel& model : models_) {
            for (const TaskLoop& loop : model.task_loops()) plan_.shows(loop.title(), loop);
            for (const FrameLoop& loop : model.frame_loops()) plan_.shows(loop.title(), loop);
        }
        return *this;
    }
    SlottedPlan& models(Slot slot) {
        for (uint32_t number = 0; const DamageModel& model : models_) {
            plan_.owner(number++);
            fill(slot, model.slots());
        }
        return *this;
    }
    SlottedPlan& structures(Slot slot) {
        for (const SlotList& structure : structures_) fill(slot, structure);
        return *this;
    }
    FramePlan<WorldData> take() { return std::move(plan_); }

 private:
    /// The printed frame says whose systems they are.
    void fill(Slot slot, const SlotList& systems) {
        plan_.stage(stage_ + ", slot " + name_of(slot) + ": " + systems.name());
        systems.add_to(plan_, slot);
        plan_.stage(stage_);
    }

    const DamageModels& models_;
    std::vector<SlotList> structures_;
    FramePlan<WorldData> plan_;
    std::string stage_;
};

}  // namespace cullet
