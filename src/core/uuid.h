#pragma once

#include <string>
#include <string_view>

namespace abut {

/// Returns the UUID of a name: version 5, lower case, with hyphens.
///
/// In          space: the UUID of the name space, with or without hyphens.
/// Source      [RFC 4122, 4.3], SHA-1 [FIPS 180-4]. SHA-1 tells names apart here; it protects
///             nothing.
std::string uuid_of_name(std::string_view space, std::string_view name);

/// Returns whether a text is a UUID in lower or upper case, with hyphens.
bool is_uuid(std::string_view text);

/// Returns a UUID in lower case. UUIDs that differ only in case are the same.
std::string lower_uuid(std::string uuid);

} // namespace abut
