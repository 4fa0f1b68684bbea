// What comes off a sheet that tears, and how it moves.
#pragma once
#include <span>

#include "components/metal_rows.hpp"

namespace cullet {

/// Before a tear: which part of the shell each element is of (Elements.copy), as its inserted ones will be. What hangs
/// together by nothing but the body stays together.
void number_parts(const ShellView& shell, std::span<FragmentPart> parts);
/// After it: what came off a part is one by itself, the largest of each part stays with the body, which comes first.
/// Returns how many there are; elements are numbered and listed.
uint32_t find_torn(const ShellView& shell, std::span<FragmentPart> parts);

/// Something went through the sheet, body axes.
struct Punch {
    Vec3d point, push;         // m; unit
    double impulse = 0;        // N s, on the body
    double striker_speed = 0;  // m/s along the push, afterwards
};
/// Velocities of the working copy's vertices: the body's, and what the impulse gives it; what has come off at `vertex`
/// goes on with the striker.
void move_torn(MetalRows rows, Row<Tasks> task, uint32_t vertex, const Punch& punch);

}  // namespace cullet
