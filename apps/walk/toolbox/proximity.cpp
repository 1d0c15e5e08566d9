#include "toolbox/proximity.h"

#include <chrono>

namespace abut::viewer {

namespace {

const WalkQuery kSkip{.missing = MissingParts::skip};
constexpr double kBodyRadius = 0.2, kBodyBelowEye = 0.6; ///< metres

} // namespace

std::string name_of(Session& session, WalkPart part) {
    const auto index = session.index_of(part);
    if (!index)
        return "part";
    const ViewPart found = session.facts(*index);
    return session.name(*index) + (found.type.empty() ? "" : " (" + found.type + ")");
}

bool Proximity::is_of_part(const Session& session) const {
    return of_chosen && session.chosen.has_value();
}

Capsule Proximity::body(const Session& session) {
    const bool stands = session.move == Move::walk;
    return Capsule{{stands ? -kBodyBelowEye * session.up() : Vec3{}, {}}, kBodyRadius};
}

void Proximity::update(Session& session) {
    const auto start = std::chrono::steady_clock::now();
    nearest.reset();
    near.clear();
    if (!on)
        return;
    NearestPart found;
    NearParts parts;
    if (is_of_part(session)) {
        const WalkPart part = session.walk_part(*session.chosen);
        found = session.walk.distance(part, kSkip);
        if (with_list)
            parts = session.walk.within(part, reach, kSkip);
    } else {
        const Camera camera = session.camera();
        const Probe probe(body(session));
        found = session.walk.distance(probe, Pose{camera.eye}, kSkip);
        if (with_list)
            parts = session.walk.within(probe, Pose{camera.eye}, reach, kSkip);
    }
    if (found.found)
        nearest = found.gap;
    complete = found.complete && parts.complete;
    near = std::move(parts.parts);
    std::stable_sort(near.begin(), near.end(),
                     [](const WalkGap& a, const WalkGap& b) { return a.distance < b.distance; });
    milliseconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() * 1e3;
}

void Proximity::colour(Session& session) {
    session.distances.reset();
    if (!colours) {
        model_.reset();
        coloured_.reset();
        return;
    }
    if (is_of_part(session)) {
        const std::uint32_t part = *session.chosen;
        const WalkPart number = session.walk_part(part);
        if (coloured_ != part) {
            model_ = session.walk.model(number);
            coloured_ = part;
        }
        session.distances = distances_from(session.drawn_number(part), *model_,
                                           session.walk.world_from_part(number), reach);
        return;
    }
    const Capsule person = body(session);
    const Vec3 eye = session.camera().eye, a = eye + person.axis.a, b = eye + person.axis.b;
    const Vec3 along = b - a;
    const double length_sq = dot(along, along), radius = person.radius;
    DistanceColours by_person;
    by_person.reach = reach;
    by_person.distance = [=](std::uint32_t, const Vec3& point) {
        const double t =
            length_sq > 0 ? std::clamp(dot(point - a, along) / length_sq, 0.0, 1.0) : 0;
        return std::max(0.0, length(point - (a + t * along)) - radius);
    };
    session.distances = std::move(by_person);
}

} // namespace abut::viewer
