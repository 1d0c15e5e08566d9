#include "toolbox/carrying.h"

#include <abut/error.h>
#include <abut/scene.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <limits>

namespace abut::viewer {

namespace {

constexpr Colour kTouching{226, 48, 40}, kClose{255, 170, 0}, kFree{90, 170, 100};
constexpr double kNearestHand = 0.05;            ///< metres before the eye
constexpr std::uint64_t kMostPathQueries = 4000; ///< of a report: a second or two
constexpr std::uint64_t kDepthSteps = 2000;      ///< while a part moves: a few milliseconds
constexpr double kBeyond = 1e-3;                 ///< metres that the way out goes beyond the depth

} // namespace

const char* to_string(CarryMode mode) {
    static constexpr std::array kNames{"through", "stop", "slide"};
    return kNames.at(static_cast<std::size_t>(mode));
}

Vec3 Carrying::middle_at(const Pose& pose) const {
    return apply(Transform(pose), middle_);
}

Pose Carrying::placed_at(const Vec3& middle, const Quaternion& rotation) const {
    return {middle - apply(Transform(Pose{{}, rotation}), middle_), rotation};
}

void Carrying::take(Session& session, std::uint32_t chosen) {
    put_down(session);
    carry = std::make_unique<Carry>(session.walk, session.walk_part(chosen));
    part = chosen;
    try {
        session.draw_moved(chosen);
    } catch (...) {
        carry.reset();
        throw;
    }
    Box3 box;
    for (const Vec3& p : carry->carried().model.mesh().positions) {
        box.lower = {std::min(box.lower.x, p.x), std::min(box.lower.y, p.y),
                     std::min(box.lower.z, p.z)};
        box.upper = {std::max(box.upper.x, p.x), std::max(box.upper.y, p.y),
                     std::max(box.upper.z, p.z)};
    }
    middle_ = middle(box);
    session.set_carried(carry->part());
    way.assign(1, carry->state().pose);
    report.reset();
    take_anew(session);
    must_step_ = true;
    session.changed = true;
}

void Carrying::take_anew(const Session& session) {
    const Pose& pose = carry->state().pose;
    const Camera camera = session.camera();
    const Vec3 forward = unit(camera.forward), at = middle_at(pose);
    ahead_ = std::max(kNearestHand, dot(at - camera.eye, forward));
    aside_ = at - (camera.eye + ahead_ * forward);
    rotation_ = pose.rotation;
    jumps_ = session.jumps;
    last_wanted_ = wanted(session);
    at_rest = false;
}

void Carrying::forget(Session& session) {
    carry.reset();
    drag.reset();
    hovered.reset();
    session.set_carried({});
    session.changed = true;
}

void Carrying::put_down(Session& session) {
    if (!carry)
        return;
    PartState state = session.state(part);
    state.colour = session.colour_of(part);
    session.set_state(part, state);
    forget(session);
}

void Carrying::remove(Session& session) {
    const std::uint32_t gone = part;
    forget(session);
    session.remove(gone);
}

void Carrying::set_mode(Session& session, CarryMode to) {
    mode = to;
    if (!carry)
        return;
    take_anew(session);
    must_step_ = true;
}

void Carrying::next_mode(Session& session) {
    set_mode(session, mode == CarryMode::stop    ? CarryMode::slide
                      : mode == CarryMode::slide ? CarryMode::through
                                                 : CarryMode::stop);
}

void Carrying::bring_in(const std::string& path) {
    if (is_reading())
        return;
    brought_ = std::make_shared<Brought>();
    reading.start([path, to = brought_](const Progress& progress) {
        const ModelPath model = parse_model_path(path);
        ReadOptions options;
        options.progress = progress;
        const Scene scene = read_scene(model, options);
        to->mesh = to_mesh(scene);
        to->file = model.path;
        to->name = std::filesystem::path(model.path).filename().string();
        if (to->mesh.triangles.empty())
            throw Error(ErrorCode::bad_mesh, path, "has no triangles");
    });
}

Pose Carrying::wanted(const Session& session) const {
    const Camera camera = session.camera();
    return placed_at(camera.eye + ahead_ * unit(camera.forward) + aside_, rotation_);
}

void Carrying::update(Session& session) {
    if (reading.has_ended()) {
        if (!reading.error().empty())
            throw Error(ErrorCode::unreadable, reading.error());
        const std::uint32_t number =
            session.bring_in(brought_->mesh, brought_->file, brought_->name);
        brought_.reset();
        session.choose(number);
        take(session, number);
    }
    if (!carry)
        return;
    if (session.jumps != jumps_)
        take_anew(session);
    try {
        step(session);
    } catch (const Error&) {
        forget(session); // it was removed
        throw;
    }
}

void Carrying::step(Session& session) {
    const Pose to = wanted(session), from = carry->state().pose;
    const bool moves = must_step_ || !(to.translation == last_wanted_.translation &&
                                       to.rotation == last_wanted_.rotation);
    if (!moves && at_rest && !carry->state().waits && carry->state().complete)
        return;
    CarryOptions options;
    options.mode = mode;
    options.clearance = clearance;
    options.missing = MissingParts::skip;
    if (moves) // depths take longest, so they are complete once it rests
        options.depth_steps = kDepthSteps;
    last_wanted_ = to;
    must_step_ = false;
    at_rest = !moves;
    const Pose& now = carry->move_to(to, options).pose;
    if (!(now.translation == from.translation && now.rotation == from.rotation))
        way.push_back(now);
    show(session);
}

void Carrying::show(Session& session) {
    const CarryStep& now = carry->state();
    session.draw_moved(part);
    PartState state = session.state(part);
    state.colour = !now.touched.empty() || now.blocked ? kTouching
                   : !now.near.empty()                 ? kClose
                                                       : kFree;
    session.set_state(part, state);
}

void Carrying::turn(const Vec3& about, double radians) {
    rotation_ = product(rotation_about(unit(about), radians), rotation_);
}

void Carrying::push(double metres) {
    ahead_ = std::max(kNearestHand, ahead_ + metres);
}

void Carrying::straighten() {
    rotation_ = way.front().rotation;
}

bool Carrying::move_out(Session& session) {
    const std::vector<WalkGap>& touched = carry->state().touched;
    const auto deepest =
        std::min_element(touched.begin(), touched.end(), [](const WalkGap& a, const WalkGap& b) {
            return a.distance < b.distance;
        });
    if (deepest == touched.end() || !(deepest->distance < 0))
        return false;
    Pose out = carry->state().pose;
    out.translation = out.translation + (kBeyond - deepest->distance) * deepest->normal;
    CarryOptions options;
    options.mode = CarryMode::through;
    options.clearance = clearance;
    options.missing = MissingParts::skip;
    carry->move_to(out, options);
    way.push_back(out);
    take_anew(session);
    show(session);
    return true;
}

Gizmo Carrying::gizmo(const Session& session) const {
    return gizmo_at(session.camera(), middle_at(carry->state().pose));
}

void Carrying::hover(const Session& session, const ScreenPoint& at) {
    hovered.reset();
    if (carry && !drag)
        hovered = handle_at(session.camera(), gizmo(session), at);
}

bool Carrying::begin_drag(const Session& session, const ScreenPoint& at) {
    if (!carry)
        return false;
    const Camera camera = session.camera();
    const Gizmo handles = gizmo(session);
    const auto handle = handle_at(camera, handles, at);
    if (!handle)
        return false;
    take_anew(session);
    drag.emplace(camera, handles, *handle, at);
    drag_middle_ = handles.middle;
    drag_rotation_ = rotation_;
    return true;
}

void Carrying::continue_drag(const Session& session, const ScreenPoint& at) {
    if (!carry || !drag)
        return;
    const Camera camera = session.camera();
    const double amount = drag->amount(camera, at);
    const Vec3 along = axis(axis_of(drag->handle()));
    if (!is_move(drag->handle())) {
        rotation_ = product(rotation_about(along, amount), drag_rotation_);
        return;
    }
    aside_ = drag_middle_ + amount * along - (camera.eye + ahead_ * unit(camera.forward));
}

void Carrying::end_drag(const Session& session) {
    if (carry && drag)
        take_anew(session);
    drag.reset();
}

void Carrying::check_way(Session& session) {
    if (!carry || way.size() < 2)
        throw Error(ErrorCode::bad_argument, "nothing was carried yet: there is no way to check");
    PathOptions options;
    options.except = carry->part();
    options.max_queries = kMostPathQueries;
    report = check_path(session.walk, carry->probe(), way, options);
}

void Carrying::write_report(Session& session, const std::string& path) const {
    std::ofstream to(path);
    to << to_json(report.value(), session.walk) << '\n';
    if (!to.flush())
        throw Error(ErrorCode::cannot_write, path, "cannot be written");
}

} // namespace abut::viewer
