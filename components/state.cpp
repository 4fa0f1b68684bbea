#include "components/state.hpp"

namespace cullet {

State::State(const Limits& l)
    : TablesOfMaterials{l},
      WorldRows(l, MaterialRows{materials, material_traits}),
      TablesOfDebris{l},
      TablesOfBlows{l},
      TablesOfFragments{l} {
    queued_hits.append(l.queued_hits);
}

uint64_t State::hash() const {
    uint64_t hash = 0;
    for_each_table([&](const AnyTable& table) {
        if (table.size() > 0) hash = table.hash(hash);
    });
    return hash_pools(hash);
}

// A table grows to what its pool hands out: where no row was ever taken the pool is as new.
uint64_t State::hash_pools(uint64_t hash) const {
    for_each_table([&](const auto& table) {
        if constexpr (kIsRanged<decltype(table)>)
            if (table.size() > 0) hash = table.pool.hash(hash);
    });
    return hash;
}

namespace {

template <class F>
void for_each_kept_column(const State& state, F&& f) {
    state.for_each_table([&](const AnyTable& table) {
        for (const ColumnInfo& c : table.columns())
            if (c.is_state()) f(table, c);
    });
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
    for_each_table([&](const AnyTable& table) {
        if (found.empty()) found = table.validate();
    });
    return found;
}

std::string State::first_difference(const State& other) const {
    std::vector<const AnyTable*> theirs;
    other.for_each_table([&](const AnyTable& table) { theirs.push_back(&table); });
    std::string found;
    size_t k = 0;
    for_each_table([&](const AnyTable& table) {
        const AnyTable& there = *theirs[k++];
        if (found.empty()) found = table.first_difference(there);
    });
    return found;
}

}  // namespace cullet
