// Everything that a world remembers, listed once.
#pragma once
#include <string>
#include <tuple>

#include "components/blows.hpp"
#include "components/body_rows.hpp"
#include "components/limits.hpp"

namespace cullet {

/// Whoever holds it reaches everything. So systems and their helpers take only the tables that they need, or one of the
/// sets of tables that it stands on: SoftRows, BodyRows, RunRows, ShellRows, MaterialRows.
struct State : SoftRows {
    explicit State(const Limits& limits = {});

    Materials materials;
    MaterialTraits material_traits;
    Models models;
    Debris debris;
    QueuedHits queued_hits;
    Fragments fragments;
    Blows blows;
    DebrisAges debris_ages;

    /// In the order of the hash and of files.
    static constexpr auto tables() {
        return list(&State::materials, &State::models, &State::bodies, &State::debris, &State::shells, &State::vertices,
                    &State::elements, &State::triangle_springs, &State::hinges, &State::stiffness_packs,
                    &State::stiffness_blocks, &State::stiffness_links, &State::cells, &State::hull_points,
                    &State::tasks, &State::task_contacts, &State::patch_vertices, &State::queued_hits,
                    &State::fragments, &State::view_vertices, &State::view_indices, &State::material_traits,
                    &State::blows, &State::shell_springs, &State::springs, &State::layer_springs,
                    &State::element_springs, &State::spring_packs, &State::spring_slots, &State::layer_slots,
                    &State::twins, &State::quick_bodies, &State::quick_runs, &State::awake_packs, &State::region_rests,
                    &State::soft_bodies, &State::soft_strikers, &State::soft_contacts, &State::fragment_ages,
                    &State::debris_ages, &State::pin_boxes);
    }
    const Limits& limits() const { return limits_; }
    /// The table of type T.
    template <class T>
    T& table() {
        constexpr T State::*member = std::get<T State::*>(tables());
        return this->*member;
    }

    uint64_t hash() const;
    std::string validate() const;
    std::string first_difference(const State& other) const;

    /// 32 bits of each State column's hash, in the order of tables() and their columns; and then of the pools.
    void digest_columns(std::vector<uint32_t>& out) const;
    /// "vertices.velocity" of the place in that list.
    std::string digested_column(size_t place) const;

    /// Of the tables whose rows come in ranges, in the order of the hash and of files. Those of springs come last,
    /// since they do not enter the hash while no shell has springs.
    auto pools() { return pools_of<RangePool>(*this, tables()); }
    auto pools() const { return pools_of<const RangePool>(*this, tables()); }
    static constexpr size_t first_spring_pool() {
        const auto is_always_there = []<class T>(T State::*) {
            return kIsRanged<T> && !requires {
                T::kIsOptional;
            };
        };
        return std::apply([&](auto... table) { return (size_t{0} + ... + size_t{is_always_there(table)}); }, tables());
    }

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
