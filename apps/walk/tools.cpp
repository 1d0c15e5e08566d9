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
    const WalkPart number{session.view.parts()[chosen]};
    carry = std::make_unique<Carry>(session.walk, number);
    part = chosen;
    const Camera camera = session.camera();
    const Vec3 place = middle(session.view.part(chosen).box);
    const Vec3 forward = unit(camera.forward);
    ahead = dot(place - camera.eye, forward);
    const Vec3 held = camera.eye + ahead * forward;
    aside = carry->carried().pose.translation - held;
    PartState state = session.renderer.state(chosen);
    if (const auto found = drawn_as.find(chosen); found != drawn_as.end()) {
        drawn = found->second;
    } else {
        state.highlighted = false;
        drawn = session.renderer.add_part(session.walk.model(number).mesh(),
                                          session.walk.world_from_part(number), state);
        drawn_as.emplace(chosen, drawn);
        state.hidden = true;
        session.set_state(chosen, state);
    }
    session.walker->set_except(number);
    way_begin(session);
}

void Carrying::put_down(Session& session) {
    carry.reset();
    session.walker->set_except({});
    session.changed = true;
}

void Carrying::update(Session& session) {
    if (!carry)
        return;
    const Camera camera = session.camera();
    Pose wanted = carry->state().pose;
    wanted.translation = camera.eye + ahead * unit(camera.forward) + aside;
    if (length(wanted.translation - carry->state().pose.translation) < 1e-9)
        return;
    CarryOptions options;
    options.mode = mode;
    options.missing = MissingParts::skip;
    const CarryStep& step = carry->move_to(wanted, options);
    session.renderer.move_part(drawn, session.walk.world_from_part(carry->part()));
    PartState state = session.renderer.state(drawn);
    state.colour = !step.touched.empty() || step.blocked ? kTouchColour
                   : !step.near.empty()                  ? kNearColour
                                                         : Colour{90, 170, 100};
    session.renderer.set_state(drawn, state);
    way.push_back(step.pose);
    session.changed = true;
}

void Carrying::way_begin(Session& session) {
    way.assign(1, carry->carried().pose);
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
