// Tables that a function is given, each as a member under its own name, and nothing else of the world:
//
//     using ShellMesh = Tables<const Structures, const Shells, Vertices, Elements>;
//     void lift(ShellMesh mesh, uint32_t v) { mesh.vertices.depth[v] += 1; }
//
// A table that stands there as const is read only. They are made of whatever has members of these names: a set of
// tables, a longer list, or several of those. So a larger list is passed where a smaller one is wanted, and what the
// larger one lacks, or may only read, does not compile.
#pragma once
#include <concepts>
#include <type_traits>

#include "engine/members.hpp"

namespace cullet {

/// Says under which name a table, or a thing that stands beside tables, is a member of what has it.
#define CULLET_NAMED(member_name)                                                                         \
    template <class Self>                                                                                 \
    struct Named {                                                                                        \
        Self& member_name;                                                                                \
        static constexpr auto of(auto& rows) -> decltype((rows.member_name)) { return rows.member_name; } \
    }

/// What lies beside tables for any thread to work in, and tells nobody anything, says so.
template <class T>
concept IsWorkingMemory = requires {
    std::remove_cvref_t<T>::kIsWorkingMemory;
};

namespace tables {

template <class T>
using Member = typename std::remove_const_t<T>::template Named<T>;

/// Whether `Given` is a T itself, or a set that stands on it, or has one.
template <class T, class Given>
concept Is = std::derived_from<std::remove_const_t<Given>, std::remove_const_t<T>> && std::convertible_to<Given&, T&>;
template <class T, class Given>
concept Has = !Is<T, Given> && requires(Given & given) {
    { Member<T>::of(given) } -> std::convertible_to<T&>;
};
template <class T, class Given>
concept Gives = Is<T, Given> || Has<T, Given>;

/// The T of the first that has one.
template <class T, class First, class... Rest>
constexpr T& pick(First& first, Rest&... rest) {
    if constexpr (Is<T, First>)
        return first;
    else if constexpr (Has<T, First>)
        return Member<T>::of(first);
    else
        return pick<T>(rest...);
}
template <class T, class... Given>
concept GivenBy = (... || Gives<T, Given>);

}  // namespace tables

template <class... T>
struct Tables : tables::Member<T>... {
    template <class... Given>
    requires(sizeof...(Given) > 0 &&
             (... && tables::GivenBy<T, std::remove_reference_t<Given>...>)) constexpr Tables(Given&&... given)
        : tables::Member<T>{tables::pick<T>(given...)}... {}
};

template <class T>
inline constexpr bool kIsTables = false;
template <class... T>
inline constexpr bool kIsTables<Tables<T...>> = true;

namespace tables {

// To lists of lists: what stands in several of them is there once, and may be written if one of them may.
template <class List, class... T>
struct Add;
template <class... Had>
struct Add<TypeList<Had...>> {
    using Type = Tables<Had...>;
};
template <class T, class... Had>
using Put = std::conditional_t<
    (... || (std::is_same_v<Had, T> || std::is_same_v<Had, std::remove_const_t<T>>)), TypeList<Had...>,
    std::conditional_t<(... || std::is_same_v<Had, const T>),
                       TypeList<std::conditional_t<std::is_same_v<Had, const T>, T, Had>...>, TypeList<Had..., T>>>;
template <class... Had, class T, class... Rest>
struct Add<TypeList<Had...>, T, Rest...> : Add<Put<T, Had...>, Rest...> {};
template <class... Had, class... T, class... Rest>
struct Add<TypeList<Had...>, Tables<T...>, Rest...> : Add<TypeList<Had...>, T..., Rest...> {};

template <class List>
struct Reading;
template <class... T>
struct Reading<Tables<T...>> {
    using Type = Tables<std::conditional_t<IsWorkingMemory<T>, T, const T>...>;
};

}  // namespace tables

/// The table of type T in a set or a list; const where it is there to be read only.
template <class T>
constexpr auto& table_in(auto& rows) {
    return tables::Member<T>::of(rows);
}

/// All of some lists and single tables.
template <class... Part>
using All = typename tables::Add<TypeList<>, Part...>::Type;
/// The same tables, to read only.
template <class List>
using Read = typename tables::Reading<List>::Type;

}  // namespace cullet
