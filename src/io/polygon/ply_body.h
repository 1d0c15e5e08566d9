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

/// Takes values off the data of a PLY file one by one, text or binary.
///
/// Errors      Fault malformed for a word that is no number, unsupported for a count or an index
///             that is a real number. The end of the data is no fault here, but false.
class PlyBody {
public:
    /// In          data: what follows the header; must outlive the body.
    PlyBody(const PlyHeader& header, ByteStream& data) : data_(data), encoding_(header.encoding) {}

    /// One integer: the length of a list, or an index. False at the end of the data.
    bool take(const PlyType& type, std::int64_t& value);

    /// One number of any type; of text, rounded to that type. False at the end of the data.
    bool take(const PlyType& type, double& value);

    /// A property of any kind. False at the end of the data.
    bool skip(const PlyProperty& property);

    /// The length of a list. False at the end of the data.
    bool take_length(const PlyProperty& property, std::uint64_t& length);

    /// More of these elements cannot follow, whatever their count says.
    [[nodiscard]] std::uint64_t most(const PlyElement& element) const;

    /// Nothing follows; in text, nothing but blanks.
    [[nodiscard]] bool at_end();

private:
    [[nodiscard]] bool is_text() const { return encoding_ == PlyEncoding::text; }
    bool skip(const PlyType& type, std::uint64_t count);
    /// In the lowest bits. False at the end of the data.
    bool take_bits(const PlyType& type, std::uint64_t& bits);
    template <typename Number>
    bool take_word_as(Number& value);

    ByteStream& data_;
    PlyEncoding encoding_;
};

/// Takes the vertices: their properties x, y and z.
///
/// Errors      as PlyBody; Fault malformed if the data ends before or one of the three is missing.
void take_ply_vertices(PlyBody& body, const PlyElement& element,
                       const std::function<void(const Vec3&)>& vertex);

/// Takes a face's corners: indices of vertices, any number of them.
using PlyFace = std::function<void(std::span<const std::uint64_t> corners)>;

/// Takes all elements of a kind, faces that have a list of vertices.
///
/// Errors      as PlyBody; Fault malformed if the data ends before, bad_mesh if a corner is not
///             among so many vertices.
void take_ply_faces(PlyBody& body, const PlyElement& element, std::uint64_t vertices,
                    const PlyFace& face);

/// Passes over all elements of a kind. Errors as PlyBody; Fault malformed if the data ends before.
void skip_ply_elements(PlyBody& body, const PlyElement& element);

/// Calls `take`, which returns false at the end of the data, for each element of a kind.
///
/// Errors      Fault malformed if the data ends before.
template <typename Take>
void take_ply_elements(const PlyElement& element, const Take& take) {
    // Without properties it has no data, however many of it there are.
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
                  (std::numeric_limits<Number>::is_integer ? " for an integer" : " for a number"));
    value = *number;
    return true;
}

inline bool PlyBody::take(const PlyType& type, std::int64_t& value) {
    if (type.is_real)
        throw Fault(ErrorCode::unsupported, "counts with real numbers");
    if (is_text())
        return take_word_as(value);
    std::uint64_t bits = 0;
    if (!take_bits(type, bits))
        return false;
    const std::size_t unused = 64 - 8 * type.bytes;
    // Shifted to the top and back, arithmetically where the sign is to be kept.
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
