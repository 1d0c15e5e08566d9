#pragma once

#include <abut/clash_review.h>
#include <abut/clash_viewpoint.h>
#include <abut/picture.h>
#include <abut/renderer.h>
#include <abut/view.h>
#include <abut/walk.h>
#include <abut/walker.h>

#include "frame_pace.h"
#include "input/action.h"
#include "vec.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace abut::viewer {

constexpr std::size_t kMostPlanes = 6; ///< section planes

enum class Move : std::uint8_t { walk, fly, orbit };

/// A point on a part that was clicked.
struct Pick {
    std::uint32_t part = 0; ///< as Session counts parts
    Vec3 point;
};

/// A part that is drawn apart from the chunks of the view: it was moved, or brought in.
struct DrawnPart {
    std::uint32_t number = 0; ///< in the renderer
    Box3 box;                 ///< in the part's own frame
};

/// A part of a file that is not in the store.
struct BroughtPart {
    WalkPart part;
    ViewPart facts; ///< its box is where it was brought in
    Colour colour;
};

/// The walk through a store: where the person is, what is seen and what is chosen. It knows no
/// window; the panels change its members.
///
/// A part is named by its index in View::parts(). Parts that were brought in have larger numbers.
class Session {
public:
    struct Limits {
        std::uint64_t memory = 0, gpu_memory = 0;
        double pixel_error = 1;
    };
    /// A context of OpenGL must be current.
    Session(const std::string& store_path, const Limits& limits, std::uint32_t width,
            std::uint32_t height);

    // ------------------------------------------------------------------ where the person is ---
    void resize(std::uint32_t width, std::uint32_t height);
    [[nodiscard]] Camera camera() const;
    [[nodiscard]] Vec3 up() const;
    /// Puts the eye somewhere and turns it. A person who walks flies from there on.
    void look(const Vec3& eye, const Vec3& forward);
    /// Shows a box from outside. Counts as a jump.
    void look_at(const Box3& box);
    /// Orbits around a point, at first from an eye that looks towards it. Counts as a jump.
    void look_around(const Vec3& point, const Vec3& eye);
    void turn(double right, double up); ///< radians
    void set_move(Move to);             ///< counts as a jump
    void step(const Wish& wish, double seconds);
    /// Multiplies the speed, or the distance of an orbit, by e to the power of this.
    void change_speed(double by);
    /// The person passes through this part; {}: through none.
    void set_carried(WalkPart part);

    // ------------------------------------------------------------------------------ the parts ---
    /// The first visible part at a pixel: neither hidden nor a ghost, nor cut away.
    std::optional<Pick> pick(double x, double y);
    void choose(std::optional<std::uint32_t> part);
    [[nodiscard]] ViewPart facts(std::uint32_t part) const;   ///< its box: where it first was
    [[nodiscard]] std::string name(std::uint32_t part) const; ///< its name, or else its id
    [[nodiscard]] WalkPart walk_part(std::uint32_t part) const;
    [[nodiscard]] std::optional<std::uint32_t> index_of(WalkPart part) const;
    [[nodiscard]] Box3 box_of(std::uint32_t part); ///< where it is now
    [[nodiscard]] bool is_removed(std::uint32_t part) const;
    [[nodiscard]] std::size_t removed() const { return removed_.size(); } ///< parts of the store

    void colour(ColourBy by);
    /// Makes all other parts ghosts. With no parts, none is.
    void ghost_all_but(const std::vector<std::uint32_t>& parts);
    void ghost_all_but_group(std::uint32_t group); ///< of the legend
    /// No ghosts, nothing hidden, the colours of `colouring`, no section box of a clash.
    void show_all();
    [[nodiscard]] PartState state(std::uint32_t part) const;
    void set_state(std::uint32_t part, const PartState& state);
    [[nodiscard]] Colour colour_of(std::uint32_t part) const;
    /// The number of a part in the renderer.
    [[nodiscard]] std::uint32_t drawn_number(std::uint32_t part) const;
    /// Draws a part where the walk has it.
    void draw_moved(std::uint32_t part);
    /// Adds a part that is not in the store, in its own place. Returns its number.
    std::uint32_t bring_in(const Mesh& mesh, const std::string& file, const std::string& name);
    /// Takes a part out of this walk; the store keeps it.
    void remove(std::uint32_t part);

