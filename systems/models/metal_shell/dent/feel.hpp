// What of a blow is more than a bump: before a task is opened for it.
#pragma once
#include "systems/model_calls.hpp"
#include "systems/models/metal_shell/shared/metal_view.hpp"

namespace cullet::metal_shell {

/// The blow dents nothing for good: it is too weak for the sheet to yield. `bounce`: what a sheet gives back of it. It
/// is remembered where it is sure: others like it may follow, and dent together.
bool leaves_nothing(MetalRows rows, const Knock& knock, float& bounce);

/// In which what comes at the same place is more of an impact, s, at least: some frames.
inline constexpr float kLeastSeconds = 0.06f;

/// What else is known of a body's last impact, when a blow like this comes.
struct Earlier {
    bool goes_on = false;    // the blow is more of it
    bool has_shape = false;  // and it has dented
    double energy = 0;       // J
};
Earlier earlier_of(const MetalImpacts& impacts, const Knock& knock);
/// How far from each other touches of one impact may be, m, at least: what is flat touches here and there.
float least_contact(MetalSizes rows, Row<Structures> structure, bool is_round);
/// What yields under a blow, J, at least: a fold as deep as a tenth of the sheet's thickness.
double least_energy(const MetalView& metal);

}  // namespace cullet::metal_shell
