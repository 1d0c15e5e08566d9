#pragma once

#include <abut/scene.h>

#include "core/temporary_file.h"

#include <cstdint>
#include <string>

namespace abut {

/// Parts on the disk, in order: some models have millions, and their texts and transforms would not
/// fit into the memory.
class PartSpool {
public:
    /// In          folder: of the temporary files. Errors: Error{cannot_write}, naming it.
    explicit PartSpool(const std::string& folder);

    /// Errors      Error{cannot_write} if the disk is full; Error{bad_argument} for a text of 4 GiB.
    void append(const Part& part);
    /// To be called after the last append and before a part is read.
    void finish();

    [[nodiscard]] std::uint64_t size() const noexcept { return count_; }
    /// From any thread.
    [[nodiscard]] Part part(std::uint64_t number) const;
    /// Without its texts.
    [[nodiscard]] Part placement(std::uint64_t number) const;

    /// Reads parts one after the other, or nearly so, in a fraction of the time. One thread.
    class Cursor {
    public:
        explicit Cursor(const PartSpool& spool) : records_(spool.records_), texts_(spool.texts_) {}
        [[nodiscard]] Part part(std::uint64_t number);
        [[nodiscard]] Part placement(std::uint64_t number);

    private:
        TemporaryReader records_, texts_;
    };

private:
    struct Record {
        Transform world_from_mesh;
        std::uint64_t text = 0; ///< offset in texts_
        std::uint32_t mesh = 0;
        std::uint32_t id_size = 0, name_size = 0, type_size = 0;
    };
    template <typename Reader>
    static Record read_record(Reader& records, std::uint64_t number);
    template <typename Reader>
    static Part read_part(Reader& records, Reader& texts, std::uint64_t number);
    static Part placement_of(const Record& record);

    TemporaryFile records_, texts_;
    TemporaryWriter record_writer_, text_writer_;
    std::uint64_t count_ = 0;
};

} // namespace abut
