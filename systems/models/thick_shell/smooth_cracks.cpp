// Cracks run along edges of the mesh and zigzag with them. Where they are drawn and collide, one pass of (1/4, 1/2,
// 1/4) along each crack takes most of it away (thick shell note, C6: kinks above 40 degrees 0.095 to 0.004 of all).
// Tips, junctions and rims stay, and so does the shell at rest: masses, stiffness and what later runs see.
#include <algorithm>

#include "components/blows.hpp"
#include "components/shell_groups.hpp"
#include "systems/models/thick_shell/systems.hpp"
#include "systems/structures/shell/cell_elements.hpp"
#include "systems/structures/shell/prism.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

using SmoothedView = ShellIn<SmoothedTables>;

/// Of its area that a face keeps at least, seen along its normal: no shift turns one over.
constexpr float kLeastFace = 0.3f;

/// Cosine of 18 degrees, by which the faces round a vertex may lean from their mean: creases have 40 between two.
constexpr float kCreaseCosine = 0.95f;
/// Of the mean edge: what moves less stays.
constexpr float kLeastShift = 1e-3f;

bool is_crack(const SmoothedView& shell, uint32_t e, uint32_t k) {
    const Elements& elements = shell.state.elements;
    return elements.neighbour[shell.element(e)][k] == kNone &&
           elements.edge_kind[shell.element(e)][k] == static_cast<uint8_t>(EdgeKind::Crack);
}

Vec3 rest_of(const SmoothedView& shell, uint32_t v) {
    return shell.state.vertices.rest[shell.vertex(v)];
}
Vec3 shift_of(const SmoothedView& shell, uint32_t v) {
    return shell.state.vertices.crack_shift[shell.vertex(v)];
}
bool is_moved(const SmoothedView& shell, uint32_t v) {
    const Vec3 shift = shift_of(shell, v);
    return shift.x != 0 || shift.y != 0 || shift.z != 0;
}

/// Where the crack comes from and goes to, seen from one side of it: the ends of both free edges of the vertex's fan.
struct CrackNeighbours {
    Vec3 next, previous;
    bool exist = false;
};
CrackNeighbours crack_neighbours(const SmoothedView& shell, uint32_t v) {
    Ring ring;
    walk_ring(shell, v, ring);
    if (ring.count == 0 || ring.is_closed) return {};
    const uint32_t first = ring.element[0], last = ring.element[ring.count - 1];
    const uint32_t out = ring.corner[0], in = (ring.corner[ring.count - 1] + 2u) % 3;
    if (!is_crack(shell, first, out) || !is_crack(shell, last, in)) return {};
    const auto corner = [&](uint32_t e, uint32_t k) {
        return rest_of(shell, shell.state.elements.corner[shell.element(e)][k % 3]);
    };
    const CrackNeighbours found{corner(first, out + 1), corner(last, in), true};
    return {found.next, found.previous, !(found.next == found.previous)};  // a tip sees one point twice
}

/// Area-weighted normal of the fans of both sides, the same for both, or zero at a crease: no shift follows both faces.
Vec3 surface_normal(const SmoothedView& shell, uint32_t u, uint32_t w) {
    Vec3 sum, normals[2 * kMostRing];
    uint32_t count = 0;
    Ring ring;
    for (const uint32_t v : {u, w}) {
        walk_ring(shell, v, ring);
        for (uint32_t i = 0; i < ring.count; ++i) {
            const auto& corner = shell.state.elements.corner[shell.element(ring.element[i])];
            const Vec3 a = rest_of(shell, corner[0]);
            sum += normals[count++] = cross(rest_of(shell, corner[1]) - a, rest_of(shell, corner[2]) - a);
        }
    }
    const Vec3 mean = normalised(sum);
    for (uint32_t i = 0; i < count; ++i)
        if (dot(normals[i], mean) < kCreaseCosine * length(normals[i])) return {};
    return mean;
}

bool keeps_shape(const SmoothedView& shell, uint32_t v) {
    Ring ring;
    walk_ring(shell, v, ring);
    const auto is_kept = [](const std::array<Vec3, 3>& before, const std::array<Vec3, 3>& after) {
        const Vec3 then = cross(before[1] - before[0], before[2] - before[0]);
        return dot(cross(after[1] - after[0], after[2] - after[0]), then) >= kLeastFace * dot(then, then);
    };
    for (uint32_t i = 0; i < ring.count; ++i) {
        std::array<Vec3, 3> outer, inner, drawn_outer, drawn_inner;
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t row = shell.vertex(shell.state.elements.corner[shell.element(ring.element[i])][k]);
            outer[k] = shell.state.vertices.rest[row], inner[k] = inner_twin(shell.state, row).to_float();
            drawn_outer[k] = smoothed_place(shell.state, row);
            drawn_inner[k] = smoothed_twin(shell.state, row).to_float();
        }
        if (!is_kept(outer, drawn_outer) || !is_kept(inner, drawn_inner)) return false;
    }
    return true;
}

