#pragma once

#include <abut/error.h>
#include <abut/progress.h>

#include "support/python.h"

#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <type_traits>
#include <utility>

/// How queries run: without the interpreter's lock, and stopped by Ctrl-C.
namespace abut::python {

/// Prepares the watch over interrupts. Call once, from the main thread, with the interpreter's lock.
void begin_watch();

/// Raises an Error as an exception of Python: to be called in a handler of `catch`.
void set_python_error(const Error& error);

/// Stops queries of the main thread at SIGINT. A thread of the module looks every few milliseconds
/// whether a query still runs, and catches the signal from then on; the handler that was there before
/// is called too, and put back when the query ends. So a short query pays nothing for it.
class InterruptWatch {
public:
    /// In: flag that other reasons to stop set.
    explicit InterruptWatch(std::atomic<bool>& own);
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    [[nodiscard]] std::atomic<bool>& flag() noexcept { return *flag_; }

private:
    std::atomic<bool>* flag_;
    bool watched_ = false;
};

/// A Python function that the library calls from any thread. The first exception that it raises is
/// kept, and raised again when the query has ended.
class Callback {
public:
    explicit Callback(py::object function) : function_(std::move(function)) {}
    ~Callback(); // NOLINT(bugprone-exception-escape)
    Callback(const Callback&) = delete;
    Callback& operator=(const Callback&) = delete;

    /// Calls the function with the interpreter's lock; false if it raised.
    template <class Use>
    bool call(Use&& use) {
        const py::gil_scoped_acquire lock;
        if (error_)
            return false;
        try {
            use(function_);
            return true;
        } catch (...) {
            error_ = std::current_exception();
            return false;
        }
    }
    /// Raises what the function raised. With the interpreter's lock.
    void raise() {
        if (error_)
            std::rethrow_exception(std::exchange(error_, nullptr));
    }

private:
    py::object function_;
    std::exception_ptr error_;
};

/// One query: its progress, and where it runs.
class Work {
public:
    /// In          report: None or a function of (stage, fraction).
    explicit Work(py::handle report = {});

    /// Runs `query(progress)` without the interpreter's lock.
    template <class Query>
    auto run(Query&& query) {
        if (PyErr_CheckSignals() != 0)
            throw py::error_already_set();
        InterruptWatch watch(stop_);
        progress_.stop = &watch.flag();
        try {
            const py::gil_scoped_release unlocked;
            return query(std::as_const(progress_));
        } catch (const Error& error) {
            if (error.code() == ErrorCode::interrupted)
                explain_stop();
            throw;
        }
    }

private:
    /// Raises the exception because of which the query was stopped.
    void explain_stop();

    std::atomic<bool> stop_{false};
    std::unique_ptr<Callback> report_;
    Progress progress_;
};

/// Objects of which one thread at a time may make use, or that several may read: the use of a changing
/// object by a second thread, or by a function that its query calls, raises RuntimeError.
class InUse {
public:
    class Change;
    class Read;

private:
    std::atomic<int> users_{0}; ///< readers, or -1
};

class InUse::Change {
public:
    Change(InUse& use, const char* what) : use_(use) {
        int free = 0;
        if (!use_.users_.compare_exchange_strong(free, -1))
            throw std::runtime_error(std::string(what) + " is in use by another thread");
    }
    ~Change() { use_.users_ = 0; }
    Change(const Change&) = delete;
    Change& operator=(const Change&) = delete;

private:
    InUse& use_;
};

class InUse::Read {
public:
    Read(InUse& use, const char* what) : use_(&use) {
        int users = use_->users_;
        do {
            if (users < 0)
                throw std::runtime_error(std::string(what) + " is being changed by another thread");
        } while (!use_->users_.compare_exchange_weak(users, users + 1));
    }
    ~Read() {
        if (use_)
            --use_->users_;
    }
    Read(Read&& other) noexcept : use_(std::exchange(other.use_, nullptr)) {}
    Read& operator=(Read&&) = delete;

private:
    InUse* use_;
};

} // namespace abut::python
