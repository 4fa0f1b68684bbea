// The neighbourhood of a hit that moves.
#pragma once
#include <algorithm>
#include <span>

#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/springs/spring_view.hpp"

namespace cullet {

/// The region of one run, awake: its springs stand.
struct RegionView {
    RunRows& state;
    Row<Tasks> task;
    SpringView springs;
    const ShellView& shell;

    RegionView(RunRows& s, Row<Tasks> t)
        : state(s), task(t), springs(s, s.quick_runs.springs[t]), shell(springs.shell) {}
    RegionView(const RegionView& o) : state(o.state), task(o.task), springs(o.springs), shell(springs.shell) {}

    uint32_t first_row() const { return task * kMostMarkedPacks; }
    uint32_t pack_count() const { return state.hidden_runs.pack_count[task]; }
    /// Row of the pack in MarkedPacks, or kNone.
    uint32_t find(uint32_t pack) const {
        const uint32_t* begin = state.marked_packs.pack.data() + first_row();
        const uint32_t* end = begin + pack_count();
        const uint32_t* at = std::lower_bound(begin, end, pack);
        return at != end && *at == pack ? first_row() + static_cast<uint32_t>(at - begin) : kNone;
    }
    bool is_awake(uint32_t v) const { return has(state.marked_packs.awake, v); }
    bool is_held(uint32_t v) const { return has(state.marked_packs.held, v); }
    /// A vertex that came after the region woke: its pack is in the region or behind all of it, or it stays asleep.
    void add(uint32_t v, bool is_held) const;
    /// Calls f(vertex, is_held) for each vertex of the region, rising.
    template <class F>
    void for_each(F&& f) const {
        const MarkedPacks& packs = state.marked_packs;
        for (uint32_t row = first_row(); row < first_row() + pack_count(); ++row)
            for (uint32_t k = 0; k < kLanes; ++k)
                if ((packs.awake[row] | packs.held[row]) >> k & 1)
                    f(packs.pack[row] * kLanes + k, (packs.held[row] >> k & 1) != 0);
    }
    /// How far the vertex is from where it was, m, body axes.
    Vec3 moved(uint32_t v) const { return springs.position(v) - state.vertices.rest[shell.vertex(v)]; }

 private:
    bool has(const Column<uint8_t>& column, uint32_t v) const {
        const uint32_t row = find(v / kLanes);
        return row != kNone && (column[row] >> (v % kLanes) & 1);
    }
};

/// Of Vertices.copy while a region is chosen.
inline constexpr uint32_t kAsleepMark = kNone, kAwakeMark = kNone - 1, kHeldMark = kNone - 2;

/// Marks the vertices within `rings` edges of those of the task's patches, and the ring round them, in Vertices.copy;
/// all of them where the task has no contact (an explosion). Lists their packs in MarkedPacks: fewer rings where there
/// are more packs than kMostMarkedPacks. Serial.
void choose_region(RunRows& state, Row<Tasks> task, uint32_t rings);

/// Rows for the springs of the elements that have an awake corner, softened, and which edge each is. False: no room,
/// and `full` names the limit. Needs choose_region's marks. Serial.
bool take_region_springs(RunRows& state, Row<Tasks> task, uint32_t layers, const char** full);
/// The chunk of the region that begins with this row of MarkedPacks: kRowsPerChunk packs, and as large a share of the
/// springs. Chunks may be worked on at once, all of them by one call before any by the other.
void measure_region_springs(const RegionView& region, uint32_t first_row);
void lay_region_springs(const RegionView& region, uint32_t first_row);
/// The time step, and what is stiffer than it allows is softened. Serial.
void limit_region_springs(const RegionView& region);

/// Bounds the stiffness of the springs at these vertices and their neighbours by what the time step allows (as B7 does
/// for the hidden run): cuts and new vertices make short edges and light points.
void limit_springs(const RegionView& region, std::span<const uint32_t> vertices);

/// 2 / m times the sum of stiffness at a vertex, the larger of both layers' (B6): omega_max^2 is at most the largest.
double stiffness_ratio(const SpringView& view, uint32_t vertex);

}  // namespace cullet
