#pragma once

#include <abut/crew.h>

#include "support/python.h"

#include <memory>

namespace abut::python {

/// A crew that can be left.
class OpenCrew {
public:
    explicit OpenCrew(std::unique_ptr<Crew> crew) : crew_(std::move(crew)) {}
    OpenCrew(OpenCrew&&) = default;
    OpenCrew& operator=(OpenCrew&&) = delete;
    // Releasing the interpreter's lock and leaving a crew throw nothing.
    ~OpenCrew() { leave(); } // NOLINT(bugprone-exception-escape)

    [[nodiscard]] Crew* get() const {
        if (!crew_)
            throw py::value_error("this process has left the crew");
        return crew_.get();
    }
    /// Waits for other processes, without the interpreter's lock.
    void leave() {
        if (!crew_)
            return;
        const py::gil_scoped_release unlocked;
        crew_.reset();
    }

private:
    std::unique_ptr<Crew> crew_;
};

} // namespace abut::python
