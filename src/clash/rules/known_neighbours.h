#pragma once

#include <abut/clash.h>
#include <abut/properties.h>

#include "clash/query/part_facts.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace abut {

/// Which parts belong together: by the relations of their models, and by the wholes that they are
/// parts of. It takes a few bytes for each relation and for each part of a whole.
class KnownNeighbours {
public:
    /// Adds the next part; parts are numbered from 0.
    void add(const PartFacts& part);
    /// Adds the relations of a model. Their parts are those from number `first` on.
    void add(std::span<const PartRelation> relations, std::size_t first);

    /// Returns how two parts belong together; the first of Neighbours that holds.
    [[nodiscard]] std::optional<Neighbours> find(std::size_t i, std::size_t k) const;
    /// Bytes in memory.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    struct Link {
        std::uint64_t pair = 0; ///< lower number, then the higher one
        Neighbours neighbours = Neighbours::fills;
        // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 misreads the comparison
        friend auto operator<=>(const Link&, const Link&) = default;
    };

    std::vector<Link> links_; ///< sorted
    std::size_t parts_ = 0;
    std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> wholes_; ///< by model and id
    std::vector<std::uint32_t> whole_of_; ///< by part, 0: none; ends after the last that has one
};

} // namespace abut
