#include "components/state.hpp"

namespace cullet {
namespace {

// All that tasks may come apart into, and more for bodies without a task whose pieces wait for room.
constexpr uint32_t kMostWaitingParts = 16 * kMostParts;
uint32_t fragment_limit(const Limits& l) {
    return l.tasks * kMostParts + kMostWaitingParts;
}
// Four for an edge of a crack.
constexpr uint32_t kMostTouches = 1u << 18;

}  // namespace

State::State(const Limits& l)
    : SoftRows(l, MaterialRows{materials, material_traits}),
      materials(kMostMaterials),
      material_traits(kMostMaterials),
      models(l.models),
      debris(l.debris),
      queued_hits(l.queued_hits),
      fragments(fragment_limit(l)),
      touches(kMostTouches),
      blows(2 * (l.bodies + l.queued_hits)),
      debris_ages(l.debris),
      limits_(l) {
    queued_hits.append(l.queued_hits);
}

uint64_t State::hash() const {
    uint64_t hash = 0;
    const auto add = [&](const auto& table) {
        if (table.size() > 0) hash = table.hash(hash);
    };
    std::apply([&](auto... table) { (add(this->*table), ...); }, tables());
    return hash_pools(hash);
}

// A table grows to what its pool hands out: where no row was ever taken the pool is as new.
uint64_t State::hash_pools(uint64_t hash) const {
    const auto add = [&](const auto& table) {
        if constexpr (requires { table.pool; })
            if (table.size() > 0) hash = table.pool.hash(hash);
    };
    std::apply([&](auto... table) { (add(this->*table), ...); }, tables());
    return hash;
}

namespace {

template <class F>
void for_each_kept_column(const State& state, F&& f) {
    const auto columns_of = [&](const AnyTable& table) {
        for (const ColumnInfo& c : table.columns())
            if (c.is_state()) f(table, c);
    };
    std::apply([&](auto... table) { (columns_of(state.*table), ...); }, State::tables());
}

}  // namespace

void State::digest_columns(std::vector<uint32_t>& out) const {
    out.clear();
    for_each_kept_column(*this, [&](const AnyTable& table, const ColumnInfo& c) {
        uint64_t hash = table.size();
        for (int a = 0; a < c.lanes * c.sides; ++a)
            hash = hash_bytes(table.column_memory(c, a), size_t{table.size()} * c.row_bytes, hash);
        out.push_back(static_cast<uint32_t>(hash));
    });
    out.push_back(static_cast<uint32_t>(hash_pools(0)));
}

std::string State::digested_column(size_t place) const {
    std::string name = "the rows that are taken";
    for_each_kept_column(*this, [&](const AnyTable& table, const ColumnInfo& c) {
        if (place-- == 0) name = std::string(table.name()) + "." + c.name;
    });
    return name;
}

std::string State::validate() const {
    std::string found;
    std::apply([&](auto... table) { ((found.empty() ? (void)(found = (this->*table).validate()) : void()), ...); },
               tables());
    return found;
}

std::string State::first_difference(const State& other) const {
    std::string found;
    std::apply(
        [&](auto... table) {
            ((found.empty() ? (void)(found = (this->*table).first_difference(other.*table)) : void()), ...);
        },
        tables());
    return found;
}

}  // namespace cullet
