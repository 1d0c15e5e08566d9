#include "view/walker/person.h"

#include "core/arguments.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

const WalkerOptions& checked_walker(const WalkerOptions& o) {
    const auto is_length = [](double v) { return v > 0 && v <= 1e6; };
    require(is_length(o.height) && is_length(o.radius) && is_length(o.ducked_height) &&
                o.ducked_height <= o.height,
            "size of the walker must be positive, and the ducked height at most the height");
    require(is_length(o.skin), "skin of the walker must be positive");
    require_not_negative(o.step_height, "step height");
    require_not_negative(o.gravity, "gravity");
    require_not_negative(o.jump_speed, "jump speed");
    require_not_negative(o.eye_height, "eye height");
    require_not_negative(o.ducked_eye_height, "eye height");
    require(o.steepest >= 0 && o.steepest < 1.57,
            "steepest floor must be an angle below 90 degrees");
    require(o.step_height <= 1e6 && o.gravity <= 1e6 && o.jump_speed <= 1e6,
            "options of the walker must be finite");
    return o;
}

Vec3 person_axis(UpAxis up) {
    return up == UpAxis::x ? Vec3{1, 0, 0} : up == UpAxis::y ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
}

Capsule upright_capsule(const Vec3& up, double height, double radius) {
    const double r = std::min(radius, 0.5 * height);
    return {{r * up, (height - r) * up}, r};
}

/// A body goes back from a contact by at most this many skins along its way.
constexpr double kSkinsAhead = 4;
/// Radius of the ball that feels for a floor behind an edge, and how far behind and above the edge
/// it starts, in skins.
constexpr double kToeRadius = 0.5, kToeBehind = 1, kToeAbove = 3;

} // namespace

Person::Person(Walk& walk, const WalkerOptions& options)
    : walk_(walk), options_(checked_walker(options)), up_(person_axis(options.up)),
      flat_(std::cos(options.steepest) - 1e-3), middle_height_(0.5 * options.ducked_height),
      standing_(upright_capsule(up_, options.height, options.radius)),
      ducked_(upright_capsule(up_, options.ducked_height, options.radius)),
      toe_(Sphere{{}, kToeRadius * options.skin}) {
    const Vec3 centre = middle_height_ * up_;
    const double r = std::min(options.radius, middle_height_);
    for (const double share : {0.5, 0.2, 0.05, 0.005, 0.0})
        thin_.emplace_back(Sphere{centre, share * r});
}

Capsule Person::capsule(bool ducked) const {
    return upright_capsule(up_, ducked ? options_.ducked_height : options_.height, options_.radius);
}

WalkQuery Person::query() const {
    WalkQuery query;
    query.missing = options_.missing;
    query.except = options_.except;
    query.mode = ContactMode::first;
    query.absolute_error = 1e-3 * options_.skin;
    return query;
}

Advance Person::advance(const Probe& body, Vec3& feet, const Vec3& way) {
    Advance result;
    const double size = length(way);
    if (!(size > 0))
        return result;
    // Looks ahead, so that the skin is kept also where the way ends just before a contact.
    const double ahead = kSkinsAhead * options_.skin, seen = size + ahead;
    const FirstContact contact = walk_.sweep(body, Pose{feet}, (seen / size) * way, query());
    if (contact.meet && contact.complete) {
        result.impact = contact.impact;
        result.distance = contact.time_free * seen;
        result.overlaps = contact.impact.time == 0 && contact.impact.gap == 0;
        // The skin is measured across the contact.
        const double slope = -dot(way, contact.impact.normal) / size;
        const double back = slope > 0 ? std::min(options_.skin / slope, ahead) : ahead;
        result.hit = result.distance - back < size;
        result.share = std::clamp((result.distance - back) / size, 0.0, 1.0);
    } else if (!contact.complete) {
        result.distance = contact.time_free * seen;
        result.waits = result.distance - options_.skin < size;
        result.share = std::clamp((result.distance - options_.skin) / size, 0.0, 1.0);
    }
    feet = feet + result.share * way;
    return result;
}

bool Person::can_stand_on(const PartImpact& impact, const Vec3& feet) {
    if (is_flat(impact.normal))
        return true;
    const Vec3 outward = normalized_or_zero(horizontal(impact.point_part - feet));
    if (dot(impact.normal, up_) <= 0 || outward == Vec3{})
        return false;
    const double skin = options_.skin;
    Vec3 toe = impact.point_part + kToeBehind * skin * outward + kToeAbove * skin * up_;
    const Vec3 way = -2 * kToeAbove * skin * up_;
    const FirstContact contact = walk_.sweep(toe_, Pose{toe}, way, query());
    return contact.meet && contact.complete && contact.impact.time > 0 &&
           is_flat(contact.impact.normal);
}

} // namespace abut
