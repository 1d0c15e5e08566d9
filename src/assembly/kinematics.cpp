#include "assembly/kinematics.h"

#include <abut/error.h>

#include "articulated/kinematics.h"
#include "core/arguments.h"
#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace abut {

namespace {

/// Values at keys may exceed the limits by this: rounding of decimal input.
constexpr double kLimitTolerance = 1e-9;
constexpr double kRigidTolerance = 1e-6;
/// The squares of a shorter axis would lose digits.
constexpr double kShortestAxis = 1e-140;
/// Seconds: keys that are nearer in time would make rates that overflow.
constexpr double kShortestSpan = 1e-30;

bool has_one_value(AssemblyJointType type) {
    return type == AssemblyJointType::revolute || type == AssemblyJointType::prismatic;
}

bool is_rigid(const Transform& t) {
    const Stretch stretch = stretch_of(t);
    return stretch.least > 1 - kRigidTolerance && stretch.most < 1 + kRigidTolerance;
}

bool is_usable(double value) {
    return std::abs(value) <= kLargestValue; // false for NaN
}

/// The turn about the axis through a point.
Transform turn_about(const Vec3& axis, double angle, const Vec3& origin) {
    const Transform turn = rotation_about(axis, angle, {});
    return translated(turn, origin - apply_linear(turn, origin));
}

} // namespace

std::size_t key_before(const std::vector<double>& times, double time) {
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    return after == times.begin() ? 0 : static_cast<std::size_t>(after - times.begin()) - 1;
}

AssemblyKinematics::AssemblyKinematics(const Assembly& assembly)
    : assembly_(assembly), loop_of_(assembly.parts.size(), kNone), axes_(assembly.parts.size()),
      free_motions_(assembly.parts.size()) {
    for (std::uint32_t i = 0; i < size(); ++i)
        check_part(i);
    for (std::uint32_t i = 0; i < size(); ++i) {
        const AssemblyJoint& joint = assembly.parts[i].joint;
        axes_[i] = normalized_or_zero(joint.axis);
        for (std::size_t k = 0; k + 1 < joint.keys.poses.size(); ++k)
            free_motions_[i].push_back(
                Motion::between(joint.keys.poses[k], joint.keys.poses[k + 1], joint.origin));
        key_times_.insert(key_times_.end(), joint.keys.times.begin(), joint.keys.times.end());
    }
    for (std::uint32_t i = 0; i < assembly.loops.size(); ++i)
        check_loop(i);
    for (const auto& [a, b] : assembly.ignored)
        require(a < size() && b < size(), "an ignored pair names a part that is out of range");
    std::ranges::sort(key_times_);
    key_times_.erase(std::unique(key_times_.begin(), key_times_.end()), key_times_.end());
    sort_parts();
    group_parts();
}

void AssemblyKinematics::fail(std::uint32_t part, const std::string& what) const {
    throw Error(ErrorCode::bad_argument, "part '" + assembly_.parts[part].name + "': " + what);
}

