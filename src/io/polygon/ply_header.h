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
    PlyType length; ///< type of a list's length
    PlyType value;
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0; ///< as stated by the file
    std::vector<PlyProperty> properties;
};

/// The header of a PLY file.
struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::text;
    std::vector<PlyElement> elements; ///< in the order of their data

    /// The number of vertices; 0 if the header names none.
    [[nodiscard]] std::uint64_t vertices() const;
};

/// Reads the header.
///
/// In/out      content: the file from its beginning; afterwards its data follow.
/// Errors      Fault malformed.
/// Source      [Turk 1994, The PLY Polygon File Format]; names of types with their sizes (float32)
///             are a later custom.
PlyHeader read_ply_header(ByteStream& content);

} // namespace abut
