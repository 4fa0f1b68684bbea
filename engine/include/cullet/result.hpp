// How cullet refuses bad input: a value, or one sentence that says what, where, which value and what to do.
#pragma once
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

namespace cullet {

/// One sentence for a person: what was wrong, where, which value, what to do.
struct Error {
    std::string message;
};

/// Prints the sentence of a refusal whose value was asked for, and ends the program: what comes after would be wrong.
[[noreturn]] inline void stop_for_want_of_value(const std::string& sentence) {
    std::fprintf(stderr, "cullet: the value of a refused call was taken. It was refused because: %s\n",
                 sentence.c_str());
    std::abort();
}

/// A T or an Error. Nothing in cullet's interface throws. Whoever takes the value of an Error is stopped with its
/// sentence, in every build: ask ok() first.
template <class T>
class [[nodiscard]] Result {
 public:
    Result(T value) : value_(std::move(value)) {}
    Result(Error error) : error_(std::move(error)) {}
    bool ok() const { return value_.has_value(); }
    explicit operator bool() const { return ok(); }
    T& value() & { return *here(); }
    const T& value() const& { return *here(); }
    T&& value() && { return std::move(*here()); }
    T& operator*() & { return *here(); }
    const T& operator*() const& { return *here(); }
    T&& operator*() && { return std::move(*here()); }
    T* operator->() { return here(); }
    const T* operator->() const { return here(); }
    /// The value, or `other` in place of an error.
    T value_or(T other) const& { return ok() ? *value_ : std::move(other); }
    T value_or(T other) && { return ok() ? std::move(*value_) : std::move(other); }
    /// Empty when there is a value.
    const std::string& error() const { return error_.message; }

 private:
    T* here() {
        if (!value_) stop_for_want_of_value(error_.message);
        return &*value_;
    }
    const T* here() const {
        if (!value_) stop_for_want_of_value(error_.message);
        return &*value_;
    }
    std::optional<T> value_;
    Error error_;
};

template <>
class [[nodiscard]] Result<void> {
 public:
    Result() = default;
    Result(Error error) : error_(std::move(error)), ok_(false) {}
    bool ok() const { return ok_; }
    explicit operator bool() const { return ok_; }
    const std::string& error() const { return error_.message; }

 private:
    Error error_;
    bool ok_ = true;
};

}  // namespace cullet
