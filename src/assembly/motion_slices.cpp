#include "assembly/motion_slices.h"

#include <abut/error.h>

#include "core/arguments.h"
#include "core/stop.h"
#include "math/vector.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

constexpr std::uint32_t kNone = AssemblyKinematics::kNone;
/// Bounds are enlarged by this share, which exceeds the rounding of their sums, and by how much a
/// place that is almost rigid may stretch lengths.
constexpr double kSpeedShare = 1e-5;
/// Least number of slices, and the largest angle that a joint turns in one.
constexpr double kLeastSlices = 96;
constexpr double kLargestTurn = 0.15;
/// Keeps long spins from taking all memory. Bounds then become worse, not wrong.
constexpr double kMostCuts = 200'000;
/// A slice is halved at most this often because of its loops.
constexpr int kMostHalvings = 12;
/// Motions that need more slices because of their loops are refused.
constexpr std::size_t kMostSlices = 4'000'000;

double distance_from_axis(const Vec3& point, const Vec3& centre, const Vec3& axis) {
    const Vec3 way = point - centre;
    return length(way - dot(way, axis) * axis);
}

} // namespace

SliceMotion::SliceMotion(const AssemblyKinematics& kinematics)
    : kinematics_(kinematics), places_(kinematics.size()), rates_(kinematics.size()),
      pin_turns_(kinematics.assembly().loops.size()) {}

void SliceMotion::set(const TimeSlice& slice, std::span<const std::uint32_t> parts) {
    half_ = 0.5 * (slice.end - slice.start);
    const double middle = slice.start + half_;
    is_bounded_ = true;
    kinematics_.place(middle, parts, places_);
    for (const std::uint32_t part : parts) {
        const std::uint32_t loop = kinematics_.loop_of(part);
        if (loop == kNone)
            rates_[part] = kinematics_.rate_at(part, middle);
        else
            bound_loop(loop);
    }
}

void SliceMotion::bound_loop(std::uint32_t loop) {
    const AssemblyLoop& l = kinematics_.assembly().loops[loop];
    const LoopGeometry& geometry = kinematics_.loop(loop);
    const std::uint32_t crank = kinematics_.parent(l.coupler);
    const std::uint32_t frame = kinematics_.parent(l.closer);
    const Vec3 pin = apply(place_of(crank), geometry.crank_pin());
    const Way way = walk(crank, frame, pin, 0, {});
    const double least = geometry.least_transmission(
        compose(inverse(place_of(frame)), place_of(crank)), way.speed * half_);
    // With this bound the loop closes at every time of the slice, so no later stage fails.
    if (!(least >= kLeastTransmission)) {
        is_bounded_ = false;
        return;
    }
    const double closer = way.speed / (geometry.closer_arm() * least);
    const double coupler = way.speed / (geometry.coupler_length() * least);
    rates_[l.closer] = geometry.slides() ? JointRate{closer, 0} : JointRate{0, closer};
    rates_[l.coupler] = {0, coupler + way.turn};
    pin_turns_[loop] = coupler + (geometry.slides() ? 0 : closer);
}

SliceMotion::Turning SliceMotion::joint(std::uint32_t part) const {
    const AssemblyJoint& of_part = kinematics_.assembly().parts[part].joint;
    const Transform& place = places_[part];
    Turning turning{apply(place, of_part.origin), {}, rates_[part]};
    if (of_part.type != AssemblyJointType::free)
        turning.axis = apply_linear(place, kinematics_.axis(part));
    return turning;
}

SliceMotion::Turning SliceMotion::pin_joint(std::uint32_t coupler) const {
    const std::uint32_t loop = kinematics_.loop_of(coupler);
    const AssemblyLoop& l = kinematics_.assembly().loops[loop];
    return {apply(places_[l.closer], l.pin),
            apply_linear(places_[coupler], kinematics_.axis(coupler)),
            {0, pin_turns_[loop]}};
}

SliceMotion::Way SliceMotion::walk(std::uint32_t from, std::uint32_t to, const Vec3& point,
                                   double radius, Detours detours) const {
    // `radius` bounds the distance of the body's points from `point`, during the whole slice, in
    // the frame that the walk has come to.
    Way way;
    const auto pass = [&](const Turning& turning) {
        const bool any_axis = length_sq(turning.axis) == 0;
        const double arm = any_axis ? length(point - turning.centre) + turning.rate.speed * half_
                                    : distance_from_axis(point, turning.centre, turning.axis);
        const double speed = turning.rate.speed + turning.rate.turn * (arm + radius);
        way.speed += speed;
        way.turn += turning.rate.turn;
        radius += speed * half_;
    };
    std::vector<Turning> down;
    const auto closer_of = [&](std::uint32_t coupler) {
        return kinematics_.assembly().loops[kinematics_.loop_of(coupler)].closer;
    };
    if (detours.from) {
        pass(pin_joint(from));
        from = closer_of(from);
    }
    if (detours.to) {
        down.push_back(pin_joint(to));
        to = closer_of(to);
    }
    while (from != to) {
        if (kinematics_.depth(from) >= kinematics_.depth(to)) {
            pass(joint(from));
            from = kinematics_.parent(from);
        } else {
            down.push_back(joint(to));
            to = kinematics_.parent(to);
        }
    }
    for (auto turning = down.rbegin(); turning != down.rend(); ++turning)
        pass(*turning);
    return way;
}

