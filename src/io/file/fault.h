#pragma once

#include <abut/error.h>

#include <stdexcept>
#include <string>

namespace abut {

/// A fault in a file's content. A caller that knows the file's name turns it into an Error.
class Fault : public std::runtime_error {
public:
    Fault(ErrorCode code, const std::string& what) : std::runtime_error(what), code_(code) {}
    [[nodiscard]] ErrorCode code() const noexcept { return code_; }

private:
    ErrorCode code_;
};

[[noreturn]] inline void malformed(const std::string& what) {
    throw Fault(ErrorCode::malformed, what);
}

} // namespace abut
