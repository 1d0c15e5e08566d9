#pragma once

#include "io/fault.h"
#include "io/random_access_file.h"
#include "io/scene_source.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace abut {

/// Lines of a file of any size, without their ends (\n or \r\n), through a buffer.
class FileLines {
public:
    explicit FileLines(const RandomAccessFile& file) : file_(file) {}

    /// False at the end of the file. The line is valid until the next one is asked for.
    ///
    /// Errors      NotStreamable for a line longer than the buffer.
    bool next(std::string_view& line) {
        std::size_t end = find_end();
        if (end == std::string_view::npos) {
            refill();
            end = find_end();
        }
        if (end == std::string_view::npos) {
            if (at_ < file_.size())
                throw NotStreamable();
            if (rest_.empty())
                return false;
            end = rest_.size();
        }
        line = rest_.substr(0, end);
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        if (!line.empty() && line.back() == '\r')
            line.remove_suffix(1);
        ++number_;
        return true;
    }
    /// "line 12", for messages.
    [[nodiscard]] std::string place() const { return "line " + std::to_string(number_); }
    /// How much of the file has been taken into the buffer.
    [[nodiscard]] std::uint64_t taken() const noexcept { return at_; }

private:
    static constexpr std::size_t kBufferBytes = std::size_t{1} << 20;

    [[nodiscard]] std::size_t find_end() const { return rest_.find('\n'); }

    /// Keeps what is left of the buffer and fills it up.
    void refill() {
        std::string next(rest_);
        const std::size_t kept = next.size();
        const std::uint64_t more = std::min<std::uint64_t>(
            kBufferBytes - std::min(kept, kBufferBytes), file_.size() - at_);
        next.resize(kept + more);
        file_.read(at_, std::as_writable_bytes(std::span(next).subspan(kept)));
        at_ += more;
        buffer_ = std::move(next);
        rest_ = buffer_;
    }

    const RandomAccessFile& file_;
    std::uint64_t at_ = 0;
    std::string buffer_;
    std::string_view rest_;
    std::uint64_t number_ = 0;
};

} // namespace abut
