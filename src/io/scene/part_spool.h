#pragma once

#include <abut/scene.h>

#include "core/temporary_file.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// A property of one part, as text.
struct PartProperty {
    std::string name, value;
    friend bool operator==(const PartProperty&, const PartProperty&) = default;
};

/// Parts on disk, in order. Some models have millions of parts, whose texts and transforms would
/// not fit into memory.
class PartSpool {
public:
    /// In          folder: for the temporary files. Errors: Error{cannot_write}, naming it.
    explicit PartSpool(const std::string& folder);

    /// Errors      Error{cannot_write} if the disk is full; Error{bad_argument} for a text of 4
    ///             GiB.
    void append(const Part& part, std::span<const PartProperty> properties = {});
    /// Call it after the last append and before a part is read.
    void finish();

    [[nodiscard]] std::uint64_t size() const noexcept { return count_; }
    /// Reads a part, from any thread.
    [[nodiscard]] Part part(std::uint64_t number) const;
    /// Reads a part without its texts.
    [[nodiscard]] Part placement(std::uint64_t number) const;
    /// Reads the properties of a part, in the order in which they were given.
    [[nodiscard]] std::vector<PartProperty> properties(std::uint64_t number) const;

    /// Reads parts in ascending or nearly ascending order in a fraction of the time. For one
    /// thread.
    class Cursor {
    public:
        explicit Cursor(const PartSpool& spool) : records_(spool.records_), texts_(spool.texts_) {}
        [[nodiscard]] Part part(std::uint64_t number);
        [[nodiscard]] Part placement(std::uint64_t number);
        [[nodiscard]] std::vector<PartProperty> properties(std::uint64_t number);

    private:
        TemporaryReader records_, texts_;
    };

private:
    struct Record {
        Transform world_from_mesh;
        std::uint64_t text = 0;           ///< offset in texts_
        std::uint64_t property_bytes = 0; ///< of the properties, which follow the three texts
        std::uint32_t mesh = 0, properties = 0;
        std::uint32_t id_size = 0, name_size = 0, type_size = 0;
        std::uint32_t has_colour = 0;
        Colour colour;
    };
    template <typename Reader>
    static Record read_record(Reader& records, std::uint64_t number);
    template <typename Reader>
    static Part read_part(Reader& records, Reader& texts, std::uint64_t number);
    template <typename Reader>
    static std::vector<PartProperty> read_properties(Reader& records, Reader& texts,
                                                     std::uint64_t number);
    static Part placement_of(const Record& record);

    TemporaryFile records_, texts_;
    TemporaryWriter record_writer_, text_writer_;
    std::uint64_t count_ = 0;
};

} // namespace abut
