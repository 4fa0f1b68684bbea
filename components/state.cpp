#include "components/state.hpp"

namespace cullet {

State::State(const Limits& l)
    : SoftRows(l, MaterialRows{materials, material_traits}),
      materials(kMostMaterials),
      material_traits(kMostMaterials),
      models(l.models),
      debris(l.debris),
      queued_hits(l.queued_hits),
      fragments((l.tasks + 1) * kMostParts),
      blows(2 * (l.bodies + l.queued_hits)),
      debris_ages(l.debris),
      limits_(l) {
    queued_hits.append(l.queued_hits);
    fragments.append((l.tasks + 1) * kMostParts);
}

namespace {

// A table that says kIsOptional counts only while it has rows: what came later leaves older scenes their hash.
template <class T>
uint64_t hash_of(const T& table, uint64_t hash) {
    if constexpr (requires { T::kIsOptional; })
        if (table.size() == 0) return hash;
    return table.hash(hash);
}

}  // namespace

uint64_t State::hash() const {
    uint64_t hash = 0;
    std::apply([&](auto... table) { ((hash = hash_of(this->*table, hash)), ...); }, tables());
    return hash_pools(hash);
}

// A table grows to what its pool hands out: where no row was ever taken the pool is as new.
uint64_t State::hash_pools(uint64_t hash) const {
    const auto all = pools();
    for (size_t k = 0; k < all.size(); ++k)
        if (k < first_spring_pool() || shell_springs.size() > 0) hash = all[k]->hash(hash);
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
