#pragma once

#include "toolbox/tools.h"

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

namespace abut::viewer {

/// Writes the state of the session to a file, one JSON object a line, whenever it has changed;
/// docs/viewer.md lists the keys.
class EventLog {
public:
    /// Without a path it writes nothing.
    ///
    /// Errors      Error{cannot_write}, naming the file.
    explicit EventLog(const std::string& path);

    /// In          is_complete: whether the picture is. seconds: of the window's clock. A state that
    ///             follows the last line sooner than 0.1 s is kept for a later call.
    void write(Session& session, const Tools& tools, bool is_complete, double seconds);

private:
    struct Close {
        void operator()(std::FILE* file) const;
    };
    std::unique_ptr<std::FILE, Close> file_;
    std::string last_;
    double written_ = -1; ///< when
};

} // namespace abut::viewer
