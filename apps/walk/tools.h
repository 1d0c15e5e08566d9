#pragma once

#include "session.h"

#include <array>
#include <exception>
#include <string>
#include <vector>

namespace abut::viewer {

/// What is near the person, or near the chosen part.
struct Proximity {
    bool on = true, of_chosen = false, with_list = false;
    double reach = 1; ///< metres
    std::optional<WalkGap> nearest;
    std::vector<WalkGap> near;
    bool complete = true;
    double milliseconds = 0; ///< that the queries took

    void update(Session& session);
};

enum class Measured : std::uint8_t { points, point_part, parts };

/// Distances between two clicks.
struct Measure {
    bool on = false;
    Measured kind = Measured::parts;
    std::vector<Pick> picks;
    std::string result;
    std::array<Vec3, 2> ends{};
    bool has_ends = false;

    void take(Session& session, const Pick& pick);
    void clear();
};

/// A part in the hand.
struct Carrying {
    CarryMode mode = CarryMode::stop;
    std::unique_ptr<Carry> carry;
    std::uint32_t part = 0;           ///< in the view
    double ahead = 0;                 ///< its distance from the eye
    Vec3 aside;                       ///< of its place, from the point straight ahead
    std::vector<Pose> way;            ///< since it was taken
    std::optional<PathReport> report; ///< of that way, once asked for
    bool at_rest = false;             ///< nothing moved since the last step, which has depths

    void take(Session& session, std::uint32_t chosen);
    void put_down(Session& session);
    void update(Session& session);
    void check_way(Session& session);

private:
    void way_begin(Session& session);
    [[nodiscard]] Vec3 wanted(const Session& session) const; ///< where the hand is
    void show(Session& session);

    Vec3 wanted_; ///< by the last step
    CarryMode last_mode_ = CarryMode::stop;
};

/// Saved viewpoints, and a path that is recorded or replayed.
struct Viewpoints {
    Tour saved, path;
    bool recording = false, replaying = false;
    double clock = 0;
    std::string file = "tour.json";
    std::size_t next = 0; ///< the saved viewpoint that `visit_next` goes to

    void save(Session& session);
    void visit(Session& session, std::size_t which);
    void visit_next(Session& session);
    void toggle_recording();
    void replay();
    void update(Session& session, double seconds);
};

struct Search {
    std::array<char, 128> text{};
    std::vector<std::uint32_t> found;
    std::uint32_t next = 0;
    bool is_over = true;
};

struct ClashList {
    bool is_read = false;
    std::vector<ClashReview> reviews;
    std::string message;
    std::optional<ListedClash> wanted;  ///< is shown as soon as the names of parts are known
    std::optional<std::uint64_t> shown; ///< the id of the last one that was shown

    void read(Session& session);
    void mark(Session& session, const MarkChanges& changes);
    void show_next(Session& session);
    void update(Session& session);
};

/// The state of all panels.
struct Tools {
    Proximity proximity;
    Measure measure;
    Carrying carrying;
    Viewpoints viewpoints;
    Search search;
    ClashList clashes;
    bool with_help = false, with_panels = true;
    double frame_milliseconds = 0;
    std::string message; ///< the last error, or what was done; shown in the status line

    /// Does work, and keeps its error as the message.
    template <typename Work>
    void attempt(const Work& work) {
        try {
            work();
        } catch (const std::exception& error) {
            message = error.what();
        }
    }

    /// Adds what the tools show to the marks of the frame.
    void add_marks(Session& session) const;
};

/// The name of a part on one line.
std::string name_of(Session& session, WalkPart part);

} // namespace abut::viewer
