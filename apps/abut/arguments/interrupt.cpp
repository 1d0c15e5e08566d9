#include "arguments/interrupt.h"

#include <abut/error.h>

#include <signal.h>
#include <string_view>
#include <unistd.h>

namespace abut::command {

namespace {

std::atomic<bool> g_interrupted{false};
std::atomic<OnInterrupt> g_answer{OnInterrupt::exit};
std::atomic<bool> g_silent{false};

// The handler makes only async-signal-safe calls (write and _exit). The atomics must be lock-free.
static_assert(std::atomic<bool>::is_always_lock_free);
static_assert(std::atomic<OnInterrupt>::is_always_lock_free);

void on_signal(int) {
    const bool again = g_interrupted.exchange(true);
    const OnInterrupt answer = g_answer.load();
    if (answer == OnInterrupt::defer || (answer == OnInterrupt::ask && !again))
        return;
    constexpr std::string_view kLine = "abut: interrupted\n";
    if (!g_silent.load()) {
        [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kLine.data(), kLine.size());
    }
    _exit(kExitInterrupted);
}

} // namespace

void install_interrupt_handlers(bool silent) {
    g_silent = silent;
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& interrupt_flag() {
    return g_interrupted;
}

void throw_if_interrupted() {
    if (g_interrupted.load())
        throw Error(ErrorCode::interrupted, "interrupted");
}

InterruptScope::InterruptScope(OnInterrupt answer) : before_(g_answer.exchange(answer)) {}

InterruptScope::~InterruptScope() {
    g_answer.store(before_);
}

} // namespace abut::command
