#include "tools.h"

#include <abut/error.h>
#include <abut/rigid.h>

#include "vec.h"

#include <chrono>
#include <fmt/format.h>

namespace abut::viewer {

namespace {

constexpr Colour kNearColour{255, 170, 0}, kTouchColour{226, 48, 40}, kMeasureColour{0, 140, 255};
const WalkQuery kSkip{.missing = MissingParts::skip};

Vec3 up_of(const Session& session) {
    const UpAxis up = session.view.up();
    return {up == UpAxis::x ? 1.0 : 0, up == UpAxis::y ? 1.0 : 0, up == UpAxis::z ? 1.0 : 0};
}

} // namespace

std::string name_of(Session& session, WalkPart part) {
    const auto index = session.view.index_of(part.number);
    if (!index)
        return "part";
    const ViewPart found = session.view.part(*index);
    return (found.name.empty() ? found.id : found.name) +
           (found.type.empty() ? "" : " (" + found.type + ")");
}

void Proximity::update(Session& session) {
    const auto start = std::chrono::steady_clock::now();
    nearest.reset();
    near.clear();
    if (!on)
        return;
    NearestPart found;
    NearParts parts;
    if (of_chosen && session.chosen) {
        const WalkPart part{session.view.parts()[*session.chosen]};
        found = session.walk.distance(part, kSkip);
        if (with_list)
            parts = session.walk.within(part, reach, kSkip);
    } else {
        // The upper body: the floor that the person stands on is not of interest.
        const Camera camera = session.camera();
        const Vec3 up = up_of(session);
        const bool stands = session.move == Move::walk;
        const Probe body(Capsule{{stands ? -0.6 * up : Vec3{}, {}}, 0.2});
        found = session.walk.distance(body, Pose{camera.eye}, kSkip);
        if (with_list)
            parts = session.walk.within(body, Pose{camera.eye}, reach, kSkip);
    }
    if (found.found)
        nearest = found.gap;
    complete = found.complete && parts.complete;
    near = std::move(parts.parts);
    std::sort(near.begin(), near.end(),
              [](const WalkGap& a, const WalkGap& b) { return a.distance < b.distance; });
    milliseconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() * 1e3;
}

void Measure::clear() {
    picks.clear();
    result.clear();
    has_ends = false;
}

void Measure::take(Session& session, const Pick& pick) {
    if (picks.size() == 2)
        clear();
    picks.push_back(pick);
    if (picks.size() < 2)
        return;
    const auto part = [&](const Pick& each) { return WalkPart{session.view.parts()[each.part]}; };
    const Pick &a = picks[0], &b = picks[1];
    has_ends = true;
    if (kind == Measured::points) {
        ends = {a.point, b.point};
        result = fmt::format("{:.6g} m between the points", length(b.point - a.point));
        return;
    }
    const Model model_b = session.walk.model(part(b));
    const Transform place_b = session.walk.world_from_part(part(b));
    if (kind == Measured::point_part) {
        const Nearest found = nearest(model_b, place_b, a.point);
        ends = {a.point, found.point};
        result = fmt::format("{:.6g} m from the point to the part", found.distance);
        return;
    }
    const Gap gap = distance(session.walk.model(part(a)), session.walk.world_from_part(part(a)),
                             model_b, place_b);
    ends = {gap.point_a, gap.point_b};
    result = fmt::format("{:.6g} m between the parts", gap.distance);
    if (gap.distance > 0)
        return;
    const NearParts deep = session.walk.penetration(part(a));
    for (const WalkGap& each : deep.parts)
        if (each.part == part(b))
            result = fmt::format("the parts meet, {:.6g} m deep", -each.distance);
}

void Carrying::take(Session& session, std::uint32_t chosen) {
    put_down(session);
    const WalkPart number{session.view.parts()[chosen]};
    carry = std::make_unique<Carry>(session.walk, number);
    part = chosen;
    try {
        session.draw_moved(chosen);
    } catch (...) {
        carry.reset();
        throw;
    }
    const Camera camera = session.camera();
    const Vec3 forward = unit(camera.forward);
    ahead = dot(middle(session.box_of(chosen)) - camera.eye, forward);
    aside = carry->carried().pose.translation - (camera.eye + ahead * forward);
    session.set_carried(number);
    way_begin(session);
}

void Carrying::put_down(Session& session) {
    if (!carry)
        return;
    carry.reset();
    PartState state = session.state(part);
    state.colour = session.colour_of(part);
    session.set_state(part, state);
    session.set_carried({});
}

Vec3 Carrying::wanted(const Session& session) const {
    const Camera camera = session.camera();
    return camera.eye + ahead * unit(camera.forward) + aside;
}

/// Steps of depths while a part moves: a few milliseconds.
constexpr std::uint64_t kDepthSteps = 2000;

void Carrying::update(Session& session) {
    if (!carry)
        return;
    const Vec3 to = wanted(session);
    const bool moves = !(to == wanted_) || mode != last_mode_;
    const CarryStep& last = carry->state();
    if (!moves && at_rest && !last.waits && last.complete)
        return;
    CarryOptions options;
    options.mode = mode;
    options.missing = MissingParts::skip;
    if (moves) // depths take longest, so they are complete once it rests
        options.depth_steps = kDepthSteps;
    const Vec3 from = last.pose.translation;
    Pose pose = last.pose;
    pose.translation = to;
    wanted_ = to, last_mode_ = mode;
    at_rest = !moves;
    carry->move_to(pose, options);
    if (!(carry->state().pose.translation == from))
        way.push_back(carry->state().pose);
    if (moves || !(carry->state().pose.translation == from) || at_rest)
        show(session);
}

void Carrying::show(Session& session) {
    const CarryStep& step = carry->state();
    session.draw_moved(part);
    PartState state = session.state(part);
    state.colour = !step.touched.empty() || step.blocked ? kTouchColour
                   : !step.near.empty()                  ? kNearColour
                                                         : Colour{90, 170, 100};
    session.set_state(part, state);
}

void Carrying::way_begin(Session& session) {
    way.assign(1, carry->carried().pose);
    wanted_ = wanted(session);
    at_rest = false;
    report.reset();
    session.changed = true;
}

void Carrying::check_way(Session& session) {
    if (!carry || way.size() < 2)
        return;
    PathOptions options;
    options.except = carry->part();
    report = check_path(session.walk, carry->probe(), way, options);
}

void Viewpoints::save(Session& session) {
    const std::size_t count = saved.points.size();
    record(saved, static_cast<double>(count), session.camera(), fmt::format("view {}", count + 1));
}

void Viewpoints::visit(Session& session, std::size_t which) {
    replaying = false;
    session.look(saved.points[which].eye, saved.points[which].forward);
    next = (which + 1) % saved.points.size();
}

void Viewpoints::visit_next(Session& session) {
    if (!saved.points.empty())
        visit(session, next);
}

void Viewpoints::toggle_recording() {
    recording = !recording;
    replaying = false;
    if (recording)
        path = {}, clock = 0;
}

void Viewpoints::replay() {
    if (recording || path.points.empty())
        return;
    replaying = true;
    clock = 0;
}

void Viewpoints::update(Session& session, double seconds) {
    if (!recording && !replaying)
        return;
    clock += seconds;
    if (recording) {
        record(path, clock, session.camera());
        return;
    }
    const Camera camera = camera_at(path, clock, session.lens);
    session.look(camera.eye, camera.forward);
    replaying = clock < duration(path);
}

void ClashList::read(Session& session) {
    try {
        reviews = review_clashes(session.store);
        message = reviews.empty() ? "no clash job has finished" : "";
    } catch (const Error& error) {
        message = error.what();
    }
    is_read = true;
}

void ClashList::mark(Session& session, const MarkChanges& changes) {
    try {
        mark_clashes(open_store(session.path, {.read_only = false}), changes);
        read(session);
    } catch (const Error& error) {
        message = error.what();
    }
}

void ClashList::show_next(Session& session) {
    if (!is_read)
        read(session);
    const ListedClash* first = nullptr;
    bool was_shown = false;
    for (const ClashReview& review : reviews)
        for (const ListedClash& clash : review.clashes) {
            if (was_shown) {
                wanted = clash;
                return;
            }
            first = first == nullptr ? &clash : first;
            was_shown = shown == clash.id;
        }
    if (first != nullptr)
        wanted = *first;
}

void ClashList::update(Session& session) {
    if (!wanted || !session.learn_ids(0.005))
        return;
    shown = wanted->id;
    message = session.show_clash(*wanted) ? "" : "a part of this clash is not in the store";
    wanted.reset();
}

void Tools::add_marks(Session& session) const {
    const auto add = [&](const Vec3& a, const Vec3& b, const Colour& colour) {
        session.marks.push_back({a, b, colour, 3});
        session.marks.push_back({a, a, colour, 8});
        session.marks.push_back({b, b, colour, 8});
    };
    if (proximity.on && proximity.nearest)
        add(proximity.nearest->point_part, proximity.nearest->point_probe,
            proximity.nearest->distance > 0 ? kNearColour : kTouchColour);
    if (measure.has_ends)
        add(measure.ends[0], measure.ends[1], kMeasureColour);
    for (const Pick& pick : measure.picks)
        session.marks.push_back({pick.point, pick.point, kMeasureColour, 8});
    if (carrying.carry) {
        for (const WalkGap& gap : carrying.carry->state().touched)
            add(gap.point_part, gap.point_probe, kTouchColour);
        for (const WalkGap& gap : carrying.carry->state().near)
            add(gap.point_part, gap.point_probe, kNearColour);
        for (const PartImpact& impact : carrying.carry->state().contacts)
            session.marks.push_back({impact.point_part, impact.point_part, kTouchColour, 10});
    }
}

} // namespace abut::viewer
