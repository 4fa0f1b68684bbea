// From the hidden state to rigid motions of the parts (thick shell note 6.6).
#pragma once
#include <optional>
#include <span>

#include "components/body_rows.hpp"
#include "components/shell_parts.hpp"
#include "systems/births/settle_momenta.hpp"
#include "systems/structure_calls.hpp"

namespace cullet {

/// Each fragment's mass, momenta and inertia: sums over the vertices of its part, along the body's axes. Parts as
/// group_fragments or find_pieces gave them, all of the shell's in turn. What find_pieces has not listed is summed as a
/// difference. `rest`: how the vertices move that the run of a large body left alone, those of blocks that do not move
/// (VertexBlocks::moves); none: each vertex has its velocity.
void sum_momenta(ShellView shell, Fragments& fragments, Rows<Fragments> of, const std::optional<RestMotion>& rest);

/// The whole hand-off of a shell that came apart: its parts become the only rows of `fragments`, which has room for
/// them.
HandoffReport rigid_handoff(ShellView shell, const HandoffStart& start, std::span<const FragmentPart> parts,
                            Fragments& fragments, Touches& touches, const std::optional<RestMotion>& rest = {});

}  // namespace cullet
