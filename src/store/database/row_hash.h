#pragma once

#include <abut/types.h>

#include "core/hash.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace abut {

/// Hashes the columns of a row one after the other. Texts are hashed with their lengths, so that
/// moving bytes from one text to the next changes the hash.
class RowHash {
public:
    template <typename Value>
    RowHash& add(const Value& value) {
        hasher_.add_value(value);
        return *this;
    }
    RowHash& add(std::string_view text) {
        hasher_.add_value(std::uint64_t{text.size()});
        hasher_.add(std::as_bytes(std::span(text)));
        return *this;
    }
    RowHash& add(const std::string& text) { return add(std::string_view(text)); }
    RowHash& add(const Box3& box) {
        return add(box.lower.x)
            .add(box.lower.y)
            .add(box.lower.z)
            .add(box.upper.x)
            .add(box.upper.y)
            .add(box.upper.z);
    }
    RowHash& add_bytes(std::span<const std::byte> bytes) {
        hasher_.add_value(std::uint64_t{bytes.size()});
        hasher_.add(bytes);
        return *this;
    }
    [[nodiscard]] std::uint64_t value() const { return hasher_.value_64(); }
    [[nodiscard]] Hash128 value_128() const { return hasher_.value(); }

private:
    Hasher hasher_;
};

} // namespace abut