void AssemblyKinematics::check_part(std::uint32_t part) const {
    const AssemblyPart& p = assembly_.parts[part];
    const AssemblyJoint& joint = p.joint;
    const auto check = [&](bool condition, std::string_view what) {
        if (!condition)
            fail(part, std::string(what));
    };
    check(!p.on || *p.on < size(), "hangs on a part that is out of range");
    check(std::ranges::all_of(p.place.m, is_usable) && is_rigid(p.place),
          "its place is not a rigid transform");
    check(is_usable(max_abs(joint.origin)) && is_finite(joint.origin), "its origin is not finite");
    check(is_finite(joint.axis) && length(joint.axis) > kShortestAxis &&
              std::isfinite(length(joint.axis)),
          "its axis has length 0, or is not finite");
    check(joint.limits.lower <= joint.limits.upper, "its limits leave no value");
    const JointKeys& keys = joint.keys;
    const bool one = has_one_value(joint.type);
    check(keys.times.size() == (one ? keys.values.size() : keys.poses.size()) &&
              (one ? keys.poses : std::vector<Pose>()).empty() &&
              (one ? std::vector<double>() : keys.values).empty(),
          "does not have one value, or one pose, for each time");
    check(keys.times.empty() || joint.type != AssemblyJointType::fixed,
          "has keys, but its joint is fixed");
    for (std::size_t k = 0; k < keys.times.size(); ++k) {
        check(is_usable(keys.times[k]), "a time is not finite or is beyond 1e9");
        if (k > 0 && !(keys.times[k] - keys.times[k - 1] >= kShortestSpan))
            fail(part, "its times do not ascend: " + std::to_string(keys.times[k]) + " follows " +
                           std::to_string(keys.times[k - 1]));
    }
    for (const Pose& pose : keys.poses)
        check(is_usable(max_abs(pose.translation)) && is_finite(pose.translation),
              "a pose is not finite or is beyond 1e9");
    const auto check_value = [&](double value) {
        check(is_usable(value), "a value is not finite or is beyond 1e9");
        if (value < joint.limits.lower - kLimitTolerance ||
            value > joint.limits.upper + kLimitTolerance)
            fail(part, "the value " + std::to_string(value) +
                           " (radians or metres) is beyond its limits");
    };
    std::ranges::for_each(keys.values, check_value);
    if (!joint.follow) {
        if (one && keys.values.empty())
            check_value(0);
        return;
    }
    check(one && keys.times.empty(), "follows another joint, so it is revolute or prismatic, "
                                     "without keys");
    check(joint.follow->part < size(), "follows a part that is out of range");
    const AssemblyJoint& source = assembly_.parts[joint.follow->part].joint;
    check(has_one_value(source.type) && !source.follow && !source.keys.times.empty(),
          "follows '" + assembly_.parts[joint.follow->part].name +
              "', whose joint must be revolute or prismatic, and have keys");
    for (const double value : source.keys.values)
        check_value(joint.follow->ratio * value + joint.follow->offset);
}

void AssemblyKinematics::check_loop(std::uint32_t loop) {
    const AssemblyLoop& l = assembly_.loops[loop];
    require(l.coupler < size() && l.closer < size() && l.coupler != l.closer,
            "a loop names a part that is out of range, or one part twice");
    for (const std::uint32_t part : {l.coupler, l.closer}) {
        const AssemblyJoint& joint = assembly_.parts[part].joint;
        if (loop_of_[part] != kNone)
            fail(part, "is part of two loops");
        if (!joint.keys.times.empty() || joint.follow || std::isfinite(joint.limits.lower) ||
            std::isfinite(joint.limits.upper))
            fail(part, "is part of a loop, which determines its value: it has no keys, no limits "
                       "and follows nothing");
        if (part == l.coupler ? joint.type != AssemblyJointType::revolute
                              : !has_one_value(joint.type))
            fail(part, part == l.coupler ? "is the coupler of a loop: its joint must be revolute"
                                         : "is the closer of a loop: its joint must be revolute or "
                                           "prismatic");
        loop_of_[part] = loop;
    }
    if (!is_finite(l.pin) || !is_usable(max_abs(l.pin)))
        fail(l.coupler, "the pin of its loop is not finite");
    try {
        loops_.emplace_back(assembly_, l, axes_[l.coupler], axes_[l.closer]);
    } catch (const Error& error) {
        fail(l.coupler, std::string("its loop: ") + error.what());
    }
}

std::vector<std::uint32_t> AssemblyKinematics::needs_of(std::uint32_t part) const {
    std::vector<std::uint32_t> needs;
    const auto add = [&](std::uint32_t each) {
        if (assembly_.parts[each].on)
            needs.push_back(*assembly_.parts[each].on);
    };
    add(part);
    if (loop_of_[part] != kNone) {
        add(assembly_.loops[loop_of_[part]].coupler);
        add(assembly_.loops[loop_of_[part]].closer);
    }
    return needs;
}

