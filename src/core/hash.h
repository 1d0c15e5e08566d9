#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace abut {

/// A 128-bit hash that identifies a content. A chance collision is not expected below about 10^18
/// contents.
struct Hash128 {
    std::uint64_t low = 0, high = 0;
    friend bool operator==(const Hash128&, const Hash128&) = default;
    friend bool operator<(const Hash128& a, const Hash128& b) {
        return a.high != b.high ? a.high < b.high : a.low < b.low;
    }
};

/// Source      XXH3 [Collet], unseeded: the same on every machine. Not safe against adversaries who
///             construct collisions.
Hash128 hash_128(std::span<const std::byte> bytes);
std::uint64_t hash_64(std::span<const std::byte> bytes);

/// The hash of a content that is added in parts. How it is divided makes no difference.
class Hasher {
public:
    Hasher();
    ~Hasher();
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    void add(std::span<const std::byte> bytes);
    template <typename Value>
    void add_value(const Value& value) {
        add(std::as_bytes(std::span(&value, 1)));
    }
    [[nodiscard]] Hash128 value() const;
    [[nodiscard]] std::uint64_t value_64() const { return value().low; }

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace abut
