// How cullet refuses bad input: a value, or one sentence that says what, where, which value and what to do.
#pragma once
#include <optional>
#include <string>
#include <utility>

namespace cullet {

/// One sentence for a person: what was wrong, where, which value, what to do.
struct Error {
    std::string message;
};

/// A T or an Error. Nothing in cullet's interface throws.
template <class T>
class [[nodiscard]] Result {
 public:
    Result(T value) : value_(std::move(value)) {}
    Result(Error error) : error_(std::move(error)) {}
    bool ok() const { return value_.has_value(); }
    explicit operator bool() const { return ok(); }
    T& value() & { return *value_; }
    const T& value() const& { return *value_; }
    T&& value() && { return std::move(*value_); }
    T& operator*() & { return *value_; }
    const T& operator*() const& { return *value_; }
    T&& operator*() && { return std::move(*value_); }
    T* operator->() { return &*value_; }
    const T* operator->() const { return &*value_; }
    /// The value, or `other` in place of an error.
    T value_or(T other) const& { return ok() ? *value_ : std::move(other); }
    T value_or(T other) && { return ok() ? std::move(*value_) : std::move(other); }
    /// Empty when there is a value.
    const std::string& error() const { return error_.message; }

 private:
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
