// The hand-off of a broken shell, for who wants motions as values.
#pragma once
#include <vector>

#include "systems/births/part_motion.hpp"
#include "systems/structures/shell/rigid_handoff.hpp"

namespace cullet::test {

/// As rigid_handoff, into a motion a part. `touches` are those that `start` names.
inline HandoffReport hand_off(ShellView shell, const HandoffStart& start, std::span<const FragmentPart> parts,
                              std::vector<PartMotion>& motions, const std::optional<RestMotion>& rest = {},
                              Touches* touches = nullptr) {
    Fragments fragments(static_cast<uint32_t>(parts.size()));
    Touches none(1);
    const HandoffReport report = rigid_handoff(shell, start, parts, fragments, touches ? *touches : none, rest);
    motions.clear();
    for (uint32_t p = 0; p < parts.size(); ++p) motions.push_back(motion_of(fragments, p));
    return report;
}

}  // namespace cullet::test
