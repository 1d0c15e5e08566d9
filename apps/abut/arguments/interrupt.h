#pragma once

#include <atomic>

/// Handling of Ctrl-C (SIGINT) and SIGTERM. No half-written file may remain.
namespace abut::command {

inline constexpr int kExitInterrupted = 130; ///< 128 + SIGINT, as shells report it

enum class OnInterrupt : int {
    exit,  ///< end at once: nothing is half-written and nobody polls the flag
    ask,   ///< set the flag that the library polls; end at once on a second signal
    defer, ///< only set the flag, because files are being written
};

/// Installs the handlers. Outside of any InterruptScope, a signal ends the process at once with
/// status 130 and prints one line on standard error unless `silent`.
void install_interrupt_handlers(bool silent);

/// The flag to pass as Progress::stop.
const std::atomic<bool>& interrupt_flag();

/// Errors      Error{interrupted} if a signal came.
void throw_if_interrupted();

/// Sets how signals are handled until the end of the scope.
class InterruptScope {
public:
    explicit InterruptScope(OnInterrupt answer);
    ~InterruptScope();
    InterruptScope(const InterruptScope&) = delete;
    InterruptScope& operator=(const InterruptScope&) = delete;

private:
    OnInterrupt before_;
};

} // namespace abut::command