/// Orders the parts by depth-first search without recursion.
void AssemblyKinematics::sort_parts() {
    enum class State : std::uint8_t { fresh, open, done };
    std::vector<State> states(size(), State::fresh);
    std::vector<std::uint32_t> stack;
    for (std::uint32_t root = 0; root < size(); ++root) {
        if (states[root] == State::fresh)
            stack.push_back(root);
        while (!stack.empty()) {
            const std::uint32_t part = stack.back();
            if (states[part] != State::fresh) {
                stack.pop_back();
                if (states[part] == State::open)
                    order_.push_back(part);
                states[part] = State::done;
                continue;
            }
            states[part] = State::open;
            for (const std::uint32_t need : needs_of(part)) {
                if (states[need] == State::open)
                    fail(part, "hangs on itself, by way of '" + assembly_.parts[need].name +
                                   "': the parts make a cycle");
                if (states[need] == State::fresh)
                    stack.push_back(need);
            }
        }
    }
}

bool AssemblyKinematics::moves(std::uint32_t part) const {
    const AssemblyJoint& joint = assembly_.parts[part].joint;
    return joint.type != AssemblyJointType::fixed &&
           (joint.keys.times.size() > 1 || joint.follow || loop_of_[part] != kNone);
}

void AssemblyKinematics::group_parts() {
    rank_.resize(size());
    for (std::uint32_t i = 0; i < size(); ++i)
        rank_[order_[i]] = i;
    depth_.resize(size());
    for (const std::uint32_t part : order_)
        if (const auto& on = assembly_.parts[part].on)
            depth_[part] = depth_[*on] + 1;
        else
            depth_[part] = 1;
    // Group 0 is the world; others have the number of their topmost part, plus one.
    group_.resize(size());
    for (const std::uint32_t part : order_) {
        const auto& on = assembly_.parts[part].on;
        group_[part] = moves(part) ? part + 1 : on ? group_[*on] : 0;
    }
}

std::vector<std::uint32_t> AssemblyKinematics::needed_for(std::uint32_t a, std::uint32_t b) const {
    std::vector<std::uint32_t> stack{a, b};
    std::vector<std::uint32_t> found;
    while (!stack.empty()) {
        const std::uint32_t part = stack.back();
        stack.pop_back();
        if (std::ranges::find(found, part) != found.end())
            continue;
        found.push_back(part);
        for (const std::uint32_t need : needs_of(part))
            stack.push_back(need);
        // Bounds of a coupler's speed also look at its closer.
        if (loop_of_[part] != kNone)
            stack.push_back(assembly_.loops[loop_of_[part]].closer);
    }
    std::ranges::sort(found, {}, [&](std::uint32_t part) { return rank_[part]; });
    return found;
}

bool AssemblyKinematics::are_joined(std::uint32_t a, std::uint32_t b) const {
    if (assembly_.parts[a].on == b || assembly_.parts[b].on == a)
        return true;
    const std::uint32_t loop = loop_of_[a];
    return loop != kNone && loop == loop_of_[b];
}

double AssemblyKinematics::value_at(std::uint32_t part, double time) const {
    const AssemblyJoint& joint = assembly_.parts[part].joint;
    if (joint.follow)
        return joint.follow->ratio * value_at(joint.follow->part, time) + joint.follow->offset;
    const JointKeys& keys = joint.keys;
    if (keys.times.empty())
        return 0;
    const std::size_t k = key_before(keys.times, time);
    if (time <= keys.times.front() || k + 1 >= keys.times.size())
        return keys.values[k];
    const double share = (time - keys.times[k]) / (keys.times[k + 1] - keys.times[k]);
    return keys.values[k] + share * (keys.values[k + 1] - keys.values[k]);
}

Transform AssemblyKinematics::own_motion(std::uint32_t part, double time) const {
    const AssemblyJoint& joint = assembly_.parts[part].joint;
    switch (joint.type) {
    case AssemblyJointType::fixed:
        return {};
    case AssemblyJointType::revolute:
        return turn_about(axes_[part], value_at(part, time), joint.origin);
    case AssemblyJointType::prismatic:
        return translated(Transform(), value_at(part, time) * axes_[part]);
    case AssemblyJointType::free:
        break;
    }
    const JointKeys& keys = joint.keys;
    if (keys.times.empty())
        return {};
    const std::size_t k = key_before(keys.times, time);
    if (time <= keys.times.front() || k + 1 >= keys.times.size())
        return Transform(keys.poses[k]);
    return at(free_motions_[part][k], (time - keys.times[k]) / (keys.times[k + 1] - keys.times[k]));
}

