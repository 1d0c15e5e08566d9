#pragma once

namespace abut {

/// That this process has used so far, in all its threads.
double processor_seconds();

} // namespace abut
