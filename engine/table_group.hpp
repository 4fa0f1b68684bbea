// A group is a plain struct of references to tables, or to other things that a world has, that systems and their helpers
// take together, as one parameter:
//
//     struct TaskRuns {
//         Tasks& tasks;
//         TaskContacts& contacts;
//         const Blows& blows;  // read only
//     };
//     void start_tasks(Each<TaskOpened> opened, ShellMesh mesh, TaskRuns runs);
//
// narrow<Smaller>(larger, ...) gives a helper less, and never more: what the arguments do not hold, or hold as const, does
// not compile. So the parameters of a function are all that it reaches.
#pragma once
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace cullet {

template <class... T>
struct TypeList {};

namespace group {

inline constexpr int kMostMembers = 12;

/// Becomes a reference to anything: members are counted with it.
struct Anything {
    template <class T>
    operator T&() const;
};
template <class G, class... Given>
constexpr int member_count() {
    if constexpr (sizeof...(Given) > kMostMembers)
        return 0;
    else if constexpr (requires { G{Given{}...}; } && !requires { G{Given{}..., Anything{}}; })
        return static_cast<int>(sizeof...(Given));
    else
        return member_count<G, Given..., Anything>();
}

/// A member, with its type as the group declares it.
template <class Declared>
struct Member {
    using Type = Declared;
    std::remove_reference_t<Declared>& held;
};

/// f(Member<..>...), in the order of declaration.
template <class G, class F>
constexpr decltype(auto) visit(G& g, F&& f) {
    constexpr int count = member_count<std::remove_const_t<G>>();
    static_assert(count > 0, "a group is a plain struct of 1 to 12 references");
// clang-format off
#define OF(m) Member<decltype(m)>{m}
    if constexpr (count == 1) { auto& [a] = g; return f(OF(a)); }
    else if constexpr (count == 2) { auto& [a, b] = g; return f(OF(a), OF(b)); }
    else if constexpr (count == 3) { auto& [a, b, c] = g; return f(OF(a), OF(b), OF(c)); }
    else if constexpr (count == 4) { auto& [a, b, c, d] = g; return f(OF(a), OF(b), OF(c), OF(d)); }
    else if constexpr (count == 5) { auto& [a, b, c, d, e] = g; return f(OF(a), OF(b), OF(c), OF(d), OF(e)); }
    else if constexpr (count == 6) { auto& [a, b, c, d, e, h] = g; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h)); }
    else if constexpr (count == 7) { auto& [a, b, c, d, e, h, i] = g; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i)); }
    else if constexpr (count == 8) { auto& [a, b, c, d, e, h, i, j] = g; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j)); }
    else if constexpr (count == 9) { auto& [a, b, c, d, e, h, i, j, k] = g; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k)); }
    else if constexpr (count == 10) { auto& [a, b, c, d, e, h, i, j, k, l] = g; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k), OF(l)); }
    else if constexpr (count == 11) { auto& [a, b, c, d, e, h, i, j, k, l, m] = g; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k), OF(l), OF(m)); }
    else { auto& [a, b, c, d, e, h, i, j, k, l, m, n] = g; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k), OF(l), OF(m), OF(n)); }
#undef OF
    // clang-format on
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

template <class... T>
constexpr bool are_references(TypeList<T...>) {
    return (... && std::is_lvalue_reference_v<T>);
}
template <class T>
constexpr bool is_group() {
    if constexpr (!std::is_class_v<T> || !std::is_aggregate_v<T> || std::is_empty_v<T>)
        return false;
    else if constexpr (member_count<T>() == 0)
        return false;
    else
        return are_references(MembersOf<T>{});
}

}  // namespace group

/// A plain struct of references and nothing else.
template <class T>
concept IsGroup = group::is_group<T>();

namespace group {

/// The references that a parameter brings: a group's members, or the parameter.
template <class T>
struct References {
    using Type = TypeList<T>;
};
template <IsGroup T>
struct References<T> {
    using Type = MembersOf<T>;
};

template <class Wanted, class Held>
inline constexpr bool kGives = std::is_same_v<std::remove_const_t<Wanted>, std::remove_const_t<Held>> &&
                               (std::is_const_v<Wanted> || !std::is_const_v<Held>);
template <class Wanted, class... T>
constexpr bool has(TypeList<T...>) {
    return (... || kGives<Wanted, std::remove_reference_t<T>>);
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

/// Becomes the reference that a member of a narrower group asks for.
template <class... Given>
struct Picker {
    std::tuple<Given&...> given;
    template <class Wanted>
    requires(... || (IsGroup<std::remove_const_t<Given>>
                         ? has<Wanted>(typename References<std::remove_const_t<Given>>::Type{})
                         : kGives<Wanted, Given>)) operator Wanted&() const {
        return std::apply(
            [](Given&... one) -> Wanted& {
                Wanted* found = nullptr;
                ((found = found ? found : find<Wanted>(one)), ...);
                return *found;
            },
            given);
    }
};

template <class Smaller, class P, std::size_t... n>
constexpr Smaller pick(const P& picker, std::index_sequence<n...>) {
    return Smaller{((void)n, picker)...};
}

}  // namespace group

/// The group `Smaller` out of groups and tables that hold all that it asks for.
template <IsGroup Smaller, class... Given>
constexpr Smaller narrow(Given&&... given) {
    const group::Picker<std::remove_reference_t<Given>...> picker{{given...}};
    return group::pick<Smaller>(picker, std::make_index_sequence<group::member_count<Smaller>()>());
}
/// Whether that compiles.
template <class Smaller, class... Given>
concept NarrowsTo = IsGroup<Smaller> && []<class... Wanted>(TypeList<Wanted...>) {
    return (... && std::is_convertible_v<group::Picker<std::remove_reference_t<Given>...>, Wanted>);
}(group::MembersOf<Smaller>{});

}  // namespace cullet
