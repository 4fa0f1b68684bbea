// Everything that a world remembers, listed once.
#pragma once
#include <string>

#include "components/blows.hpp"
#include "components/limits.hpp"
#include "components/world_rows.hpp"

namespace cullet {

struct TablesOfMaterials {
    Limits limits;
    Materials materials{kMostMaterials};
    MaterialTraits material_traits{kMostMaterials};
    Models models{limits.models};
};
struct TablesOfDebris {
    Limits limits;
    Debris debris{limits.debris};
    DebrisAges debris_ages{limits.debris};
};
/// What waits for its turn.
struct TablesOfBlows {
    Limits limits;
    QueuedHits queued_hits{limits.queued_hits};
    Blows blows{2 * (limits.bodies + limits.queued_hits)};
};
inline constexpr uint32_t kMostWaitingParts = 16 * kMostParts;  // of bodies whose pieces wait for room
inline constexpr uint32_t kMostTouches = 1u << 18;              // four for an edge of a crack
struct TablesOfFragments {
    Limits limits;
    Fragments fragments{limits.tasks * kMostParts + kMostWaitingParts};
    Touches touches{kMostTouches};
};

/// Whoever holds it reaches everything. So systems and their helpers take only the tables that they need, or one of the
/// sets of tables that it stands on. These are WorldRows, SoftRows, BodyRows, RunRows, ShellRows, StructureRows,
/// MaterialRows.
struct State : TablesOfMaterials, WorldRows, TablesOfDebris, TablesOfBlows, TablesOfFragments {
    explicit State(const Limits& limits = {});

    using TablesOfMaterials::materials, TablesOfMaterials::material_traits;

    static constexpr bool kHoldsEveryTable = true;
    /// In the order of the hash and of files.
    using Sets = TypeList<TablesOfMaterials, TablesOfStructures, TablesOfShells, TablesOfMetal, TablesOfBodies,
                          TablesOfSoftBodies, TablesOfDebris, TablesOfRuns, TablesOfLattices, TablesOfBlows,
                          TablesOfParts, TablesOfFragments, TablesOfSolids>;
    /// Calls f(table) for each, in that order.
    template <class F>
    void for_each_table(F&& f) {
        visit(*this, f, Sets{});
    }
    template <class F>
    void for_each_table(F&& f) const {
        visit(*this, f, Sets{});
    }
    /// Calls f(pool) for each table whose rows come in ranges, in that order.
    template <class F>
    void for_each_pool(F&& f) {
        for_each_table(pool_caller(f));
    }
    template <class F>
    void for_each_pool(F&& f) const {
        for_each_table(pool_caller(f));
    }
    /// The table of type T.
    template <class T>
    T& table() {
        return table_in<T>(*this);
    }

    const Limits& limits() const { return TablesOfMaterials::limits; }

    /// Of tables that have rows, and of their pools: what a world does not use leaves its hash alone.
    uint64_t hash() const;
    std::string validate() const;
    std::string first_difference(const State& other) const;

    /// 32 bits of each State column's hash, in the order of the tables and their columns; and then of the pools.
    void digest_columns(std::vector<uint32_t>& out) const;
    /// "vertices.velocity" of the place in that list.
    std::string digested_column(size_t place) const;

 private:
    template <class Self, class F, class... Set>
    static void visit(Self& self, F& f, TypeList<Set...>) {
        (visit_set<Set>(self, f), ...);
    }
    template <class Set, class Self, class F>
    static void visit_set(Self& self, F& f) {
        using Kept = std::conditional_t<std::is_const_v<Self>, const Set, Set>;
        for_each_table_of(static_cast<Kept&>(self), [&f](auto& table) {
            if constexpr (!kIsDerived<decltype(table)>) f(table);
        });
    }
    template <class F>
    static auto pool_caller(F& f) {
        return [&f](auto& table) {
            if constexpr (kIsRanged<decltype(table)>) f(table.pool);
        };
    }
    uint64_t hash_pools(uint64_t seed) const;
};

}  // namespace cullet
