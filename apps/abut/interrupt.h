#pragma once

#include <atomic>

/// What Ctrl-C (SIGINT) and SIGTERM do to the command. Nothing half-written may remain.
namespace abut::command {

inline constexpr int kExitInterrupted = 130; ///< 128 + SIGINT, as a shell reports it

enum class OnInterrupt : int {
    exit,  ///< end at once: nothing half-written is on the disk and nobody polls the flag
    ask,   ///< set the flag that the library polls; a second signal ends at once
    defer, ///< set the flag only: files are being written
};

/// Installs the handlers; until a scope says otherwise a signal ends the process at once with
/// status 130, with one line on standard error unless `silent`.
void install_interrupt_handlers(bool silent);

/// The flag to hand to Progress::stop.
const std::atomic<bool>& interrupt_flag();

/// Errors      Error{interrupted} if a signal came.
void throw_if_interrupted();

/// How signals are answered until the end of the scope.
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