double SliceMotion::seen_from(const RobotBody& body, std::uint32_t other) const {
    const auto is_coupler = [&](std::uint32_t part) {
        const std::uint32_t loop = kinematics_.loop_of(part);
        return loop != kNone && kinematics_.assembly().loops[loop].coupler == part;
    };
    const Vec3 point = apply(places_[body.owner], body.centre);
    double least = walk(body.owner, other, point, body.radius, {}).speed;
    for (const Detours detours : {Detours{true, false}, {false, true}, {true, true}})
        if ((!detours.from || is_coupler(body.owner)) && (!detours.to || is_coupler(other)))
            least = std::min(least, walk(body.owner, other, point, body.radius, detours).speed);
    return least;
}

double SliceMotion::relative_speed(const RobotBody& a, const RobotBody& b) const {
    return std::min(seen_from(a, b.owner), seen_from(b, a.owner)) * (1 + kSpeedShare);
}

Box3 SliceMotion::swept_box(const RobotBody& body, const Transform& owner_from_model) const {
    const Transform place = compose(places_[body.owner], owner_from_model);
    Box3 box;
    for (int corner = 0; corner < 8; ++corner)
        extend(box, apply(place, {(corner & 1) != 0 ? body.box.upper.x : body.box.lower.x,
                                  (corner & 2) != 0 ? body.box.upper.y : body.box.lower.y,
                                  (corner & 4) != 0 ? body.box.upper.z : body.box.lower.z}));
    const Vec3 point = apply(places_[body.owner], body.centre);
    double speed = walk(body.owner, kNone, point, body.radius, {}).speed;
    const std::uint32_t loop = kinematics_.loop_of(body.owner);
    if (loop != kNone && kinematics_.assembly().loops[loop].coupler == body.owner)
        speed = std::min(speed, walk(body.owner, kNone, point, body.radius, {true, false}).speed);
    return grown(box, speed * half_ * (1 + kSpeedShare));
}

namespace {

/// Cuts the time between two keys by the rates of the joints.
void cut_evenly(const AssemblyKinematics& kinematics, double start, double end, double duration,
                std::vector<TimeSlice>& slices) {
    const double middle = 0.5 * (start + end);
    double turn = 0;
    for (std::uint32_t part = 0; part < kinematics.size(); ++part)
        if (kinematics.loop_of(part) == kNone)
            turn = std::max(turn, kinematics.rate_at(part, middle).turn);
    const double wanted = std::ceil(
        std::max(kLeastSlices * (end - start) / duration, turn * (end - start) / kLargestTurn));
    const auto count =
        static_cast<std::size_t>(std::clamp(wanted, 1.0, kMostCuts * (end - start) / duration + 1));
    double from = start;
    for (std::size_t i = 1; i <= count; ++i) {
        const double to = i == count ? end
                                     : start + (end - start) * static_cast<double>(i) /
                                                   static_cast<double>(count);
        if (to > from)
            slices.push_back({from, to});
        from = to;
    }
}

/// Halves a slice until its loops have bounds.
void cut_for_loops(const AssemblyKinematics& kinematics, SliceMotion& motion,
                   std::span<const std::uint32_t> parts, const TimeSlice& slice, int halvings,
                   std::vector<TimeSlice>& slices) {
    motion.set(slice, parts);
    if (motion.is_bounded()) {
        slices.push_back(slice);
        return;
    }
    const double middle = 0.5 * (slice.start + slice.end);
    require(halvings < kMostHalvings,
            "a loop cannot close, or comes to a dead point, near time " + std::to_string(middle));
    cut_for_loops(kinematics, motion, parts, {slice.start, middle}, halvings + 1, slices);
    cut_for_loops(kinematics, motion, parts, {middle, slice.end}, halvings + 1, slices);
}

} // namespace

std::vector<TimeSlice> cut_into_slices(const AssemblyKinematics& kinematics) {
    const std::vector<double>& times = kinematics.key_times();
    require(times.size() > 1, "no joint has two keys, so nothing moves");
    std::vector<TimeSlice> even;
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
        poll_stop();
        cut_evenly(kinematics, times[i], times[i + 1], times.back() - times.front(), even);
    }
    std::vector<bool> is_needed(kinematics.size());
    for (const AssemblyLoop& loop : kinematics.assembly().loops)
        for (const std::uint32_t need : kinematics.needed_for(loop.coupler, loop.closer))
            is_needed[need] = true;
    std::vector<std::uint32_t> parts;
    for (const std::uint32_t part : kinematics.order())
        if (is_needed[part])
            parts.push_back(part);
    if (parts.empty())
        return even;
    SliceMotion motion(kinematics);
    std::vector<TimeSlice> slices;
    for (const TimeSlice& slice : even) {
        poll_stop();
        cut_for_loops(kinematics, motion, parts, slice, 0, slices);
        require(slices.size() <= kMostSlices,
                "the loops turn too often for one query: take a shorter time");
    }
    return slices;
}

} // namespace abut