    /// Shows a clash from a viewpoint, with its section box. Returns false, and shows nothing, if a
    /// part of the clash is not in this walk. `learn_ids` must have read all ids.
    bool show_clash(const ListedClash& clash, const ClashViewpoint& from);
    /// Reads the ids of some more parts. Returns whether all are known.
    bool learn_ids(double seconds);
    [[nodiscard]] std::optional<std::uint32_t> part_of(const std::string& file,
                                                       const std::string& id) const;
    /// The part of an id or, if there is none, of a name. Reads the names of all parts.
    [[nodiscard]] std::optional<std::uint32_t> find(const std::string& id_or_name) const;

    // --------------------------------------------------------------------------- what is drawn ---
    /// Cuts away what is nearer than `plane_distance`.
    void add_plane();
    /// Cuts away what is above along an axis, at the middle of the model.
    void add_plane_across(int axis);
    /// Opens a box around the chosen part, or around all; closes it if there is one.
    void toggle_box();
    [[nodiscard]] RenderStyle style(bool still) const;
    /// Returns the frame to be drawn now. While the eye rests, budgets do not keep the picture
    /// coarse.
    const ViewFrame& frame(const Camera& camera, const Vec3& velocity = {}, bool rests = false);

    std::string path;
    Store store;
    View view;
    Walk walk;
    Renderer renderer;
    std::unique_ptr<Walker> walker;
    FramePace pace;
    std::uint64_t memory = 0; ///< of the limits

    Camera lens; ///< field of view, size and range
    Move move = Move::fly;
    double speed = 2; ///< metres a second
    double yaw = 0, pitch = 0;
    Vec3 target; ///< of an orbit
    double orbit_distance = 10;
    std::uint64_t jumps = 0; ///< times that the eye went somewhere without the way between

    std::optional<std::uint32_t> chosen;
    std::map<std::uint32_t, DrawnPart> moved;
    std::map<std::uint32_t, BroughtPart> brought;
    ColourBy colour_by = ColourBy::material;
    PartColouring colouring;
    std::vector<SectionPlane> sections;
    double plane_distance = 2; ///< metres from the eye, of a new section plane
    std::optional<Box3> section_box;
    std::optional<DistanceColours> distances;
    bool with_edges = true, with_ground = true, with_occlusion = true;
    std::vector<Mark> marks; ///< of this frame; tools add to it
    bool changed = true;     ///< something other than the camera, since the last picture

private:
    [[nodiscard]] Vec3 forward() const;
    [[nodiscard]] Vec3 eye() const;
    /// The horizontal direction of yaw 0.
    [[nodiscard]] Vec3 north() const;
    /// Puts a person on the floor that its eye was near, or, if there is none below, to where it
    /// looks, or into the middle.
    void stand(const Vec3& at);
    void make_walker(const Vec3& at);
    [[nodiscard]] bool is_cut(const Vec3& point) const;
    [[nodiscard]] std::vector<std::uint32_t> all_parts() const;

    bool box_is_of_clash_ = false; ///< who made the section box
    bool rested_ = false;          ///< in the last frame
    std::uint64_t seen_jumps_ = 0; ///< `jumps` in the last frame

    WalkPart carried_{};
    std::vector<std::uint32_t> removed_;                 ///< sorted
    std::unordered_map<std::string, std::uint32_t> ids_; ///< of file, line end and id: the part
    std::uint32_t next_id_ = 0;                          ///< the first part whose id is not in ids_
};

} // namespace abut::viewer