void AssemblyKinematics::place(double time, std::span<const std::uint32_t> parts,
                               std::vector<Transform>& displacements) const {
    const Transform world;
    const auto parent = [&](std::uint32_t part) -> const Transform& {
        const auto& on = assembly_.parts[part].on;
        return on ? displacements[*on] : world;
    };
    for (const std::uint32_t part : parts) {
        const std::uint32_t loop = loop_of_[part];
        if (loop == kNone) {
            displacements[part] = compose(parent(part), own_motion(part, time));
            continue;
        }
        const AssemblyLoop& l = assembly_.loops[loop];
        const LoopState state =
            loops_[loop].solve(compose(inverse(parent(l.closer)), parent(l.coupler)));
        if (state.transmission == 0)
            fail(l.coupler, "its loop cannot close at time " + std::to_string(time) +
                                ", is at a dead point, or leaves its plane");
        const bool slides = part == l.closer && loops_[loop].slides();
        const double value = part == l.coupler ? state.coupler : state.closer;
        displacements[part] =
            compose(parent(part),
                    slides ? translated(Transform(), value * axes_[part])
                           : turn_about(axes_[part], value, assembly_.parts[part].joint.origin));
    }
}

JointRate AssemblyKinematics::rate_at(std::uint32_t part, double time) const {
    const AssemblyJoint& joint = assembly_.parts[part].joint;
    if (joint.follow) {
        const AssemblyJoint& source = assembly_.parts[joint.follow->part].joint;
        const JointRate rate = rate_at(joint.follow->part, time);
        const double size = std::abs(joint.follow->ratio) *
                            (source.type == AssemblyJointType::revolute ? rate.turn : rate.speed);
        return joint.type == AssemblyJointType::revolute ? JointRate{0, size} : JointRate{size, 0};
    }
    const JointKeys& keys = joint.keys;
    if (keys.times.empty() || time < keys.times.front() || time > keys.times.back())
        return {};
    if (keys.times.size() < 2)
        return {};
    const std::size_t k = std::min(key_before(keys.times, time), keys.times.size() - 2);
    const double span = keys.times[k + 1] - keys.times[k];
    if (joint.type == AssemblyJointType::free) {
        const Motion& motion = free_motions_[part][k];
        return {length(motion.velocity) / span, length(motion.angular_velocity) / span};
    }
    const double rate = std::abs(keys.values[k + 1] - keys.values[k]) / span;
    return joint.type == AssemblyJointType::revolute ? JointRate{0, rate} : JointRate{rate, 0};
}

std::vector<Transform> part_transforms(const Assembly& assembly, double time) {
    require(is_usable(time), "the time is not finite or is beyond 1e9");
    const AssemblyKinematics kinematics(assembly);
    std::vector<Transform> places(assembly.parts.size());
    kinematics.place(time, kinematics.order(), places);
    for (std::size_t i = 0; i < places.size(); ++i)
        places[i] = compose(places[i], assembly.parts[i].place);
    return places;
}

std::pair<double, double> time_range(const Assembly& assembly) {
    const AssemblyKinematics kinematics(assembly);
    require(!kinematics.key_times().empty(), "no joint has keys, so nothing moves");
    return {kinematics.key_times().front(), kinematics.key_times().back()};
}

const char* to_string(AssemblyJointType type) {
    switch (type) {
    case AssemblyJointType::revolute:
        return "revolute";
    case AssemblyJointType::prismatic:
        return "prismatic";
    case AssemblyJointType::free:
        return "free";
    default:
        return "fixed";
    }
}

const char* to_string(MotionClashKind kind) {
    return kind == MotionClashKind::contact ? "contact" : "clearance";
}

} // namespace abut
