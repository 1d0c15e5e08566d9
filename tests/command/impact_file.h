#pragma once

#include <abut/deformable.h>

#include <cstddef>
#include <string>
#include <vector>

namespace abut::test {

/// An impact as `abut ccd --out` writes it.
struct WrittenImpact {
    std::size_t step = 0;
    FeatureImpact impact;

    friend bool operator==(const WrittenImpact&, const WrittenImpact&) = default;
};

/// Reads FILE.csv or FILE.bin in the format of docs/deformable.md. Fails the test if the file
/// differs.
std::vector<WrittenImpact> read_impacts(const std::string& file);

} // namespace abut::test
