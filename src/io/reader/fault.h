#pragma once

#include <abut/error.h>

#include <stdexcept>
#include <string>

namespace abut {

/// A file's fault, found by a reader; the parent process adds the file's name.
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
