#pragma once

#include <abut/clash_review.h>

#include "session/session.h"
#include "toolbox/background_task.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace abut::viewer {

/// The clashes of the store's jobs: run one, go to its clashes, mark them.
struct ClashList {
    bool is_read = false;
    std::vector<ClashReview> reviews;
    std::string message;
    std::optional<ListedClash> wanted;  ///< is shown as soon as its viewpoint is known
    std::optional<std::uint64_t> shown; ///< the id of the last one that was shown
    double clearance = 0;               ///< metres, of the next job
    bool with_resolved = false;         ///< whether resolved clashes are listed
    std::string note;                   ///< of the shown clash, while it is typed
    BackgroundTask job;
    BackgroundTask aiming; ///< finds the viewpoint of the wanted clash

    void read(Session& session);
    void run_job(Session& session);
    void show_next(Session& session);
    /// Marks the shown clash; keeps its note.
    void mark(Session& session, ClashStatus as);
    /// Stores the note with the mark of the shown clash; without a mark, it becomes reviewed.
    void write_note(Session& session);
    void clear_mark(Session& session);
    void update(Session& session);
    [[nodiscard]] std::size_t count() const; ///< without resolved ones

private:
    [[nodiscard]] const ListedClash* find(std::uint64_t id) const;
    void change(Session& session, const MarkChanges& changes);
    void end_job(Session& session);
    /// Returns whether the viewpoint of the wanted clash is known; looks for it otherwise.
    bool aim(const Session& session);

    std::shared_ptr<ClashViewpoint> viewpoint_; ///< written by `aiming`
    std::uint64_t aimed_at_ = 0;                ///< the id of the clash that it is of
    bool is_aimed_ = false;
};

} // namespace abut::viewer
