// A group is a plain struct of references to tables, or to other things that a world has, or of smaller groups, that
// systems and their helpers take together, as one parameter:
//
//     struct TaskRuns {
//         Tasks& tasks;
//         TaskContacts& contacts;
//         const Blows& blows;  // read only
//     };
//     void start_tasks(Each<TaskOpened> opened, ShellMesh mesh, TaskRuns runs);
//
// A list of tables (tables.hpp) is a group, too, and grows narrow by itself where a smaller one is wanted.
//
// narrow<Smaller>(larger, ...) gives a helper less, and never more: what the arguments do not hold, or hold as const,
// does not compile. So the parameters of a function are all that it reaches.
#pragma once
#include <type_traits>
#include <utility>

#include "engine/members.hpp"
#include "engine/tables.hpp"

namespace cullet {

namespace group {

/// f(Member<..>...), in the order of declaration.
template <class G, class F>
requires(!kIsTables<std::remove_const_t<G>>) constexpr decltype(auto) visit(G& g, F&& f) {
    return members::visit<members::AnyReference>(g, std::forward<F>(f));
}
template <class... T, class F>
constexpr decltype(auto) visit(const Tables<T...>& of, F&& f) {
    return f(members::Member<T&>{tables::Member<T>::of(of)}...);
}
struct ListTypes {
    template <class... M>
    constexpr TypeList<typename M::Type...> operator()(M...) const {
        return {};
    }
};
/// TypeList<Tasks&, TaskContacts&, const Blows&>
template <class G>
using MembersOf = decltype(visit(std::declval<G&>(), ListTypes{}));

template <class T>
constexpr bool is_group();
/// A struct that holds all tables of a world is none of its tables: who holds it reaches everything.
template <class T>
concept IsWholeState = requires {
    std::remove_cvref_t<T>::kHoldsEveryTable;
};
template <class... T>
constexpr bool are_references_or_groups(TypeList<T...>) {
    return (... && ((std::is_lvalue_reference_v<T> && !IsWholeState<T>) || is_group<T>()));
}
template <class T>
constexpr bool is_group() {
    if constexpr (kIsTables<std::remove_const_t<T>>)
        return true;
    else if constexpr (!std::is_class_v<T> || !std::is_aggregate_v<T> || std::is_empty_v<T>)
        return false;
    else if constexpr (members::count_of<T, members::AnyReference>() == 0)
        return false;
    else
        return are_references_or_groups(MembersOf<T>{});
}

}  // namespace group

/// A plain struct of references, or of such structs, and nothing else.
template <class T>
concept IsGroup = group::is_group<T>();

namespace group {

/// Whether one thing may be handed on as another: the same type, and const only where const is asked for.
template <class Wanted, class Held>
inline constexpr bool kGives = std::is_same_v<std::remove_const_t<Wanted>, std::remove_const_t<Held>> &&
                               (std::is_const_v<Wanted> || !std::is_const_v<Held>);

/// Whether `Given`, a table or a group, holds what is wanted: a table, or all of a group.
template <class Wanted, class... Given>
constexpr bool holds();
template <class Wanted, class... M>
constexpr bool holds_any(TypeList<M...>) {
    return (... || holds<Wanted, std::remove_reference_t<M>>());
}
template <class... M, class... Given>
constexpr bool holds_all(TypeList<M...>, TypeList<Given...>) {
    return (... && holds<std::remove_reference_t<M>, Given...>());
}
template <class Wanted, class... Given>
constexpr bool holds() {
    if constexpr (IsGroup<std::remove_const_t<Wanted>>)
        return holds_all(MembersOf<std::remove_const_t<Wanted>>{}, TypeList<Given...>{});
    else if constexpr (sizeof...(Given) > 1)
        return (... || holds<Wanted, Given>());
    else
        return (... || []<class G>(TypeList<G>) {
            if constexpr (IsGroup<std::remove_const_t<G>>)
                return holds_any<Wanted>(MembersOf<std::remove_const_t<G>>{});
            else
                return kGives<Wanted, G>;
        }(TypeList<Given>{}));
}

/// Where a table lies in what is given; null: nowhere.
template <class Wanted, class Given>
constexpr Wanted* find(Given& given) {
    if constexpr (IsGroup<std::remove_const_t<Given>>)
        return visit(given, [](auto... member) {
            Wanted* found = nullptr;
            ((found = found ? found : find<Wanted>(member.held)), ...);
            return found;
        });
    else if constexpr (kGives<Wanted, Given>)
        return &given;
    else
        return nullptr;
}

template <class G, class... M, class... Given>
constexpr G make(TypeList<M...>, Given&... given);
/// A member of a narrower group, by its declared type.
template <class M, class... Given>
constexpr M pick(Given&... given) {
    if constexpr (std::is_lvalue_reference_v<M>) {
        using Wanted = std::remove_reference_t<M>;
        Wanted* found = nullptr;
        ((found = found ? found : find<Wanted>(given)), ...);
        return *found;
    } else {
        return make<M>(MembersOf<M>{}, given...);
    }
}
template <class G, class... M, class... Given>
constexpr G make(TypeList<M...>, Given&... given) {
    return G{pick<M>(given...)...};
}

}  // namespace group

/// Whether tables and groups hold all that the group `Smaller` asks for.
template <class Smaller, class... Given>
concept NarrowsTo = IsGroup<Smaller> && group::holds<Smaller, std::remove_reference_t<Given>...>();

/// The group `Smaller`, out of tables and groups.
template <IsGroup Smaller, class... Given>
requires NarrowsTo<Smaller, Given...>
constexpr Smaller narrow(Given&&... given) {
    return group::make<Smaller>(group::MembersOf<Smaller>{}, given...);
}

}  // namespace cullet
