// The members of a plain struct as a list. What a group or a set of tables holds follows from its declarations alone.
#pragma once
#include <type_traits>
#include <utility>

namespace cullet {

template <class... T>
struct TypeList {};

namespace members {

inline constexpr int kMost = 20;

/// Becomes a reference to anything: members that are references are counted with it.
struct AnyReference {
    template <class T>
    operator T&() const;
};
/// Becomes anything, also what can be neither copied nor moved: members that are values are counted with it.
struct AnyValue {
    template <class T>
    operator T() const;
};
/// How many there are; 0: more than kMost, or they are not made of `Any`.
template <class Struct, class Any, class... Given>
constexpr int count_of() {
    if constexpr (sizeof...(Given) > kMost)
        return 0;
    else if constexpr (
        requires { Struct{Given{}...}; } &&
        !requires {
            Struct{Given{}..., Any{}};
        })
        return static_cast<int>(sizeof...(Given));
    else
        return count_of<Struct, Any, Given..., Any>();
}

/// A member, with its type as the struct declares it.
template <class Declared>
struct Member {
    using Type = Declared;
    std::remove_reference_t<Declared>& held;
};

/// f(Member<..>...), in the order of declaration.
template <class Any, class Struct, class F>
constexpr decltype(auto) visit(Struct& of, F&& f) {
    constexpr int count = count_of<std::remove_const_t<Struct>, Any>();
    static_assert(count > 0, "a plain struct of 1 to 20 members is wanted here");
// clang-format off
#define OF(m) Member<decltype(m)>{m}
    if constexpr (count == 1) { auto& [a] = of; return f(OF(a)); }
    else if constexpr (count == 2) { auto& [a, b] = of; return f(OF(a), OF(b)); }
    else if constexpr (count == 3) { auto& [a, b, c] = of; return f(OF(a), OF(b), OF(c)); }
    else if constexpr (count == 4) { auto& [a, b, c, d] = of; return f(OF(a), OF(b), OF(c), OF(d)); }
    else if constexpr (count == 5) { auto& [a, b, c, d, e] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e)); }
    else if constexpr (count == 6) { auto& [a, b, c, d, e, h] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h)); }
    else if constexpr (count == 7) { auto& [a, b, c, d, e, h, i] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i)); }
    else if constexpr (count == 8) { auto& [a, b, c, d, e, h, i, j] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j)); }
    else if constexpr (count == 9) { auto& [a, b, c, d, e, h, i, j, k] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k)); }
    else if constexpr (count == 10) { auto& [a, b, c, d, e, h, i, j, k, l] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k), OF(l)); }
    else if constexpr (count == 11) { auto& [a, b, c, d, e, h, i, j, k, l, m] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k), OF(l), OF(m)); }
    else if constexpr (count == 12) { auto& [a, b, c, d, e, h, i, j, k, l, m, n] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k), OF(l), OF(m), OF(n)); }
    else if constexpr (count == 13) { auto& [a, b, c, d, e, h, i, j, k, l, m, n, o] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k), OF(l), OF(m), OF(n), OF(o)); }
    else if constexpr (count == 14) { auto& [a, b, c, d, e, h, i, j, k, l, m, n, o, p] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k), OF(l), OF(m), OF(n), OF(o), OF(p)); }
    else if constexpr (count == 15) { auto& [a, b, c, d, e, h, i, j, k, l, m, n, o, p, q] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k), OF(l), OF(m), OF(n), OF(o), OF(p), OF(q)); }
    else if constexpr (count == 16) { auto& [a, b, c, d, e, h, i, j, k, l, m, n, o, p, q, r] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k), OF(l), OF(m), OF(n), OF(o), OF(p), OF(q), OF(r)); }
    else if constexpr (count == 17) { auto& [a, b, c, d, e, h, i, j, k, l, m, n, o, p, q, r, u] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k), OF(l), OF(m), OF(n), OF(o), OF(p), OF(q), OF(r), OF(u)); }
    else if constexpr (count == 18) { auto& [a, b, c, d, e, h, i, j, k, l, m, n, o, p, q, r, u, v] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k), OF(l), OF(m), OF(n), OF(o), OF(p), OF(q), OF(r), OF(u), OF(v)); }
    else if constexpr (count == 19) { auto& [a, b, c, d, e, h, i, j, k, l, m, n, o, p, q, r, u, v, w] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k), OF(l), OF(m), OF(n), OF(o), OF(p), OF(q), OF(r), OF(u), OF(v), OF(w)); }
    else { auto& [a, b, c, d, e, h, i, j, k, l, m, n, o, p, q, r, u, v, w, x] = of; return f(OF(a), OF(b), OF(c), OF(d), OF(e), OF(h), OF(i), OF(j), OF(k), OF(l), OF(m), OF(n), OF(o), OF(p), OF(q), OF(r), OF(u), OF(v), OF(w), OF(x)); }
#undef OF
    // clang-format on
}

}  // namespace members
}  // namespace cullet
