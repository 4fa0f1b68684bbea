// An open task goes as if it had never been: nothing of the body changes.
#pragma once
#include "components/world_rows.hpp"

namespace cullet {

class DamageModels;

/// Gives back its rows, and what models hold for it. Whoever it holds is the caller's affair.
void cancel_task(const DamageModels& models, WorldRows& state, Row<Tasks> task);

}  // namespace cullet
