#pragma once

#include <abut/carry.h>
#include <abut/clash_review.h>
#include <abut/picture.h>
#include <abut/renderer.h>
#include <abut/tour.h>
#include <abut/view.h>
#include <abut/walk.h>
#include <abut/walker.h>

#include "frame_pace.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace abut::viewer {

constexpr std::size_t kMostPlanes = 6; ///< section planes

enum class Move : std::uint8_t { walk, fly, orbit };

/// What the person wants in a frame. Velocities are fractions of the speed.
struct Wish {
    double forward = 0, right = 0, up = 0;
    bool duck = false, jump = false, fast = false;
};

/// A point on a part that was clicked.
struct Pick {
    std::uint32_t part = 0; ///< index in View::parts()
    Vec3 point;
};

/// A part that was carried: the renderer draws it apart from the chunks of the view.
struct MovedPart {
    std::uint32_t drawn = 0; ///< its number in the renderer
    Vec3 start;              ///< translation of its place in the store
};

/// The walk through a store: where the person is, what is seen and what is chosen. It knows no
/// window; the panels change its members.
class Session {
public:
    struct Limits {
        std::uint64_t memory = 0, gpu_memory = 0;
        double pixel_error = 1;
    };
    /// A context of OpenGL must be current.
    Session(const std::string& store_path, const Limits& limits, std::uint32_t width,
            std::uint32_t height);

    void resize(std::uint32_t width, std::uint32_t height);
    [[nodiscard]] Camera camera() const;
    /// Puts the eye somewhere and turns it. A person who walks flies from there on.
    void look(const Vec3& eye, const Vec3& forward);
    void look_at(const Box3& box);
    void turn(double right, double up); ///< radians
    void set_move(Move to);
    void step(const Wish& wish, double seconds);
    /// The person passes through this part; {}: through none.
    void set_carried(WalkPart part);

    /// The first visible part at a pixel: neither hidden nor a ghost, nor cut away.
    std::optional<Pick> pick(double x, double y);
    void choose(std::optional<std::uint32_t> part);

    void colour(ColourBy by);
    /// Makes all other parts ghosts. With no parts, none is.
    void ghost_all_but(const std::vector<std::uint32_t>& parts);
    [[nodiscard]] PartState state(std::uint32_t part) const;
    void set_state(std::uint32_t part, const PartState& state);
    [[nodiscard]] Colour colour_of(std::uint32_t part) const { return colours_[part]; }
    [[nodiscard]] Box3 box_of(std::uint32_t part); ///< where it is now
    /// Draws a part where the walk has it.
    void draw_moved(std::uint32_t part);
    /// Returns false, and shows nothing, if a part of the clash is not in the store. `learn_ids`
    /// must have read all ids.
    bool show_clash(const ListedClash& clash);

    /// Reads the ids of some more parts. Returns whether all are known.
    bool learn_ids(double seconds);
    [[nodiscard]] std::optional<std::uint32_t> part_of(const std::string& file,
                                                       const std::string& id) const;

    void add_plane(); ///< cuts away what is nearer than 2 m
    [[nodiscard]] RenderStyle style(bool still) const;
    /// What to draw now. While the eye rests, budgets do not keep the picture coarse.
    const ViewFrame& frame(const Camera& camera, const Vec3& velocity = {}, bool rests = false);

    std::string path;
    Store store;
    View view;
    Walk walk;
    Renderer renderer;
    std::unique_ptr<Walker> walker;
    FramePace pace;

    Camera lens; ///< field of view, size and range
    Move move = Move::fly;
    double speed = 2; ///< metres a second
    double yaw = 0, pitch = 0;
    Vec3 target; ///< of an orbit
    double orbit_distance = 10;

    std::optional<std::uint32_t> chosen;
    std::map<std::uint32_t, MovedPart> moved; ///< by the index in View::parts()
    ColourBy colour_by = ColourBy::material;
    std::vector<SectionPlane> sections;
    std::optional<Box3> section_box;
    bool with_edges = true, with_ground = true, with_occlusion = true;
    std::vector<Mark> marks; ///< of this frame; tools add to it
    bool changed = true;     ///< something other than the camera, since the last picture

private:
    [[nodiscard]] Vec3 up() const;
    [[nodiscard]] Vec3 forward() const;
    [[nodiscard]] Vec3 eye() const;
    /// Puts a person on the floor that its eye was near, or, if there is none below, to where it
    /// looks, or into the middle.
    void stand(const Vec3& at);
    void make_walker(const Vec3& at);
    [[nodiscard]] bool is_cut(const Vec3& point) const;

    WalkPart carried_{};
    std::vector<Colour> colours_;
    std::vector<std::pair<std::string, std::uint32_t>>
        ids_; ///< file, line end, id; sorted at the end
    double detail_ = 0.5;
};

} // namespace abut::viewer
