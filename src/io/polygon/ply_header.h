#pragma once

#include "io/file/byte_stream.h"

#include <cstdint>
#include <string>
#include <vector>

namespace abut {

enum class PlyEncoding : std::uint8_t { text, little_endian, big_endian };

struct PlyType {
    std::size_t bytes = 0;
    bool is_signed = false;
    bool is_real = false;
};

struct PlyProperty {
    std::string name;
    bool is_list = false;
    PlyType length; ///< of a list
    PlyType value;
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0; ///< by the file's own account
    std::vector<PlyProperty> properties;
};

/// What a PLY file says of itself before its data.
struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::text;
    std::vector<PlyElement> elements; ///< in the order of their data

    /// How many vertices there are; 0 if the file says nothing of any.
    [[nodiscard]] std::uint64_t vertices() const;
};

/// In/out      content: the file from its beginning; afterwards, its data are ahead.
/// Errors      Fault malformed.
/// Source      [Turk 1994, The PLY Polygon File Format]; names of types with their sizes (float32)
///             are a later custom.
PlyHeader read_ply_header(ByteStream& content);

} // namespace abut
