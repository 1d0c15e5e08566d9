#pragma once

#include <abut/types.h>

#include "io/file/fault.h"
#include "io/file/text_scan.h"
#include "io/polygon/ply_header.h"
#include "math/rounding.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

/// Takes values one by one from the data of a PLY file, text or binary.
///
/// Errors      Fault malformed for a word that is not a number, unsupported for a count or an index
///             that is a real number. The end of the data is not an error; it returns false.
class PlyBody {
public:
    /// In          data: the bytes after the header; must outlive the body.
    PlyBody(const PlyHeader& header, ByteStream& data) : data_(data), encoding_(header.encoding) {}

    /// Takes one integer: the length of a list, or an index. False at the end of the data.
    bool take(const PlyType& type, std::int64_t& value);

    /// Takes one number of any type; in text, rounded to that type. False at the end of the data.
    bool take(const PlyType& type, double& value);

    /// Skips a property of any kind. False at the end of the data.
    bool skip(const PlyProperty& property);

    /// Takes the length of a list. False at the end of the data.
    bool take_length(const PlyProperty& property, std::uint64_t& length);

    /// Upper bound of the number of these elements that can follow, whatever their count says.
    [[nodiscard]] std::uint64_t most(const PlyElement& element) const;

    /// Returns whether nothing follows; in text, nothing but blanks.
    [[nodiscard]] bool at_end();

private:
    [[nodiscard]] bool is_text() const { return encoding_ == PlyEncoding::text; }
    bool skip(const PlyType& type, std::uint64_t count);
    /// Takes a value into the lowest bits. False at the end of the data.
    bool take_bits(const PlyType& type, std::uint64_t& bits);
    template <typename Number>
    bool take_word_as(Number& value);

    ByteStream& data_;
    PlyEncoding encoding_;
};

/// Takes the vertices with their properties x, y and z.
///
/// Errors      as PlyBody; Fault malformed if the data ends early or a property is missing.
void take_ply_vertices(PlyBody& body, const PlyElement& element,
                       const std::function<void(const Vec3&)>& vertex);

/// Receives a face's corners: any number of vertex indices.
using PlyFace = std::function<void(std::span<const std::uint64_t> corners)>;

/// Takes all faces: the elements of a kind that have a list of vertices.
///
/// Errors      as PlyBody; Fault malformed if the data ends early, bad_mesh if a corner is not
///             below `vertices`.
void take_ply_faces(PlyBody& body, const PlyElement& element, std::uint64_t vertices,
                    const PlyFace& face);

/// Skips all elements of a kind. Errors as PlyBody; Fault malformed if the data ends early.
void skip_ply_elements(PlyBody& body, const PlyElement& element);

/// Calls `take`, which returns false at the end of the data, for each element of a kind.
///
/// Errors      Fault malformed if the data ends early.
template <typename Take>
void take_ply_elements(const PlyElement& element, const Take& take) {
    // Without properties, elements have no data, whatever their count.
    if (element.properties.empty())
        return;
    for (std::uint64_t i = 0; i < element.count; ++i)
        if (!take())
            malformed("is truncated: " + std::to_string(i) + " of " +
                      std::to_string(element.count) + " elements " + element.name);
}

inline bool PlyBody::take_bits(const PlyType& type, std::uint64_t& bits) {
    if (!data_.has(type.bytes))
        return false;
    const std::string_view ahead = data_.ahead();
    bits = 0;
    for (std::size_t i = 0; i < type.bytes; ++i) {
        const std::size_t at = encoding_ == PlyEncoding::big_endian ? i : type.bytes - 1 - i;
        bits = bits << 8 | static_cast<unsigned char>(ahead[at]);
    }
    data_.take(type.bytes);
    return true;
}

template <typename Number>
bool PlyBody::take_word_as(Number& value) {
    const std::string_view word = take_word(data_);
    if (word.empty())
        return false;
    const auto number = [&]() -> std::optional<Number> {
        if constexpr (std::numeric_limits<Number>::is_integer)
            return to_number<Number>(word);
        else
            return to_real(word);
    }();
    if (!number)
        malformed("has " + std::string(word.substr(0, 40)) +
                  (std::numeric_limits<Number>::is_integer ? " in place of an integer"
                                                           : " in place of a number"));
    value = *number;
    return true;
}

inline bool PlyBody::take(const PlyType& type, std::int64_t& value) {
    if (type.is_real)
        throw Fault(ErrorCode::unsupported, "has a real number as a count or an index");
    if (is_text())
        return take_word_as(value);
    std::uint64_t bits = 0;
    if (!take_bits(type, bits))
        return false;
    const std::size_t unused = 64 - 8 * type.bytes;
    // Shifted to the top and back; the shift is arithmetic if the sign must be kept.
    value = type.is_signed ? static_cast<std::int64_t>(bits << unused) >> unused
                           : static_cast<std::int64_t>(bits);
    return true;
}

inline bool PlyBody::take(const PlyType& type, double& value) {
    if (!type.is_real) {
        std::int64_t integer = 0;
        const bool taken = take(type, integer);
        value = static_cast<double>(integer);
        return taken;
    }
    const bool is_float = type.bytes == sizeof(float);
    if (is_text()) {
        const bool taken = take_word_as(value);
        value = is_float ? to_float(value) : value;
        return taken;
    }
    std::uint64_t bits = 0;
    const bool taken = take_bits(type, bits);
    value = is_float ? std::bit_cast<float>(static_cast<std::uint32_t>(bits))
                     : std::bit_cast<double>(bits);
    return taken;
}

} // namespace abut
