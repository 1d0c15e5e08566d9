#include "session/session.h"

#include <numbers>

namespace abut::viewer {

namespace {

constexpr double kMostPitch = 1.5;     ///< of the eye, radians
constexpr double kFieldOfView = 1.1;   ///< radians
constexpr double kLeastRange = 100;    ///< metres that are seen at least
constexpr double kRangeOfDiagonal = 4; ///< of the model's diagonal, that is seen
constexpr double kFast = 5;            ///< times the speed
constexpr double kNearestOrbit = 0.05, kNearestAim = 0.5, kFarOrbit = 10; ///< metres
constexpr double kNearOfOrbit = 0.2; ///< of the distance of an orbit, that the eye may see
constexpr double kSlowest = 0.05, kFastest = 200; ///< metres a second
/// Where a person is put down: before and above the point that it looked at.
constexpr double kAway = 0.5, kAbove = 0.02;
constexpr double kFlyingRadius = 0.2; ///< of the ball around an eye that flies

ViewOptions view_options(const Session::Limits& limits) {
    ViewOptions options;
    options.memory = limits.memory / 2;
    options.gpu_memory = limits.gpu_memory;
    options.pixel_error = limits.pixel_error;
    return options;
}

} // namespace

Session::Session(const std::string& store_path, const Limits& limits, std::uint32_t width,
                 std::uint32_t height)
    : path(store_path), store(open_store(store_path)), view(store, view_options(limits)),
      walk(store, {.memory = limits.memory / 2}), renderer(view.parts().size(), view.origin()),
      memory(limits.memory) {
    const Box3 bounds = view.bounds();
    lens.field_of_view = kFieldOfView;
    resize(width, height);
    lens.far = std::max(kLeastRange, kRangeOfDiagonal * diagonal(bounds));
    colour(ColourBy::material);
    make_walker(middle(bounds));
    look_at(bounds);
}

void Session::resize(std::uint32_t width, std::uint32_t height) {
    changed = true;
    lens.width = std::max(1U, width);
    lens.height = std::max(1U, height);
}

Vec3 Session::up() const {
    const UpAxis axis = view.up();
    return viewer::axis(static_cast<int>(axis));
}

Vec3 Session::north() const {
    return view.up() == UpAxis::z ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
}

Vec3 Session::forward() const {
    const Vec3 east = cross(north(), up());
    const Vec3 flat = std::cos(yaw) * north() + std::sin(yaw) * east;
    return std::cos(pitch) * flat + std::sin(pitch) * up();
}

Vec3 Session::eye() const {
    return move == Move::orbit ? target - orbit_distance * forward() : walker->state().eye;
}

Camera Session::camera() const {
    Camera camera = lens;
    camera.eye = eye();
    camera.forward = forward();
    camera.up = up();
    if (move == Move::orbit) // what is orbited is seen from however near
        camera.near = std::min(lens.near, kNearOfOrbit * orbit_distance);
    return camera;
}

void Session::look(const Vec3& at, const Vec3& towards) {
    if (move == Move::walk)
        set_move(Move::fly); // there may be no room for a whole person
    const Vec3 way = unit(towards);
    pitch = std::clamp(std::asin(std::clamp(dot(way, up()), -1.0, 1.0)), -kMostPitch, kMostPitch);
    const Vec3 flat = way - dot(way, up()) * up();
    if (length(flat) > 1e-6)
        yaw = std::atan2(dot(flat, cross(north(), up())), dot(flat, north()));
    const WalkerState& state = walker->state();
    walker->move_to(at - (dot(state.eye - state.feet, up())) * up());
    target = at + orbit_distance * forward();
}

void Session::look_at(const Box3& box) {
    ++jumps;
    const Vec3 way = unit(0.8 * north() + -0.6 * cross(north(), up()) + -0.45 * up());
    const Camera seen = look_at_box(box, way, up(), lens);
    target = middle(box);
    orbit_distance = std::max(kNearestAim, length(seen.eye - target));
    look(seen.eye, way);
}

void Session::look_around(const Vec3& point, const Vec3& eye) {
    ++jumps;
    move = Move::orbit;
    orbit_distance = std::max(kNearestOrbit, length(point - eye));
    look(eye, point - eye);
    target = point;
}

void Session::turn(double right, double up_by) {
    yaw = std::remainder(yaw + right, 2 * std::numbers::pi);
    pitch = std::clamp(pitch + up_by, -kMostPitch, kMostPitch);
}

void Session::set_move(Move to) {
    if (to == move)
        return;
    ++jumps;
    if (to == Move::orbit) {
        const HitPart ahead = walk.first_hit({eye(), forward()});
        orbit_distance =
            ahead.meet ? std::max(kNearestAim, length(ahead.point - eye())) : kFarOrbit;
        target = eye() + orbit_distance * forward();
    } else if (move == Move::orbit) {
        look(eye(), forward());
    }
    const Vec3 at = eye();
    move = to;
    if (to != Move::orbit)
        make_walker(at);
    if (to == Move::walk)
        stand(at);
}

void Session::make_walker(const Vec3& at) {
    WalkerOptions options;
    options.up = view.up();
    options.except = carried_;
    if (move != Move::walk) {
        options.mode = WalkerMode::fly;
        options.radius = kFlyingRadius;
        options.height = options.ducked_height = 2 * kFlyingRadius;
        options.eye_height = options.ducked_eye_height = kFlyingRadius;
    }
    walker = std::make_unique<Walker>(walk, at - options.eye_height * up(), options);
}

void Session::change_speed(double by) {
    if (move == Move::orbit)
        orbit_distance = std::clamp(orbit_distance * std::exp(-0.5 * by), kNearestOrbit, lens.far);
    else
        speed = std::clamp(speed * std::exp(by), kSlowest, kFastest);
}

void Session::set_carried(WalkPart part) {
    carried_ = part;
    walker->set_except(part);
}

void Session::stand(const Vec3& at) {
    if (const HitPart below = walk.first_hit({at, -1.0 * up()}); below.meet) {
        // The feet of an eye that flew low are not in the floor.
        if (dot(below.point - walker->state().feet, up()) > 0)
            walker->move_to(below.point + kAbove * up());
        return;
    }
    if (const HitPart ahead = walk.first_hit({at, forward()}); ahead.meet) {
        const Vec3 flat = unit(forward() - dot(forward(), up()) * up());
        walker->move_to(ahead.point - kAway * flat + kAbove * up());
        return;
    }
    const Box3 bounds = view.bounds();
    const Vec3 top = middle(bounds) + diagonal(bounds) * up();
    if (const HitPart below = walk.first_hit({top, -1.0 * up()}); below.meet)
        walker->move_to(below.point + kAbove * up());
}

void Session::step(const Wish& wish, double seconds) {
    const Vec3 ahead = forward(), aside = unit(cross(ahead, up()));
    const double rate = speed * (wish.fast ? kFast : 1);
    if (move == Move::orbit) {
        orbit_distance =
            std::max(kNearestOrbit, orbit_distance * std::exp(-wish.forward * seconds));
        target = target + (rate * seconds) * (wish.right * aside + wish.up * up());
        walk.move_to(eye());
        return;
    }
    const Vec3 flat = move == Move::walk ? unit(ahead - dot(ahead, up()) * up()) : ahead;
    walker->step(rate * (wish.forward * flat + wish.right * aside + wish.up * up()), seconds,
                 wish.duck, wish.jump);
}

} // namespace abut::viewer
