// An open task goes as if it had never been: nothing of the body changes.
#pragma once
#include "components/body_rows.hpp"

namespace cullet {

/// Gives back its rows. Whoever it holds is the caller's affair.
void cancel_task(BodyRows& state, Row<Tasks> task);

}  // namespace cullet
