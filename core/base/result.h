#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace trapwright::base {

/// What a failure is about, where somebody answers differently to it.
enum class ErrorKind {
    other,
    damaged,      // a file does not hold what its program wrote
    cannotWrite,  // full, read-only, gone
    busy,         // another has it
    unattainable  // what is asked for cannot be had with these settings
};

/// An expected failure. The message says what was wrong, where, and what to do about it.
struct Error {
    std::string message;
    ErrorKind kind = ErrorKind::other;
};

/// A value, or the reason why there is none: an Error, or what a folder needs to tell instead of one.
template <class T, class E = Error>
class [[nodiscard]] Result {
 public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(E error) : state_(std::in_place_index<1>, std::move(error)) {}

    [[nodiscard]] bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }

    /// The value; only where ok().
    [[nodiscard]] const T& value() const& {
        assert(ok());
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] T& value() & {
        assert(ok());
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] T&& value() && {
        assert(ok());
        return std::move(*std::get_if<0>(&state_));
    }
    const T& operator*() const& { return value(); }
    T& operator*() & { return value(); }
    const T* operator->() const { return &value(); }
    T* operator->() { return &value(); }

    /// The error; only where not ok().
    [[nodiscard]] const E& error() const {
        assert(!ok());
        return *std::get_if<1>(&state_);
    }

 private:
    std::variant<T, E> state_;
};

/// The result of an action that gives no value.
using Status = Result<std::monostate>;

inline Status success() {
    return std::monostate{};
}

}  // namespace trapwright::base
