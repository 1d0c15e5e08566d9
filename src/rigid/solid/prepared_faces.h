#pragma once

#include "geometry/prepared_triangle.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// Triangles by slot, prepared when they are first asked for. Only one thread may use it.
class PreparedFaces {
public:
    /// Returns the triangle of a slot; `triangle()` makes it if it is not kept. The reference is
    /// valid until the next call.
    template <typename MakeTriangle>
    const PreparedTriangle& get(std::uint32_t slot, const MakeTriangle& triangle) {
        if (2 * (faces_.size() + 1) > table_.size())
            make_room();
        std::size_t at = place(slot);
        while (table_[at].face != 0 && table_[at].slot != slot)
            at = (at + 1) & (table_.size() - 1);
        if (table_[at].face == 0) {
            faces_.emplace_back(triangle());
            table_[at] = {slot, static_cast<std::uint32_t>(faces_.size())};
        }
        return faces_[table_[at].face - 1];
    }

private:
    /// Beyond this many, all are dropped: a few megabytes.
    static constexpr std::size_t kMost = 16384;

    struct Entry {
        std::uint32_t slot = 0, face = 0; ///< the face's number from 1; 0 if there is none
    };
    [[nodiscard]] std::size_t place(std::uint32_t slot) const {
        return (slot * 0x9e3779b97f4a7c15U >> 32U) & (table_.size() - 1);
    }
    void make_room();

    std::vector<Entry> table_; ///< its size is a power of two
    std::vector<PreparedTriangle> faces_;
};

} // namespace abut
