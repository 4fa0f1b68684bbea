// The events of a step by their names in scripts and reports, a line each.
#pragma once
#include <string>

#include "cullet/events.hpp"

namespace cullet {

template <class Visit>
void each_event(const StepEvents& step, const Visit& visit) {
    visit("impact", step.impacts);
    visit("crack_started", step.cracks_started);
    visit("fragment_born", step.fragments_born);
    visit("debris", step.debris);
    visit("refused", step.refused);
    visit("fault", step.faults);
    visit("asleep", step.asleep);
    visit("squeezed", step.squeezed);
}

/// "impact, crack_started, ..."
inline std::string event_names() {
    std::string names;
    each_event({}, [&](const char* name, const auto&) { names += (names.empty() ? "" : ", ") + std::string(name); });
    return names;
}

}  // namespace cullet
