#pragma once

namespace abut {

/// Processor time that all threads of this process have used so far.
double processor_seconds();

} // namespace abut
