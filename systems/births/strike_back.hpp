// What strikers get when a body breaks, so that momentum is kept.
#pragma once
#include "systems/births/limit_energy.hpp"
#include "systems/births/make_break.hpp"

namespace cullet {

/// Strikers and supports get what the pieces took (thick shell note 6.6). A striker with a task of its own that is on
/// time may break too: then the impulse waits with its contact (TaskContacts.answer). When it does break, what its own
/// run passed here takes the place of that, and the difference of the two goes to the largest piece of the larger one.
/// The largest fragment also gets what rounding took from the hidden state. Returns the energy that the pieces may
/// have, J: the body's own, of before the hit, and what strikers lost to it (limit_energy.hpp). An impulse J that takes
/// a contact's speed from v_0 to v takes J (v_0 + v)/2 from what pushes there.
double strike_back(Births& births, const Break& plan, const Pose& pose);

/// Passes on what waits with the task's contacts: the body did not break after all, or is late.
void pay_answers(Bodies& bodies, const Tasks& tasks, TaskContacts& contacts, RigidWorld& rigid, Row<Tasks> task);

}  // namespace cullet
