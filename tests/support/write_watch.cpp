#include "tests/support/write_watch.hpp"

#include <algorithm>

namespace cullet::test {

WriteWatch::WriteWatch(World& world) : state_(world.contents().data.state) {
    world.contents().after_each_system = [this](const PlannedSystem<WorldData>& system) {
        if (is_watching_) look(system);
        if (system.name == "compact_shells") is_watching_ = false;  // the last of a frame
    };
}

void WriteWatch::watch_next_step() {
    is_watching_ = true;
    state_.digest_columns(before_);
}

std::set<std::string> WriteWatch::unsaid() {
    keep_pending();
    return unsaid_;
}

void WriteWatch::keep_pending() {
    for (const auto& [system, column] : pending_) unsaid_.insert(system + " writes " + column.name);
    pending_.clear();
}

void WriteWatch::look(const PlannedSystem<WorldData>& system) {
    state_.digest_columns(after_);
    if (after_ != before_) keep_pending();
    for (size_t place = 0; place < after_.size(); ++place) {
        if (after_[place] == before_[place]) continue;
        Access column;
        column.name = state_.digested_column(place);
        column.kind = Access::Kind::Table;
        if (column.name.find('.') != std::string::npos) pending_.emplace_back(system.name, column);  // no pool
    }
    std::erase_if(pending_, [&](const auto& one) {
        return std::any_of(system.accesses.begin(), system.accesses.end(),
                           [&](const Access& access) { return access.writes && access.overlaps(one.second); });
    });
    before_ = after_;
}

}  // namespace cullet::test
