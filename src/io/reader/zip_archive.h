#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

/// A ZIP archive in memory.
///
/// Layout of a file:
///
///     entry      local header "PK\3\4" … name, extra | bytes, raw or deflated
///     directory  one record "PK\1\2" an entry: method, sizes, name, where the entry begins
///     end        "PK\5\6" … how many records, where the directory begins | comment
class ZipArchive {
public:
    /// Reads the directory.
    ///
    /// Errors      Fault malformed, also if the entries claim more than some hundred times the
    ///             archive's size, because such an archive is made to fill the memory.
    explicit ZipArchive(const std::string& path);

    /// Returns an entry's content. Names are compared without regard to case.
    ///
    /// Errors      Fault malformed if the entry is missing or damaged; unsupported.
    [[nodiscard]] std::string content(std::string_view name) const;

private:
    struct Entry {
        std::string name; ///< in lower case
        std::uint32_t packed = 0, size = 0, at = 0;
        std::uint16_t method = 0;
    };
    [[nodiscard]] std::uint32_t number(std::uint64_t at, std::size_t bytes) const;

    std::string bytes_;
    std::vector<Entry> entries_;
};

} // namespace abut
