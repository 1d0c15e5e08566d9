#pragma once

#include <abut/error.h>

#include <string>

namespace abut {

/// Errors      Error{bad_argument} with this message unless the condition holds.
/// Literals have an overload of their own: a string would be made in each call.
inline void require(bool condition, const char* message) {
    if (!condition)
        throw Error(ErrorCode::bad_argument, message);
}
inline void require(bool condition, const std::string& message) {
    if (!condition)
        throw Error(ErrorCode::bad_argument, message);
}

/// Errors      Error{bad_argument} if the value is negative, "WHAT must not be negative", or NaN, "WHAT
///             is not a number".
inline void require_not_negative(double value, const char* what) {
    if (!(value >= 0))
        throw Error(ErrorCode::bad_argument,
                    what + std::string(value < 0 ? " must not be negative" : " is not a number"));
}

} // namespace abut
