// Opens edges from one vertex and gives every fan its vertex.
#pragma once
#include "systems/structures/shell/mesh_quality.hpp"
#include "systems/structures/shell/touched.hpp"

namespace cullet {

/// Edges from one vertex that are opened together.
struct Ends {
    uint32_t count = 0;
    uint32_t end[kMostArms];      // vertices at the other ends, each once
    bool is_interior[kMostArms];  // written by cut_ends: the end was interior, and is where a crack ends now
    bool add(uint32_t v) {
        for (uint32_t i = 0; i < count; ++i)
            if (end[i] == v) return false;
        if (count == kMostArms) return false;
        end[count++] = v;
        return true;
    }
};

enum class CutOutcome : uint8_t { Cut, Impossible, Full };

/// Cuts the interior edges (vertex, end) and splits the vertex, and each end that lay on a border or a crack, into one
/// vertex a fan (thick shell note C3, recommended form). All or nothing: Impossible when an edge is not interior, when
/// an interior vertex would get fewer than two cuts, or a ring is too large; Full when the copies have no room. Vertex,
/// copies and such ends become Cracked; interior ends are left to the caller, who knows the heading.
/// dV - dE: -1 for two cuts at an interior vertex with interior ends, 0 for one cut at a border vertex or tip, and +1
/// for every end that lay on a border.
CutOutcome cut_ends(ShellView shell, uint32_t vertex, Ends& ends, Touched& touched);

}  // namespace cullet
