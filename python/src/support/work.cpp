#include "support/work.h"

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <pthread.h>
#include <thread>

namespace abut::python {

namespace {

using namespace std::chrono_literals;

// The state of the watch lives as long as the process: its thread is not joined.
std::atomic<bool> stop_main{false};          // the handler sets it
std::atomic<std::uint64_t> running_query{0}; // number of the main thread's query; 0: none
std::atomic<bool> watcher_sleeps{false};
std::atomic<bool> watcher_exists{false};
std::atomic<bool> caught{false}; // the handler is in place
std::uint64_t queries = 0;       // that the main thread has begun
pthread_t main_thread;
struct sigaction before;    // the handler that is called next, and put back
std::mutex* gate = nullptr; // guards `caught` and `before`
std::condition_variable* wake = nullptr;

constexpr auto kPeriod = 3ms;
constexpr int kIdlePeriods = 300; // until the watcher sleeps

void on_interrupt(int number, siginfo_t* info, void* context) {
    stop_main.store(true, std::memory_order_relaxed);
    if (before.sa_flags & SA_SIGINFO)
        before.sa_sigaction(number, info, context);
    else if (before.sa_handler != SIG_IGN && before.sa_handler != SIG_DFL)
        before.sa_handler(number);
}

void put_back() {
    sigaction(SIGINT, &before, nullptr);
    caught = false;
}

/// In: the gate is held.
void catch_interrupts(std::uint64_t query) {
    struct sigaction current {};
    sigaction(SIGINT, nullptr, &current);
    // A process that ignores the signal, or dies of it, goes on to do so.
    if (!(current.sa_flags & SA_SIGINFO) &&
        (current.sa_handler == SIG_IGN || current.sa_handler == SIG_DFL))
        return;
    before = current;
    struct sigaction ours {};
    ours.sa_sigaction = on_interrupt;
    ours.sa_flags = SA_SIGINFO | (current.sa_flags & SA_RESTART);
    sigemptyset(&ours.sa_mask);
    sigaction(SIGINT, &ours, nullptr);
    caught = true;
    if (running_query != query) // it ended meanwhile, and may not have seen that
        put_back();
}

void watch() {
    std::uint64_t last = 0;
    int idle = 0;
    for (std::unique_lock lock(*gate);;) {
        wake->wait_for(lock, kPeriod, [] { return false; });
        const std::uint64_t current = running_query;
        if (current != 0 && current == last && !caught)
            catch_interrupts(current);
        idle = current == last ? idle + 1 : 0;
        last = current;
        if (idle < kIdlePeriods || current != 0)
            continue;
        watcher_sleeps = true;
        wake->wait(lock, [] { return running_query != 0; });
        watcher_sleeps = false;
        idle = 0;
    }
}

void begin_watcher() {
    watcher_exists = true;
    sigset_t all, old;
    sigfillset(&all); // signals are for the program's own threads
    pthread_sigmask(SIG_SETMASK, &all, &old);
    std::thread(watch).detach();
    pthread_sigmask(SIG_SETMASK, &old, nullptr);
}

/// A child of fork has one thread, which is its main thread.
void after_fork() {
    main_thread = pthread_self();
    watcher_exists = false;
    watcher_sleeps = false;
    running_query = 0;
    caught = false;
    gate = new std::mutex;
    wake = new std::condition_variable;
}

} // namespace

void begin_watch() {
    gate = new std::mutex;
    wake = new std::condition_variable;
    main_thread = pthread_self();
    pthread_atfork(nullptr, nullptr, after_fork);
}

InterruptWatch::InterruptWatch(std::atomic<bool>& own) : flag_(&own) {
    if (running_query.load(std::memory_order_relaxed) != 0 ||
        !pthread_equal(pthread_self(), main_thread))
        return;
    watched_ = true;
    flag_ = &stop_main;
    stop_main.store(false, std::memory_order_relaxed);
    if (!watcher_exists)
        begin_watcher();
    running_query = ++queries;
    if (watcher_sleeps) {
        const std::lock_guard lock(*gate);
        wake->notify_one();
    }
}

InterruptWatch::~InterruptWatch() {
    if (!watched_)
        return;
    running_query = 0;
    if (!caught)
        return;
    const std::lock_guard lock(*gate);
    if (caught)
        put_back();
}

// To take the interpreter's lock throws nothing.
Callback::~Callback() { // NOLINT(bugprone-exception-escape)
    const py::gil_scoped_acquire lock;
    function_ = {};
    error_ = nullptr;
}

Work::Work(py::handle report) {
    if (!report || report.is_none())
        return;
    if (!PyCallable_Check(report.ptr()))
        throw py::type_error("progress: a function of (stage, fraction) is wanted");
    report_ = std::make_unique<Callback>(py::reinterpret_borrow<py::object>(report));
    progress_.report = [this](std::string_view stage, double fraction) {
        const bool done = report_->call([&](const py::object& function) {
            function(py::str(stage.data(), stage.size()), fraction);
            if (PyErr_CheckSignals() != 0)
                throw py::error_already_set();
        });
        if (!done)
            const_cast<std::atomic<bool>*>(progress_.stop)->store(true);
    };
}

void Work::explain_stop() {
    if (report_)
        report_->raise();
    if (PyErr_CheckSignals() != 0)
        throw py::error_already_set();
}

} // namespace abut::python
