#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

/// Returns the bytes of a data: URI; none if the text is not a data: URI.
///
/// Errors      Fault malformed for a payload that is not base64; unsupported for another encoding.
std::optional<std::vector<std::byte>> bytes_of_data_uri(std::string_view uri);

/// Returns a relative reference as a path, with percent-encoded bytes decoded (RFC 3986, 2.1).
///
/// Errors      Fault malformed for a percent sign without two hexadecimal digits, and for a zero
///             byte; unsupported for a URI with a scheme, such as https:.
std::string path_of_uri(std::string_view uri);

} // namespace abut
