#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Conversion of values to the bytes of a message and back. Both processes run the same build. A
/// struct takes part through a function `fields(stream, value)` that calls stream(member, member,
/// ...) in both directions.
namespace abut {

class MessageWriter {
public:
    template <typename... Values>
    void operator()(const Values&... values) {
        (put(values), ...);
    }
    std::vector<std::byte> take() { return std::move(bytes_); }

private:
    template <typename Value>
    void put(const Value& value) {
        if constexpr (requires { fields(*this, value); })
            fields(*this, value);
        else
            put_raw(&value, sizeof value, std::is_trivially_copyable<Value>());
    }
    void put(const std::string& text) {
        put(std::uint64_t{text.size()});
        put_raw(text.data(), text.size(), std::true_type());
    }
    template <typename Value>
    void put(const std::vector<Value>& values) {
        put(std::uint64_t{values.size()});
        for (const Value& value : values)
            put(value);
    }
    template <typename Value>
    void put(const std::optional<Value>& value) {
        put(value.has_value());
        if (value)
            put(*value);
    }
    void put_raw(const void* from, std::size_t count, std::true_type) {
        const auto* const bytes = static_cast<const std::byte*>(from);
        bytes_.insert(bytes_.end(), bytes, bytes + count);
    }

    std::vector<std::byte> bytes_;
};

/// Errors      std::length_error if the message is too short.
class MessageReader {
public:
    explicit MessageReader(const std::vector<std::byte>& bytes) : bytes_(bytes) {}

    template <typename... Values>
    void operator()(Values&... values) {
        (get(values), ...);
    }

private:
    template <typename Value>
    void get(Value& value) {
        if constexpr (requires { fields(*this, value); })
            fields(*this, value);
        else
            get_raw(&value, sizeof value, std::is_trivially_copyable<Value>());
    }
    void get(std::string& text) {
        text.resize(count());
        get_raw(text.data(), text.size(), std::true_type());
    }
    template <typename Value>
    void get(std::vector<Value>& values) {
        values.resize(count());
        for (Value& value : values)
            get(value);
    }
    template <typename Value>
    void get(std::optional<Value>& value) {
        bool there = false;
        get(there);
        if (there)
            get(value.emplace());
        else
            value.reset();
    }
    /// Reads the number of elements of a list. Each takes at least one byte, so a number above the
    /// bytes that are left is refused before memory is reserved.
    std::size_t count() {
        std::uint64_t count = 0;
        get(count);
        require(count);
        return count;
    }
    void get_raw(void* to, std::size_t count, std::true_type) {
        require(count);
        std::memcpy(to, bytes_.data() + at_, count);
        at_ += count;
    }
    void require(std::uint64_t count) const {
        if (count > bytes_.size() - at_)
            throw std::length_error("a message that is too short");
    }

    const std::vector<std::byte>& bytes_;
    std::size_t at_ = 0;
};

} // namespace abut
