#pragma once

#include <cstdint>
#include <span>

namespace abut::test {

/// Choices determined by bytes. When the bytes are used up, every choice is the lowest.
class ByteChoices {
public:
    explicit ByteChoices(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    [[nodiscard]] bool is_empty() const { return bytes_.empty(); }

    /// Has so few possible values that some are repeated.
    double uniform(double low, double high) {
        const int hundreds = next();
        return low + (256 * hundreds + next()) / 65535.0 * (high - low);
    }
    int integer(int low, int high) { return low + next() % (high - low + 1); }
    bool chance(double p) { return next() / 256.0 < p; }

private:
    int next() {
        if (bytes_.empty())
            return 0;
        const int first = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return first;
    }
    std::span<const std::uint8_t> bytes_;
};

} // namespace abut::test
