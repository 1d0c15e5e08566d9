#pragma once

#include <abut/carry.h>
#include <abut/clash_review.h>
#include <abut/picture.h>
#include <abut/renderer.h>
#include <abut/tour.h>
#include <abut/view.h>
#include <abut/walk.h>
#include <abut/walker.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace abut::viewer {

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
    /// Puts the eye somewhere and turns it. The person stands below it.
    void look(const Vec3& eye, const Vec3& forward);
    void look_at(const Box3& box);
    void turn(double right, double up); ///< radians
    void set_move(Move to);
    void step(const Wish& wish, double seconds);

    std::optional<Pick> pick(double x, double y);
    void choose(std::optional<std::uint32_t> part);

    void colour(ColourBy by);
    /// Makes all other parts ghosts. With no parts, none is.
    void ghost_all_but(const std::vector<std::uint32_t>& parts);
    void set_state(std::uint32_t part, const PartState& state);
    void show_clash(const ListedClash& clash);

    /// Reads the ids of some more parts. Returns whether all are known.
    bool learn_ids(double seconds);
    [[nodiscard]] std::optional<std::uint32_t> part_of(const std::string& file,
                                                       const std::string& id) const;

    [[nodiscard]] RenderStyle style(bool still) const;

    std::string path;
    Store store;
    View view;
    Walk walk;
    Renderer renderer;
    std::unique_ptr<Walker> walker;

    Camera lens; ///< field of view, size and range
    Move move = Move::fly;
    double speed = 2; ///< metres a second
    double yaw = 0, pitch = 0;
    Vec3 target; ///< of an orbit
    double orbit_distance = 10;

    std::optional<std::uint32_t> chosen;
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

    std::vector<Colour> colours_;
    std::vector<std::pair<std::string, std::uint32_t>>
        ids_; ///< file, line end, id; sorted at the end
    double detail_ = 0.5;
};

} // namespace abut::viewer
