#pragma once

#include <abut/assembly.h>

#include "core/arguments.h"

#include <string>

namespace abut {

/// Returns the name of a part that a report names.
///
/// Errors      Error{bad_argument} if the assembly has no such part.
inline const std::string& part_name(const Assembly& assembly, std::uint32_t part) {
    require(part < assembly.parts.size(), "the report names a part that the assembly lacks");
    return assembly.parts[part].name;
}

} // namespace abut
