// What the opening of tasks asks of the thick shell (model_calls.hpp).
#pragma once
#include "systems/model_calls.hpp"

namespace cullet {

/// Of the whole shell, or of what is round the contacts: then it waits for them.
WorkingCopy working_shell(BodyRows& state, Row<Bodies> body);
/// Clock, quick settings, units of the copy.
void begin_run(BodyRows& state, Row<Tasks> task);
/// Of the neighbourhood of the contacts, or of the whole body where blows reach it all, or the hit is wide.
bool give_late_rows(BodyRows& state, const Blows& blows, Row<Tasks> task, const char** full);
/// Of a hidden run on the whole body.
std::optional<RunLength> run_length(const BodyRows& state, Row<Bodies> body);

}  // namespace cullet
