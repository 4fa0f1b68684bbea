// Slots of a frame: places in its story that damage models and structures fill with systems of their own.
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

inline const char* name_of(Slot slot) {
    static constexpr const char* kNames[] = {"Rest", "Wake", "Pass", "Close", "Group",  "GiveBack",
                                             "Show", "Fill", "Hull", "Draw",  "Compact"};
    return kNames[static_cast<size_t>(slot)];
}

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

}  // namespace cullet
