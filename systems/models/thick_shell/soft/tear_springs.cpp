#include <algorithm>

#include "engine/random.hpp"
#include "systems/models/thick_shell/soft/soft_lanes.hpp"
#include "systems/models/thick_shell/soft/split_plane.hpp"
#include "systems/models/thick_shell/soft/systems.hpp"
#include "systems/models/thick_shell/springs/rebuild_springs.hpp"

namespace cullet {
namespace {

// A check, the most stretched first; more and a sheet is gone before it is seen to tear.
constexpr uint32_t kMostSplits = 4;
// Room that a split asks for: springs, and slots for packs that outgrow theirs.
constexpr uint32_t kSplitSprings = 8, kSplitSlots = 96;

constexpr uint64_t kEndSeed = 0x7465617273;

struct Candidate {
    float strain;
    uint32_t spring;
    bool comes_before(const Candidate& other) const {
        return strain != other.strain ? strain > other.strain : spring < other.spring;
    }
};

struct Candidates {
    Candidate list[kMostSplits];
    uint32_t count = 0;
    void add(const Candidate& c) {
        if (count == kMostSplits && !c.comes_before(list[count - 1])) return;
        if (count < kMostSplits) ++count;
        uint32_t at = count - 1;
        for (; at > 0 && c.comes_before(list[at - 1]); --at) list[at] = list[at - 1];
        list[at] = c;
    }
};

bool is_tip(const SpringView& view, uint32_t v) {
    return view.state.vertices.crack[view.shell.vertex(v)] == static_cast<uint8_t>(CrackState::Tip);
}
bool is_pinned(const SpringView& view, uint32_t v) {
    return view.state.vertices.is_pinned[view.shell.vertex(v)];
}

// The end that is a crack's tip, else any (C1); what is pinned holds as long as its neighbour can give way.
uint32_t end_to_split(const SpringView& view, uint32_t spring) {
    const uint32_t row = view.spring(spring), a = view.state.springs.a[row], b = view.state.springs.b[row];
    if (is_pinned(view, a) != is_pinned(view, b)) return is_pinned(view, a) ? b : a;
    if (is_tip(view, a) != is_tip(view, b)) return is_tip(view, a) ? a : b;
    return Random{kEndSeed}.bits(spring, view.state.shells.vertices[view.shell.row].count) & 1 ? a : b;
}

bool has_room(const SpringView& view) {
    const Range springs = view.own().springs[view.row], slots = view.own().slots[view.row];
    return springs.count + kSplitSprings <= springs.capacity && slots.count + kSplitSlots <= slots.capacity;
}

}  // namespace

// C1 of springs: e = |x| / L0 - 1 above the limit, the largest first, ties by row.
void tear_springs(Of<SoftBodies> soft_body, Of<ShellSprings> springs, SoftRows& rows) {
    const SpringView view(rows, springs.row);
    const uint32_t s = soft_body.row;
    const float limit = rows.soft_bodies.break_strain[s];
    Candidates candidates;
    const Range range = view.own().springs[view.row];
    if (!any_above(rows.springs.length.data() + range.first, range.count, limit)) return;
    for (uint32_t i = 0; i < range.count; ++i) {
        const float strain = rows.springs.length[range.first + i];
        if (strain > limit && rows.springs.a[range.first + i] != kNone && rows.springs.can_crack[range.first + i])
            candidates.add({strain, i});
    }
    for (uint32_t k = 0; k < candidates.count; ++k) {
        const uint32_t spring = candidates.list[k].spring, row = view.spring(spring);
        if (!has_room(view)) {
            rows.soft_bodies.lacks_room[s] = 1;
            return;
        }
        const uint32_t a = rows.springs.a[row], b = rows.springs.b[row], v = end_to_split(view, spring);
        const Vec3 normal = normalised(view.position(v == a ? b : a) - view.position(v));
        const PlaneSplit split = split_plane(view, v, normal);
        if (!split.is_done) {
            rows.springs.can_crack[row] = 0;  // of a single element: it goes on stretching
            continue;
        }
        ++rows.soft_bodies.tear_count[s];
        rows.soft_bodies.is_torn[s] = 1;
        const bool is_rebuilt = rebuild_springs(view, {split.touched, split.touched_count});
        CULLET_ASSERT(is_rebuilt, "the springs of soft body %u found no room after a split", s);
        (void)is_rebuilt;
    }
}

}  // namespace cullet
