#pragma once

#include <abut/view.h>

#include "store/database/store_file.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

namespace abut {

/// The rows of the parts of a view: names, boxes, and a search for texts.
class PartList {
public:
    /// In          numbers: rows of the table `part`, ascending; must outlive the list.
    PartList(StoreFile& store, std::span<const std::int64_t> numbers);

    [[nodiscard]] std::optional<std::uint32_t> index_of(std::int64_t number) const;
    /// As the members of View.
    [[nodiscard]] ViewPart part(std::uint32_t index) const;
    [[nodiscard]] FoundParts find(const std::string& text, std::size_t most, std::uint32_t from,
                                  double seconds) const;

private:
    StoreFile* store_;
    std::span<const std::int64_t> numbers_;
    std::map<std::int64_t, std::string> files_; ///< by model
};

} // namespace abut
