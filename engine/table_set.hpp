// A set of tables stands on a smaller one, and adds a plain struct of tables of its own:
//
//     struct TablesOfBonds {
//         Limits limits;  // what follows is made of it
//         Bonds bonds{limits.bonds};
//     };
//     struct BondRows : ShellRows, TablesOfBonds {
//         using Below = ShellRows;
//         using Own = TablesOfBonds;  // or a list of such structs
//     };
//
// One line adds a table: what systems reach, files, hash and checks follow from it.
#pragma once
#include "engine/members.hpp"
#include "engine/table.hpp"

namespace cullet {

template <class T>
concept IsTable = std::is_base_of_v<AnyTable, std::remove_cvref_t<T>>;
/// A struct that holds all tables of a world says so.
template <class T>
concept HoldsEveryTable = requires {
    std::remove_cvref_t<T>::kHoldsEveryTable;
};
template <class T>
concept IsTableSet = !HoldsEveryTable<T> && requires {
    typename std::remove_cvref_t<T>::Own;
    typename std::remove_cvref_t<T>::Below;
};
/// A table that is no part of a world's state, since other tables give it, says so.
template <class T>
inline constexpr bool kIsDerived = requires {
    std::remove_cvref_t<T>::kIsDerived;
};

/// Calls f(table) for each table of a plain struct of them, in the order of declaration.
template <class Tables, class F>
constexpr void for_each_table_of(Tables& tables, F&& f) {
    const auto look = [&f](auto member) {
        if constexpr (IsTable<typename decltype(member)::Type>) f(member.held);
    };
    members::visit<members::AnyValue>(tables, [&](auto... member) { (look(member), ...); });
}

namespace table_set {

struct ListTypes {
    template <class... M>
    constexpr TypeList<std::remove_const_t<typename M::Type>...> operator()(M...) const {
        return {};
    }
};
template <class Tables>
using TypesOf = decltype(members::visit<members::AnyValue>(std::declval<Tables&>(), ListTypes{}));

}  // namespace table_set

}  // namespace cullet
