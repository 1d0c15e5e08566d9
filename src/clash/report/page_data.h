#pragma once

#include <abut/clash.h>

#include "clash/building/packed_building.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace abut {

/// The numbers that a page gives to the parts of a report, in the order in which its clashes name
/// them.
class PartNumbers {
public:
    /// Errors      Error{bad_argument} if a clash refers to a part that does not exist.
    PartNumbers(const ClashReport& report, const std::vector<Scene>& models);

    struct Place {
        std::uint32_t model = 0, part = 0;
    };
    [[nodiscard]] const std::vector<Place>& places() const { return places_; }
    /// The numbers of parts a and b, by clash.
    [[nodiscard]] const std::vector<std::array<std::uint32_t, 2>>& sides() const { return sides_; }

private:
    std::vector<Place> places_;
    std::vector<std::array<std::uint32_t, 2>> sides_;
};

/// Returns the report as the page reads it: JSON in columns, with every part, type, file and rule
/// stored once. A page of 100,000 clashes has a third of the size that the rows of the JSON report
/// would need. src/clash/report/page/README.md describes the members.
std::string page_data(const ClashReport& report, const std::vector<Scene>& models,
                      const PartNumbers& parts, const PackedBuilding& building);

} // namespace abut
