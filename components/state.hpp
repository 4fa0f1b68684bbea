// Everything that a world remembers, listed once.
#pragma once
#include <string>
#include <tuple>

#include "components/blows.hpp"
#include "components/body_rows.hpp"
#include "components/limits.hpp"

namespace cullet {

/// Whoever holds it reaches everything. So systems and their helpers take only the tables that they need, or one of the
/// sets of tables that it stands on: SoftRows, BodyRows, RunRows, ShellRows, StructureRows, MaterialRows.
struct State : SoftRows {
    explicit State(const Limits& limits = {});

    Materials materials;
    MaterialTraits material_traits;
    Models models;
    Debris debris;
    QueuedHits queued_hits;
    Fragments fragments;
    Touches touches;
    Blows blows;
    DebrisAges debris_ages;

    /// In the order of the hash and of files.
    static constexpr auto tables() {
        return list(&State::materials, &State::material_traits, &State::models, &State::structures, &State::cells,
                    &State::hull_points, &State::shells, &State::vertices, &State::elements, &State::triangle_springs,
                    &State::hinges, &State::stiffness_packs, &State::stiffness_blocks, &State::stiffness_links,
                    &State::shell_springs, &State::springs, &State::layer_springs, &State::element_springs,
                    &State::spring_packs, &State::spring_slots, &State::layer_slots, &State::twins, &State::bodies,
                    &State::pin_boxes, &State::fragment_ages, &State::view_vertices, &State::view_indices,
                    &State::quick_bodies, &State::soft_bodies, &State::soft_strikers, &State::soft_contacts,
                    &State::debris, &State::debris_ages, &State::tasks, &State::task_contacts, &State::patch_vertices,
                    &State::hidden_runs, &State::marked_packs, &State::quick_runs, &State::region_rests,
                    &State::queued_hits, &State::blows, &State::shell_parts, &State::fragments, &State::touches);
    }
    const Limits& limits() const { return limits_; }
    /// The table of type T.
    template <class T>
    T& table() {
        constexpr T State::*member = std::get<T State::*>(tables());
        return this->*member;
    }

    /// Of tables that have rows, and of their pools: what a world does not use leaves its hash alone.
    uint64_t hash() const;
    std::string validate() const;
    std::string first_difference(const State& other) const;

    /// 32 bits of each State column's hash, in the order of tables() and their columns; and then of the pools.
    void digest_columns(std::vector<uint32_t>& out) const;
    /// "vertices.velocity" of the place in that list.
    std::string digested_column(size_t place) const;

    /// Of the tables whose rows come in ranges, in the order of the hash and of files.
    auto pools() { return pools_of<RangePool>(*this, tables()); }
    auto pools() const { return pools_of<const RangePool>(*this, tables()); }

 private:
    /// Members of the sets as members of this.
    template <class... T, class... Set>
    static constexpr std::tuple<T State::*...> list(T Set::*... members) {
        return {members...};
    }
    uint64_t hash_pools(uint64_t seed) const;
    Limits limits_;
};

}  // namespace cullet
