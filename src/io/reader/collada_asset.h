#pragma once

#include "io/scene/model_frame.h"

#include <string>
#include <string_view>

namespace abut {

/// What the `asset` element of a COLLADA document says of unit and axes; metres and y up where it
/// says nothing, as the format has it [COLLADA 1.4.1].
///
/// In          text: the document, or its beginning.
FormatFrame collada_frame(std::string_view text);

/// Of a file, from its first MiB: `asset` is the first child of the root.
FormatFrame read_collada_frame(const std::string& file);

} // namespace abut