/// The pairs of vertices that are the two sides of one point of a crack, side by side; lives in scratch of the shell.
class CrackPairs {
 public:
    CrackPairs(const SmoothedView& shell, bool is_local)
        : shell_(shell), list_(shell.state.vertices.copy.data() + shell.vertex(0)) {
        const auto add = [&](uint32_t e) {
            if (shell.state.elements.flags[shell.element(e)] & kDead) return;
            for (uint32_t k = 0; k < 3; ++k)
                if (is_crack(shell, e, k)) add_vertex(shell.state.elements.corner[shell.element(e)][k]);
        };
        const uint8_t* const is_stale = shell.state.cells.is_stale.data() + shell.cells().first;
        if (is_local)
            for_each_element_of_cells(
                shell, [&](uint32_t c) { return is_stale[c] != 0; }, add);
        else
            for (uint32_t e = 0; e < shell.element_count(); ++e) add(e);
        sort();
    }

    /// Shifts each pair that has none and lies between the same two points on both sides: more vertices there, or other
    /// neighbours, are a junction. Keeps those pairs.
    void shift() {
        uint32_t kept = 0;
        for (uint32_t i = 0, end = 0; i < count_; i = end) {
            for (end = i + 1; end < count_ && rest_of(shell_, list_[end]) == rest_of(shell_, list_[i]);) ++end;
            if (end - i != 2) continue;
            const uint32_t u = list_[i], w = list_[i + 1];
            if (is_moved(shell_, u) || is_moved(shell_, w)) continue;
            const CrackNeighbours own = crack_neighbours(shell_, u), other = crack_neighbours(shell_, w);
            if (!own.exist || !other.exist || !(own.next == other.previous) || !(own.previous == other.next)) continue;
            const Vec3 normal = surface_normal(shell_, u, w);
            if (normal == Vec3{}) continue;
            const Vec3 along = 0.25f * (own.next + own.previous) - 0.5f * rest_of(shell_, u);
            const Vec3 sideways = along - dot(along, normal) * normal;  // within the surface
            if (!(length(sideways) > kLeastShift * shell_.shells().mean_edge[shell_.row])) continue;
            set(u, w, sideways);
            list_[kept++] = u, list_[kept++] = w;
        }
        count_ = kept;
    }
    /// Takes back what would turn a face over. Each round takes one back, or is the last.
    void keep_faces() {
        for (bool is_done = false; !is_done;) {
            is_done = true;
            for (uint32_t i = 0; i < count_; i += 2) {
                const uint32_t u = list_[i], w = list_[i + 1];
                if (!is_moved(shell_, u) || (keeps_shape(shell_, u) && keeps_shape(shell_, w))) continue;
                set(u, w, {});
                is_done = false;
            }
        }
    }
    /// Hulls and drawn faces of their cells are others now.
    void mark_cells() const {
        const uint32_t first_cell = shell_.cells().first;
        Ring ring;
        for (uint32_t i = 0; i < count_; ++i) {
            if (!is_moved(shell_, list_[i])) continue;
            walk_ring(shell_, list_[i], ring);
            for (uint32_t k = 0; k < ring.count; ++k)
                shell_.state.cells.is_stale[first_cell + shell_.state.elements.cell[shell_.element(ring.element[k])]] =
                    1;
        }
    }

 private:
    /// A vertex has one fan, and so at most one free edge that begins at it.
    void add_vertex(uint32_t v) {
        CULLET_ASSERT(count_ < shell_.vertex_count(), "vertex %u begins two free edges", v);
        list_[count_++] = v;
    }
    void sort() {
        std::sort(list_, list_ + count_, [&](uint32_t a, uint32_t b) {
            const Vec3 p = rest_of(shell_, a), q = rest_of(shell_, b);
            if (p.x != q.x) return p.x < q.x;
            if (p.y != q.y) return p.y < q.y;
            return p.z != q.z ? p.z < q.z : a < b;
        });
    }
    void set(uint32_t u, uint32_t w, Vec3 shift) const {
        for (const uint32_t v : {u, w}) shell_.state.vertices.crack_shift.set(shell_.vertex(v), shift);
    }

    const SmoothedView& shell_;
    uint32_t* list_;
    uint32_t count_ = 0;
};

}  // namespace

// What the game cut stays as straight, or as sharp, as it said.
void smooth_cracks(EachOwn<TaskEnded> ended, SmoothedTables rows, const Tasks& tasks, const Blows& blows) {
    const Row<Tasks> task = ended->task;
    if (static_cast<TaskState>(tasks.state[task]) == TaskState::Dropped || tasks.crack_count[task] == 0) return;
    if (is_cut_task(blows, task)) return;
    const SmoothedView shell(rows, tasks.working[task]);
    CrackPairs pairs(shell, tasks.working[task] == tasks.source[task]);
    pairs.shift();
    pairs.keep_faces();
    pairs.mark_cells();
}

}  // namespace cullet
