#pragma once

namespace abut {

/// The largest resident memory, in MiB, that this process has had, or any of its finished children,
/// if larger.
double peak_resident_mib();

} // namespace abut
