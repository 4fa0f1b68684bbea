// Whether systems write only the tables that they say that they write: State's columns are digested after each system.
#pragma once
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "components/state.hpp"
#include "systems/world_contents.hpp"

namespace cullet::test {

class WriteWatch {
 public:
    explicit WriteWatch(World& world);
    /// Before a step that is to be watched; steps without this call cost nothing.
    void watch_next_step();
    /// "open_tasks writes task_contacts.vertex", each once; after the last step.
    std::set<std::string> unsaid();

 private:
    void look(const PlannedSystem<WorldData>& system);
    void keep_pending();

    State& state_;
    bool is_watching_ = false;
    std::vector<uint32_t> before_, after_;
    // Systems of one pass are looked at after all of them: what the first does not say the next of its pass may.
    std::vector<std::pair<std::string, Access>> pending_;
    std::set<std::string> unsaid_;
};

}  // namespace cullet::test
