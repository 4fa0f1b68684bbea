// A call is asked over all rows; who gives it takes those that it needs.
#pragma once

namespace cullet {

/// A plain function over some of the rows, as a call over all of them: `calls.measure = call<measure_shell>`.
template <auto F>
struct NarrowCall {
    template <class R, class... P>
    using Wide = R (*)(P...);
    template <class R, class... P>
    constexpr operator Wide<R, P...>() const {
        return [](P... p) -> R { return F(static_cast<P>(p)...); };
    }
};
template <auto F>
inline constexpr NarrowCall<F> call;

}  // namespace cullet
