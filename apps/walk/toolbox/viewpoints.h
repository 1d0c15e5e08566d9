#pragma once

#include <abut/tour.h>

#include "session/session.h"

#include <string>

namespace abut::viewer {

/// Saved viewpoints, and a path that is recorded or replayed.
///
/// The viewpoints are kept in a file beside the store, so that they need no right to write to the
/// store, and can be copied, edited and replayed like any path.
struct Viewpoints {
    Tour saved, path;
    bool recording = false, replaying = false;
    double clock = 0;
    std::string kept_in;            ///< file of the viewpoints; empty if it could not be read
    std::string file = "tour.json"; ///< of the path
    std::size_t next = 0;           ///< the viewpoint that `visit_next` goes to

    /// Reads the viewpoints that were kept, if there are any.
    void open(const std::string& store);
    void save(Session& session);
    void rename(std::size_t which, const std::string& name);
    void remove(std::size_t which);
    void visit(Session& session, std::size_t which);
    void visit_next(Session& session);
    void toggle_recording();
    void replay(Session& session);
    void update(Session& session, double seconds);

private:
    void keep() const;
};

/// "plant.views.json" of "plant.abut".
std::string viewpoint_file(const std::string& store);

} // namespace abut::viewer
