// What every substep of a soft body looks at, eight lanes at once: which few of its vertices and springs need more.
#pragma once
#include "components/soft.hpp"
#include "engine/math.hpp"

namespace cullet {

/// Where a striker stands in this substep.
struct StrikerPlace {
    Vec3 centre;
    Quat turn;  // since the frame began
    bool is_ball = false;
    float radius = 0;
};
/// Fills `inside` of each of the rows, all of one striker, from the vertices' places.
void mark_inside(SoftContact* contacts, uint32_t count, const Float4* places, const StrikerPlace& striker);

/// Springs of a shell, from its first on.
struct StrainLook {
    const uint32_t *a, *b;        // kNone: a row that is not used
    const float *rest, *plastic;  // m
    const float* inner_plastic;   // null: one layer
    const Float4 *outer, *inner;  // places of the shell's points
    float* strain;                // out: against the cooked length; of what is found it is not final
    float yield, most;            // strains: of the plastic length, of the cooked one
};
/// Writes the strain of springs [first, first + count), count at most kMostLooked, and lists those that are strained
/// beyond yield in any layer, beyond `most`, or in no row of eight: the caller looks at these closely. Returns how
/// many.
inline constexpr uint32_t kMostLooked = 512;
uint32_t find_strained(const StrainLook& look, uint32_t first, uint32_t count, uint32_t* found);

/// Whether any of the numbers is above the limit.
bool any_above(const float* numbers, uint32_t count, float limit);

}  // namespace cullet
