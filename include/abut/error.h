#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace abut {

/// The kind of fault that an Error reports. Each value names its cause, not its remedy.
enum class ErrorCode : std::uint8_t {
    bad_argument,   ///< a parameter is outside its domain (negative clearance, zero-length
                    ///< quaternion)
    file_not_found, ///< the path does not exist
    unreadable,     ///< the file exists but cannot be opened or read
    malformed,      ///< the content breaks its format, or ends too early
    unsupported,    ///< no reader for this format, or the reader's program is missing
    bad_mesh, ///< an index out of range, a coordinate that is not finite, nothing but degenerate
              ///< triangles
    reader_failed, ///< a third-party reader crashed, ran out of time or out of memory
    cannot_write,  ///< an output file or folder cannot be written
    interrupted,   ///< the caller asked to stop
};

/// The name of the enumerator, such as "file_not_found".
constexpr const char* to_string(ErrorCode code) {
    switch (code) {
    case ErrorCode::bad_argument:
        return "bad_argument";
    case ErrorCode::file_not_found:
        return "file_not_found";
    case ErrorCode::unreadable:
        return "unreadable";
    case ErrorCode::malformed:
        return "malformed";
    case ErrorCode::unsupported:
        return "unsupported";
    case ErrorCode::bad_mesh:
        return "bad_mesh";
    case ErrorCode::reader_failed:
        return "reader_failed";
    case ErrorCode::cannot_write:
        return "cannot_write";
    case ErrorCode::interrupted:
        return "interrupted";
    }
    return "unknown";
}

/// Bad data, failed input or output, and limits. Numerical outcomes are statuses, never errors.
///
/// `what()` is one line; where a file is at fault it begins with the file's name.
class Error : public std::runtime_error {
public:
    Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}

    /// `what()` becomes "file: message".
    Error(ErrorCode code, const std::string& file, const std::string& message)
        : std::runtime_error(file + ": " + message), code_(code), file_(file) {}

    [[nodiscard]] ErrorCode code() const noexcept { return code_; }
    /// The file at fault; empty if none is.
    [[nodiscard]] const std::string& file() const noexcept { return file_; }

private:
    ErrorCode code_;
    std::string file_;
};

} // namespace abut
