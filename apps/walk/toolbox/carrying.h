#pragma once

#include <abut/carry.h>

#include "session/session.h"
#include "toolbox/background_task.h"
#include "toolbox/gizmo.h"

#include <optional>
#include <string>
#include <vector>

namespace abut::viewer {

/// A part in the hand: where it is sent to, and how far it has got.
///
/// The hand is a place before the eye and a rotation. It follows the eye, keys turn it, and the
/// gizmo moves and turns it. Whenever the eye jumps or the mode changes, the hand takes the part
/// anew where it is, so that the part never jumps.
struct Carrying {
    CarryMode mode = CarryMode::stop;
    double clearance = 0.1; ///< metres; parts nearer than this are shown in orange
    double turn_step = 5;   ///< degrees of a key
    std::unique_ptr<Carry> carry;
    std::uint32_t part = 0;           ///< as Session counts parts
    std::vector<Pose> way;            ///< since it was taken
    std::optional<PathReport> report; ///< of that way, once asked for
    bool at_rest = false;             ///< nothing moved since the last step, which has depths
    std::string file;                 ///< to bring in
    std::optional<GizmoDrag> drag;
    std::optional<Handle> hovered;

    void take(Session& session, std::uint32_t chosen);
    void put_down(Session& session);
    /// Takes it out of the walk.
    void remove(Session& session);
    /// Drops it without touching it, if it was removed by someone else.
    void update(Session& session);
    void set_mode(Session& session, CarryMode to);
    void next_mode(Session& session);

    /// Reads a file in the background; its part is then taken.
    void bring_in(const std::string& path);
    [[nodiscard]] bool is_reading() const { return reading.is_running(); }

    void turn(const Vec3& about, double radians);
    void push(double metres); ///< away from the eye
    void straighten();        ///< as it was when it was taken
    /// Moves it by the depth of the deepest part that it overlaps. Returns false if there is none.
    bool move_out(Session& session);

    void hover(const Session& session, const ScreenPoint& at);
    /// Returns false if no handle is there.
    bool begin_drag(const Session& session, const ScreenPoint& at);
    void continue_drag(const Session& session, const ScreenPoint& at);
    void end_drag(const Session& session);
    [[nodiscard]] Gizmo gizmo(const Session& session) const;

    void check_way(Session& session);
    /// Writes the report as JSON, with the names of the parts.
    void write_report(Session& session, const std::string& path) const;

    BackgroundTask reading;

private:
    struct Brought {
        Mesh mesh;
        std::string file, name;
    };
    void take_anew(const Session& session);
    void forget(Session& session);
    void step(Session& session);
    void show(Session& session);
    [[nodiscard]] Pose wanted(const Session& session) const;
    [[nodiscard]] Vec3 middle_at(const Pose& pose) const;
    [[nodiscard]] Pose placed_at(const Vec3& middle, const Quaternion& rotation) const;

    Vec3 middle_;      ///< of its box, in the frame that the pose places
    double ahead_ = 0; ///< distance of the hand from the eye
    Vec3 aside_;       ///< of the hand, from the point straight ahead
    Quaternion rotation_{1, 0, 0, 0};
    Vec3 drag_middle_; ///< of the hand when a drag began
    Quaternion drag_rotation_{1, 0, 0, 0};
    Pose last_wanted_;
    std::uint64_t jumps_ = 0; ///< of the session, when the part was last taken anew
    bool must_step_ = false;
    std::shared_ptr<Brought> brought_; ///< by the thread that reads, until it has ended
};

/// "through", "stop", "slide".
const char* to_string(CarryMode mode);

} // namespace abut::viewer
