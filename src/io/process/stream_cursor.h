#pragma once

#include <abut/error.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

namespace abut {

/// Takes values from a reader's result, one after the other.
///
/// Errors      Error{reader_failed}, naming the file, if the result ends before.
class StreamCursor {
public:
    StreamCursor(std::span<const std::byte> rest, const std::string& file)
        : rest_(rest), file_(file) {}

    std::span<const std::byte> take(std::uint64_t size) {
        if (size > rest_.size())
            fail();
        const auto taken = rest_.first(size);
        rest_ = rest_.subspan(size);
        return taken;
    }
    template <typename Value>
    Value value() {
        Value result{};
        std::memcpy(&result, take(sizeof(Value)).data(), sizeof(Value));
        return result;
    }
    std::string text(std::uint32_t size) {
        const auto bytes = take(size);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    /// Throws the error of a damaged result.
    [[noreturn]] void fail() const {
        throw Error(ErrorCode::reader_failed, file_, "its reader returned a damaged result");
    }
    [[nodiscard]] std::size_t left() const noexcept { return rest_.size(); }
    [[nodiscard]] const std::string& file() const noexcept { return file_; }

private:
    std::span<const std::byte> rest_;
    const std::string& file_;
};

} // namespace abut
