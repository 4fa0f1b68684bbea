// What the frame knows of damage models and of structures: the slots that they fill with systems of their own.
#pragma once
#include <string>
#include <vector>

#include "engine/frame_plan.hpp"
#include "systems/world_data.hpp"

namespace cullet {

/// Places in a frame (frame.cpp).
enum class Slot : uint8_t {
    // Of what breaks things: models.
    Rest,      // what moves by itself comes to rest
    Wake,      // what was hit gets its rows
    Pass,      // what inner loops gave to others
    Close,     // what ended gives its rows back
    Group,     // what hangs together
    GiveBack,  // after the solve
    Show,      // before drawing
    // Of what things are made of: structures.
    Fill,     // pieces get their rows
    Hull,     // what collides
    Draw,     // what is seen
    Compact,  // rows that nobody uses
};

/// The systems of one model or structure, slot by slot.
class SlotList {
 public:
    explicit SlotList(std::string name) : name_(std::move(name)) {}

    /// The systems that follow belong there.
    SlotList& at(Slot slot) {
        slot_ = slot;
        return *this;
    }
    template <auto System>
    SlotList& then() {
        systems_.push_back({slot_, [](FramePlan<WorldData>& plan) { plan.then<System>(); }});
        return *this;
    }
    const std::string& name() const { return name_; }
    /// In the order in which they were named.
    void add_to(FramePlan<WorldData>& plan, Slot slot) const {
        for (const Filled& system : systems_)
            if (system.slot == slot) system.add(plan);
    }

 private:
    struct Filled {
        Slot slot;
        void (*add)(FramePlan<WorldData>&);
    };
    std::string name_;
    Slot slot_ = Slot::Rest;
    std::vector<Filled> systems_;
};

/// All of them, in the order in which they run within a slot. One more is a line in models.cpp.
struct Tenants {
    std::vector<SlotList> models, structures;
};
Tenants tenants();

/// A plan whose story has slots.
class SlottedPlan {
 public:
    explicit SlottedPlan(const Tenants& tenants) : tenants_(tenants) {}

    SlottedPlan& stage(std::string name) {
        plan_.stage(std::move(name));
        return *this;
    }
    template <auto System>
    SlottedPlan& then() {
        plan_.then<System>();
        return *this;
    }
    template <class Loop>
    SlottedPlan& shows(std::string title, const Loop& loop) {
        plan_.shows(std::move(title), loop);
        return *this;
    }
    SlottedPlan& models(Slot slot) {
        for (const SlotList& model : tenants_.models) model.add_to(plan_, slot);
        return *this;
    }
    SlottedPlan& structures(Slot slot) {
        for (const SlotList& structure : tenants_.structures) structure.add_to(plan_, slot);
        return *this;
    }
    FramePlan<WorldData> take() { return std::move(plan_); }

 private:
    const Tenants& tenants_;
    FramePlan<WorldData> plan_;
};

}  // namespace cullet
