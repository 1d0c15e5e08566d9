#pragma once

#include "io/scene/model_frame.h"

#include <string>
#include <string_view>

namespace abut {

/// Reads the unit and axes from the `asset` element of a COLLADA document. Defaults: metres and y
/// up [COLLADA 1.4.1].
///
/// In          text: the document, or its beginning.
FormatFrame collada_frame(std::string_view text);

/// As above for the first MiB of a file. `asset` is the first child of the root.
FormatFrame read_collada_frame(const std::string& file);

} // namespace abut
